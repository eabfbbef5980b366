// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/mtl.h"

#include "tests/tools/io_testing.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

LeftKinds unkept;  // of all tests

PolygonLabels named(std::vector<std::string> names) {
  PolygonLabels labels;
  labels.names = std::move(names);
  return labels;
}

MaterialLook look_of(const std::string& statements) {
  PolygonLabels labels = named({"red wall"});
  parse_mtl("newmtl red wall\n" + statements, "a.mtl", labels, unkept);
  return labels.looks.at(0);
}

TEST(Mtl, GivesTheLooksOfMaterialsThatAreAskedFor) {
  PolygonLabels labels = named({"b", "a"});
  parse_mtl("# made by hand\nnewmtl a\nKa 1 1 1\nKd 0.5 0.25 0\nnewmtl c\nKd 1 0 0\n", "a.mtl",
            labels, unkept);
  ASSERT_EQ(labels.looks.size(), 2U);
  EXPECT_FALSE(labels.looks[0].known);
  EXPECT_TRUE(labels.looks[1].known);
  EXPECT_THAT(labels.looks[1].base_colour, ElementsAre(0.5F, 0.25F, 0, 1));
}

TEST(Mtl, NamesStatementsThatHaveNoPlace) {
  unkept = {};
  look_of(
      "Kd 1 0 0\nKs 1 1 1\nNi 1.4\nmap_Ks a.png\nmap_Kd b.png\nKs 0 0 0\nillum 2\nNs 10\nd 1\nKe 0 "
      "0 0\n");
  EXPECT_THAT(unkept.kinds(),
              ElementsAre("'Ks' of materials", "'Ni' of materials", "'map_Ks' of materials"));
}

TEST(Mtl, ReadsOpacityAndShineInTheirSeveralWays) {
  EXPECT_EQ(look_of("d 0.25").base_colour[3], 0.25F);
  EXPECT_EQ(look_of("d 0.25").alpha, AlphaMode::kBlend);
  EXPECT_EQ(look_of("Tr 0.25").base_colour[3], 0.75F);
  EXPECT_EQ(look_of("d 1").alpha, AlphaMode::kOpaque);
  EXPECT_EQ(look_of("Ns 1000").roughness, 0);
  EXPECT_EQ(look_of("Ns 250").roughness, 0.5F);
  EXPECT_EQ(look_of("Pr 0.5\nNs 1000").roughness, 0.5F) << "said by itself";
  EXPECT_EQ(look_of("Pm 1").metallic, 1);
  EXPECT_THAT(look_of("Ke 2").emissive, ElementsAre(2, 2, 2));
}

TEST(Mtl, ReadsHowMetallicMaterialsOfBlenderAre) {
  PolygonLabels labels = named({"steel", "clay", "told"});
  const std::string text =
      "newmtl steel\nKa 0.5 0.5 0.5\nillum 3\nnewmtl clay\nKa 1 1 1\nillum 2\n"
      "newmtl told\nPm 0.25\nKa 1 1 1\nillum 3\n";
  const auto metallic = [&](const std::string& head) {
    labels.looks.clear();
    parse_mtl(head + text, "a.mtl", labels, unkept);
    return std::vector<float>{labels.looks[0].metallic, labels.looks[1].metallic,
                              labels.looks[2].metallic};
  };
  EXPECT_THAT(metallic("# Blender 3.4.1 MTL File: 'None'\n"), ElementsAre(0.5F, 0, 0.25F));
  EXPECT_THAT(metallic("# by hand\n"), ElementsAre(0, 0, 0.25F));
}

TEST(Mtl, FindsImagesBehindTheirOptions) {
  EXPECT_EQ(look_of("map_Kd wood grain.png").texture(TextureSlot::kBaseColour), "wood grain.png");
  EXPECT_EQ(look_of("map_Bump -bm 0.5 n.png").texture(TextureSlot::kNormal), "n.png");
  EXPECT_EQ(look_of("map_Kd -o 0 1 -clamp on -s 2 2 2 a.png").texture(TextureSlot::kBaseColour),
            "a.png");
}

TEST(Mtl, RefusesWhatIsNoNumber) {
  EXPECT_THAT(fault([] { look_of("Kd red"); }), HasSubstr("a.mtl:2:"));
  EXPECT_THAT(fault([] { look_of("d nan"); }), HasSubstr("not finite"));
}

TEST(Mtl, ComesBack) {
  PolygonLabels labels = named({"plain", "shiny #1"});
  labels.looks.resize(2);
  MaterialLook& look = labels.looks[1];
  look.known = true;
  look.base_colour = {0.1F, 0.2F, 0.3F, 0.5F};
  look.alpha = AlphaMode::kBlend;
  look.metallic = 1;
  look.roughness = 0.1F;
  look.emissive = {0, 0, 0.7F};
  look.texture(TextureSlot::kNormal) = "n.png";
  look.texture(TextureSlot::kMetallicRoughness) = "mr.png";
  ASSERT_TRUE(has_looks(labels));
  std::string text;
  append_mtl(labels, text);
  EXPECT_THAT(text, Not(HasSubstr("plain")));
  PolygonLabels read = named({"plain", "shiny _1"});
  parse_mtl(text, "a.mtl", read, unkept);
  ASSERT_EQ(read.looks.size(), 2U);
  EXPECT_EQ(read.looks[1], look);
}

}  // namespace
}  // namespace anicodec::tools
