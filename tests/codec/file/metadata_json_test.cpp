// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/metadata_json.h"

#include "codec/sequence/error.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Attribute named(const std::string& name, const std::string& unit, bool exact = false) {
  Attribute attribute{
      .kind = AttributeKind::kCustom, .name = name, .components = 1, .values = {}, .unit = unit};
  if (exact)
    attribute.bound = {AttributeBound::Measure::kExact};
  return attribute;
}

TEST(MetadataJson, SayWhatNumbersMean) {
  const Attribute heat = named("heat", "K"), phase = named("phase", "", true),
                  plain = named("plain", "");
  EXPECT_EQ(with_fields("", {&heat, &phase, &plain}),
            R"({"fields":{"heat":{"unit":"K"},"phase":{"whole":true}}})");
  EXPECT_EQ(with_fields(R"({"author":"A","fields":{"speed":{"unit":"m/s"}}})", {&heat}),
            R"({"author":"A","fields":{"speed":{"unit":"m/s"},"heat":{"unit":"K"}}})");
  EXPECT_EQ(with_fields("", {&plain}), "");
  EXPECT_EQ(with_fields("[]", {&heat}), "[]");
}

TEST(MetadataJson, RefuseFieldsThatContradict) {
  const Attribute kelvin = named("heat", "K"), celsius = named("heat", "C"),
                  nameless = named("", "K");
  EXPECT_NO_THROW(with_fields("", {&kelvin, &kelvin}));
  EXPECT_THROW(with_fields("", {&kelvin, &celsius}), Error);
  EXPECT_THROW(with_fields("", {&nameless}), Error);
  EXPECT_THROW(with_fields(R"({"fields":3})", {&kelvin}), Error);
}

TEST(MetadataJson, TakesTimeInProportionToTheFields) {
  std::vector<Attribute> attributes;
  for (int i = 0; i < 200000; ++i)
    attributes.push_back(named(std::to_string(i), "K"));
  std::vector<const Attribute*> all;
  for (int twice = 0; twice < 2; ++twice) {
    for (const Attribute& attribute : attributes)
      all.push_back(&attribute);
  }
  const std::string text = with_fields("", all);  // each with each would take minutes
  EXPECT_EQ(text.find(R"({"fields":{"0":{"unit":"K"},"1":{"unit":"K"},)"), 0U);
  EXPECT_EQ(text.find(R"("199999":{"unit":"K"}}})"), text.size() - 23);
}

TEST(MetadataJson, IsCheckedAndShortened) {
  const String text = checked_metadata(R"( { "a" : 1 } )");
  EXPECT_EQ(std::string(text.begin(), text.end()), R"({"a":1})");
  EXPECT_THROW(checked_metadata("[]"), Error);
}

}  // namespace
}  // namespace anicodec
