// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Meshes that a stream keeps from one asset to the next.
#include "sdk/clip/kept_meshes.h"

#include "format/checksum.h"
#include "format/container.h"
#include "format/continuation.h"
#include "tests/api/opened.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// The names of the steps that decoding takes.
class StepNames : public DecodingTrace {
 public:
  void step(const char* name, const int32_t*, size_t) override { names_.insert(name); }

  bool has(const char* name) const { return names_.count(name) > 0; }

 private:
  std::set<std::string> names_;
};

/// The ends of the chunks of a file.
std::vector<size_t> ends_of_chunks(const Bytes& file) {
  ContainerReader reader;
  EXPECT_TRUE(reader.open(file).ok());
  std::vector<size_t> ends;
  for (const Chunk& chunk : reader.chunks())
    ends.push_back(static_cast<size_t>(chunk.offset + chunk.size));
  return ends;
}

/// Opens all that can be opened of a file while it arrives; the last asset, which is of all of it.
Asset open_on_the_way(const Stream& stream, const Bytes& file) {
  Asset asset;
  size_t at = 0;
  for (const size_t end : ends_of_chunks(file)) {
    EXPECT_EQ(anic_push_bytes(stream.get(), file.data() + at, end - at), ANIC_OK);
    at = end;
    if (info_of(stream).playable)
      asset = open(stream);
  }
  return asset;
}

TEST(KeptMeshes, ChangeNothing) {
  for (const auto& [name, basis] : cases()) {
    SCOPED_TRACE(name);
    const Bytes& file = encoded_clip(name, basis);
    const Stream stream = new_stream();
    const Asset asset = open_on_the_way(stream, file), whole = open(file);
    ASSERT_EQ(info_of(asset).frame_count, info_of(whole).frame_count);
    EXPECT_EQ(info_of(asset).resident_bytes, info_of(whole).resident_bytes);
    EXPECT_EQ(anic_verify_asset(asset.get()), ANIC_OK);
    for (uint32_t f = 0; f < info_of(whole).frame_count; ++f)
      ASSERT_EQ(frame(asset, f), frame(whole, f));
  }
}

TEST(KeptMeshes, AreDecodedOnce) {
  const Bytes& file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  KeptMeshes kept;
  for (const bool first : {true, false}) {
    StepNames steps;
    OpenOptions options;
    options.kept = &kept;
    options.trace = &steps;
    Clip clip;
    ASSERT_TRUE(clip.open(file, options).ok());
    EXPECT_EQ(steps.has("polygon corners"), first);
    EXPECT_EQ(steps.has("vertex map"), first);
    EXPECT_TRUE(steps.has("coefficients"));
    EXPECT_TRUE(clip.check_hashes().ok());
  }
  // In another order of the vertices they are others.
  StepNames steps;
  OpenOptions options;
  options.kept = &kept;
  options.trace = &steps;
  options.any_order = true;
  Clip clip;
  ASSERT_TRUE(clip.open(file, options).ok());
  EXPECT_TRUE(steps.has("polygon corners"));
}

/// A continuation of `before` that has the pose of its mesh itself.
Bytes continuation_with_pose(const Bytes& before, const Bytes& file) {
  ContainerReader base, reader;
  EXPECT_TRUE(base.open(before).ok());
  EXPECT_TRUE(reader.open(file).ok());
  Limits sizes;
  EXPECT_EQ(Limits::read(reader.unchecked(*reader.find("LIMI")), &sizes), Status::kOk);
  sizes.continued_meshes = mesh_hash(base);
  const Bytes limits = sizes.write();
  Vector<Chunk> chunks;
  for (Chunk chunk : reader.chunks()) {
    if (chunk.type == chunk_type("LIMI")) {
      chunk.size = limits.size();
      chunk.checksum = static_cast<uint32_t>(xxh64(limits));
    }
    if (!is_of_mesh(chunk) || chunk.type == chunk_type("POSE"))
      chunks.push_back(chunk);
  }
  Bytes out = container_head(chunks, kContinuation);
  for (const Chunk& chunk : chunks) {
    const ByteView payload =
        chunk.type == chunk_type("LIMI") ? ByteView(limits) : reader.unchecked(chunk);
    out.insert(out.end(), payload.data, payload.data + payload.size);
  }
  return out;
}

TEST(KeptMeshes, AreNotThoseThatAContinuationHasItself) {
  const Bytes& keyframes = encoded_clip("limb", BasisChoice::kKeyframes, 24);
  const Stream stream = new_stream();
  ASSERT_EQ(anic_push_bytes(stream.get(), keyframes.data(), keyframes.size()), ANIC_OK);
  open(stream);
  for (const uint32_t frames : {24U, 12U, 6U}) {
    const Bytes& whole = encoded_clip("limb", BasisChoice::kEigentrajectories, frames);
    const Bytes next = continuation_with_pose(keyframes, whole);
    ASSERT_EQ(anic_advance_stream(stream.get()), ANIC_OK);
    ASSERT_EQ(anic_push_bytes(stream.get(), next.data(), next.size()), ANIC_OK);
    ASSERT_TRUE(info_of(stream).complete);
    const Asset asset = open(stream);
    EXPECT_EQ(anic_verify_asset(asset.get()), ANIC_OK);
    EXPECT_EQ(frame(asset, 3), frame(open(whole), 3));
  }
}

TEST(KeptMeshes, TakeNoMoreThanTheHostAllows) {
  const Bytes& file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  anic_requirements needs = ANIC_INIT(anic_requirements);
  ASSERT_EQ(anic_get_requirements(file.data(), file.size(), nullptr, &needs), ANIC_OK);
  const size_t before_the_last = ends_of_chunks(file).end()[-2];
  for (const bool allowed : {false, true}) {
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    options.max_bytes = allowed ? 0 : needs.opening_bytes;
    const Stream stream = new_stream(&options);
    ASSERT_EQ(anic_push_bytes(stream.get(), file.data(), before_the_last), ANIC_OK);
    const size_t before = memory.held;
    anic_mesh mesh = ANIC_INIT(anic_mesh);
    {
      const Asset asset = open(stream);
      ASSERT_EQ(anic_get_mesh(asset.get(), 0, &mesh), ANIC_OK);
    }
    const size_t kept = memory.held - before;
    if (!allowed) {
      EXPECT_EQ(kept, 0U);
    } else {
      const size_t triangles = mesh.triangle_count, vertices = mesh.vertex_count;
      EXPECT_GT(kept, 12 * triangles + 12 * vertices);
      EXPECT_LT(kept, 512 + 4 * (vertices + mesh.polygon_count + 1 + mesh.corner_count) +
                          12 * triangles + 113 * vertices);
    }
  }
}

TEST(KeptMeshes, AreNoneOfAFileThatIsOpenedOnce) {
  const Bytes& file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  CountingMemory memory;
  anic_options options = ANIC_INIT(anic_options);
  options.allocator = memory.allocator();
  const Stream stream = new_stream(&options);
  ASSERT_EQ(anic_push_bytes(stream.get(), file.data(), file.size()), ANIC_OK);
  const size_t before = memory.held;
  open(stream);
  EXPECT_EQ(memory.held, before);
}

}  // namespace
}  // namespace anicodec
