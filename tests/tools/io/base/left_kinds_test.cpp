// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files that hold one of everything, each of its format, and what is said of them.
#include "tools/io/base/left_kinds.h"

#include "tests/tools/gltf_testing.h"
#include "tests/tools/io/alembic/alembic_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/load_sequence.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

class LeftKindsOfFiles : public testing::Test {
 protected:
  /// The notes on a file, the folder taken away.
  std::string said(const std::string& name, const std::string& bytes) {
    std::string notes;
    LoadOptions options;
    options.note = [&](const std::string& text) { notes += text + "\n"; };
    load_sequence(std::vector<std::string>{folder_.write(name, bytes)}, options);
    for (size_t at = 0; (at = notes.find(folder_ / "", at)) != std::string::npos;)
      notes.erase(at, (folder_ / "").size());
    return notes;
  }

  TemporaryFolder folder_;
};

TEST(LeftKinds, ComeOnceInTheOrderMet) {
  LeftKinds kinds;
  EXPECT_EQ(kinds.text(), "");
  for (const char* kind : {"b", "a", "b"})
    kinds.add(kind);
  EXPECT_EQ(kinds.text(), "b, a");
  EXPECT_EQ(counted_kind(1, "camera") + ", " + counted_kind(2, "light"), "1 camera, 2 lights");
}

TEST_F(LeftKindsOfFiles, OfAnObj) {
  folder_.write("a.mtl",
                "newmtl red\nKa 1 1 1\nKd 1 0 0\nKs 1 1 1\nKe 0 0 0\nNs 10\nNi 1.5\nd 1\nTf 1 1 "
                "1\nillum 2\nPr 0.5\nPm 0\n"
                "Pc 1\nmap_Kd a.png\nmap_Ks b.png\nmap_Bump c.png\nrefl d.png\n");
  const std::string obj =
      "mtllib a.mtl\no thing\ng part\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 "
      "1\nvt 0 0\nvn 0 0 1\nvp 0 0\n"
      "usemtl red\ns 1\nf 1/1 2/1 3/1\nl 1 2\np 4\nbevel on\nlod 1\n";
  EXPECT_EQ(said("a.obj", obj),
            "a.obj: left out: 'g', 'vp', 'l', 'p', 'bevel', 'lod', 's', 'Ka' of materials, 'Ks' of "
            "materials, "
            "'Ni' of materials, 'Tf' of materials, 'Pc' of materials, 'map_Ks' of materials, "
            "'refl' of materials\n");
  EXPECT_EQ(said("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\ns 1\nf 1//1 2//1 3//1\n"), "")
      << "normals say which edges are hard";
}

TEST_F(LeftKindsOfFiles, OfAPly) {
  EXPECT_EQ(said("a.ply",
                 "ply\nformat ascii 1.0\ncomment of no use\nobj_info the same\nelement vertex "
                 "3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float heat\nproperty float bad\nproperty list uchar "
                 "int near\nelement face 1\n"
                 "property list uchar int vertex_indices\nproperty int flags\nelement camera "
                 "1\nproperty float fov\n"
                 "element nothing 0\nproperty float x\nend_header\n0 0 0 1 nan 1 0\n1 0 0 1 2 0\n0 "
                 "1 0 1 2 0\n3 0 1 2 7\n50\n"),
            "a.ply: left out: 'bad' of vertices, 'near' of vertices, 'flags' of faces, 'camera'\n");
}

TEST_F(LeftKindsOfFiles, OfAnOff) {
  EXPECT_EQ(
      said("a.off",
           "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 0 0 1\n1 0 0 0 0 1 1 1 1 0 0 1\n0 1 0 0 0 1 1 1 1 0 "
           "0 1\n3 0 1 2 255 0 0\n"),
      "a.off: left out: texture coordinates, colours of vertices, normals, colours of faces\n");
}

TEST_F(LeftKindsOfFiles, OfAnStl) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n";
  EXPECT_EQ(said("a.stl", "solid a\n" + facet + "endsolid a\nsolid b\n" + facet + "endsolid b\n"),
            "a.stl: left out: names of solids\n");
  std::string binary(80, '\0');
  append(uint32_t{1}, std::endian::little, binary);
  for (const float x : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
    append(x, std::endian::little, binary);
  EXPECT_EQ(said("b.stl", binary + std::string("\0\0", 2)), "");
  EXPECT_EQ(said("c.stl", binary + "\x1f\x7c"), "c.stl: left out: attribute bytes of triangles\n");
}

TEST_F(LeftKindsOfFiles, OfAGltfScene) {
  GltfScene scene = triangle_scene();
  nlohmann::json& json = scene.document;
  const size_t numbers = scene.scalars({1, 2, 3});
  json["asset"]["generator"] = json["asset"]["copyright"] = "someone";
  json["extras"] = {{"a", 1}};
  json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_thing", "KHR_materials_clearcoat"};
  json["extensions"] = {
      {"KHR_lights_punctual", {{"lights", nlohmann::json::array({{{"type", "point"}}})}}},
      {"EXT_thing", {{"x", 1}}}};
  json["nodes"][0]["camera"] = 0;
  json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
  json["nodes"].push_back({{"name", "other"}});
  json["scenes"].push_back({{"name", "second"}, {"nodes", {1}}});
  scene.primitive()["attributes"]["_HEAT"] = numbers;
  scene.primitive()["material"] = 0;
  json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  json["samplers"] = {{{"wrapS", 33071}, {"magFilter", 9729}}};
  json["images"] = {{{"uri", "a.png"}, {"mimeType", "image/png"}}};
  json["textures"] = {{{"source", 0}, {"sampler", 0}, {"name", "t"}}};
  json["materials"] = {{{"name", "m"},
                        {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                        {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}}};
  json["news"] = 1;
  EXPECT_EQ(
      said("a.glb", scene.glb()),
      "not kept: attribute _HEAT, points, lines, 1 camera, EXT_thing, lights, custom properties, "
      "KHR_materials_clearcoat, 'scale' of materials, 'news', how textures repeat, other scenes; "
      "encode to a .glb keeps all of the scene\n");
  EXPECT_EQ(said("b.glb", triangle_scene().glb()), "");
}

TEST_F(LeftKindsOfFiles, OfAnArchive) {
  MeshSequence clip;
  clip.vertex_count = 3;
  clip.frame_count = 1;
  clip.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2});
  const std::string plain = archive_of_scene(scene_of(clip));
  EXPECT_EQ(said("plain.abc", plain), "");
  const AbcArchive from(memory_source(plain, "plain.abc"));
  std::string bytes;
  AbcArchiveOutput to(sink_to(bytes), from.metadata);
  for (const AbcTime& sampling : from.samplings)
    to.shared().sampling(sampling);
  copy_object(from, 0, to.top(), [](const AbcProperty&, std::string&) {});
  to.top().child("eye", "schema=AbcGeom_Camera_v1;schemaObjTitle=AbcGeom_Camera_v1:.geom");
  AbcObjectOutput& group =
      to.top().child("group", "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform");
  AbcCompoundOutput& xform = group.properties().compound(".xform", "schema=AbcGeom_Xform_v3");
  xform.scalar(".inherits", "", AbcType::kBool, 1, 0).add_one(uint8_t{1});
  xform.compound(".userProperties", "");
  xform.compound(".arbGeomParams", "").scalar("speed", "", AbcType::kFloat64, 1, 0).add_one(2.0);
  group.properties().scalar("tag", "", AbcType::kBool, 1, 0).add_one(uint8_t{1});
  to.finish();
  EXPECT_EQ(said("a.abc", bytes),
            "not kept: 'tag' of objects, '.arbGeomParams' of Xforms, 1 AbcGeom_Camera_v1\n");
}

}  // namespace
}  // namespace anicodec::tools
