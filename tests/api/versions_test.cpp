// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Hosts whose header is older or newer than the library: structs that are shorter or longer.
#include "tests/api/opened.h"

#include <cstddef>
#include <cstring>

namespace anicodec {
namespace {

const Bytes& clip_file() {
  return encoded_clip("cloth", BasisChoice::kEigenshapes);
}

/// A struct of a host, with bytes behind it that nobody may touch.
template <class Struct>
struct Host {
  static constexpr size_t kRoom = 512;

  explicit Host(size_t size) {
    std::memset(bytes, 0xA5, sizeof bytes);
    std::memset(bytes, 0, size);
    std::memcpy(bytes, &size, sizeof size);
    length = size;
  }

  Struct* get() { return reinterpret_cast<Struct*>(bytes); }

  size_t said() const {
    size_t size;
    std::memcpy(&size, bytes, sizeof size);
    return size;
  }

  bool is_all(size_t from, size_t to, unsigned char value) const {
    return std::all_of(bytes + from, bytes + to, [&](unsigned char b) { return b == value; });
  }

  alignas(16) unsigned char bytes[sizeof(Struct) + kRoom];
  size_t length;
};

/// Fills structs of several lengths by `get`, which is given one to fill.
template <class Struct, class Get>
void expect_every_length_is_filled(Get get) {
  Struct whole = ANIC_INIT(Struct);
  ASSERT_EQ(get(&whole), ANIC_OK);
  for (size_t size = sizeof(size_t); size <= sizeof(Struct) + 64; size += 8) {
    SCOPED_TRACE(size);
    Host<Struct> host(size);
    // A host that is newer than the library finds what it left there replaced by 0.
    std::memset(host.bytes + sizeof size, 0x77, size - sizeof size);
    ASSERT_EQ(get(host.get()), ANIC_OK);
    EXPECT_EQ(host.said(), size);
    const size_t both = std::min(size, sizeof(Struct));
    EXPECT_EQ(
        std::memcmp(host.bytes + sizeof size,
                    reinterpret_cast<unsigned char*>(&whole) + sizeof size, both - sizeof size),
        0);
    EXPECT_TRUE(host.is_all(both, size, 0));
    EXPECT_TRUE(host.is_all(size, sizeof host.bytes, 0xA5));
  }
  for (const size_t size : {size_t{0}, sizeof(size_t) - 1, size_t{4097}, SIZE_MAX}) {
    Struct unset = ANIC_INIT(Struct);
    unset.struct_size = size;
    EXPECT_EQ(get(&unset), ANIC_E_ARGUMENT) << size;
  }
}

TEST(AnicVersions, StructsThatAreFilledMayHaveAnyLength) {
  const Bytes& file = clip_file();
  const Asset asset = open(file);
  const Context context = context_of(asset);
  ASSERT_EQ(anic_seek_frame(context.get(), 3), ANIC_OK);
  anic_asset* a = asset.get();
  expect_every_length_is_filled<anic_asset_info>(
      [&](anic_asset_info* out) { return anic_get_asset_info(a, out); });
  expect_every_length_is_filled<anic_mesh>(
      [&](anic_mesh* out) { return anic_get_mesh(a, 0, out); });
  expect_every_length_is_filled<anic_polygons>(
      [&](anic_polygons* out) { return anic_get_polygons(a, 0, out); });
  expect_every_length_is_filled<anic_basis>(
      [&](anic_basis* out) { return anic_get_basis(a, 0, out); });
  expect_every_length_is_filled<anic_parts>(
      [&](anic_parts* out) { return anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, out); });
  expect_every_length_is_filled<anic_texture_layout>(
      [&](anic_texture_layout* out) { return anic_get_texture_layout(a, 0, 4096, out); });
  expect_every_length_is_filled<anic_requirements>([&](anic_requirements* out) {
    return anic_get_requirements(file.data(), file.size(), nullptr, out);
  });
  const Asset painted = open(encoded_clip("painted_box", BasisChoice::kKeyframes));
  expect_every_length_is_filled<anic_attribute>(
      [&](anic_attribute* out) { return anic_get_attribute(painted.get(), 0, 1, out); });

  anic_stream* stream = nullptr;
  ASSERT_EQ(anic_create_stream(nullptr, &stream), ANIC_OK);
  ASSERT_EQ(anic_push_bytes(stream, file.data(), file.size()), ANIC_OK);
  expect_every_length_is_filled<anic_stream_info>(
      [&](anic_stream_info* out) { return anic_get_stream_info(stream, out); });
  expect_every_length_is_filled<anic_failure>(
      [&](anic_failure* out) { return anic_get_stream_failure(stream, out); });
  anic_destroy_stream(stream);

  expect_every_length_is_filled<anic_failure>([&](anic_failure* out) {
    anic_asset* none = nullptr;
    const anic_status status = anic_open_asset(file.data(), 100, nullptr, &none, out);
    return status == ANIC_E_TRUNCATED ? ANIC_OK : status;
  });
}

TEST(AnicVersions, AnOlderHostGivesFewerFields) {
  const Bytes& file = clip_file();
  // A host that does not know `flags` and `quality` yet.
  Host<anic_options> older(offsetof(anic_options, quality));
  older.get()->max_vertices = 1;
  anic_asset* asset = nullptr;
  EXPECT_EQ(anic_open_asset(file.data(), file.size(), older.get(), &asset, nullptr), ANIC_E_LIMIT);
  older.get()->max_vertices = 0;
  ASSERT_EQ(anic_open_asset(file.data(), file.size(), older.get(), &asset, nullptr), ANIC_OK);
  anic_close_asset(asset);
}

TEST(AnicVersions, ANewerHostGivesNothingThatIsUnknown) {
  const Bytes& file = clip_file();
  Host<anic_options> newer(sizeof(anic_options) + 16);
  anic_asset* asset = nullptr;
  ASSERT_EQ(anic_open_asset(file.data(), file.size(), newer.get(), &asset, nullptr), ANIC_OK);
  anic_close_asset(asset);
  newer.bytes[sizeof(anic_options) + 15] = 1;
  EXPECT_EQ(anic_open_asset(file.data(), file.size(), newer.get(), &asset, nullptr),
            ANIC_E_ARGUMENT);
  EXPECT_EQ(asset, nullptr);
  anic_options unset = ANIC_INIT(anic_options);
  unset.struct_size = 0;
  EXPECT_EQ(anic_open_asset(file.data(), file.size(), &unset, &asset, nullptr), ANIC_E_ARGUMENT);
}

// Outputs follow each other at the host's size, not at the library's.
TEST(AnicVersions, ManyOutputsHaveTheHostsLength) {
  const Asset asset = open(clip_file());
  const uint32_t n = vertices_of(asset);
  const size_t length = sizeof(anic_output) + 16;
  std::vector<float> points[2] = {std::vector<float>(3 * n), std::vector<float>(3 * n)};
  std::vector<uint64_t> host(2 * length / sizeof(uint64_t), 0);
  for (size_t i = 0; i < 2; ++i) {
    anic_output output = floats(points[i]);
    output.struct_size = length;
    std::memcpy(reinterpret_cast<unsigned char*>(host.data()) + i * length, &output, sizeof output);
  }
  const uint32_t frames[2] = {2, 9};
  const auto* outputs = reinterpret_cast<const anic_output*>(host.data());
  ASSERT_EQ(anic_write_frames(asset.get(), 0, frames, 2, 0, n, outputs), ANIC_OK);
  EXPECT_EQ(points[0], frame(asset, 2));
  EXPECT_EQ(points[1], frame(asset, 9));
  const size_t other = sizeof(anic_output);
  std::memcpy(reinterpret_cast<unsigned char*>(host.data()) + length, &other, sizeof other);
  EXPECT_EQ(anic_write_frames(asset.get(), 0, frames, 2, 0, n, outputs), ANIC_E_ARGUMENT);
}

TEST(AnicVersions, NumbersThatNameNothingAreRefused) {
  const Asset asset = open(clip_file());
  const Context context = context_of(asset);
  ASSERT_EQ(anic_seek_frame(context.get(), 3), ANIC_OK);
  std::vector<float> points(size_t{3} * vertices_of(asset));
  for (const int32_t number : {-1, INT32_MIN, 8, INT32_MAX}) {
    SCOPED_TRACE(number);
    EXPECT_EQ(anic_seek_time(context.get(), 0, static_cast<anic_sampling>(number), ANIC_WRAP_CLAMP),
              ANIC_E_ARGUMENT);
    EXPECT_EQ(anic_seek_time(context.get(), 0, ANIC_SAMPLE_STEP, static_cast<anic_wrap>(number)),
              ANIC_E_ARGUMENT);
    anic_output output = floats(points);
    EXPECT_EQ(anic_write_positions(context.get(), 0, static_cast<anic_when>(number), 0, 1, &output),
              ANIC_E_ARGUMENT);
    output.format = static_cast<anic_format>(number);
    EXPECT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, 1, &output),
              ANIC_E_ARGUMENT);
    EXPECT_STRNE(anic_get_status_text(static_cast<anic_status>(-number)), nullptr);
  }
}

}  // namespace
}  // namespace anicodec
