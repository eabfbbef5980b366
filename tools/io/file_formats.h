// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FILE_FORMATS_H_
#define ANICODEC_TOOLS_IO_FILE_FORMATS_H_

#include "tools/io/base/file_format.h"

#include <span>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// All formats that are read or written, in the order in which texts name them.
std::span<const FileFormat* const> file_formats();

/// The format by extension, in any case of letters; null for others.
const FileFormat* format_of(const std::string& path);

/// The format of bytes of the standard input by the mark that stands first, else the first of the table.
const FileFormat& format_of_bytes(std::string_view bytes);

/// Extensions of the formats that a predicate holds for: ".obj, .ply and .off". Formats of several are named as
/// "scenes of assimp".
std::string list_formats(bool (*is_meant)(const FileFormat& format),
                         std::string_view last = " and ");

/// Files that a clip can be written to, for the help of an option: "x.pc2, ..., dir/frame_%04d.obj|ply".
std::string output_names();

/// Files that one mesh can be written to: "x.obj, x.ply".
std::string mesh_names();

bool is_cache(const std::string& path);

/// True for scenes, which can be sampled at any rate.
bool is_scene(const std::string& path);

/// True for files of which one is a whole clip: scenes, and archives of frames with their meshes.
bool is_whole_clip(const std::string& path);

/// True for scenes that can carry an encoded clip.
bool carries_clip(const std::string& path);

/// True for those that are written, too.
bool is_scene_output(const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FILE_FORMATS_H_
