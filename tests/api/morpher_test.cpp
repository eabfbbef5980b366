// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Multi-scale geometry interpolation through the C interface: of clips, and of the caller's meshes.
#include "codec/surface/closest_point.h"
#include "corpus/poses.h"
#include "sdk/clip/sample.h"
#include "tests/api/opened.h"

#include <cmath>
#include <random>
#include <thread>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

const Bytes& msgi_clip(const std::string& name) {
  static std::map<std::string, Bytes> files;
  Bytes& file = files[name];
  if (file.empty()) {
    EncodeOptions options;
    options.keyframes = 4;
    options.basis = BasisChoice::kKeyframes;
    options.interpolation = InterpolationChoice::kMsgi;
    file =
        encode(name == "large" ? corpus::make_scaled("helix", 3000, 30) : corpus::make_clip(name),
               options)
            .file;
  }
  return file;
}

constexpr const char* kClips[] = {"helix", "soup", "nonmanifold", "leftovers", "polygons"};

TEST(AnicMsgi, SeeksFramesInAnyOrderWithTheSameBits) {
  for (const char* name : kClips) {
    SCOPED_TRACE(name);
    const Bytes& file = msgi_clip(name);
    Clip clip;
    ASSERT_TRUE(clip.open(file).ok());
    anic_options options = ANIC_INIT(anic_options);
    options.flags = ANIC_OPEN_BOUNDS;
    const Asset asset = open(file, &options);
    const Context context = context_of(asset);
    EXPECT_EQ(anic_verify_asset(asset.get()), ANIC_OK);
    std::vector<float> expected(size_t{3} * clip.vertex_count());
    std::mt19937 random(1);
    for (int i = 0; i < 12; ++i) {
      const auto f = static_cast<uint32_t>(random() % clip.frame_count());
      ASSERT_EQ(show_positions(clip, 0, f, expected.data()), Status::kOk);
      const std::vector<float> before = i > 0 ? positions(asset, context) : expected;
      ASSERT_EQ(anic_seek_frame(context.get(), f), ANIC_OK);
      EXPECT_EQ(positions(asset, context), expected);
      EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), before);
      anic_box now, then;
      ASSERT_EQ(anic_compute_bounds(context.get(), 0, ANIC_WHEN_CURRENT, &now), ANIC_OK);
      ASSERT_EQ(anic_get_frame_bounds(asset.get(), 0, f, &then), ANIC_OK);
      EXPECT_TRUE(std::equal(now.min, now.min + 3, then.min));
      EXPECT_TRUE(std::equal(now.max, now.max + 3, then.max));
    }
    ASSERT_EQ(anic_forget_previous(context.get()), ANIC_OK);
    ASSERT_EQ(anic_seek_frame(context.get(), 0), ANIC_OK);
    EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), expected);
  }
}

TEST(AnicMsgi, WritesOtherFormatsAndRangesFromSeveralThreads) {
  const Asset asset = open(msgi_clip("helix"));
  const Context context = context_of(asset);
  ASSERT_EQ(anic_seek_time(context.get(), 0.31, ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP), ANIC_OK);
  const std::vector<float> all = positions(asset, context);
  const uint32_t n = vertices_of(asset);
  std::vector<float> cut(all.size() / 3 * 4, -5);
  auto write = [&](uint32_t first, uint32_t count) {
    anic_output output = ANIC_INIT(anic_output);
    output.data = cut.data() + size_t{4} * first;
    output.size = sizeof(float) * 4 * count;
    output.format = ANIC_FORMAT_FLOAT32X4;
    EXPECT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, first, count, &output),
              ANIC_OK);
  };
  std::thread other([&] { write(0, 37); });
  write(37, n - 37);
  other.join();
  for (uint32_t v = 0; v < n; ++v) {
    EXPECT_TRUE(std::equal(&all[size_t{3} * v], &all[size_t{3} * v] + 3, &cut[size_t{4} * v]));
    EXPECT_EQ(cut[size_t{4} * v + 3], 1);
  }
}

TEST(AnicMsgi, GivesAGpuTheShape) {
  for (const char* name : kClips) {
    const Asset asset = open(msgi_clip(name));
    const Context context = context_of(asset);
    ASSERT_EQ(anic_seek_frame(context.get(), 3), ANIC_OK);
    anic_basis basis = ANIC_INIT(anic_basis);
    anic_parts shown = ANIC_INIT(anic_parts);
    ASSERT_EQ(anic_get_basis(asset.get(), 0, &basis), ANIC_OK);
    ASSERT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
    ASSERT_EQ(shown.count, 1U);
    EXPECT_EQ(basis.reconstruction, ANIC_RECONSTRUCTION_MSGI);
    ASSERT_NE(shown.parts[0].shape, nullptr);
    const std::vector<float> x = positions(asset, context);
    for (uint32_t v = 0; v < basis.vertex_count; ++v) {
      const float* p =
          shown.parts[0].shape + size_t{3} * (basis.vertex_shape ? basis.vertex_shape[v] : v);
      for (size_t c = 0; c < 3; ++c) {
        const float* m = shown.parts[0].motion + 4 * c;
        EXPECT_NEAR(m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3], x[size_t{3} * v + c], 1e-5)
            << name;
      }
    }
    std::vector<float> out(x.size());
    const anic_output output = floats(out);
    const uint32_t frame = 3;
    EXPECT_EQ(anic_write_frames(asset.get(), 0, &frame, 1, 0, basis.vertex_count, &output),
              ANIC_E_STATE);
  }
}

TEST(AnicMsgi, TakesTheMemoryThatTheQueryToldAndNoMore) {
  for (const char* name : {"large", "helix", "soup", "nonmanifold", "leftovers"}) {
    SCOPED_TRACE(name);
    const Bytes& file = msgi_clip(name);
    anic_requirements r = ANIC_INIT(anic_requirements);
    ASSERT_EQ(
        anic_get_requirements(file.data(), 4096 < file.size() ? 4096 : file.size(), nullptr, &r),
        ANIC_OK);
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    const Asset asset = open(file, &options);
    EXPECT_LE(memory.peak, r.opening_bytes);
    EXPECT_EQ(info_of(asset).resident_bytes, memory.held);
    const auto held = static_cast<double>(memory.held);
    EXPECT_GE(static_cast<double>(r.resident_bytes), held);
    EXPECT_LE(static_cast<double>(r.resident_bytes), 3.5 * held + 4096);
    EXPECT_LE(info_of(asset).context_bytes, r.context_bytes);
    const size_t before = memory.held;
    const Context context = context_of(asset);
    EXPECT_EQ(memory.held - before, info_of(asset).context_bytes);
    const size_t calls = memory.calls;
    ASSERT_EQ(anic_seek_frame(context.get(), 2), ANIC_OK);
    ASSERT_EQ(anic_seek_time(context.get(), 0.4, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP), ANIC_OK);
    positions(asset, context);
    EXPECT_EQ(memory.calls, calls);
    options.max_bytes = before;
    anic_asset* none = nullptr;
    EXPECT_EQ(anic_open_asset(file.data(), file.size(), &options, &none, nullptr), ANIC_E_LIMIT);
  }
}

TEST(AnicMsgi, FailsWithoutALeakWhicheverAllocationFails) {
  EXPECT_GT(expect_no_leak_whichever_allocation_fails(msgi_clip("nonmanifold")), 100U);
}

TEST(AnicMsgi, RefusesDamagedFilesWithoutALeak) {
  // Checksums are made right again by nobody here: what gets through them is tested by fuzzing.
  const Bytes& file = msgi_clip("nonmanifold");
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    Bytes damaged = file;
    damaged[random() % damaged.size()] ^= static_cast<uint8_t>(1 + random() % 255);
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    anic_asset* asset = nullptr;
    anic_status status = anic_open_asset(damaged.data(), damaged.size(), &options, &asset, nullptr);
    anic_close_asset(asset);
    anic_box box;
    if (status == ANIC_OK)  // boxes have a checksum that opening does not look at
      status = anic_read_bounds(damaged.data(), damaged.size(), 0, 0, 0, &box);
    EXPECT_NE(status, ANIC_OK);
    EXPECT_EQ(memory.held, 0U);
  }
}

/// Meshes of a caller.
struct Meshes {
  explicit Meshes(const std::string& name) : clip(corpus::make_poses(name)) {
    triangles = fan_triangles(clip.polygons);
    for (uint32_t f = 0; f < clip.frame_count; ++f)
      inputs.push_back(clip.frame(f).data());
  }

  anic_status create(anic_morpher** out, const anic_morpher_options* options = nullptr,
                     const anic_allocator* allocator = nullptr) const {
    return anic_create_morpher(triangles.data(), static_cast<uint32_t>(triangles.size() / 3),
                               clip.vertex_count, inputs.data(),
                               static_cast<uint32_t>(inputs.size()), options, allocator, out);
  }

  MeshSequence clip;
  std::vector<uint32_t> triangles;
  std::vector<const float*> inputs;
};

TEST(AnicMorpher, BlendsMeshesOfTheCaller) {
  const Meshes meshes("bend");
  CountingMemory memory;
  const anic_allocator allocator = memory.allocator();
  anic_morpher* morpher = nullptr;
  ASSERT_EQ(meshes.create(&morpher, nullptr, &allocator), ANIC_OK);
  anic_morpher_info info = ANIC_INIT(anic_morpher_info);
  anic_get_morpher_info(morpher, &info);
  EXPECT_EQ(info.vertex_count, meshes.clip.vertex_count);
  EXPECT_EQ(info.mesh_count, 2U);
  EXPECT_EQ(info.resident_bytes, memory.held);
  const size_t calls = memory.calls;
  std::vector<double> scratch(info.scratch_bytes / 8 + 1);
  std::vector<float> x(size_t{3} * info.vertex_count), threaded = x;
  const size_t size = 8 * scratch.size();
  const double diagonal = anicodec::diagonal(meshes.clip);
  for (size_t i = 0; i < 2; ++i) {
    const double weights[] = {i == 0 ? 1.0 : 0.0, i == 0 ? 0.0 : 1.0};
    ASSERT_EQ(anic_morph(morpher, weights, nullptr, nullptr, scratch.data(), size, x.data()),
              ANIC_OK);
    for (size_t k = 0; k < x.size(); ++k)
      EXPECT_NEAR(x[k], meshes.inputs[i][k], 1e-6 * diagonal);
  }
  const double weights[] = {0.4, 0.6};
  anic_threads threads = {};
  threads.run = [](void*, size_t count, void (*body)(void*, size_t), void* context) {
    std::thread half([&] {
      for (size_t i = 0; i < count; i += 2)
        body(context, i);
    });
    for (size_t i = 1; i < count; i += 2)
      body(context, i);
    half.join();
  };
  ASSERT_EQ(anic_morph(morpher, weights, nullptr, nullptr, scratch.data(), size, x.data()),
            ANIC_OK);
  ASSERT_EQ(anic_morph(morpher, weights, nullptr, &threads, scratch.data(), size, threaded.data()),
            ANIC_OK);
  EXPECT_EQ(x, threaded);
  EXPECT_EQ(memory.calls, calls);
  EXPECT_EQ(anic_morph(morpher, weights, nullptr, nullptr, scratch.data(), info.scratch_bytes - 1,
                       x.data()),
            ANIC_E_BUFFER_SIZE);
  EXPECT_EQ(anic_morph(morpher, weights, nullptr, nullptr,
                       reinterpret_cast<char*>(scratch.data()) + 4, size, x.data()),
            ANIC_E_ARGUMENT);
  const double wrong[] = {0.4, 0.7};
  EXPECT_EQ(anic_morph(morpher, wrong, nullptr, nullptr, scratch.data(), size, x.data()),
            ANIC_E_ARGUMENT);
  anic_destroy_morpher(morpher);
  anic_destroy_morpher(nullptr);
  EXPECT_EQ(memory.held, 0U);
}

TEST(AnicMorpher, HoldsPins) {
  const Meshes meshes("bend");
  const uint32_t pins[] = {0, 5};
  anic_morpher_options options = ANIC_INIT(anic_morpher_options);
  options.pins = pins;
  options.pin_count = 2;
  options.sweeps = 2;
  anic_morpher* morpher = nullptr;
  ASSERT_EQ(meshes.create(&morpher, &options), ANIC_OK);
  anic_morpher_info info = ANIC_INIT(anic_morpher_info);
  anic_get_morpher_info(morpher, &info);
  std::vector<double> scratch(info.scratch_bytes / 8 + 1);
  std::vector<float> x(size_t{3} * info.vertex_count);
  const double weights[] = {0.5, 0.5};
  const float at[] = {1, 2, 3, 1.5F, 2, 3};
  EXPECT_EQ(
      anic_morph(morpher, weights, nullptr, nullptr, scratch.data(), 8 * scratch.size(), x.data()),
      ANIC_E_ARGUMENT);
  ASSERT_EQ(anic_morph(morpher, weights, at, nullptr, scratch.data(), 8 * scratch.size(), x.data()),
            ANIC_OK);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(x[c], at[c]);
    EXPECT_EQ(x[15 + c], at[3 + c]);
  }
  anic_destroy_morpher(morpher);
}

TEST(AnicMorpher, SaysWhatItCannotDo) {
  Meshes meshes("bend");
  anic_morpher* morpher = nullptr;
  anic_morpher_options options = ANIC_INIT(anic_morpher_options);
  options.leaf_faces = 256;
  EXPECT_EQ(meshes.create(&morpher, &options), ANIC_E_ARGUMENT);
  options = ANIC_INIT(anic_morpher_options);
  options.pin_count = 1;
  EXPECT_EQ(meshes.create(&morpher, &options), ANIC_E_ARGUMENT);
  options.pins = &meshes.clip.vertex_count;
  EXPECT_EQ(meshes.create(&morpher, &options), ANIC_E_ARGUMENT);
  options = ANIC_INIT(anic_morpher_options);
  options.max_bytes = 1000;
  EXPECT_EQ(meshes.create(&morpher, &options), ANIC_E_LIMIT);
  EXPECT_EQ(morpher, nullptr);
  for (size_t n = 0; n < 60; n += 5) {
    CountingMemory memory;
    memory.fail_at = n;
    const anic_allocator allocator = memory.allocator();
    EXPECT_EQ(meshes.create(&morpher, nullptr, &allocator), ANIC_E_MEMORY);
    EXPECT_EQ(memory.held, 0U);
  }
  Meshes one = meshes;
  one.inputs.resize(1);
  EXPECT_EQ(one.create(&morpher), ANIC_E_ARGUMENT);
  one.inputs.push_back(nullptr);
  EXPECT_EQ(one.create(&morpher), ANIC_E_ARGUMENT);
  meshes.clip.positions[7] = NAN;
  EXPECT_EQ(meshes.create(&morpher), ANIC_E_NON_FINITE);
  meshes.clip.positions[7] = 0;
  meshes.triangles[4] = meshes.clip.vertex_count;
  EXPECT_EQ(meshes.create(&morpher), ANIC_E_INDEX_RANGE);
}

}  // namespace
}  // namespace anicodec
