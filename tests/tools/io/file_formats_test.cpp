// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/file_formats.h"

#include "tests/tools/command_testing.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

std::string text_of_page(const std::string& path) {
  std::ifstream in(ANICODEC_SOURCE_DIR "/" + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> extensions_of(const FileFormat& format) {
  std::istringstream words{std::string(format.extensions)};
  return {std::istream_iterator<std::string>(words), {}};
}

/// Cells of the table of a page that begins so.
std::vector<std::vector<std::string>> table_of(const std::string& text, const std::string& head) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text.substr(std::min(text.find(head), text.size())));
  for (std::string line, cell; std::getline(lines, line) && line.starts_with('|');) {
    std::istringstream cells(line.substr(1));
    for (rows.emplace_back(); std::getline(cells, cell, '|');) {
      const size_t begin = std::min(cell.find_first_not_of(' '), cell.size());
      rows.back().push_back(cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin));
    }
  }
  return rows;
}

/// The formats that a text names.
std::vector<const FileFormat*> named_in(const std::string& text) {
  std::vector<const FileFormat*> formats;
  for (const FileFormat* format : file_formats()) {
    if (std::regex_search(text, std::regex("\\b" + std::string(format->name) + "\\b")))
      formats.push_back(format);
  }
  return formats;
}

TEST(FileFormats, AreFoundByTheirExtensions) {
  for (const FileFormat* format : file_formats()) {
    for (const std::string& extension : extensions_of(*format)) {
      EXPECT_EQ(format_of("folder.x/a" + extension), format);
      EXPECT_EQ(format_of("A.1" + extension), format);
    }
  }
  EXPECT_EQ(format_of("A.GlB")->name, "GLB");
  for (const char* other : {"", "obj", "a", "a.", "a.ob", "a.objx", ".obj", "a. ", "a.obj/b", "-"})
    EXPECT_EQ(format_of(other), nullptr) << other;
}

TEST(FileFormats, AreFoundByTheirMarks) {
  const std::map<std::string, std::string> kFormats = {{"ply\ncomment OFF", "PLY"},
                                                       {"STCN4OFF\n", "OFF"},
                                                       {" \n{\"OFF\": 1}", "glTF"},
                                                       {"glTF\2", "GLB"},
                                                       {"Ogawa\xff", "Alembic"},
                                                       {"v 0 0 0\n", "OBJ"},
                                                       {"", "OBJ"},
                                                       {"# of a kind and OFF\n", "OBJ"}};
  for (const auto& [bytes, name] : kFormats)
    EXPECT_EQ(format_of_bytes(bytes).name, name) << bytes;
}

TEST(FileFormats, DoWhatTheirRolesWant) {
  for (const FileFormat* format : file_formats()) {
    SCOPED_TRACE(format->name);
    EXPECT_EQ(format->mesh_parser != nullptr, format->role == FileRole::kMesh);
    EXPECT_EQ(format->open_cache != nullptr, format->role == FileRole::kCache);
    EXPECT_EQ(format->read_clip != nullptr,
              format->role == FileRole::kScene || format->role == FileRole::kArchive);
    EXPECT_FALSE(format->frame_writer && format->write_clip);
    if (format->is_written() || format->role != FileRole::kScene) {
      EXPECT_THAT(std::string(format->extensions), testing::Not(HasSubstr(" ")));
    }
  }
}

TEST(FileFormats, AreListed) {
  EXPECT_EQ(list_formats([](const FileFormat& f) { return f.role == FileRole::kCache; }, " or "),
            ".pc2 or .mdd");
  EXPECT_EQ(list_formats([](const FileFormat& f) { return f.is_soup; }), ".stl");
  EXPECT_THAT(list_formats([](const FileFormat& f) { return !f.is_written(); }),
              HasSubstr(", .md3 and scenes of assimp"));
  EXPECT_THAT(output_names(), HasSubstr("x.glb, x.abc, dir/frame_%04d.obj|ply"));
  EXPECT_THAT(mesh_names(), HasSubstr("x.obj, x.ply"));
}

TEST(FileFormats, StandInTheTableOfTheReadme) {
  std::multiset<const FileFormat*> seen;
  for (const std::vector<std::string>& row :
       table_of(text_of_page("README.md"), "| format | in | out |")) {
    const std::vector<const FileFormat*> formats = named_in(row.at(0));
    std::string written;
    for (const FileFormat* format : formats) {
      seen.insert(format);
      EXPECT_EQ(row[1], "yes") << row[0];
      EXPECT_EQ(format->frame_writer != nullptr, row[0].ends_with("a file per frame")) << row[0];
      if (format->is_written())
        written += (written.empty() ? "" : ", ") + std::string(format->name);
    }
    if (formats.empty())
      continue;
    EXPECT_EQ(row[2], written.empty()                             ? "no"
                      : named_in(written).size() < formats.size() ? written
                                                                  : "yes")
        << row[0];
    EXPECT_FALSE(row.at(3).empty()) << row[0] << ": what survives?";
    EXPECT_EQ(row.at(4).empty(), written.empty()) << row[0];
  }
  for (const FileFormat* format : file_formats())
    EXPECT_EQ(seen.count(format), 1) << format->name << " has a row of its own";
}

TEST(FileFormats, StandInTheTableOfTheRoom) {
  std::vector<const FileFormat*> missing(file_formats().begin(), file_formats().end());
  for (const std::vector<std::string>& row :
       table_of(text_of_page("tools/io/README.md"), "| format | read | timing |")) {
    for (const FileFormat* format : named_in(row.at(0)))
      std::erase(missing, format);
  }
  for (const FileFormat* format : missing)
    ADD_FAILURE() << format->name << " has no row";
}

TEST(FileFormats, StandInTheHelp) {
  const std::string encode = anicodec({"encode", "--help"}).out;
  const std::string decode = anicodec({"decode", "--help"}).out;
  for (const FileFormat* format : file_formats()) {
    EXPECT_THAT(encode,
                HasSubstr(std::string(extensions_of(*format).size() == 1 ? format->extensions
                                                                         : format->name)));
    if (format->is_written()) {
      const std::string extension(format->extensions.substr(1));
      EXPECT_TRUE(std::regex_search(decode, std::regex("--format [a-z0-9|]*\\b" + extension)))
          << extension;
    }
  }
}

TEST(FileFormats, StandInThePackageOfPython) {
  const std::string text = text_of_page("bindings/python/anicodec/_usd_batch.py");
  const std::string line = text.substr(text.find("_OTHERS = ("));
  for (const FileFormat* format : file_formats()) {
    for (const std::string& extension : extensions_of(*format))
      EXPECT_THAT(line.substr(0, line.find(')')), HasSubstr('"' + extension + '"'));
  }
}

}  // namespace
}  // namespace anicodec::tools
