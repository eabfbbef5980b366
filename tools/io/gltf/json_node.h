// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_JSON_NODE_H_
#define ANICODEC_TOOLS_IO_GLTF_JSON_NODE_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace anicodec::tools {

/// The members of a document that were read.
class JsonReadings {
 public:
  void add(const nlohmann::json& member) { members_.insert(&member); }

  /// Kinds of the other members, but for those within them: as "/nodes/extras", without numbers in arrays. Each
  /// extension is one.
  std::set<std::string> missing(const nlohmann::json& document) const;

 private:
  void find_missing(const nlohmann::json& value, const std::string& path,
                    std::set<std::string>* out) const;

  std::unordered_set<const nlohmann::json*> members_;
};

/// A value of a JSON document together with where it stands, so that every fault names its JSON
/// pointer (RFC 6901): Error(kInput) "file: /accessors/3/count: reason". The document must outlive
/// the node.
class JsonNode {
 public:
  /// `readings`, where given, is told of all members that are asked for, and outlives the node.
  JsonNode(const nlohmann::json& value, std::string_view file, JsonReadings* readings = nullptr)
      : value_(&value), file_(file), readings_(readings) {}

  const std::string& path() const { return path_; }

  /// Member of an object; throws where it is missing.
  JsonNode member(const char* key) const;

  /// The same, nothing where it is missing.
  std::optional<JsonNode> find(const char* key) const;

  /// Elements of an array.
  std::vector<JsonNode> elements() const;

  /// Elements of the array under a key, none where it is missing.
  std::vector<JsonNode> elements(const char* key) const;

  /// Members of an object, in the order of their names.
  std::vector<std::pair<std::string, JsonNode>> members() const;

  /// A whole number from 0 to limit (inclusive).
  uint64_t whole(uint64_t limit) const;

  /// An index of one of `count` things; `what` names them in the message.
  uint32_t index(size_t count, const char* what) const;

  double number() const;

  /// `count` numbers.
  std::vector<double> numbers(size_t count) const;

  std::string text() const;

  bool boolean() const;

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  /// A value within this one.
  JsonNode child(const nlohmann::json& value, const std::string& key) const;

  const nlohmann::json* value_;
  std::string_view file_;
  JsonReadings* readings_;
  std::string path_;
};

/// Text of a member; empty where there is none.
inline std::string text_or_empty(const JsonNode& node, const char* key) {
  const std::optional<JsonNode> found = node.find(key);
  return found ? found->text() : std::string();
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_JSON_NODE_H_
