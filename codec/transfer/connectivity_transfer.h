// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// One connectivity for meshes that share none (thesis section 3.3.4).
#ifndef ANICODEC_CODEC_TRANSFER_CONNECTIVITY_TRANSFER_H_
#define ANICODEC_CODEC_TRANSFER_CONNECTIVITY_TRANSFER_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/transfer/registration.h"
#include "codec/transfer/remesh_fit.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace anicodec {

/// Gives the mesh of a frame. Asked for frames in order, each once.
using SurfaceSource = std::function<SurfaceFrame(uint32_t frame)>;

/// Why a carried mesh is not to be trusted.
enum class TransferAlarm : uint8_t {
  kDistance = 1,    ///< part of one surface has no counterpart in the other
  kTurned = 2,      ///< triangles face against the surface
  kDistortion = 4,  ///< the triangles have lost their shapes
  kDropped = 8,     ///< too many correspondences disagree
};

struct TransferOptions {
  /// Alarm: largest distance of the surfaces, both ways, in per cent of the diagonal, or in mean
  /// edges of the frame if that is more: so far a mesh does not know its own surface.
  double distance = 0.5, edges = 0.65;
  double turned = 0.2;      ///< alarm: per cent of the triangles
  double conformal = 1.15;  ///< alarm: mean conformal distortion from the segment's first frame
  double dropped = 5;       ///< alarm: per cent of the correspondences
  int rounds = 14;          ///< of registration
  /// Makes the mesh to carry from the one that begins a segment, such as one of fewer vertices;
  /// empty: the mesh itself.
  std::function<SurfaceFrame(const SurfaceFrame& frame)> first_mesh;
};

struct TransferredFrame {
  bool first = false;        ///< of a segment: the mesh as given, or made by first_mesh
  int attempts = 0;          ///< 0 for the first of a segment
  uint8_t alarms = 0;        ///< of the best attempt, bits of TransferAlarm
  double mean = 0, max = 0;  ///< symmetric Hausdorff distance, scene units
  double tried_mean = 0;     ///< of the best attempt, whether it was accepted or not
  double turned = 0;         ///< per cent of the triangles
  double conformal = 1;
  double dropped = 0;  ///< per cent
};

/// Frames first_frame, first_frame + 1, ... of the input with the connectivity of the first one.
struct TransferSegment {
  uint32_t first_frame = 0;
  MeshSequence sequence;
};

struct TransferResult {
  std::vector<TransferSegment> segments;
  std::vector<TransferredFrame> frames;
  double diagonal = 0;  ///< of the largest box around a frame
};

/// Carries the connectivity of the first mesh through the others: each is reached from the mesh
/// before, or from where its last move leads on, by Registration with the segment's first frame as
/// rigid shape, and brought close by fit_distance(), softly where that raises no alarm; the next
/// frame starts from before the soft fit, so that shapes lost to it do not add up. A frame that
/// raises an alarm is tried again, up to six times: what moved slowly and fits in the attempt that has distorted
/// least is taken for right, and tells by distances over the surface where the rest belongs (geodesic_landmarks());
/// there the mesh is brought without regard to the surface (Registration::pose()) before it is
/// registered, so that a leg finds itself however far it went. If it still raises one, it starts a
/// new segment with its own connectivity, or with what first_mesh makes of it. Memory: the result
/// and two meshes. Throws Error(kInput) naming the frame for a mesh without triangles, and as
/// check_openings() of what is carried and a mesh. Stage "transferring".
TransferResult transfer_connectivity(const SurfaceSource& source, uint32_t frame_count,
                                     const TransferOptions& options, const Progress& progress = {});

/// The alarms in words: "distance, turned".
std::string alarm_names(uint8_t alarms);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_CONNECTIVITY_TRANSFER_H_
