// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PLAN_ENCODE_RESULT_H_
#define ANICODEC_CODEC_PLAN_ENCODE_RESULT_H_

#include "codec/plan/encode_options.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/bytes.h"
#include "format/records.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anicodec {

/// One encoding that the search tried: for `-v`.
struct Trial {
  std::string what;
  uint64_t bytes = 0;
  double rmse = 0;
  double max_error = 0;
};

/// How an attribute whose values change came out.
struct AttributeResult {
  AttributeKind kind = AttributeKind::kCustom;
  std::string name;
  uint32_t number = 0;      ///< in the file
  uint32_t components = 0;  ///< of its basis; 0: it stays within the error of the first frame
  size_t bytes = 0;         ///< of its segments
  double asked = 0;         ///< largest error allowed
  double max_error = 0;     ///< measured, of a single number
  double rmse = 0;
};

/// How a clip of several came out.
struct ClipResult {
  std::string name;
  uint32_t frames = 0;
  FrameRate rate = {};
  double kg = 0;                      ///< per cent
  double rmse = 0;                    ///< scene units
  double max_error = 0;               ///< scene units
  double max_displacement_error = 0;  ///< of a move from frame to frame, scene units
  double diagonal = 0;
};

/// The massage that was done, and the reason.
struct MassageVerdict {
  std::optional<SurfaceChange> change;  ///< none: the file holds the source
  uint64_t sample_plain_bytes = 0;      ///< kAuto: of the sample frames
  uint64_t sample_massaged_bytes = 0;   ///< the same, massaged; 0: not possible
  uint64_t plain_bytes = 0;             ///< kAuto: of the whole clip; 0: not tried
};

/// The encoded clip and what is known about it. Errors are measured on the decoded file.
struct EncodeResult {
  Bytes file;
  uint32_t meshes = 1;
  uint32_t vertices = 0;  ///< of the source; of several meshes, in the frame that shows most
  uint32_t faces = 0;
  uint32_t frames = 0;
  FrameRate rate = {};     ///< the source's; average one of uneven times
  uint64_t positions = 0;  ///< vertices of all frames together
  BasisKind kind = BasisKind::kKeyframes;
  uint32_t components = 0;
  double kg = 0;                            ///< per cent
  double rmse = 0;                          ///< scene units
  double max_error = 0;                     ///< scene units
  double max_displacement_error = 0;        ///< of a move from frame to frame, scene units
  double diagonal = 0;                      ///< of the box around all frames of all clips
  std::vector<AttributeResult> attributes;  ///< those that change
  std::vector<ClipResult> clips;            ///< in the order of their frames
  std::vector<FrameRun> segments;           ///< of positions: clips in one share its basis
  MassageVerdict massage;
  std::vector<Trial> trials;
  std::vector<std::string> search_notes;  ///< what the search left alone, and why
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PLAN_ENCODE_RESULT_H_
