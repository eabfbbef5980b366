// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Opened without the source's order, a clip shows the same vertices and polygons in another one.
#include "sdk/clip/sample.h"
#include "tests/api/opened.h"
#include "tests/codec/edited_file.h"

#include <algorithm>
#include <array>

namespace anicodec {
namespace {

using Points = std::vector<std::array<float, 3>>;

struct Shown {
  anic_order order = ANIC_ORDER_VERTICES;
  Points vertices;               ///< of the last frame, sorted
  std::vector<Points> polygons;  ///< their corners there, sorted
  anic_status verified = ANIC_OK;
};

anic_status show(const Bytes& file, uint64_t flags, Shown* out) {
  anic_options options = ANIC_INIT(anic_options);
  options.flags = flags;
  anic_asset* opened = nullptr;
  const anic_status status = anic_open_asset(file.data(), file.size(), &options, &opened, nullptr);
  if (status != ANIC_OK)
    return status;
  const Asset asset(opened);
  out->verified = anic_verify_asset(opened);
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(opened, &info);
  out->order = info.order;
  Clip clip;
  OpenOptions direct;
  direct.any_order = flags & ANIC_OPEN_ANY_ORDER;
  EXPECT_TRUE(clip.open(file, direct).ok());
  const Topology& t = clip.meshes()[0].topology;
  Points points(t.vertex_coded.size());
  EXPECT_EQ(show_positions(clip, 0, clip.frame_count() - 1, points[0].data()), Status::kOk);
  for (size_t p = 0; p + 1 < t.polygon_offsets.size(); ++p) {
    Points& polygon = out->polygons.emplace_back();
    for (uint32_t c = t.polygon_offsets[p]; c < t.polygon_offsets[p + 1]; ++c)
      polygon.push_back(points[t.polygon_corners[c]]);
    std::ranges::sort(polygon);
  }
  std::ranges::sort(points);
  std::ranges::sort(out->polygons);
  out->vertices = points;
  return ANIC_OK;
}

TEST(AnyOrder, ShowsTheSameVerticesAndPolygons) {
  for (const char* name : {"polygons", "painted_box", "leftovers", "limb"}) {
    SCOPED_TRACE(name);
    EncodeOptions options;
    options.target = {ErrorMetric::kMaxError, 1, true};
    options.order = OrderMode::kAll;
    options.effort = Effort::kFast;
    const Bytes file = encode(corpus::make_clip(name), options).file;
    Shown source, any;
    ASSERT_EQ(show(file, 0, &source), ANIC_OK);
    ASSERT_EQ(show(file, ANIC_OPEN_ANY_ORDER, &any), ANIC_OK);
    EXPECT_EQ(source.order, ANIC_ORDER_ALL);
    EXPECT_EQ(any.order, ANIC_ORDER_FREE);
    EXPECT_EQ(any.verified, ANIC_OK);
    EXPECT_EQ(any.vertices, source.vertices);
    EXPECT_EQ(any.polygons, source.polygons);
    // The order is not looked at.
    EditedFile edited(file);
    edited.part("VMAP").payload = edited.part("FMAP").payload = Bytes(20, 0x5A);
    EXPECT_NE(show(edited.bytes(), 0, &source), ANIC_OK);
    EXPECT_EQ(show(edited.bytes(), ANIC_OPEN_ANY_ORDER, &any), ANIC_OK);
  }
}

}  // namespace
}  // namespace anicodec
