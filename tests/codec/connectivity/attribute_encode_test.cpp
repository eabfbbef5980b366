// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/attribute_encode.h"

#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/container.h"
#include "sdk/clip/clip.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr double kUvStep = 1.0 / 4096;

/// A clip with texture coordinates that have seams, colours, hard edges, materials and parts.
MeshSequence detailed(const std::string& name) {
  MeshSequence clip = corpus::make_clip(name);
  const std::span<const float> pose = clip.frame(0);
  const std::vector<uint32_t>& corners = clip.polygons.corners;
  Attribute uv{AttributeKind::kUv, "map", AttributeDomain::kCorner, 2, 1, {}};
  Attribute normals{AttributeKind::kNormal, "", AttributeDomain::kCorner, 3, 1, {}};
  for (size_t p = 0; p < clip.polygons.size(); ++p) {
    const bool other_chart = p % 16 >= 8;
    for (uint32_t v : clip.polygons[p]) {
      uv.values.push_back(pose[3 * v] * 0.25F + (other_chart ? 0.5F : 0.0F));
      uv.values.push_back(pose[3 * v + 1] * 0.25F);
      for (float x : {other_chart ? 1.0F : 0.0F, 0.0F, other_chart ? 0.0F : 1.0F})
        normals.values.push_back(x);
    }
    clip.materials.of_polygon.push_back(p % 3 == 0 ? kNoLabel : static_cast<uint32_t>(p / 20 % 2));
    clip.parts.of_polygon.push_back(p < 10 ? 0 : 1);
  }
  clip.materials.names = {"skin", "cloth \xC3\xA9"};
  clip.parts.names = {"head", "body"};
  Attribute colours{AttributeKind::kColour, "Col", AttributeDomain::kVertex, 4, 1, {}};
  Attribute weight{AttributeKind::kCustom, "weight", AttributeDomain::kVertex, 1, 1, {}};
  for (uint32_t v = 0; v < clip.vertex_count; ++v) {
    for (uint32_t i = 0; i < 4; ++i)
      colours.values.push_back(static_cast<float>(v * 7 % 256) / 255.0F);
    weight.values.push_back(std::sin(static_cast<float>(v)) * 1000);
  }
  EXPECT_EQ(uv.values.size(), 2 * corners.size());
  clip.attributes = {uv, colours, normals, weight};
  return clip;
}

/// Puts decoded attributes into a sequence of the same numbering.
void restore_attributes(const Vector<MeshAttribute>& decoded, MeshSequence* sequence) {
  for (const MeshAttribute& a : decoded) {
    const AttributeHeader& header = a.header;
    if (header.has_labels()) {
      PolygonLabels& labels =
          header.kind == AttributeKind::kMaterial ? sequence->materials : sequence->parts;
      labels = {};
      for (const String& name : header.labels)
        labels.names.emplace_back(name.begin(), name.end());
      labels.looks.assign(header.looks.begin(), header.looks.end());
      for (uint32_t label : a.labels)
        labels.of_polygon.push_back(label == 0 ? kNoLabel : label - 1);
    } else if (header.components() == 0) {
      sequence->shared_normals.assign(a.labels.begin(), a.labels.end());
    } else {
      Attribute& attribute = sequence->attributes.emplace_back();
      attribute.kind = header.kind;
      attribute.name.assign(header.name.begin(), header.name.end());
      attribute.domain = header.domain;
      attribute.components = header.components();
      attribute.values.assign(a.values.begin(), a.values.end());
    }
  }
}

MeshSequence decoded(const Bytes& file) {
  Clip clip;
  EXPECT_EQ(clip.open(file).status, Status::kOk);
  MeshSequence out;
  out.vertex_count = clip.vertex_count();
  const Topology& t = clip.meshes()[0].topology;
  out.polygons.offsets.assign(t.polygon_offsets.begin(), t.polygon_offsets.end());
  out.polygons.corners.assign(t.polygon_corners.begin(), t.polygon_corners.end());
  restore_attributes(clip.meshes()[0].attributes, &out);
  return out;
}

EncodeOptions quick(OrderMode order) {
  EncodeOptions options;
  options.keyframes = 2;
  options.basis = BasisChoice::kKeyframes;
  options.order = order;
  return options;
}

const Attribute* find(const MeshSequence& clip, AttributeKind kind) {
  const auto found = std::ranges::find(clip.attributes, kind, &Attribute::kind);
  return found == clip.attributes.end() ? nullptr : &*found;
}

/// Corners that share a normal, as sets: the first corner of the set of each.
std::vector<size_t> sets(const std::vector<uint32_t>& shared) {
  std::map<uint32_t, size_t> first;
  std::vector<size_t> out;
  for (size_t c = 0; c < shared.size(); ++c)
    out.push_back(first.try_emplace(shared[c], c).first->second);
  return out;
}

class AttributeEncodeOf : public testing::TestWithParam<const char*> {};

TEST_P(AttributeEncodeOf, ComeBackInTheOrderOfTheSource) {
  const MeshSequence clip = detailed(GetParam());
  const MeshSequence back = decoded(encode(clip, quick(OrderMode::kAll)).file);
  ASSERT_EQ(back.polygons.corners, clip.polygons.corners);
  EXPECT_EQ(back.materials, clip.materials);
  EXPECT_EQ(back.parts, clip.parts);
  const Attribute *uv = find(back, AttributeKind::kUv),
                  *colour = find(back, AttributeKind::kColour),
                  *weight = find(back, AttributeKind::kCustom);
  ASSERT_TRUE(uv && colour && weight);
  EXPECT_TRUE(uv->per_corner());
  EXPECT_EQ(uv->name, "map");
  ASSERT_EQ(uv->values.size(), clip.attributes[0].values.size());
  for (size_t i = 0; i < uv->values.size(); ++i)
    ASSERT_NEAR(uv->values[i], clip.attributes[0].values[i], kUvStep / 2 + 1e-6) << i;
  EXPECT_EQ(colour->values, clip.attributes[1].values);
  for (size_t i = 0; i < weight->values.size(); ++i)
    ASSERT_NEAR(weight->values[i], clip.attributes[3].values[i], 2000.0 / 4095 / 2 + 1e-3) << i;
}

TEST_P(AttributeEncodeOf, KeepTheHardEdges) {
  const MeshSequence clip = detailed(GetParam());
  const MeshSequence back = decoded(encode(clip, quick(OrderMode::kAll)).file);
  EXPECT_EQ(find(back, AttributeKind::kNormal), nullptr);
  ASSERT_EQ(back.shared_normals.size(), clip.polygons.corners.size());
  const std::vector<size_t> first = sets(back.shared_normals);
  const float* normals = clip.attributes[2].values.data();
  for (size_t c = 0; c < first.size(); ++c)
    ASSERT_TRUE(std::equal(normals + 3 * c, normals + 3 * c + 3, normals + 3 * first[c])) << c;
  // No more sets than there are pairs of a place and a normal.
  std::map<std::pair<std::vector<float>, float>, int> places;
  for (size_t c = 0; c < first.size(); ++c) {
    const auto pose = clip.frame(0).subspan(size_t{3} * clip.polygons.corners[c], 3);
    places[{{pose.begin(), pose.end()}, normals[3 * c]}] = 1;
  }
  std::vector<size_t> unique = first;
  std::ranges::sort(unique);
  EXPECT_LE(static_cast<size_t>(std::ranges::unique(unique).begin() - unique.begin()),
            places.size());
}

TEST_P(AttributeEncodeOf, FollowThePolygonsInEveryOrder) {
  MeshSequence clip = detailed(GetParam());
  clip.attributes.resize(2);
  for (OrderMode order : {OrderMode::kVertices, OrderMode::kFree}) {
    const MeshSequence back = decoded(encode(clip, quick(order)).file);
    const Attribute *uv = find(back, AttributeKind::kUv),
                    *colour = find(back, AttributeKind::kColour);
    ASSERT_TRUE(uv && colour);
    // Each corner tells its vertex's colour and its own texture coordinate: compared as a multiset.
    auto rows = [&](const MeshSequence& s, const Attribute& of_corners,
                    const Attribute& of_vertices) {
      std::multiset<std::vector<int>> all;
      for (size_t p = 0; p < s.polygons.size(); ++p) {
        for (uint32_t c = s.polygons.offsets[p]; c < s.polygons.offsets[p + 1]; ++c) {
          const uint32_t label = s.materials.of_polygon[p];
          all.insert(
              {static_cast<int>(std::lround(of_corners.values[2 * c] / kUvStep)),
               static_cast<int>(std::lround(of_corners.values[2 * c + 1] / kUvStep)),
               static_cast<int>(std::lround(of_vertices.values[4 * s.polygons.corners[c]] * 255)),
               label == kNoLabel ? -1 : static_cast<int>(label)});
        }
      }
      return all;
    };
    EXPECT_EQ(rows(back, *uv, *colour), rows(clip, clip.attributes[0], clip.attributes[1]));
  }
}

INSTANTIATE_TEST_SUITE_P(Clips, AttributeEncodeOf,
                         testing::Values("limb", "quad_box", "nonmanifold"));

TEST(AttributeEncode, LeavesFilesWithoutAttributesAsTheyWere) {
  MeshSequence clip = corpus::make_clip("quad_box");
  const Bytes plain = encode(clip, quick(OrderMode::kVertices)).file;
  EncodeOptions without = quick(OrderMode::kVertices);
  without.attributes.keep = false;
  EXPECT_EQ(encode(detailed("quad_box"), without).file, plain);
}

TEST(AttributeEncode, KeepsTangentsWithNormalsOnly) {
  MeshSequence clip = corpus::make_clip("quad_box");
  Attribute tangents{AttributeKind::kTangent, "TANGENT", AttributeDomain::kVertex, 4, 1, {}};
  for (uint32_t v = 0; v < clip.vertex_count; ++v)
    tangents.values.insert(tangents.values.end(), {0.6F, 0, 0.8F, v % 2 == 0 ? 1.0F : -1.0F});
  clip.attributes = {tangents};
  EncodeOptions options = quick(OrderMode::kAll);
  EXPECT_TRUE(decoded(encode(clip, options).file).attributes.empty());
  options.attributes.normals = 0.05;
  const MeshSequence back = decoded(encode(clip, options).file);
  ASSERT_EQ(back.attributes.size(), 1U);
  EXPECT_EQ(back.attributes[0].name, "TANGENT");
  for (size_t i = 0; i < tangents.values.size(); ++i)
    ASSERT_NEAR(back.attributes[0].values[i], tangents.values[i], 5.1e-4);
}

TEST(AttributeEncode, StoresNormalsWhereAsked) {
  EncodeOptions options = quick(OrderMode::kAll);
  options.attributes.normals = 0.05;
  const MeshSequence clip = detailed("quad_box");
  const MeshSequence back = decoded(encode(clip, options).file);
  const Attribute* normals = find(back, AttributeKind::kNormal);
  ASSERT_TRUE(normals);
  EXPECT_EQ(normals->values, clip.attributes[2].values);
}

TEST(AttributeEncode, TakesTheHardEdgesOfNormalsOfPolygons) {
  MeshSequence box = corpus::make_clip("painted_box");
  box.attributes.clear();
  box.shared_normals.clear();
  Attribute of_polygons, of_corners;
  of_polygons.kind = of_corners.kind = AttributeKind::kNormal;
  of_polygons.components = of_corners.components = 3;
  of_polygons.domain = AttributeDomain::kPolygon;
  of_corners.domain = AttributeDomain::kCorner;
  for (size_t p = 0; p < box.polygons.size(); ++p) {
    float normal[3] = {};
    normal[p % 3] = p % 2 == 0 ? 1.0F : -1.0F;
    of_polygons.values.insert(of_polygons.values.end(), normal, normal + 3);
    for (size_t c = 0; c < box.polygons[p].size(); ++c)
      of_corners.values.insert(of_corners.values.end(), normal, normal + 3);
  }
  MeshSequence other = box;
  box.attributes.push_back(of_polygons);
  other.attributes.push_back(of_corners);
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  EXPECT_EQ(encode(box, options).file, encode(other, options).file);
}

TEST(AttributeEncode, KeepsDirectionsWithinTheAngle) {
  MeshSequence clip = corpus::make_clip("limb");
  Attribute normals{AttributeKind::kNormal, "NORMAL", AttributeDomain::kVertex, 3, 1, {}};
  for (uint32_t v = 0; v < clip.vertex_count; ++v) {
    const float a = 0.7F * static_cast<float>(v), b = 0.3F * static_cast<float>(v);
    const float length = v % 2 == 0 ? 1 : 0.5F;
    normals.values.insert(normals.values.end(),
                          {length * std::cos(a) * std::cos(b), length * std::sin(a) * std::cos(b),
                           length * std::sin(b)});
  }
  clip.attributes = {normals};
  size_t coarse = 0;
  for (double angle : {5.0, 0.5, 0.01}) {
    EncodeOptions options = quick(OrderMode::kVertices);
    options.attributes.normals = angle;
    const Bytes file = encode(clip, options).file;
    EXPECT_GT(file.size(), coarse);
    coarse = file.size();
    const MeshSequence back = decoded(file);
    double largest = 0;
    for (size_t i = 0; i < normals.values.size(); i += 3) {
      const Eigen::Vector3d a = Eigen::Vector3f(&normals.values[i]).cast<double>();
      const Eigen::Vector3d b = Eigen::Vector3f(&back.attributes[0].values[i]).cast<double>();
      largest = std::max(largest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
    }
    EXPECT_LE(largest, angle);
    EXPECT_GT(largest, 0.3 * angle);
  }
}

TEST(AttributeEncode, KeepsBoundsOfAttributesThatRest) {
  using Measure = AttributeBound::Measure;
  MeshSequence clip = detailed("limb");
  const size_t usual = encode(clip, quick(OrderMode::kAll)).file.size();
  const auto largest_error = [](const MeshSequence& source) {
    const MeshSequence back = decoded(encode(source, quick(OrderMode::kAll)).file);
    const Attribute *a = find(source, AttributeKind::kCustom),
                    *b = find(back, AttributeKind::kCustom);
    EXPECT_EQ(a->values.size(), b->values.size());
    float largest = 0;
    for (size_t i = 0; i < a->values.size(); ++i)
      largest = std::max(largest, std::abs(a->values[i] - b->values[i]));
    return largest;
  };
  Attribute& weight = clip.attributes[3];
  weight.bound = {Measure::kPercent, 1};
  EXPECT_LE(largest_error(clip), 20);
  EXPECT_GT(largest_error(clip), 10);
  EXPECT_LT(encode(clip, quick(OrderMode::kAll)).file.size(), usual);
  weight.bound = {Measure::kUnits, 0.01};
  EXPECT_LE(largest_error(clip), 0.01);
  weight.bound = {Measure::kUnits, 1e-6};
  EXPECT_THROW(encode(clip, quick(OrderMode::kAll)), Error);
  weight.bound = {Measure::kUnits, 0};
  EXPECT_THROW(encode(clip, quick(OrderMode::kAll)), Error);
  weight.bound = {Measure::kExact};
  EXPECT_THROW(encode(clip, quick(OrderMode::kAll)), Error);
  for (float& value : weight.values)
    value = std::round(value * 1e4F);
  EXPECT_EQ(largest_error(clip), 0);
  std::ranges::fill(weight.values, 3.25F);
  weight.bound = {Measure::kPercent, 1};
  EXPECT_EQ(largest_error(clip), 0);
}

TEST(AttributeEncode, RefusesWhatDoesNotFit) {
  auto fails = [](auto change) {
    MeshSequence clip = detailed("quad_box");
    change(clip);
    EXPECT_THROW(encode(clip, quick(OrderMode::kVertices)), Error);
  };
  fails([](MeshSequence& c) { c.attributes[0].values.pop_back(); });
  fails([](MeshSequence& c) { c.attributes[0].values[3] = NAN; });
  fails([](MeshSequence& c) { c.attributes[1].values[0] = INFINITY; });
  fails([](MeshSequence& c) { c.attributes[0].values[1] = 1e9F; });
  fails([](MeshSequence& c) { c.attributes[3].components = 17; });
  fails([](MeshSequence& c) { c.materials.of_polygon[2] = 2; });
  fails([](MeshSequence& c) { c.parts.of_polygon.pop_back(); });
}

TEST(AttributeDecode, SurvivesDamagedStreams) {
  const Bytes file = encode(detailed("limb"), quick(OrderMode::kVertices)).file;
  ContainerReader reader;
  ASSERT_EQ(reader.open(file).status, Status::kOk);
  ByteView payload;
  ASSERT_EQ(reader.payload(*reader.find("ATTR", 0), &payload).status, Status::kOk);
  Clip clip;  // in the order of the file, which is all that decode_attributes() needs
  ASSERT_EQ(clip.open(file).status, Status::kOk);
  std::mt19937 random(1);
  int refused = 0;
  const Vector<uint8_t> moving(kMaxAttributes, 0);
  for (int i = 0; i < 400; ++i) {
    Bytes bytes(payload.data, payload.data + payload.size);
    if (i % 2 == 0)
      bytes.resize(random() % bytes.size());
    else
      bytes[random() % bytes.size()] ^= static_cast<uint8_t>(1 + random() % 255);
    AttributeRecord record;
    Status status = AttributeRecord::read(bytes, clip.limits().meshes[0], &record);
    Vector<MeshAttribute> out;
    if (status == Status::kOk)
      status = decode_attributes(record, clip.limits().meshes[0], clip.meshes()[0].topology, moving,
                                 &out);
    refused += status != Status::kOk;
    for (const MeshAttribute& a : out) {
      for (float x : a.values)
        ASSERT_TRUE(std::isfinite(x));
    }
  }
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace anicodec
