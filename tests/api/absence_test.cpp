// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// A mesh that is in some frames only.
#include "codec/encode.h"
#include "tests/api/opened.h"
#include "tests/two_boxes.h"

namespace anicodec {
namespace {

TEST(AnicAbsence, HasAStatus) {
  EncodeOptions encoding;
  encoding.target = {ErrorMetric::kMaxError, 1, true};
  encoding.effort = Effort::kFast;
  const Bytes file = encode(split_parts(two_boxes()), encoding).file;
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_BOUNDS;
  const Asset asset = open(file, &options);
  const Context context = context_of(asset);
  for (uint32_t m = 0; m < 2; ++m) {
    std::vector<float> points(size_t{3} * vertices_of(asset, m));
    const anic_output output = floats(points);
    const uint32_t n = vertices_of(asset, m);
    for (uint32_t f = 0; f < kBoxFrames; ++f) {
      SCOPED_TRACE(f);
      const anic_status expected = m == 1 && f >= 4 && f < 8 ? ANIC_E_ABSENT : ANIC_OK;
      anic_box box;
      anic_parts parts = ANIC_INIT(anic_parts);
      anic_normal_plan_options normals = ANIC_INIT(anic_normal_plan_options);
      normals.reference_frame = f;
      anic_normal_plan* plan = nullptr;
      ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
      EXPECT_EQ(anic_write_positions(context.get(), m, ANIC_WHEN_CURRENT, 0, n, &output), expected);
      EXPECT_EQ(anic_compute_bounds(context.get(), m, ANIC_WHEN_CURRENT, &box), expected);
      EXPECT_EQ(anic_get_parts(context.get(), m, ANIC_WHEN_CURRENT, &parts), expected);
      EXPECT_EQ(anic_write_frames(asset.get(), m, &f, 1, 0, n, &output), expected);
      EXPECT_EQ(anic_get_frame_bounds(asset.get(), m, f, &box), expected);
      EXPECT_EQ(anic_create_normal_plan(asset.get(), m, &normals, nullptr, &plan), expected);
      anic_destroy_normal_plan(plan);
    }
    anic_box box;
    EXPECT_EQ(anic_get_clip_bounds(asset.get(), m, &box), ANIC_OK);
  }
}

}  // namespace
}  // namespace anicodec
