// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_EDIT_CLIPS_H_
#define ANICODEC_CODEC_FILE_EDIT_CLIPS_H_

#include "codec/file/join_clips.h"
#include "codec/segment/encoded_segment.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/bytes.h"
#include "format/records.h"

#include <memory>
#include <string>
#include <vector>

namespace anicodec {

/// Properties of a file that a clip added to it must share.
struct ClipHome {
  OrderMode order = OrderMode::kVertices;
  uint8_t up = 0;
  double metres_per_unit = 0;
  Point origin{};
  ErrorMetric asked = ErrorMetric::kNone;  ///< of the last clip
  double asked_value = 0;
  std::vector<std::string> names;           ///< of the clips that are there
  std::shared_ptr<const EncodedPose> pose;  ///< of the mesh; null: the file has none
};

/// Reads it. Throws Error: kCorrupt; kUnsupported for a file of several meshes.
ClipHome clip_home(const ClipPart& file);

/// A file of the clips of `file` and, behind them, those of `added`, whose mesh and order must be
/// the same bytes. No payload of a segment changes; a pose of the mesh that both have is stored once. Attributes
/// are those of `file`. The result has been opened and its hashes checked. Throws Error: kInput for
/// another connectivity or a name that is there, kCorrupt.
Bytes add_clips(const ClipPart& file, const ClipPart& added);

/// A file without some of its clips, at least one of which stays. Segments of these clips go;
/// payloads of the others stay as they are. Throws Error: kUsage for a name that is not there, for
/// all clips, and for a clip that shares a segment with one that stays; kCorrupt.
Bytes remove_clips(const ClipPart& file, const std::vector<std::string>& names);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_EDIT_CLIPS_H_
