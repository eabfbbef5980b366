// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_MTL_H_
#define ANICODEC_TOOLS_IO_FORMATS_MTL_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/base/left_kinds.h"

#include <string>
#include <string_view>

namespace anicodec::tools {

/// Reads a library of materials that an OBJ names, and puts the looks of those in `materials` there, by
/// their names: colours (Kd, Ke), opacity (d, Tr), shine (Ns, Pr, Pm) and their images. All else is
/// skipped, as programs do, and added to what is left out. Throws Error(kInput) "name:line: reason" for what is no number.
void parse_mtl(std::string_view text, std::string_view name, PolygonLabels& materials,
               LeftKinds& left_out);

/// Whether append_mtl() has anything to write.
bool has_looks(const PolygonLabels& materials);

/// Appends the library of the materials whose looks are known.
void append_mtl(const PolygonLabels& materials, std::string& out);

/// A name as it can stand in an OBJ and in its library.
std::string statement_name(const std::string& name);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_MTL_H_
