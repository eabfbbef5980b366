// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/base/quaternion.h"

#include <algorithm>

namespace anicodec {
namespace {

// Share of the identity's vote: decides what points leave open, below what single precision shows.
constexpr double kPriorWeight = 1e-10;

UnitQuaternion normalized(const double q[4]) {
  double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(size > 0))
    return {};
  return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
}

constexpr double kTurn = 2 * 3.14159265358979323846;

/// cos(x) and sin(x) / x for |x| <= pi, to 1e-15, by their series: sines of a library for all angles take
/// more code than anything else that rotates.
struct HalfAngle {
  double cosine = 1, sine_share = 1;

  explicit HalfAngle(double x) {
    for (size_t k = kTerms; k-- > 0;) {
      cosine = 1 - x * x * cosine * kInverse.of_cosine[k];
      sine_share = 1 - x * x * sine_share * kInverse.of_sine[k];
    }
  }

 private:
  static constexpr size_t kTerms = 14;

  struct Inverse {
    double of_cosine[kTerms] = {}, of_sine[kTerms] = {};

    constexpr Inverse() {
      for (size_t k = 0; k < kTerms; ++k) {
        const auto even = static_cast<double>(2 * k + 2);
        of_cosine[k] = 1 / ((even - 1) * even);
        of_sine[k] = 1 / (even * (even + 1));
      }
    }
  };

  static const Inverse kInverse;
};

constexpr HalfAngle::Inverse HalfAngle::kInverse;

/// Cofactors of one row of a 4 x 4 matrix.
void cofactors(const double a[4][4], size_t row, double out[4]) {
  size_t r[3];
  for (size_t i = 0, k = 0; i < 4; ++i) {
    if (i != row)
      r[k++] = i;
  }
  for (size_t column = 0; column < 4; ++column) {
    size_t c[3];
    for (size_t i = 0, k = 0; i < 4; ++i) {
      if (i != column)
        c[k++] = i;
    }
    const double *p = a[r[0]], *q = a[r[1]], *s = a[r[2]];
    double minor = p[c[0]] * (q[c[1]] * s[c[2]] - q[c[2]] * s[c[1]]) -
                   p[c[1]] * (q[c[0]] * s[c[2]] - q[c[2]] * s[c[0]]) +
                   p[c[2]] * (q[c[0]] * s[c[1]] - q[c[1]] * s[c[0]]);
    out[column] = (row + column) % 2 == 0 ? minor : -minor;
  }
}

/// The leading eigenvector of a symmetric matrix by Jacobi's method.
UnitQuaternion leading_by_jacobi(const double n[4][4]) {
  double a[4][4], v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  std::copy(&n[0][0], &n[0][0] + 16, &a[0][0]);
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0, all = 0;
    for (size_t i = 0; i < 4; ++i) {
      for (size_t j = 0; j < 4; ++j)
        (i == j ? all : off) += a[i][j] * a[i][j];
    }
    if (!(off > 1e-30 * (all + off)))
      break;
    for (size_t p = 0; p < 3; ++p) {
      for (size_t q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0)
          continue;
        double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
        double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (auto& row : a) {
          double kp = row[p], kq = row[q];
          row[p] = c * kp - s * kq;
          row[q] = s * kp + c * kq;
        }
        for (size_t k = 0; k < 4; ++k) {
          double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          double vp = v[k][p], vq = v[k][q];
          v[k][p] = c * vp - s * vq;
          v[k][q] = s * vp + c * vq;
        }
      }
    }
  }
  size_t best = 0;
  for (size_t i = 1; i < 4; ++i) {
    if (a[i][i] > a[best][best])
      best = i;
  }
  const double q[4] = {v[0][best], v[1][best], v[2][best], v[3][best]};
  return normalized(q);
}

}  // namespace

Matrix3 to_matrix(const UnitQuaternion& q) {
  double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
           {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
           {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}};
}

UnitQuaternion exp_rotation(const Vector3& v) {
  const double angle = length(v);
  double half = angle / 2;
  half -= kTurn * std::nearbyint(half / kTurn);
  const HalfAngle of(half);
  const double s = angle > 1e-8 ? half * of.sine_share / angle : 0.5;
  return {of.cosine, s * v[0], s * v[1], s * v[2]};
}

Vector3 log_rotation(const UnitQuaternion& q) {
  double sign = q.w < 0 ? -1 : 1;
  Vector3 v{{sign * q.x, sign * q.y, sign * q.z}};
  double size = length(v);
  return (size > 1e-12 ? 2 * std::atan2(size, sign * q.w) / size : 2) * v;
}

void RotationVotes::add(const UnitQuaternion& q, double weight) {
  const double v[4] = {q.w, q.x, q.y, q.z};
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j)
      n[i][j] += 4 * weight * v[i] * v[j];
    n[i][i] -= weight;
  }
}

UnitQuaternion RotationVotes::leading() const {
  // The characteristic polynomial l^4 + c2 l^2 + c1 l + c0 of a matrix without trace; Newton's
  // method from above its largest root, then the adjugate.
  double squares[4][4], c2 = 0, c1 = 0;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j) {
      squares[i][j] = 0;
      for (size_t k = 0; k < 4; ++k)
        squares[i][j] += n[i][k] * n[k][j];
    }
    c2 -= squares[i][i] / 2;
  }
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j)
      c1 -= squares[i][j] * n[i][j] / 3;
  }
  double row[4], c0 = 0;
  cofactors(n, 0, row);
  for (size_t j = 0; j < 4; ++j)
    c0 += n[0][j] * row[j];
  double scale = std::sqrt(-1.5 * c2);
  if (!(scale > 0))
    return {};
  double root = scale;
  for (int i = 0; i < 60; ++i) {
    double square = root * root;
    double slope = (4 * square + 2 * c2) * root + c1;
    if (!(slope > 0))
      break;
    double step = ((square + c2) * square + c1 * root + c0) / slope;
    root -= step;
    if (std::fabs(step) < 1e-14 * scale)
      break;
  }
  double shifted[4][4];
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j)
      shifted[i][j] = n[i][j] - (i == j ? root : 0);
  }
  // A row of the adjugate is as long as the gaps to the other roots allow.
  double cube = scale * scale * scale;
  for (size_t r = 0; r < 4; ++r) {
    cofactors(shifted, r, row);
    double size = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2] + row[3] * row[3]);
    if (size > 1e-3 * cube)
      return normalized(row);
  }
  return leading_by_jacobi(n);
}

RotationVotes votes_for(const Matrix3& products) {
  double s[3][3], size = 0;
  for (const auto& row : products.m) {
    for (const double product : row)
      size = std::max(size, std::fabs(product));
  }
  RotationVotes votes;
  if (!(size > 0)) {
    votes.add({}, 1);
    return votes;
  }
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j)
      s[i][j] = products.m[i][j] / size + (i == j ? kPriorWeight : 0);
  }
  double trace = s[0][0] + s[1][1] + s[2][2];
  auto& n = votes.n;
  n[0][0] = trace;
  n[0][1] = n[1][0] = s[1][2] - s[2][1];
  n[0][2] = n[2][0] = s[2][0] - s[0][2];
  n[0][3] = n[3][0] = s[0][1] - s[1][0];
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j)
      n[i + 1][j + 1] = s[i][j] + s[j][i] - (i == j ? trace : 0);
  }
  return votes;
}

}  // namespace anicodec
