// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/clip.h"
#include "sdk/mesh/polygon_cutter.h"
#include "tests/api/all_files.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <malloc.h>

namespace anicodec {
namespace {

using testing::ElementsAreArray;

TEST(Statuses, HaveTheNumbersOfTheFormat) {
  const std::pair<anic_status, Status> pairs[] = {{ANIC_OK, Status::kOk},
                                                  {ANIC_E_ARGUMENT, Status::kArgument},
                                                  {ANIC_E_STATE, Status::kState},
                                                  {ANIC_E_BUFFER_SIZE, Status::kBufferSize},
                                                  {ANIC_E_FRAME_RANGE, Status::kFrameRange},
                                                  {ANIC_E_MAGIC, Status::kMagic},
                                                  {ANIC_E_VERSION, Status::kVersion},
                                                  {ANIC_E_FEATURE, Status::kFeature},
                                                  {ANIC_E_TRUNCATED, Status::kTruncated},
                                                  {ANIC_E_HEADER, Status::kHeader},
                                                  {ANIC_E_HEADER_CHECKSUM, Status::kHeaderChecksum},
                                                  {ANIC_E_CHUNK_BOUNDS, Status::kChunkBounds},
                                                  {ANIC_E_CHUNK_CHECKSUM, Status::kChunkChecksum},
                                                  {ANIC_E_CHUNK_DUPLICATE, Status::kChunkDuplicate},
                                                  {ANIC_E_CHUNK_MISSING, Status::kChunkMissing},
                                                  {ANIC_E_CHUNK_UNKNOWN, Status::kChunkUnknown},
                                                  {ANIC_E_TRAILING_BYTES, Status::kTrailingBytes},
                                                  {ANIC_E_FILE_SIZE, Status::kFileSize},
                                                  {ANIC_E_RECORD, Status::kRecord},
                                                  {ANIC_E_ENTROPY, Status::kEntropy},
                                                  {ANIC_E_ZSTD, Status::kZstd},
                                                  {ANIC_E_TOPOLOGY, Status::kTopology},
                                                  {ANIC_E_INDEX_RANGE, Status::kIndexRange},
                                                  {ANIC_E_QUANTIZER, Status::kQuantizer},
                                                  {ANIC_E_NON_FINITE, Status::kNonFinite},
                                                  {ANIC_E_DRACO, Status::kDraco},
                                                  {ANIC_E_SEGMENT, Status::kSegment},
                                                  {ANIC_E_ABSENT, Status::kAbsent},
                                                  {ANIC_E_CANCELLED, Status::kCancelled},
                                                  {ANIC_E_HASH, Status::kHash},
                                                  {ANIC_E_MESHES, Status::kMeshes},
                                                  {ANIC_E_SEGMENT_MISSING, Status::kSegmentMissing},
                                                  {ANIC_E_LIMIT, Status::kLimit},
                                                  {ANIC_E_MEMORY, Status::kMemory},
                                                  {ANIC_E_READ, Status::kRead},
                                                  {ANIC_E_INTERNAL, Status::kInternal}};
  for (const auto& [c, status] : pairs) {
    EXPECT_EQ(static_cast<int>(c), static_cast<int>(status));
    EXPECT_STREQ(anic_get_status_text(c), status_string(status));
    EXPECT_STRNE(anic_get_status_text(c), "unknown status");
  }
  EXPECT_STREQ(anic_get_status_text(static_cast<anic_status>(12345)), "unknown status");
  EXPECT_EQ(anic_get_version(), 0x010000U);
}

TEST(AnicAsset, TellsWhatIsInIt) {
  const MeshSequence source = corpus::make_clip("polygons");
  const Asset asset = open(encoded_clip("polygons", BasisChoice::kKeyframes));
  const anic_asset_info info = info_of(asset);
  EXPECT_EQ(info.mesh_count, 1U);
  EXPECT_EQ(info.frame_count, source.frame_count);
  EXPECT_EQ(info.rate_numerator, 24U);
  EXPECT_EQ(info.start_time, 0);
  EXPECT_DOUBLE_EQ(info.duration, (source.frame_count - 1) / 24.0);
  EXPECT_FALSE(info.partial);
  EXPECT_EQ(anic_verify_asset(asset.get()), ANIC_OK);

  anic_mesh mesh = ANIC_INIT(anic_mesh);
  ASSERT_EQ(anic_get_mesh(asset.get(), 0, &mesh), ANIC_OK);
  EXPECT_EQ(mesh.vertex_count, source.vertex_count);
  EXPECT_EQ(mesh.polygon_count, source.polygons.size());
  EXPECT_EQ(mesh.corner_count, source.polygons.corners.size());
  EXPECT_EQ(mesh.triangle_count, mesh.corner_count - 2 * mesh.polygon_count);
  EXPECT_EQ(anic_get_mesh(asset.get(), 1, &mesh), ANIC_E_ARGUMENT);
}

TEST(AnicAsset, CutsPolygonsInOrder) {
  const Asset asset = open(encoded_clip("polygons", BasisChoice::kKeyframes));
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  anic_polygons polygons = ANIC_INIT(anic_polygons);
  ASSERT_EQ(anic_get_mesh(asset.get(), 0, &mesh), ANIC_OK);
  ASSERT_EQ(anic_get_polygons(asset.get(), 0, &polygons), ANIC_OK);
  const std::vector<float> pose = frame(asset, 0);
  PolygonCutter cutter(pose.data(), mesh.corner_count);
  std::vector<uint32_t> expected;
  for (uint32_t p = 0; p < polygons.polygon_count; ++p) {
    const uint32_t* corners = polygons.corners + polygons.offsets[p];
    Vector<uint32_t> triangles;
    cutter.cut(corners, polygons.offsets[p + 1] - polygons.offsets[p], &triangles);
    for (const uint32_t c : triangles)
      expected.push_back(corners[c]);
  }
  ASSERT_EQ(expected.size(), size_t{3} * mesh.triangle_count);
  std::vector<uint32_t> wide(expected.size());
  std::vector<uint16_t> narrow(expected.size());
  EXPECT_EQ(anic_write_indices(asset.get(), 0, 4, wide.data(), 4 * wide.size()), ANIC_OK);
  EXPECT_EQ(anic_write_indices(asset.get(), 0, 2, narrow.data(), 2 * narrow.size()), ANIC_OK);
  EXPECT_EQ(wide, expected);
  EXPECT_THAT(narrow, ElementsAreArray(expected));
  EXPECT_EQ(anic_write_indices(asset.get(), 0, 4, wide.data(), 4 * wide.size() - 1),
            ANIC_E_BUFFER_SIZE);
  EXPECT_EQ(anic_write_indices(asset.get(), 0, 3, wide.data(), 4 * wide.size()), ANIC_E_ARGUMENT);
}

TEST(AnicAsset, CutsConcavePolygonsByTheFirstFrameThatShowsThem) {
  // An L, whose fan from the first corner would cover what is outside; it falls flat in the last frame.
  MeshSequence clip;
  clip.vertex_count = 6;
  clip.frame_count = 2;
  clip.polygons.add(std::array<uint32_t, 6>{3, 4, 5, 0, 1, 2});
  clip.positions = {0, 0, 0, 3, 0, 0, 3, 1, 0, 1, 1, 0, 1, 3, 0, 0, 3, 0,
                    0, 0, 0, 3, 0, 0, 3, 0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 3};
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.1, true};
  const Asset asset = open(encode(clip, options).file);
  std::vector<uint32_t> indices(12);
  ASSERT_EQ(anic_write_indices(asset.get(), 0, 4, indices.data(), 48), ANIC_OK);
  anic_render_plan* plan = nullptr;
  ASSERT_EQ(anic_create_render_plan(asset.get(), 0, nullptr, nullptr, &plan), ANIC_OK);
  anic_render_info info = ANIC_INIT(anic_render_info);
  ASSERT_EQ(anic_get_render_info(plan, &info), ANIC_OK);
  double area = 0;
  for (size_t t = 0; t < 12; t += 3) {
    const float *a = &clip.positions[3 * size_t{indices[t]}],
                *b = &clip.positions[3 * size_t{indices[t + 1]}],
                *c = &clip.positions[3 * size_t{indices[t + 2]}];
    const float twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    EXPECT_GT(twice, 0);
    area += static_cast<double>(twice) / 2;
    for (size_t k = 0; k < 3; ++k)
      EXPECT_EQ(info.vertices[info.indices[t + k]], indices[t + k]);
  }
  EXPECT_NEAR(area, 5, 1e-6);
  anic_destroy_render_plan(plan);
}

TEST(AnicAsset, TellsWhichVerticesMoveTogether) {
  const Asset asset = open(encoded_clip("soup", BasisChoice::kAuto));
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  const uint32_t* coded = nullptr;
  ASSERT_EQ(anic_get_mesh(asset.get(), 0, &mesh), ANIC_OK);
  ASSERT_EQ(anic_get_coded_vertices(asset.get(), 0, &coded), ANIC_OK);
  ASSERT_LT(mesh.coded_vertex_count, mesh.vertex_count);
  const std::vector<float> p = frame(asset, 3);
  std::vector<uint32_t> first(mesh.coded_vertex_count, UINT32_MAX);
  for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
    ASSERT_LT(coded[v], mesh.coded_vertex_count);
    uint32_t& one = first[coded[v]];
    one = std::min(one, v);
    EXPECT_TRUE(std::equal(&p[size_t{3} * v], &p[size_t{3} * v] + 3, &p[size_t{3} * one]));
  }
}

TEST(AnicAsset, GivesTheAttributesOfTheSource) {
  const MeshSequence source = corpus::make_clip("painted_box");
  const Asset asset = open(encoded_clip("painted_box", BasisChoice::kKeyframes));
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  ASSERT_EQ(anic_get_mesh(asset.get(), 0, &mesh), ANIC_OK);
  ASSERT_EQ(mesh.attribute_count, 5U);
  const anic_attribute_kind kinds[] = {ANIC_ATTRIBUTE_UV, ANIC_ATTRIBUTE_COLOUR,
                                       ANIC_ATTRIBUTE_NORMAL, ANIC_ATTRIBUTE_MATERIAL,
                                       ANIC_ATTRIBUTE_PART};
  const uint32_t counts[] = {mesh.corner_count, mesh.vertex_count, mesh.corner_count,
                             mesh.polygon_count, mesh.polygon_count};
  const uint32_t components[] = {2, 3, 0, 0, 0};
  anic_attribute a = ANIC_INIT(anic_attribute);
  for (uint32_t i = 0; i < 5; ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(anic_get_attribute(asset.get(), 0, i, &a), ANIC_OK);
    EXPECT_EQ(a.kind, kinds[i]);
    EXPECT_EQ(a.count, counts[i]);
    EXPECT_EQ(a.components, components[i]);
    EXPECT_EQ(a.values != nullptr, components[i] > 0);
    EXPECT_EQ(a.labels != nullptr, components[i] == 0);
  }
  ASSERT_EQ(anic_get_attribute(asset.get(), 0, 1, &a), ANIC_OK);
  EXPECT_EQ(a.domain, ANIC_DOMAIN_VERTICES);
  EXPECT_STREQ(a.name, "paint");
  EXPECT_EQ(FrameArray(a.values, a.values + size_t{3} * a.count), source.attributes[1].values);
  ASSERT_EQ(anic_get_attribute(asset.get(), 0, 3, &a), ANIC_OK);
  ASSERT_EQ(a.label_count, 2U);
  EXPECT_STREQ(anic_get_label_name(asset.get(), 0, 3, 1), "metal");
  EXPECT_EQ(anic_get_label_name(asset.get(), 0, 3, 2), nullptr);
  EXPECT_EQ(anic_get_label_name(asset.get(), 0, 9, 0), nullptr);
  EXPECT_EQ(anic_get_attribute(asset.get(), 0, 5, &a), ANIC_E_ARGUMENT);
  anic_material wood = ANIC_INIT(anic_material);
  ASSERT_EQ(anic_get_material(asset.get(), 0, 3, 0, &wood), ANIC_OK);
  EXPECT_STREQ(wood.name, "wood");
  EXPECT_THAT(wood.base_colour, ElementsAreArray(source.materials.looks[0].base_colour));
  EXPECT_EQ(wood.metallic, 0);
  EXPECT_EQ(wood.roughness, 0.875F);
  EXPECT_EQ(wood.emissive[1], 0.0625F);
  EXPECT_EQ(wood.alpha, ANIC_ALPHA_MASK);
  EXPECT_EQ(wood.alpha_cutoff, 0.25F);
  EXPECT_TRUE(wood.double_sided);
  EXPECT_STREQ(wood.base_colour_texture, "textures/wood grain.png");
  EXPECT_STREQ(wood.normal_texture, "textures/wood_normal.png");
  EXPECT_STREQ(wood.emissive_texture, "");
  EXPECT_EQ(anic_get_material(asset.get(), 0, 3, 1, &wood), ANIC_E_ABSENT);
  EXPECT_EQ(anic_get_material(asset.get(), 0, 3, 2, &wood), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_material(asset.get(), 0, 4, 0, &wood), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_attribute(asset.get(), 1, 0, &a), ANIC_E_ARGUMENT);
}

TEST(AnicAsset, SaysWhereAFileIsDamaged) {
  Bytes file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  ContainerReader reader;
  ASSERT_TRUE(reader.open(file).ok());
  const Chunk chunk = *reader.find("SEGM", 0, 0);
  file[chunk.offset + 5] ^= 1;
  anic_asset* asset = nullptr;
  anic_failure failure = ANIC_INIT(anic_failure);
  EXPECT_EQ(anic_open_asset(file.data(), file.size(), nullptr, &asset, &failure),
            ANIC_E_CHUNK_CHECKSUM);
  EXPECT_EQ(asset, nullptr);
  EXPECT_EQ(failure.status, ANIC_E_CHUNK_CHECKSUM);
  EXPECT_EQ(failure.offset, chunk.offset);
  EXPECT_STREQ(failure.chunk, "SEGM");
  EXPECT_STRNE(failure.detail, "");
  // Without a place for the failure, and with a file that is none.
  EXPECT_EQ(anic_open_asset(file.data(), 0, nullptr, &asset, nullptr), ANIC_E_MAGIC);
  EXPECT_EQ(anic_open_asset("no such file", 12, nullptr, &asset, &failure), ANIC_E_MAGIC);
  EXPECT_STREQ(failure.chunk, "");
}

TEST(AnicAsset, RefusesWhatTheHostDoesNotAllow) {
  const Bytes& file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  anic_requirements r = ANIC_INIT(anic_requirements);
  ASSERT_EQ(anic_get_requirements(file.data(), file.size(), nullptr, &r), ANIC_OK);
  auto status = [&](auto set) {
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    set(options);
    anic_asset* asset = nullptr;
    const anic_status result = anic_open_asset(file.data(), file.size(), &options, &asset, nullptr);
    anic_close_asset(asset);
    EXPECT_EQ(memory.held, 0U);
    if (result == ANIC_E_LIMIT) {
      EXPECT_LT(memory.peak, 4096U);  // header, table and limits only
    }
    return result;
  };
  EXPECT_EQ(status([&](anic_options& o) { o.max_vertices = r.max_vertices; }), ANIC_OK);
  EXPECT_EQ(status([&](anic_options& o) { o.max_vertices = r.max_vertices - 1; }), ANIC_E_LIMIT);
  EXPECT_EQ(status([&](anic_options& o) { o.max_frames = r.frame_count - 1; }), ANIC_E_LIMIT);
  EXPECT_EQ(status([&](anic_options& o) { o.max_components = r.max_components - 1; }),
            ANIC_E_LIMIT);
  EXPECT_EQ(status([&](anic_options& o) { o.max_bytes = r.opening_bytes; }), ANIC_OK);
  EXPECT_EQ(status([&](anic_options& o) { o.max_bytes = r.resident_bytes; }), ANIC_E_LIMIT);
}

TEST(AnicAsset, IsCoarserAndSmallerAtLowerQuality) {
  const Bytes& file = encoded_clip("limb", BasisChoice::kEigentrajectories);
  const Asset whole = open(file);
  anic_options options = ANIC_INIT(anic_options);
  options.quality = 0.4;
  const Asset coarse = open(file, &options);
  EXPECT_LT(info_of(coarse).resident_bytes, info_of(whole).resident_bytes);
  const double difference = largest_difference(frame(whole, 5), frame(coarse, 5));
  EXPECT_GT(difference, 0);
  EXPECT_LT(difference, 0.2 * info_of(whole).diagonal);
  EXPECT_EQ(anic_verify_asset(coarse.get()), ANIC_E_STATE);
  anic_requirements r = ANIC_INIT(anic_requirements);
  ASSERT_EQ(anic_get_requirements(file.data(), file.size(), &options, &r), ANIC_OK);
  EXPECT_NEAR(static_cast<double>(info_of(coarse).resident_bytes),
              static_cast<double>(r.resident_bytes),
              0.05 * static_cast<double>(r.resident_bytes) + 4096);
  options.quality = 1.5;
  anic_asset* none = nullptr;
  EXPECT_EQ(anic_open_asset(file.data(), file.size(), &options, &none, nullptr), ANIC_E_ARGUMENT);
}

TEST(AnicQuery, SaysHowManyBytesItNeeds) {
  const Bytes& file = encoded_clip("cloth", BasisChoice::kEigenshapes);
  size_t given = 0;
  anic_requirements r = ANIC_INIT(anic_requirements);
  for (int calls = 0; anic_get_requirements(file.data(), given, nullptr, &r) == ANIC_E_TRUNCATED;
       ++calls) {
    ASSERT_GT(r.head_bytes, given);
    ASSERT_LE(r.head_bytes, file.size());
    ASSERT_LT(calls, 4);
    given = r.head_bytes;
  }
  EXPECT_LT(given, 1000U);
  EXPECT_EQ(r.head_bytes, given);
  EXPECT_EQ(r.file_bytes, file.size());
  EXPECT_EQ(r.frame_count, corpus::make_clip("cloth").frame_count);
  EXPECT_EQ(anic_get_requirements("nothing of the kind", 19, nullptr, &r), ANIC_E_MAGIC);
}

// The tolerance is what the interface promises; of geometry interpolation it knows a bound.
TEST(AnicQuery, KnowsTheMemoryInAdvance) {
  for (const auto& [name, file] : all_files()) {
    SCOPED_TRACE(name);
    for (uint32_t flags : {0U, uint32_t{ANIC_OPEN_BOUNDS}}) {
      CountingMemory memory;
      anic_options options = ANIC_INIT(anic_options);
      options.allocator = memory.allocator();
      options.flags = flags;
      anic_requirements r = ANIC_INIT(anic_requirements);
      ASSERT_EQ(anic_get_requirements(file.data(), file.size(), &options, &r), ANIC_OK);
      EXPECT_EQ(memory.held, 0U);
      const Asset asset = open(file, &options);
      const auto held = static_cast<double>(memory.held);
      anic_basis basis = ANIC_INIT(anic_basis);
      EXPECT_EQ(anic_get_basis(asset.get(), 0, &basis), ANIC_OK);
      const bool bounded = basis.reconstruction == ANIC_RECONSTRUCTION_MSGI;
      const auto told = static_cast<double>(r.resident_bytes);
      if (bounded)
        EXPECT_GE(told, held);
      else
        EXPECT_NEAR(told, held, std::max(0.05 * held, 4096.0));
      EXPECT_LE(memory.peak, r.opening_bytes);
      EXPECT_EQ(info_of(asset).resident_bytes, memory.held);
      const Context context = context_of(asset);
      const uint64_t context_bytes = info_of(asset).context_bytes;
      EXPECT_EQ(static_cast<double>(memory.held) - held, static_cast<double>(context_bytes));
      EXPECT_TRUE(bounded ? context_bytes <= r.context_bytes : context_bytes == r.context_bytes);
    }
  }
}

TEST(AnicMemory, AllComesFromTheHostAndGoesBack) {
  for (const auto& [name, file] : all_files()) {
    SCOPED_TRACE(name);
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    {
      const Asset asset = open(file, &options);
      const Context context = context_of(asset);
      anic_normal_plan* normals = nullptr;
      EXPECT_EQ(anic_create_normal_plan(asset.get(), 0, nullptr, nullptr, &normals), ANIC_OK);
      EXPECT_GT(memory.held, 0U);
      anic_destroy_normal_plan(normals);
    }
    EXPECT_EQ(memory.held, 0U);
    EXPECT_EQ(memory.small, 0U);
  }
}

/// Uses an asset in every way that takes a context, counting allocations meanwhile.
void expect_no_allocation(const Asset& asset, const CountingMemory& memory) {
  const Context context = context_of(asset);
  const uint32_t n = vertices_of(asset), frames = info_of(asset).frame_count;
  std::vector<float> out(size_t{3} * n);
  const anic_output output = floats(out);
  anic_parts parts = ANIC_INIT(anic_parts);
  anic_box box;
  const size_t calls = memory.calls;
  const size_t heap = mallinfo2().uordblks;
  for (uint32_t f = 0; f < frames; ++f) {
    anic_seek_frame(context.get(), f);
    anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, n, &output);
    anic_seek_time(context.get(), 0.37 * f, ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP);
    anic_write_positions(context.get(), 0, ANIC_WHEN_PREVIOUS, 0, n, &output);
    anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, n, &output);
    anic_compute_bounds(context.get(), 0, ANIC_WHEN_CURRENT, &box);
    anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &parts);
    anic_forget_previous(context.get());
    anic_write_frames(asset.get(), 0, &f, 1, 0, n, &output);
  }
  EXPECT_EQ(memory.calls, calls);
  EXPECT_EQ(mallinfo2().uordblks, heap);
}

TEST(AnicMemory, NothingIsAllocatedAfterOpening) {
  for (const auto& [name, file] : all_files()) {
    SCOPED_TRACE(name);
    CountingMemory memory;
    anic_options options = ANIC_INIT(anic_options);
    options.allocator = memory.allocator();
    expect_no_allocation(open(file, &options), memory);

    // A stream, when it becomes playable.
    anic_stream* stream = nullptr;
    ASSERT_EQ(anic_create_stream(&options, &stream), ANIC_OK);
    anic_stream_info info = ANIC_INIT(anic_stream_info);
    for (size_t i = 0; i < file.size() && !info.playable; ++i) {
      ASSERT_EQ(anic_push_bytes(stream, &file[i], 1), ANIC_OK);
      anic_get_stream_info(stream, &info);
    }
    anic_asset* asset = nullptr;
    ASSERT_EQ(anic_open_asset_from_stream(stream, &asset, nullptr), ANIC_OK);
    expect_no_allocation(Asset(asset), memory);
    anic_destroy_stream(stream);
  }
}

TEST(AnicMemory, FailsWithoutALeakWhicheverAllocationFails) {
  for (const auto& [clip, basis] : {cases()[0], cases()[2], cases()[9]}) {
    SCOPED_TRACE(clip);
    EXPECT_GT(expect_no_leak_whichever_allocation_fails(encoded_clip(clip, basis)), 20U);
  }
}

TEST(AnicMemory, FitsABlockOfTheHost) {
  for (const auto& [clip, basis] : cases()) {
    SCOPED_TRACE(clip);
    const Bytes& file = encoded_clip(clip, basis);
    anic_requirements r = ANIC_INIT(anic_requirements);
    ASSERT_EQ(anic_get_requirements(file.data(), file.size(), nullptr, &r), ANIC_OK);
    std::vector<unsigned char> block(r.block_bytes + r.context_bytes);
    anic_options options = ANIC_INIT(anic_options);
    ASSERT_EQ(anic_init_block_allocator(block.data() + 3, block.size() - 3, &options.allocator),
              ANIC_OK);
    const Asset asset = open(file, &options);
    ASSERT_TRUE(asset);
    const Context context = context_of(asset);
    ASSERT_EQ(anic_seek_frame(context.get(), 2), ANIC_OK);
    EXPECT_EQ(positions(asset, context), frame(open(file), 2));
  }
  unsigned char small[255];
  anic_allocator allocator;
  EXPECT_EQ(anic_init_block_allocator(small, sizeof small, &allocator), ANIC_E_BUFFER_SIZE);
}

}  // namespace
}  // namespace anicodec
