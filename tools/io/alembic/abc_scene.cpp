// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_scene.h"

namespace anicodec::tools {
namespace {

constexpr size_t kMaxNodes = size_t{1} << 20;
}  // namespace

struct AbcScene::Motion {
  Motion(const AbcArchive& archive, const AbcObject& object)
      : visible(archive, archive.properties(object), "visible", -1) {
    if (object.schema == AbcSchema::kXform)
      xform.emplace(archive, object);
  }

  std::optional<AbcXform> xform;
  AbcFlag visible;  ///< 1 shown, 0 hidden, -1 as the parent
};

AbcScene::AbcScene(const AbcArchive& archive, const AbcNote& note)
    : archive_(archive), motions_(archive.objects.size()) {
  nodes_.push_back({.path = "/", .instance_of = {}});
  for (uint32_t n = 0; n < nodes_.size(); ++n) {
    const uint32_t object = nodes_[n].object;
    if (!motions_[object])
      motions_[object] = std::make_shared<Motion>(archive, archive.objects[object]);
    for (uint32_t child : archive.objects[object].children)
      add(child, n, !nodes_[n].instance_of.empty(), note);
  }
}

/// Whether the node or one of its ancestors is a place of the object.
bool AbcScene::is_open(uint32_t object, uint32_t node) const {
  for (uint32_t n = node; n != kAbcNone; n = nodes_[n].parent) {
    if (nodes_[n].object == object)
      return true;
  }
  return false;
}

void AbcScene::add(uint32_t object, uint32_t parent, bool in_instance, const AbcNote& note) {
  const std::string& name = archive_.objects[object].name;
  AbcNode node{.object = object, .parent = parent, .path = nodes_[parent].path, .instance_of = {}};
  if (node.path.size() > 1)
    node.path += '/';
  node.path += name;
  // An instance may stand for another one.
  size_t steps = 0;
  while (!archive_.objects[node.object].instance_source.empty()) {
    const std::string& source = archive_.objects[node.object].instance_source;
    const uint32_t found = archive_.find(source);
    if (found == kAbcNone || ++steps > archive_.objects.size() || is_open(found, parent)) {
      note(node.path + ": is an instance of " + source +
           (found == kAbcNone ? ", which is not there, and left out"
                              : ", which contains it, and left out"));
      return;
    }
    node.object = found;
    in_instance = true;
  }
  if (in_instance)
    node.instance_of = archive_.objects[node.object].path;
  if (nodes_.size() >= kMaxNodes)
    archive_.file.fail(node.path, "the instances make more than a million objects");
  if (node.path.size() > kAbcMaxPath)
    archive_.file.fail(node.path, "the path is longer than 4096 bytes");
  nodes_.push_back(std::move(node));
}

/// A node by the place of its parent, null for the root.
AbcPlace AbcScene::below(const AbcPlace* parent, uint32_t node, double time) {
  Motion& motion = *motions_[nodes_[node].object];
  AbcPlace place;
  place.world = parent ? parent->world : identity_transform();
  if (motion.xform)
    place.world = motion.xform->inherits(time) ? after(place.world, motion.xform->at(time))
                                               : motion.xform->at(time);
  const int visible = motion.visible.at(time);
  place.visible = visible < 0 ? parent == nullptr || parent->visible : visible != 0;
  return place;
}

std::vector<AbcPlace> AbcScene::at(double time) {
  std::vector<AbcPlace> places(nodes_.size());
  for (uint32_t n = 0; n < nodes_.size(); ++n) {
    const uint32_t parent = nodes_[n].parent;
    places[n] = below(parent == kAbcNone ? nullptr : &places[parent], n, time);
  }
  return places;
}

AbcPlace AbcScene::at(uint32_t node, double time) {
  std::vector<uint32_t> ancestors;
  for (uint32_t n = node; n != kAbcNone; n = nodes_[n].parent)
    ancestors.push_back(n);
  AbcPlace place = below(nullptr, ancestors.back(), time);
  for (size_t i = ancestors.size() - 1; i-- > 0;)
    place = below(&place, ancestors[i], time);
  return place;
}

std::vector<const AbcProperty*> AbcScene::timed(const std::vector<uint32_t>& nodes) const {
  std::vector<bool> seen(nodes_.size());
  std::vector<const AbcProperty*> out;
  for (uint32_t node : nodes) {
    for (uint32_t n = node; n != kAbcNone && !seen[n]; n = nodes_[n].parent) {
      seen[n] = true;
      const Motion& motion = *motions_[nodes_[n].object];
      if (motion.visible.timed())
        out.push_back(motion.visible.timed());
      if (motion.xform) {
        const std::vector<const AbcProperty*> own = motion.xform->timed();
        out.insert(out.end(), own.begin(), own.end());
      }
    }
  }
  return out;
}

}  // namespace anicodec::tools
