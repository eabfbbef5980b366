// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/linear_bases.h"

#include "codec/parallel/parallel.h"
#include "codec/search/opening_time.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

// Trajectories of the space that components of regions are found in, for each component of the whole. Chicken at
// --kg 0.1: 61.0 kB with 2, 53.8 with 3, 54.0 with 4, 53.9 with 6; dance, horse, flag and face: within 0.5 %.
constexpr double kSpaceOfRegions = 3;
// Files of these at --kg 0.1 with 4, 16, 32 and 1000: from 1.1 % below to 2.3 % above those with 8.
constexpr double kPoseStepsOfOctave = 8;

/// The step of the pose on a grid, so that trials of nearly the same steps share a coded pose.
double shared_pose_step(const LinearSettings& settings, size_t frames) {
  return std::exp2(std::round(std::log2(pose_step(settings, frames)) * kPoseStepsOfOctave) /
                   kPoseStepsOfOctave);
}

double space_size(const LinearChoice& cut) {
  return kSpaceOfRegions * cut.components_of_whole;
}

}  // namespace

LinearBases::LinearBases(const EncoderInput& input, const LinearAnalysis& analysis, BasisKind kind,
                         Effort effort, bool smallest)
    : input_(input), analysis_(analysis), kind_(kind), effort_(effort), smallest_(smallest) {}

void LinearBases::share_pose(std::shared_ptr<const EncodedPose> pose) {
  pose_ = std::move(pose);
  const PoseGrid& grid = pose_->grid;
  given_pose_.resize(static_cast<Eigen::Index>(grid.points.size() / 3), 3);
  for (Eigen::Index i = 0; i < given_pose_.size(); ++i)
    given_pose_(i / 3, i % 3) = grid.points[static_cast<size_t>(i)] * grid.step;
}

LinearBases::Made& LinearBases::made(const LinearChoice& choice) {
  const size_t most = std::min(choice.components_made, kMostComponents);
  const std::scoped_lock lock(mutex_);
  const std::tuple key{choice.pose, choice.base, choice.regions, most};
  auto found = made_.find(key);
  if (found == made_.end()) {
    LinearBasis basis;
    // A thread that waits for others here must not take a task that waits for the lock.
    isolated([&] {
      basis = choice.regions == 1
                  ? analysis_.basis(kind_, choice.pose, choice.base, most, 0, given())
                  : analysis_of(choice).basis(analysis_, choice.pose, most, given());
    });
    const auto components = static_cast<double>(basis.most_components());
    MemoryShare memory = input_.take_memory(
        analysis_.clip().frame_count, "a basis of the components that the error takes",
        [&](const EncodingMemory& m) {
          return m.basis(kind_, components, effort_, choice.regions);
        });
    found = made_.try_emplace(key).first;
    found->second.memory = std::move(memory);
    found->second.basis = std::move(basis);
  }
  return found->second;
}

std::shared_ptr<const EncodedPose> LinearBases::coded_pose(const LinearChoice& choice) {
  if (pose_)
    return pose_;
  Made& of_basis = made(choice);
  const double step = shared_pose_step(choice.settings, analysis_.clip().frame_count);
  {
    const std::scoped_lock lock(of_basis.mutex);
    // Isolated: a thread that waits for others in it must not take a task that waits for the lock.
    if (!of_basis.pose)
      isolated([&] {
        of_basis.pose.emplace(of_basis.basis.pose, of_basis.basis.origin, input_.layout,
                              bytes_per_nanosecond(smallest_));
      });
    if (const auto found = of_basis.poses.find(step); found != of_basis.poses.end())
      return found->second;
  }
  std::shared_ptr<const EncodedPose> pose = of_basis.pose->at_step(step);
  const std::scoped_lock lock(of_basis.mutex);
  return of_basis.poses.try_emplace(step, std::move(pose)).first->second;
}

void LinearBases::reserve(const LinearChoice& cut) {
  Regions& regions = regions_[cut.regions];
  if (!regions.memory)
    regions.memory = input_.take_memory(
        analysis_.clip().frame_count, "the motion of regions of the surface",
        [&](const EncodingMemory& m) { return m.regions(cut.regions, space_size(cut)); });
}

void LinearBases::analyse(std::span<const LinearChoice> cuts) {
  if (cuts.empty())
    return;
  space(cuts[0]);  // which all share
  parallel_tasks(cuts.size(), [&](size_t i) {
    input_.begin(SearchStep::kAnalysis);
    analysis_of(cuts[i]);
  });
}

void LinearBases::cut_like(const LinearBases& other, uint32_t regions) {
  regions_[regions].of_vertex = other.regions_.at(regions).of_vertex;
}

const std::shared_ptr<const Eigen::MatrixXd>& LinearBases::space(const LinearChoice& cut) {
  if (!space_)
    space_ = std::make_shared<const Eigen::MatrixXd>(
        analysis_.space_of_trajectories(static_cast<size_t>(space_size(cut))));
  return space_;
}

const RegionAnalysis& LinearBases::analysis_of(const LinearChoice& cut) {
  reserve(cut);
  Regions& regions = regions_[cut.regions];
  if (regions.of_vertex.empty()) {
    const Vector<uint32_t>& triangles = input_.layout.topology.triangles;
    MeshGraph graph;
    if (graph.init(triangles.data(), triangles.size() / 3, analysis_.clip().vertex_count) !=
        Status::kOk)
      throw Error(ErrorKind::kInternal, "the edges of the mesh cannot be found");
    regions.of_vertex = find_regions(analysis_.clip(), graph, cut.regions);
  }
  if (!regions.analysis)
    regions.analysis = std::make_unique<RegionAnalysis>(
        std::make_shared<const RegionClips>(analysis_.clip(), regions.of_vertex, cut.regions),
        space(cut));
  return *regions.analysis;
}

}  // namespace anicodec
