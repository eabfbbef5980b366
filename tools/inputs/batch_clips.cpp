// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/batch_clips.h"

#include "codec/sequence/error.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/package_hint.h"
#include "tools/io/base/printable.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/files/natural_order.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

bool stages_are_left = false;

/// Without the number at its end and the minus of one below zero.
std::string without_number(const std::string& stem) {
  std::string before = stem.substr(0, stem.find_last_not_of("0123456789") + 1);
  if (before.size() < stem.size() && before.ends_with('-') &&
      (before.size() == 1 || !std::isalnum(static_cast<unsigned char>(before[before.size() - 2]))))
    before.pop_back();
  return before;
}

using FramesOfClips = std::map<std::pair<std::string, const FileFormat*>, std::vector<std::string>>;

/// Joins names with decimals (sim.1.25) to those of their clip that have none (sim.1).
void join_fractions(FramesOfClips& frames) {
  for (auto group = frames.begin(); group != frames.end();) {
    const auto& [before, format] = group->first;
    const auto whole =
        before.ends_with('.')
            ? frames.find({without_number(before.substr(0, before.size() - 1)), format})
            : frames.end();
    if (whole == frames.end() || whole == group) {
      ++group;
      continue;
    }
    std::vector<std::string> all = whole->second;
    all.insert(all.end(), group->second.begin(), group->second.end());
    sort_naturally(all);
    whole->second = std::move(all);
    group = frames.erase(group);
  }
}

std::string joined(const fs::path& folder, const std::string& name) {
  return (folder / name).lexically_normal().generic_string();
}

/// Adds the clips of one folder, `relative` to the first.
void add_folder(const fs::path& folder, const fs::path& relative, std::vector<BatchClip>& clips) {
  std::vector<std::string> files, folders;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    (it->is_directory() ? folders : files).push_back(it->path().filename().string());
  if (error)
    throw Error(ErrorKind::kInput, folder.string() + ": " + error.message());
  for (std::vector<std::string>* names : {&files, &folders})
    sort_naturally(*names);

  std::set<std::string> cached;  // stems of caches, whose meshes are no clips
  FramesOfClips frames;
  for (const std::string& file : files) {
    const FileFormat* format = format_of(file);
    const std::string stem = fs::path(file).stem().string();
    if (is_cache(file))
      cached.insert(stem);
    if (is_cache(file) || is_whole_clip(file) || (is_stage(file) && !stages_are_left))
      clips.push_back({joined(relative, stem), {(folder / file).string()}});
    else if (format && without_number(stem) != stem)
      frames[{without_number(stem), format}].push_back(file);
  }
  join_fractions(frames);
  for (const auto& [group, names] : frames) {
    BatchClip clip;
    for (const std::string& name : names) {
      if (!cached.contains(fs::path(name).stem().string()))
        clip.inputs.push_back((folder / name).string());
    }
    if (clip.inputs.size() < 2)
      continue;
    std::string name = group.first.substr(0, group.first.find_last_not_of("_-. ") + 1);
    if (name.empty())
      name = folder.filename().string();
    clip.name = joined(relative, name);
    clips.push_back(std::move(clip));
  }
  for (const std::string& name : folders)
    add_folder(folder / name, relative / name, clips);
}

std::vector<BatchClip> clips_of_list(const std::string& path) {
  std::string text, line, input;
  read_file(path, text);
  if (text.find('\0') != std::string::npos)
    fail_input(path, "is no list of clips but a binary file; a list has a clip per line");
  std::vector<BatchClip> clips;
  for (std::istringstream lines(text); std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    if (line.empty() || line[0] == '#')
      continue;
    BatchClip clip;
    for (std::istringstream inputs(line); std::getline(inputs, input, '\t');)
      clip.inputs.push_back(input);
    fs::path first = clip.inputs[0];
    // A pattern has the name of its folder.
    if (first.stem().string().find_first_of("*?[") != std::string::npos && first.has_parent_path())
      first = first.parent_path();
    clip.name = first.stem().string();
    clips.push_back(std::move(clip));
  }
  return clips;
}

}  // namespace

void leave_stages_to_others() {
  stages_are_left = true;
}

std::vector<BatchClip> find_clips(const std::string& source) {
  std::vector<BatchClip> clips;
  if (fs::is_directory(source))
    add_folder(source, "", clips);
  else
    clips = clips_of_list(source);
  if (clips.empty())
    fail_input(source, "no clip is found in it");
  std::map<std::string, std::string> input_of;
  for (BatchClip& clip : clips) {
    clip.name = printable(clip.name);  // names a file, and a line of the list of what is done
    auto [other, is_new] = input_of.emplace(clip.name, clip.inputs[0]);
    if (!is_new)
      throw Error(ErrorKind::kUsage, clip.inputs[0] + ": would be written to " + clip.name +
                                         ".anic, and so would " + other->second);
  }
  return clips;
}

}  // namespace anicodec::tools
