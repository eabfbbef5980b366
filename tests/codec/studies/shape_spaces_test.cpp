// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/studies/shape_spaces.h"

#include "codec/keyframes/keyframe_fit.h"
#include "codec/studies/basis_error.h"
#include "corpus/clips.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

const ShapeSpaceError& row(const std::vector<ShapeSpaceError>& rows, const std::string& space,
                           size_t k) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ShapeSpaceError& r) {
    return r.space == space && r.k == k;
  });
  EXPECT_NE(found, rows.end()) << space << " " << k;
  return *found;
}

TEST(ShapeSpaces, VerticesHaveTheErrorOfTheirEigenvalues) {
  // As few frames as are measured.
  const MeshSequence clip = corpus::make_scaled("limb", 300, 16);
  const size_t counts[] = {1, 3, 7};
  const std::vector<ShapeSpaceError> rows = shape_space_errors(clip, counts);
  KeyframeFitter fitter{FrameView(clip)};
  for (const BasisError& e : basis_errors(fitter, counts)) {
    if (e.method == "pca-mean-rigid") {
      // The best motion of each frame may do a little better still.
      EXPECT_LE(row(rows, "vertices", e.k).kg, 1.001 * e.kg);
      EXPECT_GE(row(rows, "vertices", e.k).kg, 0.8 * e.kg);
    }
  }
}

TEST(ShapeSpaces, AllComponentsGiveTheFramesBack) {
  const MeshSequence clip = corpus::make_scaled("helix", 600, 9);
  const size_t counts[] = {1, 4, 8, 9};
  const std::vector<ShapeSpaceError> rows = shape_space_errors(clip, counts);
  EXPECT_EQ(rows.size(), 9U);  // nine frames span eight dimensions
  for (const std::string space : {"vertices", "edges", "gradients"}) {
    EXPECT_LT(row(rows, space, 8).kg, 0.01) << space;
    EXPECT_LT(row(rows, space, 8).residual_percent, 1e-6) << space;
    EXPECT_LT(row(rows, space, 4).residual_percent, row(rows, space, 1).residual_percent) << space;
    EXPECT_EQ(row(rows, space, 4).bytes, 4 * (5 * row(rows, space, 4).numbers + 4 * 9)) << space;
  }
}

TEST(ShapeSpaces, LengthsAndAnglesNeedFewComponentsOfARodThatWindsUp) {
  const MeshSequence clip = corpus::make_scaled("helix", 600, 24);
  const size_t counts[] = {1, 2};
  const std::vector<ShapeSpaceError> rows = shape_space_errors(clip, counts);
  for (size_t k : counts)
    EXPECT_LT(row(rows, "edges", k).kg, 0.5 * row(rows, "vertices", k).kg) << k;
}

TEST(ShapeSpaces, TakeAnyMesh) {
  const size_t counts[] = {1, 2};
  for (const char* name : {"points", "one_vertex", "one_triangle", "nonmanifold", "soup",
                           "one_frame", "static", "leftovers", "far"}) {
    for (const ShapeSpaceError& r : shape_space_errors(corpus::make_clip(name), counts)) {
      EXPECT_GE(r.kg, 0) << name;
      EXPECT_LE(r.kg, 1000) << name << " " << r.space;
    }
  }
}

}  // namespace
}  // namespace anicodec
