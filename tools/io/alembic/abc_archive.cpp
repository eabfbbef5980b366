// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_archive.h"

#include "codec/sequence/error.h"
#include "tools/io/base/byte_order.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr size_t kHashesSize = 32;
constexpr size_t kMaxDepth = 1024;

AbcSchema schema_of(std::string_view metadata) {
  constexpr std::pair<std::string_view, AbcSchema> kSchemas[] = {
      {"AbcGeom_Xform_v", AbcSchema::kXform},
      {"AbcGeom_PolyMesh_v", AbcSchema::kPolyMesh},
      {"AbcGeom_SubD_v", AbcSchema::kSubD},
      {"AbcGeom_FaceSet_v", AbcSchema::kFaceSet}};
  const std::string_view schema = metadata_value(metadata, "schema");
  for (const auto& [prefix, kind] : kSchemas) {
    if (schema.starts_with(prefix))
      return kind;
  }
  return AbcSchema::kOther;
}

/// Takes bytes from the front.
class Bytes {
 public:
  Bytes(const OgawaFile& file, std::string place, std::string_view bytes)
      : file_(file), place_(std::move(place)), bytes_(bytes) {}

  bool at_end() const { return bytes_.empty(); }

  size_t left() const { return bytes_.size(); }

  std::string_view take(size_t size) {
    if (size > bytes_.size())
      file_.fail(place_, "the data is truncated");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  template <typename T>
  T number() {
    return load<T>(take(sizeof(T)).data(), std::endian::little);
  }

 private:
  const OgawaFile& file_;
  std::string place_;
  std::string_view bytes_;
};

std::vector<AbcTime> read_samplings(const OgawaFile& file, OgawaChild child) {
  const std::string place = "the time samplings";
  const std::string raw = file.read(file.data(child, place));
  Bytes bytes(file, place, raw);
  std::vector<AbcTime> samplings;
  while (!bytes.at_end()) {
    bytes.number<uint32_t>();  // most samples of a property
    const auto per_cycle = bytes.number<double>();
    const auto count = bytes.number<uint32_t>();
    if (count > bytes.left() / sizeof(double))
      file.fail(place, "the data is truncated");
    std::vector<double> stored(count);
    for (double& t : stored)
      t = bytes.number<double>();
    const std::string fault = AbcTime::fault(per_cycle, stored);
    if (!fault.empty())
      file.fail("time sampling " + std::to_string(samplings.size()), fault);
    samplings.emplace_back(per_cycle, std::move(stored));
  }
  return samplings;
}

}  // namespace

AbcArchive::AbcArchive(const ByteSource& source) : file(source) {
  constexpr size_t kTop = 2, kSamplings = 4, kParts = 6;
  const std::string place = "the archive";
  const std::vector<OgawaChild> root = file.group(file.root(), place);
  if (root.size() < kParts)
    file.fail(place,
              "has " + std::to_string(root.size()) + " parts, not " + std::to_string(kParts));
  const std::string version = file.read(file.data(root[0], place));
  if (version != std::string_view("\0\0\0\0", 4))
    throw Error(ErrorKind::kUnsupported,
                file.name() + ": is an Alembic archive of an unknown version");
  read_metadata(root);
  samplings = read_samplings(file, root[kSamplings]);
  read_objects(root[kTop]);
}

void AbcArchive::read_metadata(const std::vector<OgawaChild>& root) {
  metadata = file.read(file.data(root[3], "the archive's metadata"));
  const std::string place = "the shared metadata";
  const std::string raw = file.read(file.data(root[5], place));
  Bytes bytes(file, place, raw);
  shared_metadata_.emplace_back();
  while (!bytes.at_end())
    shared_metadata_.emplace_back(bytes.take(bytes.number<uint8_t>()));
}

void AbcArchive::read_objects(OgawaChild top) {
  add_object(kAbcNone, "", "");
  std::vector<OgawaChild> groups{top};  // of each object
  std::vector<size_t> depths{0};
  for (uint32_t o = 0; o < objects.size(); ++o) {
    const std::vector<OgawaChild> group = file.group(groups[o], objects[o].path);
    if (group.empty())
      continue;
    if (depths[o] > kMaxDepth)
      file.fail(objects[o].path, "the objects are nested too deeply");
    objects[o].properties = group[0];
    read_children(o, group, groups);
    depths.resize(objects.size(), depths[o] + 1);
  }
  for (uint32_t o = 0; o < objects.size(); ++o)
    by_path_.emplace(objects[o].path, o);
  for (AbcObject& object : objects) {
    if (metadata_value(object.metadata, "isInstance") != "1")
      continue;
    const AbcCompound compound = properties(object);
    const AbcProperty* source = compound.find(".instanceSource");
    if (source == nullptr)
      file.fail(object.path, "is an instance of nothing");
    object.instance_source = AbcSamples(file, *source).text(0);
  }
}

void AbcArchive::read_children(uint32_t parent, const std::vector<OgawaChild>& group,
                               std::vector<OgawaChild>& groups) {
  const std::string path = objects[parent].path;
  if (group.size() < 2 || !is_data(group.back()))
    return;
  const std::string raw = file.read(file.data(group.back(), path));
  if (raw.size() <= kHashesSize)
    return;
  Bytes bytes(file, path, std::string_view(raw).substr(0, raw.size() - kHashesSize));
  size_t child = 1;
  while (!bytes.at_end()) {
    std::string name(bytes.take(bytes.number<uint32_t>()));
    const auto index = bytes.number<uint8_t>();
    std::string text;
    if (index == kInlineMetadata)
      text = bytes.take(bytes.number<uint32_t>());
    else if (index < shared_metadata_.size())
      text = shared_metadata_[index];
    else
      file.fail(path, "metadata " + std::to_string(index) + " of " +
                          std::to_string(shared_metadata_.size()) + " is not there");
    if (child + 1 >= group.size())
      file.fail(path, "has headers of more children than the " + std::to_string(group.size() - 2) +
                          " of its group");
    if (objects.size() > file.size() / 16)
      file.fail(path, "the file is too small for its objects");
    add_object(parent, std::move(name), std::move(text));
    groups.push_back(group[child++]);
  }
}

void AbcArchive::add_object(uint32_t parent, std::string name, std::string text) {
  AbcObject object;
  object.parent = parent;
  object.path = parent == kAbcNone ? "/" : objects[parent].path;
  if (object.path.size() > 1)
    object.path += '/';
  object.path += name;
  if (object.path.size() > kAbcMaxPath)
    file.fail(object.path, "the path is longer than " + std::to_string(kAbcMaxPath) + " bytes");
  object.name = std::move(name);
  object.schema = schema_of(text);
  object.metadata = std::move(text);
  if (parent != kAbcNone)
    objects[parent].children.push_back(static_cast<uint32_t>(objects.size()));
  objects.push_back(std::move(object));
}

AbcCompound AbcArchive::properties(const AbcObject& object) const {
  return read_compound(file, object.properties, object.path, shared_metadata_);
}

AbcCompound AbcArchive::properties(const AbcProperty& compound) const {
  if (compound.shape != AbcShape::kCompound)
    file.fail(compound.place(), "samples stand where a compound is expected");
  return read_compound(file, compound.child, compound.place(), shared_metadata_);
}

const AbcTime& AbcArchive::time_of(const AbcProperty& property) const {
  if (property.sampling >= samplings.size())
    file.fail(property.place(), "time sampling " + std::to_string(property.sampling) + " of " +
                                    std::to_string(samplings.size()) + " is not there");
  const AbcTime& time = samplings[property.sampling];
  if (property.samples > time.max_samples())
    file.fail(property.place(), std::to_string(property.samples) + " samples have " +
                                    std::to_string(time.max_samples()) + " times");
  return time;
}

uint32_t AbcArchive::sample_at(const AbcSamples& samples, double time) const {
  const AbcProperty& property = samples.property();
  return property.is_constant() ? 0 : time_of(property).sample_at(time, property.samples);
}

uint32_t AbcArchive::find(std::string_view path) const {
  while (path.size() > 1 && path.back() == '/')
    path.remove_suffix(1);
  const auto found = by_path_.find(path);
  return found == by_path_.end() ? kAbcNone : found->second;
}

}  // namespace anicodec::tools
