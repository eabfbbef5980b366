// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_ENCODE_OPTIONS_H_
#define ANICODEC_CODEC_FILE_ENCODE_OPTIONS_H_

#include "codec/connectivity/attribute_encode.h"
#include "codec/file/target.h"
#include "codec/keyframes/keyframe_selection.h"
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

class KeptLearning;

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

struct EncodeOptions {
  Target target;              ///< kNone: only with `keyframes`
  std::optional<Target> cap;  ///< a maximum error beside another target
  BasisChoice basis = BasisChoice::kAuto;
  std::optional<uint32_t> keyframes;  ///< exact number of key-frames
  KeyframeMethod select = KeyframeMethod::kPivot;
  KeyframePoses keyframe_poses = KeyframePoses::kNative;
  /// As a rule kLinear between key-frames that are asked for. The search for the smallest basis takes MSGI
  /// where limbs swing so far that it makes a file a tenth smaller; kLinear: never.
  std::optional<InterpolationChoice> interpolation;
  OrderMode order = OrderMode::kVertices;
  /// Encodes these frames alone, as a part for join_clips(): mesh, reference pose and diagonal are
  /// those of the whole sequence, and the same in all parts. Not with key-frames.
  std::optional<FrameRun> part;
  std::string metadata;  ///< a JSON object to store in the file (spec/06, section 14); empty: none
  bool bounds = true;    ///< whether the file has boxes of its frames, to cull it without decoding
  std::string encoder;   ///< name and version to store in the file
  /// The sequence is not the source itself but one that massage() made of it: to store in the file.
  std::optional<SurfaceChange> surface_change;
  /// Takes the motion of the whole out of the positions, where there is any, and stores it apart.
  bool root_motion = false;
  /// Bases of eigenshapes and eigentrajectories lean on this pose, of a file that the clip goes to. Null: on
  /// any.
  std::shared_ptr<const EncodedPose> pose;
  /// The mesh and attributes of the file that the clip goes to. Attributes of the sequence are
  /// ignored, except for the moving ones that `stored` lists. Null: it is laid out.
  std::shared_ptr<const MeshLayout> layout;
  std::shared_ptr<const std::vector<StoredAttribute>> stored;
  /// Learnt from the files of a live stream before this one: its segment goes on there, and leaves what it learns
  /// itself. Null: segments begin anew.
  KeptLearning* learning = nullptr;
  AttributeOptions attributes;
  Effort effort = Effort::kNormal;
  /// Features that the search of eigenshapes and eigentrajectories leaves out, by the names of
  /// search_means(): to measure the worth of each.
  std::vector<std::string> without;
  /// Most bytes of memory (docs/memory.md): OverMemory where more would be held, fewer threads before; 0: any.
  uint64_t most_bytes = 0;
  /// Searches for the fewest bytes, whatever opening takes; else a millisecond of it, as estimated, is worth
  /// some: bytes_per_nanosecond().
  bool smallest = false;
};

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

/// The encoded clip and what is known about it. Errors are measured on the decoded file.
struct EncodeResult {
  Bytes file;
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
  std::vector<Trial> trials;
  std::vector<std::string> search_notes;  ///< what the search left alone, and why
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_ENCODE_OPTIONS_H_
