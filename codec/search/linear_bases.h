// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_LINEAR_BASES_H_
#define ANICODEC_CODEC_SEARCH_LINEAR_BASES_H_

#include "codec/search/encoder_input.h"
#include "codec/search/linear_choice.h"
#include "codec/segment/linear_basis.h"
#include "codec/segment/reference_pose_encode.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>

namespace anicodec {

/// Bases of a kind, with their coded poses and the regions of the surface: trials share them. They are made when first
/// asked for, within the memory that is allowed.
class LinearBases {
 public:
  static constexpr size_t kMostComponents = 2000;

  /// `input` and `analysis` must outlive this object. Opening of a coded pose has a price, unless the `smallest` file is
  /// wanted.
  LinearBases(const EncoderInput& input, const LinearAnalysis& analysis, BasisKind kind,
              Effort effort, bool smallest);

  /// From now on bases are over this pose, which the file has already. Before the first basis.
  void share_pose(std::shared_ptr<const EncodedPose> pose);

  /// The pose that the file has; null: none.
  const std::shared_ptr<const EncodedPose>& shared_pose() const { return pose_; }

  /// The basis of a choice with choice.components_made components in each region, at most kMostComponents, or as many as
  /// there are. Stays valid. Safe for threads. Throws OverMemory. Cost: that of LinearAnalysis::basis() once.
  const LinearBasis& basis(const LinearChoice& choice) { return made(choice).basis; }

  /// The pose that the file has, or that of the choice's basis at the step of its settings. Safe for threads.
  std::shared_ptr<const EncodedPose> coded_pose(const LinearChoice& choice);

  /// Takes the memory for the regions of a choice. Throws OverMemory.
  void reserve(const LinearChoice& cut);

  /// Finds the regions of some choices, for which memory was taken, and the motion in them, at the same time.
  void analyse(std::span<const LinearChoice> cuts);

  /// Takes over the regions that another clip of the mesh was cut into.
  void cut_like(const LinearBases& other, uint32_t regions);

 private:
  struct Made {
    MemoryShare memory;
    LinearBasis basis;
    // No std::once_flag: glibc ends the process where a function of one throws and there is no memory to unwind.
    std::mutex mutex;                                            ///< of both poses
    std::optional<ReferencePoseEncoder> pose;                    ///< of the basis
    std::map<double, std::shared_ptr<const EncodedPose>> poses;  ///< by their step
  };

  /// A cut of the surface, and the analysis of this clip by it.
  struct Regions {
    Vector<uint8_t> of_vertex;
    std::optional<MemoryShare> memory;
    std::unique_ptr<RegionAnalysis> analysis;  ///< made when needed
  };

  Made& made(const LinearChoice& choice);
  /// The space of trajectories that components of regions are found in.
  const std::shared_ptr<const Eigen::MatrixXd>& space(const LinearChoice& cut);
  const RegionAnalysis& analysis_of(const LinearChoice& cut);

  /// A pose chosen elsewhere; null: none.
  const Eigen::MatrixXd* given() const { return pose_ ? &given_pose_ : nullptr; }

  const EncoderInput& input_;
  const LinearAnalysis& analysis_;
  BasisKind kind_;
  Effort effort_;
  bool smallest_;
  std::shared_ptr<const EncodedPose> pose_;
  Eigen::MatrixXd given_pose_;
  std::mutex mutex_;
  /// By pose, base, regions and the most components that one of them has.
  std::map<std::tuple<ReferencePose, Base, uint32_t, size_t>, Made> made_;
  std::map<uint32_t, Regions> regions_;  ///< by their number
  std::shared_ptr<const Eigen::MatrixXd> space_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_LINEAR_BASES_H_
