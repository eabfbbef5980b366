// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PLAN_ENCODE_OPTIONS_H_
#define ANICODEC_CODEC_PLAN_ENCODE_OPTIONS_H_

#include "codec/connectivity/attribute_encode.h"
#include "codec/keyframes/keyframe_selection.h"
#include "codec/massage/massage.h"
#include "codec/plan/target.h"
#include "codec/segment/encoded_segment.h"
#include "codec/segment/keyframe_poses.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/records.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace anicodec {

enum class BasisChoice : uint8_t { kAuto, kKeyframes, kEigenshapes, kEigentrajectories };

/// How frames are made from key-frames: on straight lines, by multi-scale geometry interpolation
/// (MSGI), which decoders may lack, or by whichever does better.
enum class InterpolationChoice : uint8_t { kLinear, kMsgi, kAuto };

/// How long to search for a small file. kFirst takes the first one that keeps the target: of live streams.
enum class Effort : uint8_t { kFirst, kFast, kNormal, kBest };

/// The effort below, kFirst at least.
constexpr Effort less(Effort effort) {
  return effort == Effort::kFirst ? effort : static_cast<Effort>(static_cast<int>(effort) - 1);
}

/// How far a surface was moved before coding: its Hausdorff distance from the source's, in scene
/// units.
struct SurfaceChange {
  double mean = 0;
  double max = 0;
};

/// How the search goes about a basis.
struct SearchOptions {
  BasisChoice basis = BasisChoice::kAuto;
  std::optional<uint32_t> keyframes;  ///< exact number of key-frames
  KeyframeMethod select = KeyframeMethod::kPivot;
  KeyframePoses keyframe_poses = KeyframePoses::kNative;
  /// As a rule kLinear between key-frames that are asked for. The search for the smallest basis takes MSGI
  /// where limbs swing so far that it makes a file a tenth smaller; kLinear: never.
  std::optional<InterpolationChoice> interpolation;
  Effort effort = Effort::kNormal;
  /// Searches for the fewest bytes, whatever opening takes; else a millisecond of it, as estimated, is worth
  /// some: bytes_per_nanosecond().
  bool smallest = false;
};

/// Properties of a file that its records hold.
struct FileOptions {
  OrderMode order = OrderMode::kVertices;
  std::string encoder;  ///< name and version
  /// The sequence is not the source itself but one whose surface was moved: by massage(), or to other faces.
  std::optional<SurfaceChange> surface_change;
};

/// Options that are the same for every mesh, and relative to none.
struct CodingOptions : SearchOptions, FileOptions {
  AttributeOptions attributes;
  std::string metadata;  ///< a JSON object to store in the file (spec/06, section 14); empty: none
  bool bounds = true;    ///< whether the file has boxes of its frames, to cull it without decoding
  /// Takes the motion of the whole out of the positions, where there is any, and stores it apart.
  bool root_motion = false;
  /// Bases of eigenshapes and eigentrajectories lean on this pose, of a file that the clip goes to. Null: on
  /// any.
  std::shared_ptr<const EncodedPose> pose;
  /// Features that the search of eigenshapes and eigentrajectories leaves out, by the names of
  /// search_means(): to measure the worth of each.
  std::vector<std::string> without;
  /// Most bytes of memory (docs/memory.md): OverMemory where more would be held, fewer threads before; 0: any.
  uint64_t most_bytes = 0;
};

enum class MassageMode : uint8_t { kOff, kOn, kAuto };

/// Whether to massage() first. kAuto: where the file becomes smaller (massage_choice.h).
struct MassageChoice {
  MassageMode mode = MassageMode::kOff;
  MassageOptions options;
};

struct EncodeOptions : CodingOptions {
  Target target;              ///< kNone: only with `keyframes`
  std::optional<Target> cap;  ///< a maximum error beside another target
  MassageChoice massage;
  /// Encodes these frames alone, as a part for join_clips(): mesh, reference pose and diagonal are
  /// those of the whole sequence, and the same in all parts. Not with key-frames.
  std::optional<FrameRun> part;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PLAN_ENCODE_OPTIONS_H_
