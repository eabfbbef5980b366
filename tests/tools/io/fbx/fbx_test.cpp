// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// FBX as text, written here; what is expected follows from its numbers by the arithmetic of the format.
#include "tools/io/fbx/fbx.h"

#include "tests/tools/clip_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/formats/vertex_cache.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Vec = std::array<double, 3>;

constexpr int64_t kSecond = 46186158000;
constexpr int kStepped = 0x2, kLinear = 0x4, kCubic = 0x8;

std::string listed(const std::vector<double>& numbers) {
  std::string text = "*" + std::to_string(numbers.size()) + " {\na: ";
  for (size_t i = 0; i < numbers.size(); ++i) {
    const bool whole = numbers[i] == std::floor(numbers[i]);
    text += (i > 0 ? "," : "") +
            (whole ? std::to_string(static_cast<int64_t>(numbers[i])) : std::to_string(numbers[i]));
  }
  return text + "\n}\n";
}

/// A key of a curve: second, value.
using Keys = std::vector<std::pair<double, double>>;

/// An FBX in the making.
class Fbx {
 public:
  int id() { return next_++; }

  std::string property(const std::string& name, const std::vector<double>& values) {
    std::string text = "P: \"" + name + "\", \"\", \"\", \"A\"";
    for (const double x : values)
      text += "," + std::to_string(x);
    return text + "\n";
  }

  /// A node with the tetrahedron of the origin and the axes, or none; gives its number.
  int node(const std::string& name, const std::string& properties = "", int parent = 0,
           bool mesh = true) {
    const int n = id();
    objects_ += "Model: " + std::to_string(n) + ", \"Model::" + name + "\", \"" +
                (mesh ? "Mesh" : "Null") + "\" {\nVersion: 232\nProperties70:  {\n" + properties +
                "}\n}\n";
    connect(n, parent);
    if (!mesh)
      return n;
    geometry_ = id();
    objects_ += "Geometry: " + std::to_string(geometry_) + ", \"Geometry::" + name +
                "\", \"Mesh\" {\nVertices: " + listed({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
                "PolygonVertexIndex: " + listed({0, 2, -2, 0, 1, -4, 0, 3, -3, 1, 2, -4}) + "}\n";
    connect(geometry_, n);
    return n;
  }

  int geometry() const { return geometry_; }

  int take(const std::string& name, double begin, double end) {
    const int stack = id();
    layer_ = id();
    objects_ += "AnimationStack: " + std::to_string(stack) + ", \"AnimStack::" + name +
                "\", \"\" {\nProperties70:  {\n" + time("LocalStart", begin) +
                time("LocalStop", end) + "}\n}\n" + "AnimationLayer: " + std::to_string(layer_) +
                ", \"AnimLayer::L\", \"\" {\n}\n";
    connect(layer_, stack);
    return stack;
  }

  /// Curves of a property of the take made last, one for each component.
  void animate(int object, const std::string& property, const std::vector<std::string>& components,
               const std::vector<Keys>& curves, int flags) {
    const int value = id();
    objects_ += "AnimationCurveNode: " + std::to_string(value) +
                ", \"AnimCurveNode::x\", \"\" {\nProperties70:  {\n";
    for (size_t k = 0; k < curves.size(); ++k)
      objects_ += "P: \"" + components[k] + "\", \"Number\", \"\", \"A\"," +
                  std::to_string(curves[k][0].second) + "\n";
    objects_ += "}\n}\n";
    connect(value, layer_);
    connections_ += "C: \"OP\"," + std::to_string(value) + "," + std::to_string(object) + ", \"" +
                    property + "\"\n";
    for (size_t k = 0; k < curves.size(); ++k) {
      const int curve = id();
      std::vector<double> times, values;
      for (const auto& [second, number] : curves[k]) {
        times.push_back(std::round(second * static_cast<double>(kSecond)));
        values.push_back(number);
      }
      objects_ += "AnimationCurve: " + std::to_string(curve) +
                  ", \"AnimCurve::\", \"\" {\nKeyVer: 4008\nKeyTime: " + listed(times) +
                  "KeyValueFloat: " + listed(values) + "KeyAttrFlags: " + listed({double(flags)}) +
                  "KeyAttrDataFloat: " + listed({0, 0, 0, 0}) +
                  "KeyAttrRefCount: " + listed({double(times.size())}) + "}\n";
      connections_ += "C: \"OP\"," + std::to_string(curve) + "," + std::to_string(value) + ", \"" +
                      components[k] + "\"\n";
    }
  }

  void move(int object, const std::string& property, const std::vector<Keys>& curves, int flags) {
    animate(object, property, {"d|X", "d|Y", "d|Z"}, curves, flags);
  }

  void object(const std::string& text) { objects_ += text; }

  void connect(int from, int to) {
    connections_ += "C: \"OO\"," + std::to_string(from) + "," + std::to_string(to) + "\n";
  }

  /// The file, of 30 frames per second unless its mode is another.
  std::string text(const std::string& settings = "") const {
    return "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: "
           "7300\n}\n"
           "GlobalSettings:  {\nVersion: 1000\nProperties70:  {\n"
           "P: \"UpAxis\", \"int\", \"Integer\", \"\",1\nP: \"UpAxisSign\", \"int\", \"Integer\", "
           "\"\",1\n"
           "P: \"FrontAxis\", \"int\", \"Integer\", \"\",2\nP: \"FrontAxisSign\", \"int\", "
           "\"Integer\", \"\",1\n"
           "P: \"CoordAxis\", \"int\", \"Integer\", \"\",0\nP: \"CoordAxisSign\", \"int\", "
           "\"Integer\", \"\",1\n"
           "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",1\nP: \"TimeMode\", \"enum\", "
           "\"\", \"\",6\n" +
           settings + "}\n}\nObjects:  {\n" + objects_ + "}\nConnections:  {\n" + connections_ +
           "}\n";
  }

 private:
  static std::string time(const std::string& name, double second) {
    return "P: \"" + name + "\", \"KTime\", \"Time\", \"\"," +
           std::to_string(std::llround(second * static_cast<double>(kSecond))) + "\n";
  }

  int next_ = 1000, geometry_ = 0, layer_ = 0;
  std::string objects_, connections_;
};

Vec turned(Vec p, int axis, double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  const auto i = static_cast<size_t>((axis + 1) % 3), j = static_cast<size_t>((axis + 2) % 3);
  const double x = p[i] * std::cos(a) - p[j] * std::sin(a),
               y = p[i] * std::sin(a) + p[j] * std::cos(a);
  p[i] = x;
  p[j] = y;
  return p;
}

Vec at(const MeshSequence& clip, size_t frame, size_t vertex) {
  const float* p = clip.frame(frame).data() + 3 * vertex;
  return {double(p[0]), double(p[1]), double(p[2])};
}

void expect_near(const Vec& a, const Vec& b, double within = 1e-6) {
  for (size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(a[k], b[k], within) << "component " << k;
}

/// Six times the volume that the faces of a frame enclose.
double volume(const MeshSequence& clip, size_t frame, size_t first_polygon = 0, size_t count = 4) {
  double sum = 0;
  for (size_t p = first_polygon; p < first_polygon + count; ++p) {
    const auto polygon = clip.polygons[p];
    const Vec a = at(clip, frame, polygon[0]), b = at(clip, frame, polygon[1]),
              c = at(clip, frame, polygon[2]);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

class FbxFile : public testing::Test {
 protected:
  void SetUp() override {
    if (!reads_fbx())
      GTEST_SKIP() << "this build is without ufbx";
  }

  MeshSequence load(const Fbx& fbx, LoadOptions options = {}, const std::string& settings = "") {
    notes_.clear();
    options.note = [this](const std::string& text) { notes_ += text + "\n"; };
    return load_sequence(std::vector<std::string>{folder_.write("a.fbx", fbx.text(settings))},
                         options);
  }

  TemporaryFolder folder_;
  std::string notes_;
};

TEST_F(FbxFile, NamesWhatItHoldsBesideMeshesAndTheirMotion) {
  Fbx fbx;
  const int mesh = fbx.node("a", "P: \"mark\", \"double\", \"Number\", \"AU\",1\n");
  for (const auto& [kind, owner] : {std::pair("Camera", "eye"), {"Light", "lamp"}}) {
    const int attribute = fbx.id(), node = fbx.node(owner, "", 0, false);
    fbx.object("NodeAttribute: " + std::to_string(attribute) + ", \"NodeAttribute::x\", \"" + kind +
               "\" {\nTypeFlags: \"" + kind + "\"\n}\n");
    fbx.connect(attribute, node);
  }
  fbx.object("Constraint: " + std::to_string(fbx.id()) +
             ", \"Constraint::c\", \"Aim\" {\nType: \"Aim\"\n}\n");
  EXPECT_GT(mesh, 0);
  load(fbx);
  EXPECT_THAT(notes_, HasSubstr("not kept: 1 camera, 1 constraint, 1 light, custom properties\n"));
}

TEST_F(FbxFile, HasTheMeshesOfAllTakesInEach) {
  Fbx fbx;
  const int plain = fbx.node("a"),
            turned = fbx.node("b", fbx.property("Lcl Translation", {5, 0, 0}));
  fbx.take("walk", 0, 1);
  fbx.move(plain, "Lcl Translation", {{{0, 0}, {1, 1}}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 0}}},
           kLinear);
  fbx.take("flip", 0, 1);
  fbx.move(turned, "Lcl Scaling",
           {{{0, 1}, {0.5, -1}, {1, -1}}, {{0, 1}, {1, 1}}, {{0, 1}, {1, 1}}}, kStepped);
  LoadOptions options;
  options.takes = true;
  const MeshSequence clip = load(fbx, options);
  ASSERT_EQ(clip.clips.size(), 2U) << notes_;
  EXPECT_THAT(clip.parts.names, ElementsAre("a", "b", "b mirrored"));
  // Inside out only would be below 0; what is at a point has none.
  const size_t last = clip.frame_count - 1, flip = clip.clips[0].frame_count;
  for (const size_t f : {size_t{0}, flip, last}) {
    EXPECT_NEAR(volume(clip, f, 4), f == last ? 0 : 1, 1e-6) << f;
    EXPECT_NEAR(volume(clip, f, 8), f == last ? 1 : 0, 1e-6) << f;
  }
}

TEST_F(FbxFile, StepsStayUntilTheirKeys) {
  Fbx fbx;
  const int node = fbx.node("N");
  fbx.take("Take", 0, 1);
  fbx.move(node, "Lcl Translation", {{{0, 0}, {0.5, 3}, {1, 6}}, {{0, 0}}, {{0, 0}}}, kStepped);
  const MeshSequence clip = load(fbx);
  ASSERT_EQ(clip.frame_count, 31U);
  EXPECT_EQ(clip.rate.numerator, 30U);
  EXPECT_EQ(clip.up, UpAxis::kY);
  EXPECT_DOUBLE_EQ(clip.metres_per_unit, 0.01);
  for (size_t f = 0; f < 31; ++f)
    EXPECT_EQ(clip.frame(f)[0], f < 15 ? 0 : f < 30 ? 3 : 6) << f;
  EXPECT_NEAR(volume(clip, 0), 1, 1e-6);
}

TEST_F(FbxFile, CubicKeysWithFlatTangentsEaseInAndOut) {
  Fbx fbx;
  const int node = fbx.node("N");
  fbx.take("Take", 0, 1);
  constexpr int kUserTangents = 0x400;  // slopes of 0
  fbx.move(node, "Lcl Translation", {{{0, 0}, {1, 6}}, {{0, 0}}, {{0, 0}}}, kCubic | kUserTangents);
  const MeshSequence clip = load(fbx);
  for (size_t f = 0; f < 31; ++f) {
    const double s = static_cast<double>(f) / 30;
    EXPECT_NEAR(static_cast<double>(clip.frame(f)[0]), 6 * (3 * s * s - 2 * s * s * s), 1e-5) << f;
  }
}

TEST_F(FbxFile, EulerAnglesGoEachByItself) {
  Fbx fbx;
  const int node = fbx.node("N");
  fbx.take("Take", 0, 1);
  fbx.move(node, "Lcl Rotation", {{{0, 0}, {1, 80}}, {{0, 0}, {1, 60}}, {{0, 0}, {1, 100}}},
           kLinear);
  const MeshSequence clip = load(fbx);
  for (size_t f = 0; f < 31; ++f) {
    const double s = static_cast<double>(f) / 30;
    for (size_t v = 1; v < 4; ++v) {
      Vec p{0, 0, 0};
      p[v - 1] = 1;
      expect_near(at(clip, f, v), turned(turned(turned(p, 0, 80 * s), 1, 60 * s), 2, 100 * s));
    }
  }
}

TEST_F(FbxFile, TurnsAboutPivotsAfterPreRotation) {
  Fbx fbx;
  const int node = fbx.node(
      "N", fbx.property("RotationActive", {1}) + fbx.property("RotationPivot", {2, 0, 0}) +
               fbx.property("PreRotation", {90, 0, 0}) + fbx.property("RotationOffset", {0, 0, 5}) +
               fbx.property("GeometricTranslation", {0, 7, 0}));
  fbx.take("Take", 0, 1);
  fbx.move(node, "Lcl Rotation", {{{0, 0}}, {{0, 0}}, {{0, 0}, {1, 90}}}, kLinear);
  const MeshSequence clip = load(fbx);
  for (const size_t f : {0U, 15U, 30U}) {
    Vec p{1 - 2, 0 + 7, 0};
    p = turned(turned(p, 2, 90 * static_cast<double>(f) / 30), 0, 90);
    expect_near(at(clip, f, 1), {p[0] + 2, p[1], p[2] + 5}, 1e-5);
  }
}

TEST_F(FbxFile, NodesThatMirrorTurnTheirFaces) {
  Fbx fbx;
  const int parent = fbx.node("P", fbx.property("Lcl Scaling", {-1, 1, 1}), 0, false);
  fbx.node("N", "", parent);
  const MeshSequence clip = load(fbx);
  EXPECT_EQ(clip.frame_count, 1U);
  EXPECT_NEAR(volume(clip, 0), 1, 1e-6);
  expect_near(at(clip, 0, 1), {-1, 0, 0});
}

TEST_F(FbxFile, NodesThatMirrorAtTimesAreThereTwice) {
  Fbx fbx;
  const int node = fbx.node("N");
  fbx.take("Take", 0, 1);
  fbx.move(node, "Lcl Scaling", {{{0, 1}, {0.5, -1}}, {{0, 1}}, {{0, 1}}}, kStepped);
  const MeshSequence clip = load(fbx);
  EXPECT_THAT(clip.parts.names, ElementsAre("N", "N mirrored"));
  EXPECT_NEAR(volume(clip, 0), 1, 1e-6);
  EXPECT_NEAR(volume(clip, 0, 4), 0, 1e-6);
  EXPECT_NEAR(volume(clip, 20), 0, 1e-6);
  EXPECT_NEAR(volume(clip, 20, 4), 1, 1e-6);
}

TEST_F(FbxFile, InBetweensOfShapesAreMet) {
  Fbx fbx;
  fbx.node("N");
  const int deformer = fbx.id(), channel = fbx.id(), half = fbx.id(), full = fbx.id();
  fbx.object("Deformer: " + std::to_string(deformer) +
             ", \"Deformer::B\", \"BlendShape\" {\nVersion: 100\n}\n");
  fbx.object("Deformer: " + std::to_string(channel) +
             ", \"SubDeformer::C\", \"BlendShapeChannel\" {\nVersion: 100\nDeformPercent: "
             "0\nFullWeights: " +
             listed({50, 100}) + "}\n");
  for (const auto& [id, z] : {std::pair(half, 5.0), {full, 2.0}})
    fbx.object("Geometry: " + std::to_string(id) +
               ", \"Geometry::S\", \"Shape\" {\nVersion: 100\nIndexes: " + listed({3}) +
               "Vertices: " + listed({0, 0, z}) + "}\n");
  fbx.connect(deformer, fbx.geometry());
  fbx.connect(channel, deformer);
  fbx.connect(half, channel);
  fbx.connect(full, channel);
  fbx.take("Take", 0, 1);
  fbx.animate(channel, "DeformPercent", {"d|DeformPercent"}, {{{0, 0}, {1, 100}}}, kLinear);
  const MeshSequence clip = load(fbx);
  const auto z = [&](size_t f) { return at(clip, f, 3)[2]; };
  EXPECT_NEAR(z(0), 1, 1e-6);
  EXPECT_NEAR(z(6), 1 + 5 * 0.4, 1e-5);  // weight 20 of 50
  EXPECT_NEAR(z(15), 1 + 5, 1e-5);
  EXPECT_NEAR(z(24), 1 + 5 * 0.4 + 2 * 0.6, 1e-5);  // weight 80, between 50 and 100
  EXPECT_NEAR(z(30), 1 + 2, 1e-5);
}

TEST_F(FbxFile, TakesAreClips) {
  Fbx fbx;
  const int node = fbx.node("N");
  for (const auto& [name, x] : {std::pair("walk", 1.0), {"idle", 0.0}, {"run", 3.0}}) {
    fbx.take(name, 0, x == 3 ? 0.5 : 1);
    fbx.move(node, "Lcl Translation", {{{0, 0}, {1, x}}, {{0, 0}}, {{0, 0}}}, kLinear);
  }
  const MeshSequence first = load(fbx);
  EXPECT_EQ(first.name, "a walk");
  EXPECT_THAT(notes_, HasSubstr("other takes are left out: 'run'"));
  LoadOptions takes;
  takes.takes = true;
  const MeshSequence all = load(fbx, takes);
  ASSERT_EQ(all.clips.size(), 2U);
  EXPECT_EQ(all.clips[0].name, "walk");
  EXPECT_EQ(all.clips[1].name, "run");
  EXPECT_EQ(all.clips[1].frame_count, 16U);
  EXPECT_THAT(notes_, HasSubstr("left out, as they move no vertex: 'idle'"));
  EXPECT_FLOAT_EQ(load(fbx, {.clip = "run"}).frame(15)[0], 1.5F);
  EXPECT_FLOAT_EQ(load(fbx, {.clip = "2"}).frame(15)[0], 1.5F);
  EXPECT_EQ(load(fbx, {.clip = "none"}).frame_count, 1U);
  EXPECT_THAT(fault([&] { load(fbx, {.clip = "jump"}); }, ErrorKind::kUsage),
              HasSubstr("there is no clip 'jump'; the clips are: 'walk', 'idle', 'run'"));
}

TEST_F(FbxFile, TakesPlayedTogetherReplaceWhatEachMoves) {
  Fbx fbx;
  const int left = fbx.node("left", fbx.property("Lcl Scaling", {100, 100, 100})),
            right = fbx.node("right", fbx.property("Lcl Translation", {5, 0, 0}));
  fbx.take("grow", 0, 1);
  fbx.move(left, "Lcl Scaling", {{{0, 100}, {1, 300}}, {{0, 100}}, {{0, 100}}}, kLinear);
  fbx.take("slide", 0, 1);
  fbx.move(left, "Lcl Scaling", {{{0, 100}}, {{0, 100}}, {{0, 100}}}, kLinear);
  fbx.move(right, "Lcl Translation", {{{0, 5}, {1, 7}}, {{0, 0}}, {{0, 0}}}, kLinear);
  const MeshSequence grown = load(fbx, {.clip = "slide+grow"});
  ASSERT_EQ(grown.frame_count, 31U);
  expect_near(at(grown, 30, 1), {300, 0, 0}, 1e-4);
  expect_near(at(grown, 30, 5), {8, 0, 0});
  expect_near(at(load(fbx, {.clip = "grow+slide"}), 30, 1), {100, 0, 0}, 1e-4);
}

TEST_F(FbxFile, FramesFollowKeysThatAreCloser) {
  Fbx fbx;
  const int node = fbx.node("N");
  fbx.take("Take", -0.5, 0.5);
  Keys keys;
  for (int k = 0; k <= 60; ++k)
    keys.emplace_back(-0.5 + k / 60.0, k);
  fbx.move(node, "Lcl Translation", {keys, {{0, 0}}, {{0, 0}}}, kLinear);
  const MeshSequence clip = load(fbx);
  EXPECT_EQ(clip.rate.numerator, 60U);
  EXPECT_DOUBLE_EQ(clip.start_time, -0.5);
  ASSERT_EQ(clip.frame_count, 61U);
  EXPECT_NEAR(static_cast<double>(clip.frame(31)[0]), 31, 1e-4);
  EXPECT_EQ(load(fbx, {.rate = FrameRate{12, 1, false}}).frame_count, 13U);
}

TEST_F(FbxFile, HiddenMeshesAreAtAPointOrLeftOut) {
  Fbx fbx;
  const int node = fbx.node("N");
  fbx.node("never", fbx.property("Visibility", {0}) + fbx.property("Lcl Translation", {5, 0, 0}));
  fbx.take("Take", 0, 1);
  fbx.animate(node, "Visibility", {"d|Visibility"}, {{{0, 1}, {0.5, 0}}}, kStepped);
  const MeshSequence clip = load(fbx);
  EXPECT_EQ(clip.vertex_count, 4U);
  EXPECT_THAT(notes_, HasSubstr("mesh 'never' is left out: no frame shows it"));
  expect_near(at(clip, 0, 1), {1, 0, 0});
  expect_near(at(clip, 15, 1), {0, 0, 0});
  EXPECT_EQ(load(fbx, {.mesh = "never"}).vertex_count, 4U);
}

TEST_F(FbxFile, CachesOfGeometryMoveMeshes) {
  Fbx fbx;
  fbx.node("N");
  const int deformer = fbx.id(), cache = fbx.id();
  fbx.object("Deformer: " + std::to_string(deformer) +
             ", \"Deformer::V\", \"VertexCacheDeformer\" {\nProperties70:  {\n"
             "P: \"Active\", \"bool\", \"\", \"\",1\nP: \"Channel\", \"KString\", \"\", \"\", "
             "\"\"\n}\n}\n");
  fbx.object("Cache: " + std::to_string(cache) +
             ", \"Cache::C\", \"\" {\nProperties70:  {\n"
             "P: \"CacheFileName\", \"KString\", \"XRefUrl\", \"\", \"a.pc2\"\n"
             "P: \"CacheFileType\", \"enum\", \"\", \"\",1\n}\n}\n");
  fbx.connect(deformer, fbx.geometry());
  fbx.connect(cache, deformer);
  fbx.take("Take", 0, 1);
  load(fbx);
  EXPECT_THAT(notes_, HasSubstr("has a cache of geometry that is not found"));
  std::string bytes;
  append_pc2_header(4, 31, bytes);
  for (int f = 0; f < 31; ++f) {
    for (const float x : {float(f), 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F})
      bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  }
  folder_.write("a.pc2", bytes);
  const MeshSequence clip = load(fbx);
  ASSERT_EQ(clip.frame_count, 31U);
  EXPECT_FLOAT_EQ(clip.frame(17)[0], 17);
}

TEST_F(FbxFile, RefusesWhatIsNoMeshInOneLine) {
  Fbx fbx;
  fbx.node("N", "", 0, false);
  EXPECT_EQ(fault([&] { load(fbx); }), folder_ / "a.fbx: the scene has no mesh");
  folder_.write("b.fbx", "Kaydara FBX Binary  nonsense");
  EXPECT_THAT(fault([&] { load_file(folder_ / "b.fbx"); }), HasSubstr("b.fbx: ufbx: "));
  Fbx named;
  named.node("N");
  const std::string whole = named.text("");
  folder_.write("c.fbx", whole.substr(0, whole.rfind("C:")));
  EXPECT_EQ(fault([&] { load_file(folder_ / "c.fbx"); }),
            folder_ / "c.fbx: truncated: ends in a block that is not closed");
  EXPECT_THAT(fault([&] { load(named, {.mesh = "M"}); }, ErrorKind::kUsage),
              HasSubstr("the meshes are: 'N'"));
}

}  // namespace
}  // namespace anicodec::tools
