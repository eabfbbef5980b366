// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Multi-scale geometry interpolation word by word as spec/09c-interpolation.md has it, slow and in
// double, against the decoder's.
#include "sdk/msgi/msgi.h"
#include "tests/sdk/triangle_lists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Faces = std::vector<size_t>;
using VertexPair = std::pair<uint32_t, uint32_t>;

/// The sum of b a^T over the pairs tells the rotation of a onto b.
Matrix3d best(const Matrix3d& products) {
  const Eigen::JacobiSVD<Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Vector3d log_of(const Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Matrix3d exp_of(const Vector3d& turn) {
  const double angle = turn.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                   : Matrix3d::Identity();
}

class Reference {
 public:
  Reference(const TriangleList& list, const std::vector<Matrix3Xd>& inputs, size_t leaf_faces)
      : inputs_(inputs), leaf_faces_(leaf_faces) {
    for (size_t t = 0; t < list.triangles.size(); t += 3) {
      const uint32_t* c = &list.triangles[t];
      if (c[0] != c[1] || c[1] != c[2])
        corners_.push_back({c[0], c[1], c[2]});
    }
    find_neighbours();
    for (const Faces& part : parts_)
      cut(part, 0);
    find_patches();
    align();
  }

  Matrix3Xd evaluate(const std::vector<double>& t) const {
    std::map<std::pair<size_t, size_t>, Matrix3d> relative;
    for (const auto& [link, turns] : turns_) {
      Vector3d sum = Vector3d::Zero();
      for (size_t j = 0; j < t.size(); ++j)
        sum += t[j] * turns[j];
      relative[link] = exp_of(sum);
    }
    std::vector<Matrix3d> r(leaves_.size(), Matrix3d::Identity());
    for (const Node& node : nodes_) {  // small ones come first
      Matrix3d votes = Matrix3d::Zero();
      for (const auto& [link, weight] : links_) {
        if (link.first >= node.first && link.first < node.middle && link.second >= node.middle &&
            link.second < node.last)
          votes += weight * r[link.first] * relative[link] * r[link.second].transpose();
      }
      const Matrix3d g = best(votes);
      for (size_t q = node.middle; q < node.last; ++q)
        r[q] = g * r[q];
    }

    const Index n = inputs_[0].cols();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 3);
    for (size_t p = 0; p < leaves_.size(); ++p) {
      for (const VertexPair& edge : patch_edges_[p]) {
        const double w = weights_.at(edge);
        const Index a = edge.first, b = edge.second;
        Vector3d d = Vector3d::Zero();
        for (size_t j = 0; j < t.size(); ++j)
          d += t[j] * turns_to_first_[p][j] * (aligned_[j].col(a) - aligned_[j].col(b));
        d = r[p] * d;
        matrix(a, a) += w;
        matrix(b, b) += w;
        matrix(a, b) -= w;
        matrix(b, a) -= w;
        right.row(a) += w * d.transpose();
        right.row(b) -= w * d.transpose();
      }
    }
    const Matrix3Xd x = matrix.completeOrthogonalDecomposition().solve(right).transpose();

    Matrix3Xd shape = Matrix3Xd::Zero(3, n);
    for (size_t j = 0; j < t.size(); ++j)
      shape += t[j] * inputs_[j];  // vertices without face keep this
    for (size_t c = 0; c < part_vertices_.size(); ++c) {
      const std::set<uint32_t>& vertices = part_vertices_[c];
      Vector3d mean = Vector3d::Zero(), turn = Vector3d::Zero(), place = Vector3d::Zero();
      for (uint32_t v : vertices)
        mean += x.col(v) / static_cast<double>(vertices.size());
      Matrix3d products = Matrix3d::Zero();
      for (uint32_t v : vertices) {
        Vector3d y = Vector3d::Zero();
        for (size_t j = 0; j < t.size(); ++j)
          y += t[j] * aligned_[j].col(v);
        products += y * (x.col(v) - mean).transpose();
      }
      for (size_t j = 0; j < t.size(); ++j) {
        turn += t[j] * log_of(part_turns_[c][j]);
        place += t[j] * part_centroids_[c][j];
      }
      const Matrix3d rotation = exp_of(turn) * best(products);
      for (uint32_t v : vertices)
        shape.col(v) = rotation * (x.col(v) - mean) + place;
    }
    return shape;
  }

 private:
  struct Node {
    size_t first, middle, last;  ///< leaves
  };

  void find_neighbours() {
    std::map<VertexPair, std::vector<size_t>> faces_of;
    for (size_t f = 0; f < corners_.size(); ++f) {
      for (size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(corners_[f][k], corners_[f][(k + 1) % 3]);
        if (a != b) {
          faces_of[{a, b}].push_back(f);
          face_edges_[f].insert({a, b});
        }
      }
    }
    hinges_.resize(corners_.size());
    std::vector<size_t> set(corners_.size());
    std::iota(set.begin(), set.end(), size_t{0});
    auto unite = [&](size_t f, size_t g) {
      const size_t from = std::max(set[f], set[g]), to = std::min(set[f], set[g]);
      std::replace(set.begin(), set.end(), from, to);
    };
    for (const auto& [edge, faces] : faces_of) {
      edges_.insert(edge);
      for (size_t i = 1; i < faces.size(); ++i) {
        if (faces[i] == faces[i - 1])
          continue;
        hinges_[faces[i - 1]].push_back(faces[i]);
        hinges_[faces[i]].push_back(faces[i - 1]);
        unite(faces[i - 1], faces[i]);
      }
    }
    neighbours_ = hinges_;
    std::map<uint32_t, size_t> met;
    for (size_t f = 0; f < corners_.size(); ++f) {
      for (uint32_t v : corners_[f]) {
        const auto before = met.find(v);
        if (before != met.end() && set[before->second] != set[f]) {
          neighbours_[before->second].push_back(f);
          neighbours_[f].push_back(before->second);
          unite(before->second, f);
        }
        met[v] = f;
      }
    }
    std::map<size_t, Faces> by_lowest;
    for (size_t f = 0; f < corners_.size(); ++f)
      by_lowest[set[f]].push_back(f);
    for (const auto& [lowest, faces] : by_lowest) {
      parts_.push_back(faces);
      part_vertices_.emplace_back();
      for (size_t f : faces)
        part_vertices_.back().insert(corners_[f].begin(), corners_[f].end());
    }
  }

  /// The next face that a breadth-first search over `reached` finds among those free.
  bool next(const Faces& reached, const std::set<size_t>& free, size_t* found) const {
    for (size_t f : reached) {
      for (size_t g : neighbours_[f]) {
        if (free.count(g)) {
          *found = g;
          return true;
        }
      }
    }
    return false;
  }

  size_t farthest(size_t from, const Faces& set) const {
    Faces reached{from};
    std::set<size_t> free(set.begin(), set.end());
    free.erase(from);
    for (size_t g = 0; next(reached, free, &g);) {
      reached.push_back(g);
      free.erase(g);
    }
    return reached.back();
  }

  /// Cuts a set; its node comes after those of its halves.
  void cut(const Faces& set, int depth) {
    if (set.size() <= leaf_faces_ || depth == 48) {
      leaves_.push_back(set);
      return;
    }
    const size_t a = farthest(set[0], set), b = farthest(a, set);
    Faces halves[2] = {{a}, {b}};
    std::set<size_t> free(set.begin(), set.end());
    free.erase(a);
    free.erase(b);
    for (;;) {
      size_t to_a = 0, to_b = 0;
      const bool a_can = next(halves[0], free, &to_a), b_can = next(halves[1], free, &to_b);
      if (!a_can && !b_can)
        break;
      const bool a_grows = a_can && (halves[0].size() <= halves[1].size() || !b_can);
      halves[a_grows ? 0 : 1].push_back(a_grows ? to_a : to_b);
      free.erase(a_grows ? to_a : to_b);
    }
    std::sort(halves[0].begin(), halves[0].end());
    std::sort(halves[1].begin(), halves[1].end());
    Node node{leaves_.size(), 0, 0};
    cut(halves[0], depth + 1);
    node.middle = leaves_.size();
    cut(halves[1], depth + 1);
    node.last = leaves_.size();
    nodes_.push_back(node);
  }

  void find_patches() {
    std::map<size_t, size_t> leaf_of;
    for (size_t p = 0; p < leaves_.size(); ++p) {
      std::set<size_t> patch(leaves_[p].begin(), leaves_[p].end());
      for (size_t f : leaves_[p]) {
        leaf_of[f] = p;
        patch.insert(hinges_[f].begin(), hinges_[f].end());
      }
      patch_edges_.emplace_back();
      for (size_t f : patch) {
        const auto edges = face_edges_.find(f);
        if (edges != face_edges_.end())
          patch_edges_.back().insert(edges->second.begin(), edges->second.end());
      }
    }
    for (size_t f = 0; f < corners_.size(); ++f) {
      for (size_t g : neighbours_[f]) {
        if (leaf_of[f] < leaf_of[g])
          ++links_[{leaf_of[f], leaf_of[g]}];
      }
    }
  }

  void align() {
    const size_t inputs = inputs_.size();
    aligned_ = inputs_;
    for (const std::set<uint32_t>& vertices : part_vertices_) {
      part_turns_.emplace_back();
      part_centroids_.emplace_back();
      for (size_t j = 0; j < inputs; ++j) {
        Vector3d centroid = Vector3d::Zero();
        for (uint32_t v : vertices)
          centroid += inputs_[j].col(v) / static_cast<double>(vertices.size());
        part_centroids_.back().push_back(centroid);
        Matrix3d products = Matrix3d::Zero();
        for (uint32_t v : vertices)
          products += (inputs_[j].col(v) - centroid) *
                      (inputs_[0].col(v) - part_centroids_.back()[0]).transpose();
        const Matrix3d g = j == 0 ? Matrix3d::Identity() : best(products);
        part_turns_.back().push_back(g);
        for (uint32_t v : vertices)
          aligned_[j].col(v) = g.transpose() * (inputs_[j].col(v) - centroid);
      }
    }
    std::map<VertexPair, double> lengths;
    double mean = 0;
    for (const VertexPair& e : edges_) {
      for (const Matrix3Xd& x : inputs_)
        lengths[e] += (x.col(e.first) - x.col(e.second)).norm() / static_cast<double>(inputs);
      mean += lengths[e] / static_cast<double>(edges_.size());
    }
    for (const VertexPair& e : edges_)
      weights_[e] = mean > 0 ? std::pow(mean / std::max(lengths[e], mean / 1000), 2) : 1;
    for (size_t p = 0; p < leaves_.size(); ++p) {
      turns_to_first_.emplace_back();
      for (size_t j = 0; j < inputs; ++j) {
        Matrix3d products = Matrix3d::Zero();
        for (const VertexPair& e : patch_edges_[p])
          products += weights_[e] * (aligned_[0].col(e.first) - aligned_[0].col(e.second)) *
                      (aligned_[j].col(e.first) - aligned_[j].col(e.second)).transpose();
        turns_to_first_.back().push_back(j == 0 ? Matrix3d::Identity() : best(products));
      }
    }
    for (const auto& [link, weight] : links_) {
      for (size_t j = 0; j < inputs; ++j)
        turns_[link].push_back(
            log_of(turns_to_first_[link.first][j] * turns_to_first_[link.second][j].transpose()));
    }
  }

  std::vector<Matrix3Xd> inputs_, aligned_;
  size_t leaf_faces_;
  std::vector<std::array<uint32_t, 3>> corners_;
  std::set<VertexPair> edges_;
  std::map<size_t, std::set<VertexPair>> face_edges_;
  std::vector<Faces> hinges_, neighbours_;
  std::vector<Faces> parts_;
  std::vector<std::set<uint32_t>> part_vertices_;
  std::vector<std::vector<Matrix3d>> part_turns_;
  std::vector<std::vector<Vector3d>> part_centroids_;
  std::vector<Faces> leaves_;
  std::vector<Node> nodes_;
  std::vector<std::set<VertexPair>> patch_edges_;
  std::map<std::pair<size_t, size_t>, double> links_;
  std::map<std::pair<size_t, size_t>, std::vector<Vector3d>> turns_;
  std::map<VertexPair, double> weights_;
  std::vector<std::vector<Matrix3d>> turns_to_first_;
};

TEST(MsgiReference, IsWhatTheDecoderComputes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const TriangleList& list : odd_triangle_lists()) {
    if (list.name == "degenerate")
      continue;  // parts on a line: their rotations are open
    // Scattered points, twisted and bent by several amounts.
    const auto n = static_cast<Index>(list.vertex_count);
    Matrix3Xd base(3, n);
    for (double& x : base.reshaped())
      x = uniform(random);
    std::vector<Matrix3Xd> inputs;
    std::vector<std::vector<float>> floats;
    std::vector<const float*> pointers;
    for (double twist : {0.0, 1.2, -0.8}) {
      Matrix3Xd x(3, n);
      for (Index v = 0; v < n; ++v)
        x.col(v) = exp_of({0, 0.4 * twist, twist * (0.5 + base(2, v))}) * base.col(v) +
                   0.05 * Vector3d(uniform(random), uniform(random), twist);
      floats.emplace_back(x.size());
      Eigen::Map<Eigen::Matrix3Xf>(floats.back().data(), 3, n) = x.cast<float>();
      inputs.push_back(Eigen::Map<Eigen::Matrix3Xf>(floats.back().data(), 3, n).cast<double>());
    }
    for (const std::vector<float>& x : floats)
      pointers.push_back(x.data());
    for (uint32_t leaf : {1U, 5U, 255U}) {
      Msgi::Options options;
      options.leaf_faces = leaf;
      Msgi msgi;
      ASSERT_EQ(msgi.init(list.triangles.data(), list.triangles.size() / 3, list.vertex_count,
                          pointers.data(), pointers.size(), options),
                Status::kOk);
      const Reference reference(list, inputs, leaf);
      std::vector<double> scratch(msgi.scratch_bytes() / 8 + 1);
      std::vector<float> out(3 * size_t{list.vertex_count});
      for (const std::vector<double>& weights :
           {std::vector{0.5, 0.5, 0.0}, std::vector{0.2, 0.3, 0.5}, std::vector{1.3, -0.4, 0.1}}) {
        ASSERT_EQ(msgi.evaluate(weights.data(), nullptr, scratch.data(), out.data()), Status::kOk);
        const Matrix3Xd expected = reference.evaluate(weights);
        const Matrix3Xd got = Eigen::Map<Eigen::Matrix3Xf>(out.data(), 3, n).cast<double>();
        const double diagonal = (base.rowwise().maxCoeff() - base.rowwise().minCoeff()).norm();
        EXPECT_LE((got - expected).cwiseAbs().maxCoeff(), 1e-5 * diagonal)
            << list.name << " " << leaf;
      }
    }
  }
}

}  // namespace
}  // namespace anicodec
