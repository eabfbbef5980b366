// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C++ wrapper does what the C functions do, and gives everything back.
#include "tests/api/opened.h"

#include <anicodec/anicodec.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>

namespace anicodec {
namespace {

static_assert(!std::is_copy_constructible_v<anic::Asset>);
static_assert(std::is_nothrow_move_constructible_v<anic::Asset>);
static_assert(std::is_nothrow_move_assignable_v<anic::Context>);
static_assert(std::is_convertible_v<std::vector<float>&, anic::Span<const float>>);
static_assert(!std::is_convertible_v<const std::vector<float>&, anic::Span<float>>);
static_assert(!std::is_convertible_v<std::vector<float>&, anic::Span<const int>>);

const Bytes& limb() {
  return encoded_clip("limb", BasisChoice::kEigentrajectories);
}

TEST(AnicWrapper, OpensPlaysAndGivesBack) {
  CountingMemory memory;
  anic_options options = ANIC_INIT(anic_options);
  options.allocator = memory.allocator();
  options.flags = ANIC_OPEN_BOUNDS;
  {
    anic::Asset asset;
    EXPECT_FALSE(asset);
    ASSERT_TRUE(asset.open(limb(), &options));
    ASSERT_TRUE(asset);
    EXPECT_TRUE(asset.verify());
    const Asset expected = open(limb(), &options);
    EXPECT_EQ(asset.info().frame_count, info_of(expected).frame_count);
    EXPECT_EQ(asset.mesh().vertex_count, vertices_of(expected));
    EXPECT_EQ(asset.polygons().polygon_count, asset.mesh().polygon_count);
    EXPECT_EQ(asset.coded_vertices().size(), asset.mesh().vertex_count);
    EXPECT_EQ(asset.frame_time(3), anic_get_frame_time(expected.get(), 3));
    EXPECT_EQ(asset.mesh(7).vertex_count, 0U);
    EXPECT_EQ(asset.polygons(7).polygon_count, 0U);
    EXPECT_EQ(asset.coded_vertices(7).size(), 0U);

    const anic_mesh mesh = asset.mesh();
    std::vector<uint16_t> narrow(size_t{3} * mesh.triangle_count);
    std::vector<uint32_t> wide(narrow.size());
    ASSERT_TRUE(asset.write_indices<uint16_t>(narrow));
    ASSERT_TRUE(asset.write_indices<uint32_t>(wide));
    EXPECT_TRUE(std::equal(wide.begin(), wide.end(), narrow.begin()));
    wide.pop_back();
    EXPECT_EQ(asset.write_indices<uint32_t>(wide).code(), ANIC_E_BUFFER_SIZE);

    anic::Context context;
    ASSERT_TRUE(context.create(asset));
    std::vector<float> points(size_t{3} * mesh.vertex_count);
    EXPECT_EQ(context.write_positions(anic::output(points), 0, mesh.vertex_count).code(),
              ANIC_E_STATE);
    ASSERT_TRUE(context.seek_frame(5));
    ASSERT_TRUE(context.write_positions(anic::output(points), 0, mesh.vertex_count));
    EXPECT_EQ(points, frame(expected, 5));
    ASSERT_TRUE(context.seek(asset.frame_time(9), ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP));
    ASSERT_TRUE(
        context.write_positions(anic::output(points), 0, mesh.vertex_count, ANIC_WHEN_PREVIOUS));
    EXPECT_EQ(points, frame(expected, 5));
    ASSERT_TRUE(context.forget_previous());
    ASSERT_TRUE(
        context.write_positions(anic::output(points), 0, mesh.vertex_count, ANIC_WHEN_PREVIOUS));
    EXPECT_EQ(points, frame(expected, 9));

    anic_box now, table, clip;
    ASSERT_TRUE(context.compute_bounds(&now));
    ASSERT_TRUE(asset.frame_bounds(9, &table));
    ASSERT_TRUE(asset.bounds(&clip));
    EXPECT_EQ(std::memcmp(&now, &table, sizeof now), 0);

    anic_parts shown = ANIC_INIT(anic_parts);
    ASSERT_TRUE(context.parts(&shown));
    ASSERT_EQ(shown.count, 1U);
    anic_basis basis = ANIC_INIT(anic_basis);
    ASSERT_TRUE(asset.basis(shown.parts[0].segment, &basis));
    EXPECT_EQ(basis.vertex_count, mesh.vertex_count);

    anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
    ASSERT_TRUE(asset.texture_layout(shown.parts[0].segment, 4096, &layout));
    std::vector<unsigned char> texture(size_t{8} * layout.width * layout.narrow_height);
    ASSERT_TRUE(asset.write_texture(shown.parts[0].segment, ANIC_TEXTURE_NARROW, layout, texture));
    std::vector<float> state(layout.state_floats);
    ASSERT_TRUE(context.write_state(0, state));
    ASSERT_TRUE(context.set_clip(0));
    ASSERT_TRUE(context.set_quality(0.5));
    ASSERT_TRUE(context.blend(0, asset.frame_time(3), 1));
    ASSERT_TRUE(context.set_quality(1));

    const std::array<uint32_t, 2> frames = {2, 7};
    std::vector<float> two[2] = {points, points};
    const std::array<anic_output, 2> outputs = {anic::output(two[0]), anic::output(two[1])};
    ASSERT_TRUE(asset.write_frames(frames, outputs, 0, mesh.vertex_count));
    EXPECT_EQ(two[0], frame(expected, 2));
    EXPECT_EQ(two[1], frame(expected, 7));
    EXPECT_EQ(asset.write_frames(frames, {outputs.data(), 1}, 0, 1).code(), ANIC_E_ARGUMENT);

    anic::NormalPlan normals;
    ASSERT_TRUE(normals.create(asset));
    ASSERT_EQ(normals.size(), mesh.vertex_count);
    std::vector<float> directions(points.size());
    ASSERT_TRUE(
        normals.write_normals(points.data(), anic::output(directions), 0, mesh.vertex_count));
    EXPECT_NEAR(std::hypot(directions[0], directions[1], directions[2]), 1, 1e-6);
  }
  EXPECT_EQ(memory.held, 0U);
}

TEST(AnicWrapper, HandlesMoveAndClose) {
  CountingMemory memory;
  anic_options options = ANIC_INIT(anic_options);
  options.allocator = memory.allocator();
  anic::Asset a;
  ASSERT_TRUE(a.open(limb(), &options));
  anic::Asset b = std::move(a);
  EXPECT_FALSE(a);  // NOLINT: that is what is asked
  ASSERT_TRUE(b);
  EXPECT_GT(memory.held, 0U);
  anic_failure failure = ANIC_INIT(anic_failure);
  EXPECT_EQ(b.open(anic::Span<const uint8_t>(), &options, &failure).code(), ANIC_E_MAGIC);
  EXPECT_EQ(failure.status, ANIC_E_MAGIC);
  EXPECT_FALSE(b);  // what could not be opened leaves nothing behind
  EXPECT_EQ(memory.held, 0U);
  ASSERT_TRUE(b.open(limb(), &options));
  b.close();
  EXPECT_EQ(memory.held, 0U);
}

TEST(AnicWrapper, OpensThroughAFunction) {
  const Bytes& file = limb();
  size_t calls = 0;
  auto read = [&](uint64_t offset, void* to, size_t size) {
    ++calls;
    std::memcpy(to, file.data() + offset, size);
    return true;
  };
  anic::Asset asset;
  ASSERT_TRUE(asset.open(file.size(), read));
  EXPECT_GT(calls, 0U);
  EXPECT_EQ(asset.info().frame_count, info_of(open(file)).frame_count);
  auto refuse = [](uint64_t, void*, size_t) { return false; };
  EXPECT_EQ(asset.open(file.size(), refuse).code(), ANIC_E_READ);
}

TEST(AnicWrapper, StreamsAndQueries) {
  const Bytes& file = limb();
  anic_requirements needs = ANIC_INIT(anic_requirements);
  ASSERT_TRUE(anic::get_requirements(file, &needs));
  anic::Stream stream;
  ASSERT_TRUE(stream.create());
  anic::Asset asset;
  for (size_t at = 0; at < file.size(); at += 100) {
    const size_t size = std::min<size_t>(100, file.size() - at);
    ASSERT_TRUE(stream.push({file.data() + at, size}));
    EXPECT_EQ(static_cast<bool>(asset.open(stream)), stream.info().playable != 0);
  }
  EXPECT_TRUE(stream.info().complete);
  EXPECT_EQ(stream.failure().status, ANIC_OK);
  EXPECT_TRUE(asset.verify());
  EXPECT_NEAR(static_cast<double>(asset.info().resident_bytes),
              static_cast<double>(needs.resident_bytes),
              0.05 * static_cast<double>(needs.resident_bytes) + 4096);
}

TEST(AnicWrapper, PutsABoxIntoSixteenBits) {
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_BOUNDS;
  anic::Asset asset;
  anic::Context context;
  anic_box box;
  ASSERT_TRUE(asset.open(limb(), &options) && context.create(asset) && asset.bounds(&box));
  ASSERT_TRUE(context.seek_frame(4));
  const std::vector<float> exact = frame(open(limb()), 4);
  const uint32_t n = asset.mesh().vertex_count;
  std::vector<int16_t> bits(size_t{3} * n);
  for (anic_format format : {ANIC_FORMAT_UNORM16X3, ANIC_FORMAT_SNORM16X3}) {
    const double steps = format == ANIC_FORMAT_UNORM16X3 ? 65535 : 32767;
    const anic_output out = anic::within(anic::output(bits.data(), 2 * bits.size(), format), box);
    ASSERT_TRUE(context.write_positions(out, 0, n));
    for (size_t i = 0; i < bits.size(); ++i) {
      const double stored = format == ANIC_FORMAT_UNORM16X3
                                ? static_cast<double>(static_cast<uint16_t>(bits[i]))
                                : bits[i];
      const double scale = static_cast<double>(out.scale[i % 3]);
      const double x = static_cast<double>(out.offset[i % 3]) + scale * stored / steps;
      ASSERT_NEAR(x, static_cast<double>(exact[i]), 0.51 * scale / steps + 1e-6 * scale);
    }
  }
}

}  // namespace
}  // namespace anicodec
