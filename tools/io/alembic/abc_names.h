// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_NAMES_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_NAMES_H_

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Names of objects or properties beside one another.
class AbcNames {
 public:
  /// A name fit for an archive, without slashes and control characters, and not empty; with a
  /// number behind it where it is taken.
  std::string unique(std::string_view name);

 private:
  std::set<std::string> taken_;
  std::map<std::string, uint64_t> next_;  ///< number behind a name that is taken
};

/// The steps of the path of a mesh: of "/rig/body" the two, of a plain "body" the names of an
/// Xform and of the mesh below it.
std::vector<std::string> path_steps(std::string_view name);

/// A text fit for a value in metadata, where semicolons and equal signs mean something.
std::string metadata_text(std::string_view text);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_NAMES_H_
