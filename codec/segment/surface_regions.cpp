// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/surface_regions.h"

#include "codec/algebra/blocked_product.h"
#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/symmetric_solve.h"
#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr size_t kMostFrames = 48;                // looked at
constexpr size_t kMostNumbers = size_t{1} << 24;  // of the trajectories looked at
// Vertices of a region that its trajectories are found by, on average.
constexpr size_t kSamples = 1024;
constexpr Index kRank = 8;     // trajectories of a region
constexpr Index kDirect = 64;  // numbers of a trajectory, from which on few axes are cheaper
constexpr int kRounds = 20, kSmoothings = 3;
constexpr double kFewestMoves = 0.002;  // of the vertices, in a round that is not the last
constexpr double kSmall = 0.4;          // of the mean size: a region that loses none
constexpr double kSizePower = 0.5;      // of what a size counts for

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The frames looked at: in rows [1, mean position, trajectory] of each vertex, relative to the centroid of all.
struct Trajectories {
  explicit Trajectories(const FrameView& clip) {
    const size_t n = clip.vertex_count;
    const size_t most = std::clamp<size_t>(kMostNumbers / (3 * n + 1), 4, kMostFrames);
    const size_t step = (clip.frame_count + most - 1) / most;
    const FrameView some = clip.frames(0, (clip.frame_count + step - 1) / step, step);
    motion.resize(static_cast<Index>(n), static_cast<Index>(3 * some.frame_count));
    base.resize(static_cast<Index>(n), 4);
    parallel_for(size_t{0}, n, [&](size_t v) {
      const auto row = static_cast<Index>(v);
      double mean[3] = {};
      for (size_t f = 0; f < some.frame_count; ++f) {
        for (size_t c = 0; c < 3; ++c)
          mean[c] += double{some.frame(f)[3 * v + c]} / static_cast<double>(some.frame_count);
      }
      base.row(row) << 1, mean[0], mean[1], mean[2];
    });
    const Eigen::RowVector3d origin = base.rightCols<3>().colwise().mean();
    base.rightCols<3>().rowwise() -= origin;
    parallel_for(size_t{0}, n, [&](size_t v) {
      const auto row = static_cast<Index>(v);
      for (size_t f = 0; f < some.frame_count; ++f) {
        for (size_t c = 0; c < 3; ++c)
          motion(row, static_cast<Index>(3 * f + c)) =
              static_cast<float>(double{some.frame(f)[3 * v + c]} - origin[static_cast<Index>(c)]);
      }
    });
  }

  RowMatrix motion;
  MatrixXd base;
};

/// The products of all pairs of columns of Trajectories, summed over the vertices of a region looked at.
class RegionProducts {
 public:
  explicit RegionProducts(const Trajectories& all)
      : all_(all), upper_(MatrixXd::Zero(kBase + all.motion.cols(), kBase + all.motion.cols())) {}

  void add(const std::vector<uint32_t>& vertices) { upper_ += products(vertices); }

  void remove(const std::vector<uint32_t>& vertices) { upper_ -= products(vertices); }

  /// Upper triangle.
  const MatrixXd& upper() const { return upper_; }

  static constexpr Index kBase = 4;

 private:
  MatrixXd products(const std::vector<uint32_t>& vertices) const {
    MatrixXd sums = MatrixXd::Zero(upper_.rows(), upper_.cols());
    const auto depth = static_cast<size_t>(panel_depth(upper_.cols()));
    for (size_t first = 0; first < vertices.size(); first += depth) {
      const size_t count = std::min(depth, vertices.size() - first);
      MatrixXd panel(static_cast<Index>(count), upper_.cols());
      for (size_t i = 0; i < count; ++i) {
        const auto row = static_cast<Index>(i);
        const uint32_t v = vertices[first + i];
        panel.row(row).head<kBase>() = all_.base.row(v);
        panel.row(row).tail(all_.motion.cols()) = all_.motion.row(v).cast<double>();
      }
      add_self_products(panel, sums);
    }
    return sums;
  }

  const Trajectories& all_;
  MatrixXd upper_;
};

/// How much of the motion of a vertex a region explains.
class RegionModel {
 public:
  RegionModel(const Trajectories& all, const RegionProducts& of_region) : all_(all) {
    constexpr Index kBase = RegionProducts::kBase;
    MatrixXd products = of_region.upper();
    mirror_upper(products);
    const Index motion = products.cols() - kBase;
    const MatrixXd of_base = products.topRightCorner(kBase, motion);
    MatrixXd gram = products.topLeftCorner(kBase, kBase);
    gram.diagonal() *= 1 + 1e-9;
    affine_ = solve_symmetric(gram, of_base);
    const MatrixXd rest =
        products.bottomRightCorner(motion, motion) - of_base.transpose() * affine_;
    axes_ = leading_eigenpairs(rest, kRank, 0, kDirect).vectors;
  }

  /// The squared motion of a vertex that is left.
  double left(uint32_t v) const {
    const Eigen::RowVectorXd rest = all_.motion.row(v).cast<double>() - all_.base.row(v) * affine_;
    return std::max(rest.squaredNorm() - (rest * axes_).squaredNorm(), 0.0);
  }

 private:
  const Trajectories& all_;
  MatrixXd affine_, axes_;
};

class RegionSearch {
 public:
  RegionSearch(const FrameView& clip, const MeshGraph& graph, uint32_t count)
      : graph_(graph),
        count_(count),
        all_(clip),
        regions_(clip.vertex_count, 0),
        products_(count, RegionProducts(all_)) {
    const size_t step = std::max<size_t>(clip.vertex_count / (kSamples * count), 1);
    for (size_t v = 0; v < clip.vertex_count; v += step)
      samples_.push_back({static_cast<uint32_t>(v), kNoRegion});
    find_pieces();
  }

  Vector<uint8_t> run() {
    seed();
    for (int round = 0; round < kRounds; ++round) {
      if (static_cast<double>(move_borders()) < kFewestMoves * static_cast<double>(size()))
        break;
    }
    for (int round = 0; round < kSmoothings; ++round)
      smooth();
    return std::move(regions_);
  }

 private:
  static constexpr uint8_t kNoRegion = UINT8_MAX;

  struct Sample {
    uint32_t vertex;
    uint8_t region;  ///< whose products have it
  };

  size_t size() const { return regions_.size(); }

  /// Calls visit(u) for the neighbours of a vertex.
  template <class Visit>
  void around(uint32_t v, const Visit& visit) const {
    if (graph_.is_dense())
      return;
    for (uint32_t e = graph_.start()[v]; e < graph_.start()[v + 1]; ++e)
      visit(graph_.adjacent()[e]);
  }

  size_t fewest() const {
    return static_cast<size_t>(kSmall * static_cast<double>(size()) / count_);
  }

  bool is_small(uint32_t v) const { return pieces_[piece_[v]].size() < fewest(); }

  /// Connected vertices.
  void find_pieces() {
    constexpr auto kNotYet = UINT32_MAX;
    piece_.assign(size(), kNotYet);
    for (uint32_t first = 0; first < size(); ++first) {
      if (piece_[first] != kNotYet)
        continue;
      const auto number = static_cast<uint32_t>(pieces_.size());
      std::vector<uint32_t> found{first};
      piece_[first] = number;
      for (size_t i = 0; i < found.size(); ++i) {
        around(found[i], [&](uint32_t u) {
          if (piece_[u] == kNotYet) {
            piece_[u] = number;
            found.push_back(u);
          }
        });
      }
      pieces_.push_back(std::move(found));
    }
  }

  double distance(uint32_t a, uint32_t b) const {
    return (all_.base.row(a) - all_.base.row(b)).norm();
  }

  /// Each next seed is furthest from those before along the edges, in pieces that are not small;
  /// vertices are of the nearest.
  void seed() {
    std::vector<double> away(size(), std::numeric_limits<double>::infinity());
    for (uint32_t v = 0; v < size(); ++v)
      away[v] = is_small(v) ? -1 : away[v];
    auto from = static_cast<uint32_t>(std::ranges::max_element(away) - away.begin());
    for (uint32_t r = 0; r < count_; ++r) {
      using Place = std::pair<double, uint32_t>;
      std::priority_queue<Place, std::vector<Place>, std::greater<>> open;
      away[from] = 0;
      open.push({0, from});
      while (!open.empty()) {
        const double d = open.top().first;
        const uint32_t v = open.top().second;
        open.pop();
        if (d > away[v])
          continue;
        regions_[v] = static_cast<uint8_t>(r);
        around(v, [&](uint32_t u) {
          const double next = d + distance(u, v);
          if (next < away[u])
            open.push({away[u] = next, u});
        });
      }
      from = static_cast<uint32_t>(std::ranges::max_element(away) - away.begin());
    }
  }

  std::vector<size_t> sizes() const {
    std::vector<size_t> result(count_);
    for (const uint8_t r : regions_)
      ++result[r];
    return result;
  }

  /// Follows the vertices that went to other regions.
  void update_products() {
    std::vector<std::vector<uint32_t>> come(count_), gone(count_);
    for (Sample& sample : samples_) {
      const uint8_t now = regions_[sample.vertex];
      if (now == sample.region)
        continue;
      come[now].push_back(sample.vertex);
      if (sample.region != kNoRegion)
        gone[sample.region].push_back(sample.vertex);
      sample.region = now;
    }
    for (uint32_t r = 0; r < count_; ++r) {
      products_[r].add(come[r]);
      products_[r].remove(gone[r]);
    }
  }

  /// Moves vertices to the region of a neighbour that leaves less; returns how many.
  size_t move_borders() {
    update_products();
    std::vector<RegionModel> models;
    std::vector<double> price;
    const double mean = static_cast<double>(size()) / count_;
    for (const size_t vertices : sizes())
      price.push_back(std::pow(static_cast<double>(vertices) / mean, kSizePower));
    for (const RegionProducts& products : products_)
      models.emplace_back(all_, products);
    std::vector<uint8_t> wanted(regions_.begin(), regions_.end());
    parallel_for(uint32_t{0}, static_cast<uint32_t>(size()), [&](uint32_t v) {
      uint32_t near = 0;
      around(v, [&](uint32_t u) { near |= 1U << regions_[u]; });
      const uint32_t own = regions_[v];
      if ((near & ~(1U << own)) == 0)
        return;
      double least = price[own] * models[own].left(v);
      for (uint32_t r = 0; r < count_; ++r) {
        const double cost = r != own && (near >> r & 1) ? price[r] * models[r].left(v) : least;
        if (cost < least) {
          least = cost;
          wanted[v] = static_cast<uint8_t>(r);
        }
      }
    });
    const size_t moved = take(wanted);
    for (const std::vector<uint32_t>& piece : pieces_) {
      if (piece.size() < fewest())
        move_piece(piece, models, price);
    }
    return moved;
  }

  void move_piece(const std::vector<uint32_t>& piece, const std::vector<RegionModel>& models,
                  const std::vector<double>& price) {
    std::vector<double> left(count_, 0);
    for (uint32_t r = 0; r < count_; ++r) {
      for (uint32_t v : piece)
        left[r] += price[r] * models[r].left(v);
    }
    const auto best = static_cast<uint8_t>(std::ranges::min_element(left) - left.begin());
    for (uint32_t v : piece)
      regions_[v] = best;
  }

  /// Does as vertices want, as long as the region that they leave is not small.
  size_t take(const std::vector<uint8_t>& wanted) {
    std::vector<size_t> sizes = this->sizes();
    size_t moved = 0;
    for (uint32_t v = 0; v < size(); ++v) {
      if (wanted[v] == regions_[v] || sizes[regions_[v]] <= fewest())
        continue;
      --sizes[regions_[v]];
      ++sizes[wanted[v]];
      regions_[v] = wanted[v];
      ++moved;
    }
    return moved;
  }

  /// Vertices join the region of most of their neighbours: shorter borders.
  void smooth() {
    std::vector<uint8_t> wanted(regions_.begin(), regions_.end());
    for (uint32_t v = 0; v < size(); ++v) {
      std::vector<uint32_t> seen(count_);
      uint32_t total = 0;
      around(v, [&](uint32_t u) {
        ++seen[regions_[u]];
        ++total;
      });
      const auto most = std::max_element(seen.begin(), seen.end());
      if (2 * *most > total && total > 0)
        wanted[v] = static_cast<uint8_t>(most - seen.begin());
    }
    take(wanted);
  }

  const MeshGraph& graph_;
  uint32_t count_;
  Trajectories all_;
  Vector<uint8_t> regions_;
  std::vector<Sample> samples_;
  std::vector<RegionProducts> products_;
  std::vector<uint32_t> piece_;                ///< of each vertex
  std::vector<std::vector<uint32_t>> pieces_;  ///< connected vertices
};

}  // namespace

Vector<uint8_t> find_regions(const FrameView& clip, const MeshGraph& graph, uint32_t count) {
  return RegionSearch(clip, graph, count).run();
}

RegionClips::RegionClips(const FrameView& clip, Vector<uint8_t> regions, uint32_t count)
    : regions_(std::move(regions)), vertices_(count) {
  for (uint32_t v = 0; v < regions_.size(); ++v)
    vertices_[regions_[v]].push_back(v);
  positions_.resize(3 * clip.vertex_count * clip.frame_count);
  view_ = FrameView(positions_.data(), clip.frame_count, clip.vertex_count);
  size_t first = 0;
  for (const std::vector<uint32_t>& vertices : vertices_) {
    first_.push_back(first);
    for (size_t f = 0; f < clip.frame_count; ++f) {
      float* to = positions_.data() + f * view_.frame_stride + 3 * first;
      for (uint32_t v : vertices)
        to = std::copy_n(clip.frame(f) + size_t{3} * v, 3, to);
    }
    first += vertices.size();
  }
}

FrameView RegionClips::clip(size_t region) const {
  return view_.vertices(first_[region], vertices_[region].size());
}

}  // namespace anicodec
