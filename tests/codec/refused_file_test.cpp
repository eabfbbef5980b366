// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files whose checksums fit and whose contents do not: each rule of a decoder, broken once.
#include "codec/encode.h"
#include "corpus/clips.h"
#include "sdk/clip/clip.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/segment/keyframe_segment.h"
#include "tests/codec/edited_file.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

Bytes encoded(const char* clip, BasisChoice basis, OrderMode order = OrderMode::kVertices) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  options.basis = basis;
  options.keyframe_poses = KeyframePoses::kDraco;
  options.effort = Effort::kFast;
  options.order = order;
  return encode(corpus::make_clip(clip), options).file;
}

Status status_of(const EditedFile& file, uint64_t resident_bytes = uint64_t{1} << 30) {
  Bytes bytes = file.bytes();
  Clip clip;
  OpenOptions options;
  options.limits.resident_bytes = resident_bytes;
  return clip.open(bytes, options).status;
}

uint32_t components(const Bytes& bytes) {
  EditedFile file(bytes);
  Limits limits;
  Limits::read(file.part("LIMI").payload, &limits);
  return limits.segments[0].components;
}

class RefusedFile : public testing::Test {
 protected:
  const Bytes keyframes_ = encoded("nonmanifold", BasisChoice::kKeyframes);
  const Bytes shapes_ = encoded("nonmanifold", BasisChoice::kEigenshapes);
  Bytes changed_;  // what a record refers to
};

TEST_F(RefusedFile, UnchangedOpens) {
  for (const Bytes& bytes : {keyframes_, shapes_}) {
    EXPECT_EQ(EditedFile(bytes).bytes(), bytes);
    EXPECT_EQ(status_of(EditedFile(bytes)), Status::kOk);
  }
}

TEST_F(RefusedFile, NeedsNoMoreMemoryThanAllowed) {
  Limits limits;
  EditedFile file(shapes_);
  ASSERT_EQ(Limits::read(file.part("LIMI").payload, &limits), Status::kOk);
  MemoryEstimate estimate = estimate_memory(limits);
  EXPECT_EQ(status_of(file, estimate.opening), Status::kOk);
  EXPECT_EQ(status_of(file, estimate.opening - 1), Status::kLimit);
  Clip clip;
  ASSERT_TRUE(clip.open(shapes_).ok());
  EXPECT_LE(clip.resident_bytes(), estimate.resident);
  // Sums that do not fit 64 bits do not wrap.
  limits.meshes[0].source_vertices = limits.meshes[0].coded_vertices = kMaxVertices;
  limits.segments[0].components = kMaxComponents;
  limits.segments.resize(1 << 16, limits.segments[0]);
  EXPECT_EQ(estimate_memory(limits).opening, UINT64_MAX);
}

TEST_F(RefusedFile, SegmentsOverlap) {
  EditedFile file(keyframes_);
  file.change_limits([](Limits& limits) { limits.segments.push_back(limits.segments[0]); });
  EXPECT_EQ(status_of(file), Status::kRecord);
}

TEST_F(RefusedFile, MoreTrianglesThanCornersCanBeNumbered) {
  EditedFile file(keyframes_);
  file.change_limits([](Limits& limits) { limits.meshes[0].triangles = kMaxTriangles + 1; });
  EXPECT_EQ(status_of(file), Status::kRecord);
}

TEST_F(RefusedFile, SegmentsThatTheFormatDoesNotHave) {
  const auto with = [](const Bytes& bytes, auto change) {
    EditedFile file(bytes);
    file.change_limits([&](Limits& limits) { change(limits.segments[0]); });
    return status_of(file);
  };
  constexpr auto unknown_kind = [](Limits::Segment& s) { s.kind = static_cast<BasisKind>(3); };
  constexpr auto unknown_reconstruction = [](Limits::Segment& s) {
    s.reconstruction = static_cast<Reconstruction>(2);
  };
  constexpr auto by_msgi = [](Limits::Segment& s) { s.reconstruction = Reconstruction::kMsgi; };
  constexpr auto in_regions = [](Limits::Segment& s) { s.regions = 2; };
  constexpr auto of_attribute = [](Limits::Segment& s) { s.attribute = 0; };
  EXPECT_EQ(with(keyframes_, unknown_kind), Status::kFeature);
  EXPECT_EQ(with(keyframes_, unknown_reconstruction), Status::kFeature);
  for (const Bytes& bytes : {keyframes_, shapes_}) {
    EXPECT_EQ(with(bytes, in_regions), Status::kFeature);
    EXPECT_EQ(with(bytes, of_attribute), Status::kFeature);
  }
  EXPECT_EQ(with(shapes_, by_msgi), Status::kFeature);
  EXPECT_EQ(with(shapes_, [](Limits::Segment& s) { s.draco_bytes = s.draco_points = 1; }),
            Status::kFeature);
}

TEST_F(RefusedFile, FeaturesThatAreNotThoseOfTheSegments) {
  for (const Bytes& bytes : {keyframes_, shapes_}) {
    for (const uint64_t change : {kDracoFeature, kMsgiFeature}) {
      EditedFile file(bytes);
      file.features ^= change;
      EXPECT_EQ(status_of(file), Status::kRecord) << change;
    }
  }
  EditedFile unknown(keyframes_);
  unknown.features |= uint64_t{1} << 17;
  EXPECT_EQ(status_of(unknown), Status::kFeature);
  Clip clip;
  EXPECT_STREQ(clip.open(unknown.bytes()).detail,
               "the file needs feature 17, which this decoder does not know");
}

TEST_F(RefusedFile, DracoBytesThatAreNotThere) {
  EditedFile loose(encoded("one_vertex", BasisChoice::kKeyframes));
  ASSERT_EQ(status_of(loose), Status::kOk);
  loose.change_limits([](Limits& limits) {
    limits.segments[0].draco_bytes = 100;
    limits.segments[0].draco_points = 1;
  });
  EXPECT_EQ(status_of(loose), Status::kSegment);
  const auto with = [&](auto change) {
    EditedFile file(keyframes_);
    file.change_limits([&](Limits& limits) { change(limits.segments[0]); });
    return status_of(file);
  };
  ASSERT_EQ(with([](Limits::Segment&) {}), Status::kOk);
  EXPECT_EQ(with([](Limits::Segment& s) { s.draco_bytes = s.draco_points = 0; }), Status::kEntropy);
  EXPECT_EQ(with([](Limits::Segment& s) { s.draco_bytes += 200; }), Status::kSegment);
  EXPECT_EQ(with([](Limits::Segment& s) { s.draco_bytes = UINT32_MAX; }), Status::kLimit);
  EXPECT_EQ(with([](Limits::Segment& s) { ++s.draco_points; }), Status::kRecord);
  EXPECT_EQ(with([](Limits::Segment& s) { s.draco_points = 0; }), Status::kRecord);
  EXPECT_EQ(with([](Limits::Segment& s) { s.draco_points = UINT32_MAX; }), Status::kLimit);
}

TEST_F(RefusedFile, StrayChunks) {
  auto with = [](const Bytes& bytes, const char(&like)[5], auto change) {
    EditedFile file(bytes);
    EditedFile::Part part = file.part(like);
    change(part);
    file.parts.push_back(part);
    return status_of(file);
  };
  for (const Bytes& bytes : {keyframes_, shapes_}) {
    auto of_another_mesh = [](auto& part) { part.chunk.mesh = 1; };
    EXPECT_EQ(with(bytes, "MESH", of_another_mesh), Status::kIndexRange);
    EXPECT_EQ(with(bytes, "VMAP", of_another_mesh), Status::kIndexRange);
    EXPECT_EQ(with(bytes, "SEGM", of_another_mesh), Status::kIndexRange);
    EXPECT_EQ(with(bytes, "SEGM", [](auto& part) { part.chunk.segment = 1; }), Status::kIndexRange);
    EXPECT_EQ(with(bytes, "CLIP", [](auto& part) { part.chunk.mesh = 0; }), Status::kIndexRange);
    EXPECT_EQ(with(bytes, "SEGM", [](auto& part) { part.chunk.type = chunk_type("FMAP"); }),
              Status::kIndexRange);
  }
  EXPECT_EQ(with(keyframes_, "SEGM", [](auto& part) { part.chunk.type = chunk_type("BASI"); }),
            Status::kIndexRange);
  EXPECT_EQ(with(keyframes_, "SEGM", [](auto& part) { part.chunk.type = chunk_type("POSE"); }),
            Status::kIndexRange);
  EXPECT_EQ(with(shapes_, "BASI", [](auto& part) { part.chunk.mesh = 1; }), Status::kIndexRange);
  EditedFile optional(shapes_);
  optional.part("VMAP").chunk.required = false;
  EXPECT_EQ(status_of(optional), Status::kIndexRange);
  EXPECT_EQ(with(shapes_, "VMAP", [](auto&) {}), Status::kChunkDuplicate);
}

TEST_F(RefusedFile, DracoBitstreamThatAnnouncesTooMuch) {
  // Decoders, attributes, the kind, numbers and width of the first.
  for (const size_t at : {0U, 1U, 2U, 3U, 4U}) {
    EditedFile file(keyframes_);
    file.change_record<SegmentRecord>("SEGM", [&](SegmentRecord& record) {
      changed_.assign(record.pose.data, record.pose.data + record.pose.size);
      changed_[at] ^= 0x7F;
      record.pose = changed_;
    });
    EXPECT_EQ(status_of(file), Status::kDraco) << at;
  }
}

TEST_F(RefusedFile, ZstdFrameOfAnotherSize) {
  EditedFile file(encoded("leftovers", BasisChoice::kKeyframes));
  Limits limits;
  ASSERT_EQ(Limits::read(file.part("LIMI").payload, &limits), Status::kOk);
  const uint32_t draco = limits.segments[0].draco_bytes;
  ASSERT_GT(draco, 0U);
  for (const Bytes& frame : {Bytes{0x50, 0x2A, 0x4D, 0x18, 0, 0, 0, 0},  // skippable, empty
                             Bytes{0x28, 0xB5, 0x2F, 0xFD, 0x00, 0x58, 1, 0, 0},  // states no size
                             Bytes{}}) {
    file.change_record<SegmentRecord>("SEGM", [&](SegmentRecord& record) {
      changed_.assign(record.pose.data, record.pose.data + draco);
      changed_.insert(changed_.end(), frame.begin(), frame.end());
      record.pose = changed_;
    });
    EXPECT_EQ(status_of(file), Status::kZstd);
  }
}

TEST_F(RefusedFile, NativeKeyframesThatRunOut) {
  EncodeOptions options;
  options.keyframes = 3;
  const Bytes bytes = encode(corpus::make_clip("limb"), options).file;
  EditedFile whole(bytes);
  ASSERT_EQ(status_of(whole), Status::kOk);
  for (const size_t kept : {size_t{0}, size_t{1}, size_t{100}}) {
    EditedFile file(bytes);
    file.change_record<SegmentRecord>("SEGM", [&](SegmentRecord& record) {
      record.pose.size = std::min(record.pose.size, kept);
    });
    EXPECT_EQ(status_of(file), Status::kEntropy) << kept;
  }
  EditedFile longer(bytes);
  longer.change_record<SegmentRecord>("SEGM", [&](SegmentRecord& record) {
    changed_.assign(record.pose.data, record.pose.data + record.pose.size);
    changed_.push_back(1);
    record.pose = changed_;
  });
  EXPECT_EQ(status_of(longer), Status::kEntropy);
}

TEST_F(RefusedFile, NumbersTooLargeToPlay) {
  for (double huge : {1e20, 1e300}) {
    EditedFile file(shapes_);
    file.change_record<PoseRecord>("POSE", [&](PoseRecord& record) { record.origin[1] = -huge; });
    EXPECT_EQ(status_of(file), Status::kNonFinite);
  }
  EditedFile file(keyframes_);
  file.change_record<SegmentRecord>("SEGM", [&](SegmentRecord& record) {
    KeyframeParameters parameters;
    Limits::Segment sizes;
    sizes.components = components(keyframes_);
    sizes.frames = 1 << 20;
    ASSERT_EQ(parameters.read(record.parameters, sizes), Status::kOk);
    parameters.step = 1e300;
    changed_ = parameters.write();
    record.parameters = changed_;
  });
  EXPECT_EQ(status_of(file), Status::kNonFinite);
}

TEST_F(RefusedFile, HashCoversCorrections) {
  const Bytes bytes = encoded("soup", BasisChoice::kKeyframes);
  EditedFile file(bytes);
  Limits limits;
  Limits::read(file.part("LIMI").payload, &limits);
  ASSERT_GT(limits.segments[0].corrections, 0U);
  file.change_limits([](Limits& l) { l.segments[0].corrections = 0; });
  file.parts.erase(file.parts.begin() + (&file.part("CORR") - file.parts.data()));
  const Bytes without = file.bytes();
  Clip clip;
  ASSERT_TRUE(clip.open(bytes).ok());
  EXPECT_TRUE(clip.check_hashes().ok());
  ASSERT_TRUE(clip.open(without).ok());
  EXPECT_EQ(clip.check_hashes().status, Status::kHash);
}

TEST_F(RefusedFile, MapThatRunsOut) {
  EditedFile file(encoded("large", BasisChoice::kKeyframes, OrderMode::kAll));
  ASSERT_EQ(status_of(file), Status::kOk);
  for (size_t i = 0; i < file.parts.size(); ++i) {
    if (file.parts[i].chunk.type == chunk_type("VMAP")) {
      EditedFile cut = file;
      cut.parts[i].payload.resize(cut.parts[i].payload.size() - 1);
      Status status = status_of(cut);
      EXPECT_TRUE(status == Status::kEntropy || status == Status::kIndexRange);
    }
  }
}

TEST(LongPolygon, ComesBackAsItIs) {
  for (uint32_t corners : {1023U, 1024U, 1025U, 3000U}) {
    MeshSequence source;
    source.vertex_count = corners;
    source.frame_count = 2;
    source.polygons.offsets = {0, corners};
    for (uint32_t f = 0; f < 2; ++f) {
      for (uint32_t v = 0; v < corners; ++v) {
        const double angle = 2 * M_PI * v / corners;
        source.positions.push_back(static_cast<float>(std::cos(angle)));
        source.positions.push_back(static_cast<float>(std::sin(angle)));
        source.positions.push_back(static_cast<float>(f));
      }
    }
    for (uint32_t v = 0; v < corners; ++v)
      source.polygons.corners.push_back(v);
    EncodeOptions options;
    options.target = {ErrorMetric::kMaxError, 1, true};
    options.basis = BasisChoice::kKeyframes;
    const Bytes bytes = encode(source, options).file;
    Clip clip;
    ASSERT_TRUE(clip.open(bytes).ok());
    const Topology& t = clip.meshes()[0].topology;
    ASSERT_THAT(t.polygon_offsets, testing::ElementsAreArray(source.polygons.offsets));
    Vector<uint32_t> cycle = t.polygon_corners;
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
    EXPECT_THAT(cycle, testing::ElementsAreArray(source.polygons.corners));
    EXPECT_EQ(clip.limits().meshes[0].triangles, corners - 2);
  }
}

}  // namespace
}  // namespace anicodec
