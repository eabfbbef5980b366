// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Unreal's tool writes a header of this name.
#pragma once
#undef GENERATED_BODY
#define GENERATED_BODY()                                                                    \
 public:                                                                                    \
  using Super = UObject;                                                                    \
  static UClass* StaticClass() {                                                            \
    static UClass made;                                                                     \
    made.make = []() -> std::unique_ptr<UObject> { return std::make_unique<UAnicClip>(); }; \
    return &made;                                                                           \
  }                                                                                         \
                                                                                            \
 private:
