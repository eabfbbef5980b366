// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_ENCODING_ENCODE_REPORT_H_
#define ANICODEC_TOOLS_ENCODING_ENCODE_REPORT_H_

#include "codec/plan/encode_result.h"

#include <cstddef>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace anicodec::tools {

/// The words of `encode` about a file that it has written.
struct EncodeReport {
  const std::string& path;
  const EncodeResult& result;
  bool massage_was_choice = false;  ///< --massage auto
  bool rate_asked = false;          ///< --fps
  size_t glb_bytes = 0;             ///< of the scene that carries the clip; 0: it stands alone
  std::span<const std::string> notes = {};  ///< what of the input is not kept

  nlohmann::ordered_json json() const;

  /// `verbosity` above 0: what was tried, too.
  void print_text(int verbosity) const;

  void print_clips(int verbosity) const;
  const char* origin_of(const FrameRate& rate) const;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_ENCODING_ENCODE_REPORT_H_
