// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Vectors of three doubles whose sums are evaluated in a fixed order.
#ifndef ANICODEC_SDK_BASE_VECTOR3_H_
#define ANICODEC_SDK_BASE_VECTOR3_H_

#include <cmath>
#include <cstddef>

namespace anicodec {

struct Vector3 {
  double x[3] = {0, 0, 0};

  double& operator[](size_t i) { return x[i]; }

  double operator[](size_t i) const { return x[i]; }

  Vector3& operator+=(const Vector3& b) {
    for (size_t i = 0; i < 3; ++i)
      x[i] += b.x[i];
    return *this;
  }

  friend Vector3 operator+(Vector3 a, const Vector3& b) { return a += b; }

  friend Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }

  friend Vector3 operator*(double s, const Vector3& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
};

template <class Number>
Vector3 vector_at(const Number* p) {
  return {{double{p[0]}, double{p[1]}, double{p[2]}}};
}

inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

inline double length(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_VECTOR3_H_
