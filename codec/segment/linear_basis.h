// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_LINEAR_BASIS_H_
#define ANICODEC_CODEC_SEGMENT_LINEAR_BASIS_H_

#include "codec/motion/motion_products.h"
#include "codec/motion/space_products.h"
#include "codec/segment/surface_regions.h"
#include "codec/sequence/frame_view.h"
#include "format/records.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// The pose that order and prior weights are taken from, and that the components are added to.
enum class ReferencePose : uint8_t {
  kMean,       ///< mean of all frames
  kFrame,      ///< the frame whose affine images explain most of the clip
  kRankThree,  ///< the three leading trajectories, mapped onto that frame
  kGiven       ///< chosen elsewhere
};

/// The part of the clip that is taken out before the components.
enum class Base : uint8_t {
  kPose,   ///< the pose itself, the same in every frame; for shapes
  kAffine  ///< in every frame its best affine image
};

/// Principal components of a clip, not yet quantised.
struct LinearBasis {
  BasisKind kind = BasisKind::kEigentrajectories;
  Base base = Base::kAffine;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< everything is relative to it
  Eigen::MatrixXd pose;                              ///< vertices x 3
  /// Squared deviations of the clip from the base: the sum of all energies.
  double base_energy = 0;
  Eigen::VectorXd energies;  ///< squared singular values, descending
  /// A column per component, orthonormal: 3 frames (trajectories) or frames (shapes).
  Eigen::MatrixXd time;

  /// If the surface has regions, each has base and components of its own; energies and time of the
  /// whole are then empty. Else null and empty.
  std::shared_ptr<const RegionClips> clips;
  std::vector<LinearBasis> regions;

  /// Components of the whole, or of the region that has most.
  size_t most_components() const {
    auto most = static_cast<size_t>(energies.size());
    for (const LinearBasis& region : regions)
      most = std::max(most, region.most_components());
    return most;
  }
};

/// Finds the bases of a segment. Eigenshapes: a component is a vector per vertex and a weight per
/// frame; eigentrajectories: a scalar per vertex and three weights per frame (Alexa and Mueller
/// 2000; Karni and Gotsman 2004). Both come from the same inner products, of whichever side of the clip is
/// smaller; the clip is read a few times and never copied.
class LinearAnalysis {
 public:
  /// The view must outlive the object. Cost and memory: those of motion_products().
  explicit LinearAnalysis(const FrameView& clip);

  /// That of some of its frames, by the products that the whole has if it is short, else anew. Cost O(frames^2) then.
  LinearAnalysis(const LinearAnalysis& whole, size_t first_frame, size_t frame_count);

  /// Components with energy above `smallest`, at most max_components. Trajectories need
  /// Base::kAffine. Cost: the eigenpairs, and at most two passes over the clip.
  /// For ReferencePose::kGiven: `given_pose`, vertices x 3, with any origin. For kRankThree it is what
  /// to come near, in place of a frame.
  LinearBasis basis(BasisKind kind, ReferencePose pose, Base base, size_t max_components,
                    double smallest, const Eigen::MatrixXd* given_pose = nullptr) const;

  /// A pose of that kind, vertices x 3, relative to origin().
  Eigen::MatrixXd pose(ReferencePose kind, const Eigen::MatrixXd* given_pose = nullptr) const;

  const Eigen::Vector3d& origin() const { return origin_; }

  const FrameView& clip() const { return clip_; }

  /// A space of trajectories for RegionAnalysis: that of the leading third of `count`, and a guess at others.
  /// Cost O(frames^2 count).
  Eigen::MatrixXd space_of_trajectories(size_t count) const {
    return products_->space_of_trajectories(static_cast<Eigen::Index>(count));
  }

  /// How many vector fields any basis needs at least for its frames to have this squared error.
  /// Cost: that of the eigenpairs.
  size_t fewest_fields(double squared_error) const;

  /// Squared deviations of all frames from their own centroids: what the KG error is relative to.
  double kg_reference() const { return kg_reference_; }

 private:
  void measure();
  void set_reference();
  Eigen::MatrixXd frame(size_t f) const;

  FrameView clip_;
  Eigen::Vector3d origin_;
  Eigen::VectorXd sums_;  // 3 frames: over the vertices
  std::unique_ptr<const MotionProducts> products_;
  double kg_reference_ = 0;
};

/// The same for eigentrajectories of regions, over one pose of the whole.
class RegionAnalysis {
 public:
  /// `space`: of trajectories of the whole, orthonormal (LinearAnalysis::space_of_trajectories()); components are found
  /// within it. Cost: that of SpaceProducts for the whole.
  RegionAnalysis(std::shared_ptr<const RegionClips> clips,
                 const std::shared_ptr<const Eigen::MatrixXd>& space);

  /// As LinearAnalysis::basis(), with Base::kAffine; at most max_components in each region.
  LinearBasis basis(const LinearAnalysis& whole, ReferencePose pose, size_t max_components,
                    const Eigen::MatrixXd* given_pose = nullptr) const;

 private:
  struct Region {
    Eigen::Vector3d origin;
    SpaceProducts products;
  };

  LinearBasis basis_of(size_t region, const Eigen::MatrixXd& pose, bool rank_three,
                       size_t max_components) const;

  std::shared_ptr<const RegionClips> clips_;
  std::vector<std::optional<Region>> regions_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_LINEAR_BASIS_H_
