// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_SCENE_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_SCENE_H_

#include "tools/io/alembic/abc_archive.h"
#include "tools/io/alembic/abc_xform.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Told, once each, what of a file is left out and why.
using AbcNote = std::function<void(const std::string& text)>;

/// A place of the scene where an object stands: its own, or one that an instance gives it.
struct AbcNode {
  uint32_t object = 0;
  uint32_t parent = kAbcNone;  ///< node
  std::string path;
  std::string instance_of;  ///< path of the object, empty at its own place
};

/// The transform of a node at a time.
struct AbcPlace {
  AbcTransform world;
  bool visible = true;
};

/// The hierarchy with its instances in place, and how it moves.
class AbcScene {
 public:
  /// Instances of what is not there or of their own ancestors are left out with a note. Throws
  /// Error(kInput) beyond a million nodes. The archive must outlive the scene.
  AbcScene(const AbcArchive& archive, const AbcNote& note);

  const std::vector<AbcNode>& nodes() const { return nodes_; }

  const AbcObject& object(const AbcNode& node) const { return archive_.objects[node.object]; }

  /// All nodes at a time: the last samples that are not after it.
  std::vector<AbcPlace> at(double time);

  /// One node at a time. Cost: its ancestors.
  AbcPlace at(uint32_t node, double time);

  /// Properties that move or show some nodes or their ancestors.
  std::vector<const AbcProperty*> timed(const std::vector<uint32_t>& nodes) const;

 private:
  struct Motion;

  void add(uint32_t object, uint32_t parent, bool in_instance, const AbcNote& note);
  AbcPlace below(const AbcPlace* parent, uint32_t node, double time);
  bool is_open(uint32_t object, uint32_t node) const;

  const AbcArchive& archive_;
  std::vector<AbcNode> nodes_;
  std::vector<std::shared_ptr<Motion>> motions_;  ///< of each object
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_SCENE_H_
