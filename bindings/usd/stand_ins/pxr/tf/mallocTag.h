// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Stands in for OpenUSD's header of this name: memory is not tagged. The inline parts of that
// header refer to symbols that come and go with releases (26.8 has one, 26.11 lacks it), and tags
// serve profiling alone.
#ifndef ANICODEC_BINDINGS_USD_STAND_INS_MALLOC_TAG_H_
#define ANICODEC_BINDINGS_USD_STAND_INS_MALLOC_TAG_H_

#include <cstdint>
#include <cstdlib>
#include <iosfwd>
#include <new>
#include <string>
#include <vector>

#include <pxr/tf/api.h>
#include <pxr/tf/pxr.h>

TF_NAMESPACE_OPEN_SCOPE

class TfMallocTag {
 public:
  struct Auto {
    template <class... Names>
    explicit Auto(Names&&... /*names*/) {}

    // Not trivial, so that a tag that is never looked at is no warning.
    ~Auto() {}  // NOLINT

    void Release() {}
  };

  struct StackState {};

  struct StackOverride {
    template <class... States>
    explicit StackOverride(States&&... /*states*/) {}

    ~StackOverride() {}  // NOLINT
  };

  static bool IsInitialized() { return false; }

  static StackState GetCurrentStackState() { return {}; }
};

using TfAutoMallocTag = TfMallocTag::Auto;
using TfAutoMallocTag2 = TfMallocTag::Auto;
#define TF_MALLOC_TAG_NEW(name1, name2)

TF_NAMESPACE_CLOSE_SCOPE

#endif  // ANICODEC_BINDINGS_USD_STAND_INS_MALLOC_TAG_H_
