// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/metadata_json.h"

#include "codec/sequence/error.h"
#include "format/metadata.h"

#include <map>
#include <string_view>

#include <nlohmann/json.hpp>

namespace anicodec {

String checked_metadata(const std::string& json) {
  if (const ByteView view(reinterpret_cast<const uint8_t*>(json.data()), json.size());
      nesting(view) > kMaxMetadataNesting)
    throw Error(ErrorKind::kUsage,
                "the metadata nests deeper than " + std::to_string(kMaxMetadataNesting));
  const auto parsed = nlohmann::ordered_json::parse(json, nullptr, false);
  if (!parsed.is_object())
    throw Error(ErrorKind::kUsage, "the metadata is not a JSON object in UTF-8");
  const std::string text = parsed.dump();
  if (text.size() > kMaxMetadataBytes)
    throw Error(ErrorKind::kUsage, "the metadata takes " + std::to_string(text.size()) +
                                       " bytes; at most " + std::to_string(kMaxMetadataBytes) +
                                       " are possible");
  return String(text.begin(), text.end());
}

std::string with_fields(const std::string& json, const std::vector<const Attribute*>& attributes) {
  const auto is_whole = [](const Attribute& a) {
    return a.bound && a.bound->measure == AttributeBound::Measure::kExact;
  };
  nlohmann::ordered_json fields = nlohmann::ordered_json::object();
  std::map<std::string_view, const Attribute*> firsts;  // by name
  for (const Attribute* a : attributes) {
    const bool says_something = !a->unit.empty() || is_whole(*a);
    if (says_something && a->name.empty())
      throw Error(ErrorKind::kUsage,
                  "an attribute without a name has neither a unit nor exact values");
    const auto [first, is_new] = firsts.try_emplace(a->name, a);
    if (first->second->unit != a->unit || is_whole(*first->second) != is_whole(*a))
      throw Error(ErrorKind::kUsage,
                  "attributes " + a->name + " differ in their units, or not all are exact");
    if (!says_something || !is_new)
      continue;
    nlohmann::ordered_json field = nlohmann::ordered_json::object();
    if (!a->unit.empty())
      field["unit"] = a->unit;
    if (is_whole(*a))
      field["whole"] = true;
    // Names are new, and a search among all before them would take a square of their number.
    fields.get_ref<nlohmann::ordered_json::object_t&>().emplace_back(a->name, std::move(field));
  }
  if (fields.empty())
    return json;
  auto metadata = json.empty() ? nlohmann::ordered_json::object()
                               : nlohmann::ordered_json::parse(json, nullptr, false);
  if (!metadata.is_object())
    return json;  // which checked_metadata() refuses
  nlohmann::ordered_json& all = metadata["fields"];
  if (!all.is_null() && !all.is_object())
    throw Error(ErrorKind::kUsage, "\"fields\" of the metadata is no object");
  if (all.empty())
    all = std::move(fields);
  else
    all.update(fields);
  return metadata.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace anicodec
