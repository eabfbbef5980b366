// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A slow decoder that follows the text of spec/09-reconstruction.md line by line, against the
// library.
#include "sdk/prediction/predictor.h"
#include "sdk/prediction/vertex_order.h"
#include "tests/sdk/prediction_hash.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Graph = std::map<int, std::set<int>>;

/// Section 1.
struct ReferenceOrder {
  std::vector<int> order;
  std::vector<std::vector<int>> neighbours;  // by rank

  ReferenceOrder(const PredictionClip& clip, size_t m, int colours) {
    const int n = static_cast<int>(clip.vertex_count());
    const auto P = [&](int v, int axis) {
      return clip.positions[static_cast<size_t>(3 * v + axis)];
    };
    int extent = 0, low[3];
    for (int axis = 0; axis < 3; ++axis) {
      int high = low[axis] = P(0, axis);
      for (int v = 0; v < n; ++v) {
        low[axis] = std::min(low[axis], P(v, axis));
        high = std::max(high, P(v, axis));
      }
      extent = std::max(extent, high - low[axis]);
    }
    int s = 0;
    while (extent >> s >= 1 << 15)
      ++s;
    const auto g = [&](int v, int axis) { return int64_t{(P(v, axis) - low[axis]) >> s}; };
    const auto d = [&](int v, int w) {
      int64_t sum = 0;
      for (int axis = 0; axis < 3; ++axis)
        sum += (g(v, axis) - g(w, axis)) * (g(v, axis) - g(w, axis));
      return sum;
    };
    const auto lg = [](int64_t x) {
      int bits = 0;
      while (x > 1) {
        x >>= 1;
        ++bits;
      }
      return bits;
    };
    const auto morton = [&](int v) {
      int64_t code = 0;
      for (int i = 0; i <= 9; ++i)
        for (int axis = 0; axis < 3; ++axis)
          code |= (g(v, axis) >> (i + 5) & 1) << (3 * i + axis);
      return code;
    };

    Graph G;
    for (int v = 0; v < n; ++v)
      G[v] = {};
    for (size_t t = 0; t < clip.triangles.size(); t += 3)
      for (size_t a = t; a < t + 3; ++a)
        for (size_t b = t; b < t + 3; ++b)
          if (clip.triangles[a] != clip.triangles[b])
            G[static_cast<int>(clip.triangles[a])].insert(static_cast<int>(clip.triangles[b]));
    std::vector<std::vector<int>> level;
    std::map<int, std::vector<int>> found;
    const auto linked = [&] {
      std::vector<int> H;
      for (const auto& [v, N] : G)
        if (!N.empty())
          H.push_back(v);
      return H;
    };
    const auto link_all = [&] {
      std::vector<std::pair<int64_t, int>> curve;
      for (auto& [v, N] : G) {
        N.clear();
        curve.emplace_back(morton(v), v);
      }
      std::sort(curve.begin(), curve.end());
      for (size_t i = 0; i < curve.size(); ++i)
        for (size_t e = 1; e <= 2 && i + e < curve.size(); ++e) {
          G[curve[i].second].insert(curve[i + e].second);
          G[curve[i + e].second].insert(curve[i].second);
        }
    };
    std::set<int> removed;
    const auto select = [&] {
      std::vector<std::tuple<int, size_t, int>> visit;
      for (const int v : linked()) {
        int64_t shortest = INT64_MAX;
        for (const int u : G[v])
          shortest = std::min(shortest, d(u, v));
        visit.emplace_back(lg(shortest), std::min<size_t>(G[v].size(), 15), v);
      }
      std::sort(visit.begin(), visit.end());
      removed.clear();
      std::set<int> locked;
      for (const auto& [length, degree, v] : visit)
        if (!locked.count(v) && G[v].size() <= 32) {
          removed.insert(v);
          locked.insert(G[v].begin(), G[v].end());
        }
    };
    while (true) {
      std::vector<int> H = linked();
      size_t degrees = 0;
      for (const int v : H)
        degrees += G[v].size();
      if (H.empty()) {
        if (G.size() < 2)
          break;
        link_all();
      } else if (degrees > 16 * H.size()) {
        link_all();
      }
      select();
      if (16 * removed.size() < linked().size()) {
        link_all();
        select();
      }
      std::map<int, int> target;
      for (const int v : removed)
        target[v] = *std::min_element(G[v].begin(), G[v].end(), [&](int a, int b) {
          return std::pair(d(a, v), a) < std::pair(d(b, v), b);
        });
      const auto merged = [&](int v) { return target.count(v) ? target[v] : v; };
      Graph next;
      for (const auto& [v, N] : G) {
        if (!removed.count(v))
          next[v];
        for (const int u : N)
          if (merged(u) != merged(v))
            next[merged(v)].insert(merged(u));
      }
      std::map<int, int> colour;
      for (const int v : removed) {
        std::set<int> used;
        for (const int u : G[v])
          if (G[u].size() <= 32)
            for (const int w : G[u])
              if (colour.count(w))
                used.insert(colour[w]);
        int k = 0;
        while (k < colours - 1 && used.count(k))
          ++k;
        colour[v] = k;
      }
      for (const int v : removed) {
        std::set<int> Q = G[v], second;
        for (const int u : G[v])
          if (next[u].size() <= 32)
            for (const int w : next[u])
              if (!G[v].count(w))
                second.insert(w);
        Q.insert(second.begin(), second.end());
        if (Q.size() <= m)
          for (const int u : second)
            if (next[u].size() <= 32)
              Q.insert(next[u].begin(), next[u].end());
        if (colour[v] > 0)
          for (const int u : G[v])
            if (G[u].size() <= 32)
              for (const int w : G[u])
                if (removed.count(w) && colour[w] < colour[v])
                  Q.insert(w);
        std::vector<int>& nearest = found[v];
        nearest.assign(Q.begin(), Q.end());
        std::sort(nearest.begin(), nearest.end(),
                  [&](int a, int b) { return std::pair(d(a, v), a) < std::pair(d(b, v), b); });
        nearest.resize(std::min(m, nearest.size()));
      }
      for (int k = colours - 1; k >= 0; --k) {
        std::vector<int> part;
        for (const int v : removed)
          if (colour[v] == k)
            part.push_back(v);
        if (!part.empty())
          level.push_back(part);
      }
      G = next;
    }
    for (const auto& [v, N] : G)
      level.push_back({v});
    for (size_t t = level.size(); t-- > 0;)
      order.insert(order.end(), level[t].begin(), level[t].end());
    std::map<int, int> rank;
    for (size_t r = 0; r < order.size(); ++r)
      rank[order[r]] = static_cast<int>(r);
    for (const int v : order) {
      neighbours.emplace_back();
      for (const int w : found[v])
        neighbours.back().push_back(rank[w]);
    }
  }
};

using Row = std::vector<float>;
using Matrix = std::vector<Row>;

/// Section 3.
class Solver {
 public:
  Solver(const Matrix& A, float e) : m_(A.size()), L_(m_, Row(m_)), I_(m_) {
    Row D(m_), t(m_);
    for (size_t j = 0; j < m_; ++j) {
      for (size_t p = 0; p < j; ++p)
        t[p] = L_[j][p] * D[p];
      float x = A[j][j] + e;
      for (size_t p = 0; p < j; ++p)
        x = x - L_[j][p] * t[p];
      D[j] = x;
      I_[j] = 1 / x;
      for (size_t i = j + 1; i < m_; ++i) {
        x = A[i][j];
        for (size_t p = 0; p < j; ++p)
          x = x - L_[i][p] * t[p];
        L_[i][j] = x * I_[j];
      }
    }
  }

  Row solve(const Row& b) const {
    Row x(m_);
    for (size_t i = 0; i < m_; ++i) {
      x[i] = b[i];
      for (size_t p = 0; p < i; ++p)
        x[i] = x[i] - L_[i][p] * x[p];
    }
    for (size_t i = 0; i < m_; ++i)
      x[i] = x[i] * I_[i];
    for (size_t i = m_; i-- > 0;)
      for (size_t p = i + 1; p < m_; ++p)
        x[i] = x[i] - L_[p][i] * x[p];
    return x;
  }

 private:
  size_t m_;
  Matrix L_;
  Row I_;
};

float limit(float x) {
  if (!(x < 1048576))
    return 1048576;
  return !(x > -1048576) ? -1048576 : x;
}

float finite(float x) {
  return std::isfinite(x) ? x : 0;
}

float from_bits(uint32_t bits) {
  float x;
  std::memcpy(&x, &bits, 4);
  return x;
}

/// Sections 4 to 6: y[r][j * c + k].
Matrix reference_coefficients(const PredictionCase& t, const PredictionClip& clip,
                              const ReferenceOrder& order) {
  const auto m = static_cast<size_t>(t.neighbours), c = static_cast<size_t>(t.channels);
  const size_t n = order.order.size(), K = t.components;
  const std::map<RefitSchedule, std::set<size_t>> schedules = {
      {RefitSchedule::kNone, {}},
      {RefitSchedule::kSparse, {1, 4, 12, 36, 108, 324}},
      {RefitSchedule::kMedium,
       {0, 1, 2, 3, 5, 8, 12, 18, 26, 36, 50, 70, 100, 140, 200, 280, 400, 560}}};
  std::set<size_t> refits;
  for (const size_t j : schedules.at(t.schedule))
    if (j + 1 < K)
      refits.insert(j);
  std::set<size_t> renewals;
  for (const size_t j : {1, 3, 7, 9})
    if (t.alike > 0 && j + 1 < K)
      renewals.insert(j);
  refits.insert(renewals.begin(), renewals.end());
  const std::map<size_t, uint32_t> trace_factor = {
      {8, 0x35A7C5AC}, {12, 0x355FB23B}, {16, 0x3527C5AC}, {20, 0x350637BD}, {24, 0x34DFB23B}};
  const uint32_t quarters[] = {0x3F800000, 0x3F9837F0, 0x3FB504F3, 0x3FD744FD};
  const float inverse = 1 / static_cast<float>(t.radius);
  const auto phi = [&](float z) {
    const float s = z * inverse;
    float u = 1 - s;
    if (!(u > 0))
      u = 0;
    const float w = u * u;
    return (w * w) * (4 * s + 1);
  };
  Matrix y(n, Row(K * c));
  for (size_t r = 0; r < n; ++r) {
    const std::vector<int>& nb = order.neighbours[r];
    Row valid(m), l(m), b(m);
    Matrix x(m, Row(3)), M(m, Row(m));
    const auto P = [&](size_t rank, size_t axis) {
      return static_cast<float>(clip.positions[3 * static_cast<size_t>(order.order[rank]) + axis]);
    };
    float length = 0, number = 0;
    for (size_t a = 0; a < m; ++a) {
      valid[a] = a < nb.size() ? 1 : 0;
      for (size_t axis = 0; axis < 3 && a < nb.size(); ++axis)
        x[a][axis] = P(static_cast<size_t>(nb[a]), axis) - P(r, axis);
      l[a] = std::sqrt(x[a][0] * x[a][0] + x[a][1] * x[a][1] + x[a][2] * x[a][2]);
      length = length + l[a];
      number = number + valid[a];
    }
    const float scale = length > 0 ? number / length : 1;
    for (size_t a = 0; a < m; ++a) {
      for (float& e : x[a])
        e = e * scale;
      l[a] = l[a] * scale;
    }
    const auto square = [](const Row& e) { return e[0] * e[0] + e[1] * e[1] + e[2] * e[2]; };
    const auto apart = [&](size_t a, size_t k) {
      return Row{x[a][0] - x[k][0], x[a][1] - x[k][1], x[a][2] - x[k][2]};
    };
    const auto prior = [&](const auto& near, const auto& between) {
      for (size_t a = 0; a < m; ++a) {
        b[a] = valid[a] * (100 + 10 * near(a));
        for (size_t k = 0; k <= a; ++k) {
          const float dot = x[a][0] * x[k][0] + x[a][1] * x[k][1] + x[a][2] * x[k][2];
          M[a][k] = (valid[a] * valid[k]) * ((100 + 10 * dot) + 10 * between(a, k));
        }
      }
      Row weights = Solver(M, 0.02f).solve(b);
      for (float& e : weights)
        e = finite(e);
      return weights;
    };
    Row w0 = prior([&](size_t a) { return phi(l[a]); },
                   [&](size_t a, size_t k) { return phi(std::sqrt(square(apart(a, k)))); });
    Row w = w0, g(m);
    Matrix A(m, Row(m));
    for (size_t j = 0; j < K; ++j) {
      const float omega =
          from_bits(quarters[clip.omega[j] % 4]) * std::ldexp(1.0f, clip.omega[j] / 4 - 32);
      for (size_t k = 0; k < c; ++k) {
        Row z(m);
        float p = 0, p0 = 0;
        for (size_t a = 0; a < m; ++a) {
          const float value = a < nb.size() ? y[static_cast<size_t>(nb[a])][j * c + k] : 0;
          p = p + w[a] * value;
          p0 = p0 + w0[a] * value;
          z[a] = value;
        }
        float u = limit(p) * 64;
        u = u + 12582912;
        u = u - 12582912;
        const float value =
            limit(u * (1.0f / 64) + static_cast<float>(clip.q[(j * c + k) * n + r]));
        y[r][j * c + k] = value;
        const float e = value - p0;
        if (!refits.empty() && *refits.rbegin() >= j)
          for (size_t a = 0; a < m; ++a) {
            const float weighted = z[a] * omega;
            for (size_t i = 0; i <= a; ++i)
              A[a][i] = A[a][i] + weighted * z[i];
            g[a] = g[a] + weighted * e;
          }
      }
      if (renewals.count(j)) {
        const auto value = [&](size_t a, size_t s) {
          return a < nb.size() ? y[static_cast<size_t>(nb[a])][s] : 0.0f;
        };
        const size_t S = (j + 1) * c;
        Row D(m);
        float mean = 0;
        for (size_t a = 0; a < m; ++a) {
          for (size_t s = 0; s < S; ++s) {
            const float difference = value(a, s) - y[r][s];
            D[a] = D[a] + difference * difference;
          }
          mean = mean + valid[a] * std::sqrt(D[a]);
        }
        mean = mean / number;
        const float spread = mean * mean;
        const float rest = spread - from_bits(0x3E2AAAAB) * static_cast<float>(S);
        const float tau = static_cast<float>(t.alike * t.alike) / 64;
        const float v = tau * (rest > 0 ? rest / (spread * spread) : 0);
        const float reach = 0.28f / static_cast<float>(t.radius);
        const auto psi = [&](float squared) {
          const float z = std::sqrt(squared) * reach;
          const float u = 1 + z, u2 = u * u, u4 = u2 * u2, u8 = u4 * u4;
          return (1 + 16 * z) / (u8 * u8);
        };
        const Row before = w0;
        w0 = prior([&](size_t a) { return psi(square(x[a]) + v * D[a]); },
                   [&](size_t a, size_t k) {
                     float sum = 0;
                     for (size_t s = 0; s < S; ++s) {
                       const float difference = value(a, s) - value(k, s);
                       sum = sum + difference * difference;
                     }
                     return psi(square(apart(a, k)) + v * sum);
                   });
        for (size_t a = 0; a < m; ++a)
          for (size_t i = 0; i < m; ++i)
            g[a] = g[a] + (i < a ? A[a][i] : A[i][a]) * (before[i] - w0[i]);
      }
      if (refits.count(j)) {
        float trace = 0;
        for (size_t a = 0; a < m; ++a)
          trace = trace + A[a][a];
        const Row change = Solver(A, 0.3f + trace * from_bits(trace_factor.at(m))).solve(g);
        for (size_t a = 0; a < m; ++a)
          w[a] = finite(w0[a] + change[a]);
      }
    }
  }
  return y;
}

void expect_reference_order(const PredictionClip& clip, int m, int colours) {
  const auto count = static_cast<size_t>(m);
  const ReferenceOrder reference(clip, count, colours);
  VertexOrder order;
  ASSERT_EQ(make_vertex_order(clip.triangles.data(), clip.triangles.size() / 3,
                              clip.positions.data(), clip.vertex_count(), m, colours, &order),
            Status::kOk);
  ASSERT_EQ(Vector<uint32_t>(reference.order.begin(), reference.order.end()), order.order);
  for (size_t r = 0; r < order.order.size(); ++r) {
    std::vector<int> nb = reference.neighbours[r];
    nb.resize(count, -1);
    const auto from = order.neighbours.begin() + static_cast<ptrdiff_t>(r * count);
    ASSERT_EQ(nb, std::vector<int>(from, from + m));
  }
}

// Graphs that meet the bounds on degrees.
TEST(PredictionReference, OrdersIrregularGraphs) {
  PredictionClip fan, dense, random;
  uint32_t seed = 3;
  const auto next = [&](uint32_t range) {
    seed = seed * 1664525 + 1013904223;
    return static_cast<uint32_t>((uint64_t{seed} * range) >> 32);
  };
  for (PredictionClip* clip : {&fan, &dense, &random})
    for (int i = 0; i < 3 * 120; ++i)
      clip->positions.push_back(static_cast<int32_t>(next(1000000)));
  for (uint32_t i = 1; i < 110; ++i)
    fan.triangles.insert(fan.triangles.end(), {0, i, i + 1});
  for (uint32_t a = 0; a < 60; ++a)
    for (uint32_t b = 0; b < a; ++b)
      dense.triangles.insert(dense.triangles.end(), {a, b, b});
  for (int t = 0; t < 400; ++t)
    random.triangles.push_back(next(120));
  random.triangles.resize(399);
  PredictionClip hub;  // removed first, again and again
  hub.positions.assign(3 * 90, 5);
  for (uint32_t i = 1; i < 90; ++i)
    for (uint32_t e = 1; e <= 7; ++e)
      hub.triangles.insert(hub.triangles.end(), {0, i, 1 + (i + e) % 89});
  for (const PredictionClip* clip : {&fan, &dense, &random, &hub})
    for (const int colours : {1, 3})
      expect_reference_order(*clip, 16, colours);
}

TEST(PredictionReference, IsWhatTheSpecificationSays) {
  for (const PredictionCase& t : kPredictionCases) {
    const PredictionClip clip = prediction_clip(t.components, static_cast<size_t>(t.channels));
    const auto m = static_cast<size_t>(t.neighbours);
    expect_reference_order(clip, t.neighbours, t.colours);
    const ReferenceOrder reference(clip, m, t.colours);
    uint64_t hash = 0xcbf29ce484222325;
    for (const Row& row : reference_coefficients(t, clip, reference))
      for (const float value : row) {
        uint32_t bits;
        std::memcpy(&bits, &value, 4);
        for (int byte = 0; byte < 4; ++byte)
          hash = (hash ^ (bits >> (8 * byte) & 255)) * 0x100000001b3;
      }
    EXPECT_EQ(hash, t.hash) << m;
  }
}

}  // namespace
}  // namespace anicodec
