// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/json_node.h"

#include "tools/io/base/mesh.h"
#include "tools/io/base/text_cursor.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

std::set<std::string> JsonReadings::missing(const nlohmann::json& document) const {
  std::set<std::string> kinds;
  find_missing(document, "", &kinds);
  return kinds;
}

void JsonReadings::find_missing(const nlohmann::json& value, const std::string& path,
                                std::set<std::string>* out) const {
  if (value.is_array()) {
    for (const nlohmann::json& element : value)
      find_missing(element, path, out);
  } else if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      const std::string place = path + "/" + shown(key);
      if (members_.contains(&member) || key == "extensions")
        find_missing(member, place, out);
      else
        out->insert(place);
    }
  }
}

void JsonNode::fail(const std::string& reason) const {
  fail_input(file_, (path_.empty() ? "the document" : path_) + ": " + reason);
}

std::optional<JsonNode> JsonNode::find(const char* key) const {
  if (!value_->is_object())
    fail("an object is expected");
  auto it = value_->find(key);
  if (it == value_->end())
    return std::nullopt;
  return child(*it, key);
}

JsonNode JsonNode::child(const nlohmann::json& value, const std::string& key) const {
  JsonNode node(value, file_, readings_);
  node.path_ = path_ + "/" + key;
  if (readings_)
    readings_->add(value);
  return node;
}

JsonNode JsonNode::member(const char* key) const {
  std::optional<JsonNode> node = find(key);
  if (!node)
    fail(std::string("'") + key + "' is missing");
  return *node;
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!value_->is_array())
    fail("an array is expected");
  std::vector<JsonNode> nodes;
  nodes.reserve(value_->size());
  for (size_t i = 0; i < value_->size(); ++i) {
    nodes.push_back(child((*value_)[i], std::to_string(i)));
  }
  return nodes;
}

std::vector<JsonNode> JsonNode::elements(const char* key) const {
  std::optional<JsonNode> node = find(key);
  return node ? node->elements() : std::vector<JsonNode>();
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!value_->is_object())
    fail("an object is expected");
  std::vector<std::pair<std::string, JsonNode>> nodes;
  for (const auto& [key, value] : value_->items()) {
    nodes.emplace_back(key, child(value, shown(key)));
  }
  return nodes;
}

double JsonNode::number() const {
  if (!value_->is_number())
    fail("a number is expected");
  return value_->get<double>();
}

uint64_t JsonNode::whole(uint64_t limit) const {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  double x = number();
  if (x < 0 || x != std::floor(x) || x > kExact || static_cast<uint64_t>(x) > limit)
    fail(shown(value_->dump()) + " is not a whole number from 0 to " + std::to_string(limit));
  return static_cast<uint64_t>(x);
}

uint32_t JsonNode::index(size_t count, const char* what) const {
  uint64_t i = whole(UINT32_MAX);
  if (i >= count)
    fail(std::to_string(i) + " is out of range; there are " + std::to_string(count) + " " + what);
  return static_cast<uint32_t>(i);
}

std::vector<double> JsonNode::numbers(size_t count) const {
  std::vector<double> out;
  for (const JsonNode& node : elements())
    out.push_back(node.number());
  if (out.size() != count)
    fail(std::to_string(out.size()) + " numbers; " + std::to_string(count) + " are expected");
  return out;
}

std::string JsonNode::text() const {
  if (!value_->is_string())
    fail("a text is expected");
  return value_->get<std::string>();
}

bool JsonNode::boolean() const {
  if (!value_->is_boolean())
    fail("true or false is expected");
  return value_->get<bool>();
}

}  // namespace anicodec::tools
