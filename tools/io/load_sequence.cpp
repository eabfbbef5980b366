// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/load_sequence.h"

#include "codec/sequence/clip_library.h"
#include "codec/sequence/error.h"
#include "codec/sequence/position_box.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/base/frame_changes.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/package_hint.h"
#include "tools/io/base/printable.h"
#include "tools/io/base/signed_axes.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/files/natural_order.h"
#include "tools/io/files/staging.h"
#include "tools/io/formats/cache_record.h"
#include "tools/io/formats/mtl.h"
#include "tools/io/formats/vertex_cache.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glob.h>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_usage(const std::string& text) {
  throw Error(ErrorKind::kUsage, text);
}

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

std::vector<std::string> matches(const std::string& pattern) {
  glob_t found = {};
  int result = ::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found);
  std::vector<std::string> paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (result == GLOB_NOMATCH)
    throw Error(ErrorKind::kInput, pattern + ": no file matches");
  if (result != 0)
    throw Error(ErrorKind::kInput, pattern + ": the folder cannot be read");
  sort_naturally(paths);
  return paths;
}

/// Finishes what killed runs have left beside these files. Throws when one of them was to be replaced together with
/// others, and this run may not finish that.
void check_complete(std::span<const std::string> paths) {
  std::set<fs::path> folders, pending;
  for (const std::string& path : paths) {
    const fs::path folder = fs::path(path).parent_path();
    if (!folders.insert(folder).second)
      continue;
    for (const std::string& name : recover_folder(folder.string()))
      pending.insert(folder / name);
  }
  for (const std::string& path : paths) {
    if (pending.contains(path))
      fail_input(path,
                 "was to be replaced together with other files by a run that was killed; write "
                 "there or repeat that run to finish it");
  }
}

/// Files behind the inputs. A name that exists is never a pattern.
std::vector<std::string> expand(std::span<const std::string> inputs) {
  std::vector<std::string> paths;
  check_complete(inputs);  // a pattern matches all files then
  for (const std::string& input : inputs) {
    if (input.find_first_of("*?[") != std::string::npos && !exists(input)) {
      std::vector<std::string> found = matches(input);
      paths.insert(paths.end(), found.begin(), found.end());
    } else {
      paths.push_back(input);
    }
  }
  check_complete(paths);
  for (const std::string& path : paths) {
    std::error_code error;
    if (fs::is_directory(path, error))
      fail_input(path, "is a directory; name its frames with a pattern such as '" +
                           (fs::path(path) / "*.obj").string() + "'");
    if (!format_of(path))
      fail_input(path, "is of unknown kind; " +
                           list_formats([](const FileFormat&) { return true; }) + " are read" +
                           package_hint(path));
  }
  return paths;
}

/// Whether meshes of a format have vertices, which vertex caches move.
bool has_vertices(const FileFormat& format) {
  return format.mesh_parser && !format.is_soup;
}

[[noreturn]] void fail_without_vertices(const std::string& path) {
  fail_input(path, "is not an " + list_formats(has_vertices, " or ") + " mesh");
}

/// Parses one mesh after the other, all of one format, with the same memory.
class MeshReader {
 public:
  /// `path`: of any of them.
  MeshReader(const std::string& path, const LoadOptions& options) {
    const FileFormat* format = format_of(path);
    if (!format || !format->mesh_parser)
      fail_without_vertices(path);
    parse_ = format->mesh_parser(options);
    mesh_.origin = origin_of(options);
  }

  const LocalOrigin& origin() const { return mesh_.origin; }

  /// `details`, where given, receives what stands beside the positions.
  const Mesh& read(const std::string& path, MeshDetails* details = nullptr) {
    read_file(path, bytes_);
    libraries_.clear();
    parse_(bytes_, path, mesh_, details, &libraries_);
    return mesh_;
  }

  /// Notes what meshes that were read with their details have and these do not.
  void note_left_out(const std::string& path, const LoadOptions& options) const {
    if (const std::string text = mesh_.left_out.text(); options.note && !text.empty())
      options.note(path + ": left out: " + text);
  }

  /// The libraries of materials that the mesh read last names.
  const std::vector<std::string>& libraries() const { return libraries_; }

  /// The bytes of the file that was read last.
  std::string_view text() const { return bytes_; }

  /// Takes the looks of materials from the libraries that the mesh at `path`, read last, names. A
  /// library that cannot be had is noted: it is no reason to refuse the clip.
  void read_looks(const std::string& path, const LoadOptions& options, PolygonLabels& materials) {
    for (const std::string& library : libraries_) {
      const fs::path relative = fs::path(library).lexically_normal();
      const std::string file = (fs::path(path).parent_path() / relative).string();
      try {
        if (!options.allow_outside &&
            (relative.is_absolute() || (!relative.empty() && *relative.begin() == "..")))
          fail_input(file, "is outside the folder of " + path + "; --allow-outside reads it");
        std::string text;
        read_file(file, text);
        parse_mtl(text, file, materials, mesh_.left_out);
      } catch (const Error& e) {
        if (options.note)
          options.note("materials keep their names alone: " + std::string(e.what()));
      }
    }
  }

 private:
  MeshParser parse_;
  std::string bytes_;
  Mesh mesh_;
  std::vector<std::string> libraries_;
};

/// Tells what changes beside the positions of frames and is not kept.
class ChangesOfFrames {
 public:
  explicit ChangesOfFrames(const LoadOptions& options) : options_(options), changes_(options.note) {
    options_.note = {};
  }

  /// The frame that the others are compared with has been read.
  void begin(const MeshReader& reader) { libraries_ = reader.libraries(); }

  /// The frame at `path`, read last, with its details.
  void compare(MeshReader& reader, const std::string& path, const MeshDetails& first,
               MeshDetails& now) {
    if (reader.libraries() != libraries_ && first.materials.names == now.materials.names)
      reader.read_looks(path, options_, now.materials);
    changes_.compare(first, now, path);
  }

 private:
  LoadOptions options_;  ///< notes nothing
  FrameChanges changes_;
  std::vector<std::string> libraries_;
};

std::string listed(std::span<const uint32_t> polygon) {
  std::string text;
  for (size_t i = 0; i < polygon.size() && i < 8; ++i)
    text += (i > 0 ? " " : "") + std::to_string(polygon[i]);
  return polygon.size() > 8 ? text + " ..." : text;
}

/// Throws naming the first difference between a frame and frame 0.
void check_same_mesh(const Mesh& mesh, const std::string& path, const MeshSequence& sequence,
                     const std::string& first_path) {
  if (mesh.vertex_count() != sequence.vertex_count)
    fail_input(path, std::to_string(mesh.vertex_count()) + " vertices, but " + first_path +
                         " has " + std::to_string(sequence.vertex_count));
  if (mesh.polygons == sequence.polygons)
    return;
  if (mesh.polygons.size() != sequence.polygons.size())
    fail_input(path, std::to_string(mesh.polygons.size()) + " faces, but " + first_path + " has " +
                         std::to_string(sequence.polygons.size()));
  for (size_t p = 0; p < mesh.polygons.size(); ++p) {
    auto here = mesh.polygons[p], there = sequence.polygons[p];
    if (!std::equal(here.begin(), here.end(), there.begin(), there.end()))
      fail_input(path, "face " + std::to_string(p) + " has vertices " + listed(here) + ", but " +
                           listed(there) + " in " + first_path + " (counted from 0)");
  }
}

void reserve(MeshSequence& sequence, size_t frames, const std::string& path) {
  sequence.frame_count = static_cast<uint32_t>(frames);
  try {
    sequence.positions.reserve(size_t{sequence.vertex_count} * 3 * frames);
  } catch (const Error& error) {
    throw Error(error.kind(), path + ": " + error.what());
  } catch (const std::exception&) {
    fail_input(path, "not enough memory for " + std::to_string(sequence.vertex_count) +
                         " vertices x " + std::to_string(frames) + " frames");
  }
}

void report(const Progress& progress, size_t done, size_t all) {
  if (progress)
    progress("reading", static_cast<double>(done) / static_cast<double>(all));
}

/// Tells what float32 took from the coordinates of the source, where that was measured.
void note_rounding(const std::string& path, const LocalOrigin& origin, const LoadOptions& options) {
  if (options.note && origin.rounding > 0 && options.measures_rounding)
    options.note(
        fmt::format("{}: float32 takes up to {:.2g} from the coordinates", path, origin.rounding));
}

void load_frames(const std::vector<std::string>& paths, const LoadOptions& options,
                 MeshSequence& sequence) {
  MeshReader reader(paths[0], options);
  MeshDetails details;
  ChangesOfFrames changes(options);
  for (size_t f = 0; f < paths.size(); ++f) {
    const Mesh& mesh = reader.read(paths[f], f == 0 ? &sequence : &details);
    if (f == 0) {
      changes.begin(reader);
      sequence.vertex_count = static_cast<uint32_t>(mesh.vertex_count());
      sequence.polygons = mesh.polygons;
      reader.read_looks(paths[0], options, sequence.materials);
      reserve(sequence, paths.size(), paths[0]);
    } else {
      check_same_mesh(mesh, paths[f], sequence, paths[0]);
      changes.compare(reader, paths[f], sequence, details);
      add_frame(details.attributes, static_cast<uint32_t>(f), sequence.attributes);
    }
    sequence.positions.insert(sequence.positions.end(), mesh.positions.begin(),
                              mesh.positions.end());
    report(options.progress, f + 1, paths.size());
  }
  reader.note_left_out(paths[0], options);
  note_rounding(paths[0], reader.origin(), options);
}

/// The mesh of a lone cache.
std::string mesh_beside(const std::string& cache) {
  for (const FileFormat* format : file_formats()) {
    std::string path = fs::path(cache).replace_extension(format->extensions).string();
    if (has_vertices(*format) && exists(path))
      return path;
  }
  throw Error(ErrorKind::kInput,
              cache + ": a vertex cache has no faces; name the mesh that it moves (" +
                  list_formats(has_vertices, ", ") + ")");
}

/// Tells of a vertex cache beside a mesh that is taken by itself.
void note_cache_beside(const std::string& mesh, const LoadOptions& options) {
  for (const FileFormat* format : file_formats()) {
    const std::string cache = fs::path(mesh).replace_extension(format->extensions).string();
    if (options.note && format->role == FileRole::kCache && exists(cache))
      options.note("one frame, without " + cache + " beside it, which moves it if named, too");
  }
}

/// Compares a cache's first frame with its mesh, whose positions are not kept. If one is the other
/// turned from Y up to Z up or back, the axis that is up is known; other axes and units are noted.
void compare_axes(const std::string& cache, std::span<const float> mesh, const LoadOptions& options,
                  MeshSequence& sequence) {
  const std::optional<ScaledTurn> turn = find_turn(mesh, sequence.frame(0));
  if (!turn)
    return;  // another pose
  constexpr SignedAxis kY{1, 1}, kZ{2, 1};
  if (turn->axes[2] == kY)
    sequence.up = UpAxis::kZ;
  else if (turn->axes[1] == kZ)
    sequence.up = UpAxis::kY;
  const bool is_scaled = std::abs(turn->scale - 1) > 1e-3;
  if (!options.note || (turn->axes == kSameAxes && !is_scaled))
    return;
  std::string text = cache + ": its axes are " + text_of(turn->axes) + " of the mesh";
  if (turn->axes == kSameAxes)
    text = cache + ": its unit is not that of the mesh";
  if (is_scaled)
    text += ", lengths " + std::to_string(turn->scale) + " times as large";
  if (sequence.up != UpAxis::kUnknown)
    text += std::string("; ") + (sequence.up == UpAxis::kZ ? "z" : "y") + " is up (--up)";
  options.note(text);
}

/// Takes the first frame and the frames of a sample from the header of a PC2. They count frames of the
/// scene, whose rate is the one given or assumed.
void set_pc2_timing(const VertexCache& cache, const std::string& path, const LoadOptions& options,
                    MeshSequence& sequence) {
  constexpr float kMostFrames = 10;  // more is a rate: some writers put frames per second there
  const float step = cache.frames_per_sample;
  if (options.rate)
    sequence.rate = *options.rate;
  sequence.rate.assumed = !options.rate;
  if (cache.first_frame == 0 && step == 1)
    return;
  const auto say = [&](const std::string& text) {
    if (options.note)
      options.note(path + ": " + text);
  };
  if (!std::isfinite(cache.first_frame) || !(step > 0 && step <= kMostFrames))
    return say(
        fmt::format("its header says first frame {:g}, {:g} frames a sample, which is not used",
                    cache.first_frame, step));
  const double fps = sequence.rate.value();
  std::vector<double> times;
  for (uint32_t f = 0; f < std::max(cache.frame_count, 2U); ++f)
    times.push_back((static_cast<double>(cache.first_frame) + f * static_cast<double>(step)) / fps);
  const Timing timing = timing_of(times, 0, path);
  sequence.rate = timing.rate;
  sequence.rate.assumed = !options.rate;
  sequence.start_time = timing.start_time;
  say(
      fmt::format("its header says first frame {:g}, {:g} frames a sample: at {:g} frames per "
                  "second{}, samples "
                  "from {:g} s at {:g} per second",
                  cache.first_frame, step, fps, options.rate ? "" : ", which are assumed (--fps)",
                  timing.start_time, timing.rate.value()));
}

void load_cache(const std::string& cache_path, const std::string& mesh_path,
                const LoadOptions& options, MeshSequence& sequence) {
  if (const FileFormat* mesh = format_of(mesh_path); mesh && mesh->is_soup)
    fail_input(
        mesh_path,
        fmt::format("an {} has no order of vertices and cannot be the mesh of a vertex cache",
                    mesh->name));
  const FileFormat& format = *format_of(cache_path);
  ByteSource source = file_source(cache_path);
  VertexCache cache = format.open_cache(source);
  FrameArray surface;
  {
    MeshReader reader(mesh_path, options);
    const Mesh& mesh = reader.read(mesh_path, &sequence);
    if (mesh.vertex_count() != cache.vertex_count)
      fail_input(cache_path, std::to_string(cache.vertex_count) + " vertices, but the mesh " +
                                 mesh_path + " has " + std::to_string(mesh.vertex_count()));
    check_cache_record(reader.text(), mesh_path, source);
    reader.read_looks(mesh_path, options, sequence.materials);
    reader.note_left_out(mesh_path, options);
    sequence.polygons = mesh.polygons;
    surface = mesh.positions;
  }
  sequence.vertex_count = cache.vertex_count;
  reserve(sequence, cache.frame_count, cache_path);
  sequence.positions.resize(size_t{cache.vertex_count} * 3 * cache.frame_count);
  read_positions(cache, source, sequence.positions, options.progress);
  move_origin(options, sequence.positions);
  if (cache.frame_count > 0)
    compare_axes(cache_path, surface, options, sequence);
  if (format.counts_frames) {
    set_pc2_timing(cache, cache_path, options, sequence);
  } else if (!options.rate) {
    Timing timing = timing_of(cache.times, cache_path);
    sequence.rate = timing.rate;
    sequence.start_time = timing.start_time;
    sequence.times = std::move(timing.times);
  }
}

/// A scene or an archive.
void load_whole_clip(const FileFormat& format, const std::string& path, const LoadOptions& options,
                     MeshSequence& sequence) {
  const std::string stem = sequence.name;
  sequence = format.read_clip({path}, options);
  if (format.role != FileRole::kScene)
    sequence.name = stem;
  else if (sequence.clips.empty())
    sequence.name = sequence.name.empty() ? stem : stem + " " + sequence.name;
}

/// A scene, an archive or one mesh from the standard input, told apart by how it begins.
void load_standard_input(const std::string& bytes, const LoadOptions& options,
                         MeshSequence& sequence) {
  const FileFormat& format = format_of_bytes(bytes);
  if (format.read_clip) {
    sequence = format.read_clip({"-", &bytes}, options);
    return;
  }
  Mesh mesh;
  mesh.origin = origin_of(options);
  format.mesh_parser(options)(bytes, "-", mesh, &sequence, nullptr);
  sequence.vertex_count = static_cast<uint32_t>(mesh.vertex_count());
  sequence.frame_count = 1;
  sequence.polygons = std::move(mesh.polygons);
  sequence.positions = std::move(mesh.positions);
  note_rounding("-", mesh.origin, options);
  if (options.note && !mesh.left_out.text().empty())
    options.note("-: left out: " + mesh.left_out.text());
}

/// Tells of frames that are not in the order of their numbers: shells sort by letters.
void note_order(const std::vector<std::string>& paths, const LoadOptions& options) {
  const bool fractions = have_fractions(paths);
  const auto late = std::ranges::adjacent_find(
      paths,
      [&](const std::string& a, const std::string& b) { return natural_less(b, a, fractions); });
  if (options.note && late != paths.end())
    options.note("frames stay in the order given, " + late[0] + " before " + late[1] +
                 "; a pattern in quotes sorts them by their numbers");
}

void load(const std::vector<std::string>& paths, const LoadOptions& options,
          MeshSequence& sequence) {
  for (const std::string& path : paths) {
    if (is_whole_clip(path) && paths.size() > 1)
      fail_usage(path + ": is a whole clip, but " + std::to_string(paths.size()) +
                 " inputs are given");
  }
  const FileFormat& first = *format_of(paths[0]);
  if (first.role == FileRole::kScene)
    return load_whole_clip(first, paths[0], options, sequence);
  if (!options.clip.empty())
    fail_usage("--clip " + options.clip + ": " + paths[0] + " is no scene with clips");
  if (!options.clips.empty())
    fail_usage("--clips: " + paths[0] + " is no scene with clips");
  if (first.role == FileRole::kArchive)
    return load_whole_clip(first, paths[0], options, sequence);
  std::vector<std::string> caches, meshes;
  for (const std::string& path : paths)
    (is_cache(path) ? caches : meshes).push_back(path);
  if (!caches.empty()) {
    if (meshes.size() + (options.mesh.empty() ? 0 : 1) > 1)
      fail_usage(caches[0] + ": a vertex cache goes with one mesh, but " +
                 std::to_string(meshes.size() + (options.mesh.empty() ? 0 : 1)) + " are given");
    std::string mesh = !meshes.empty()         ? meshes[0]
                       : !options.mesh.empty() ? options.mesh
                                               : mesh_beside(caches[0]);
    if (caches.size() == 1)
      return load_cache(caches[0], mesh, options, sequence);
    std::vector<MeshSequence> clips(caches.size());
    for (size_t c = 0; c < caches.size(); ++c) {
      load_cache(caches[c], mesh, options, clips[c]);
      clips[c].name = fs::path(caches[c]).stem().string();
    }
    sequence = clip_library(std::move(clips));
    return;
  }
  if (!options.mesh.empty())
    fail_usage(options.mesh + ": a mesh is given for a vertex cache, but there is none");
  if (meshes.size() == 1)
    note_cache_beside(meshes[0], options);
  if (meshes.size() > kMaxFrames)
    fail_usage(std::to_string(meshes.size()) + " frames; at most 2^24 - 1 are possible");
  for (const std::string& path : meshes) {
    if (format_of(path) != &first)
      fail_usage(path + ": frames are of one format, but " + meshes[0] + " is of another");
  }
  note_order(meshes, options);
  load_frames(meshes, options, sequence);
}

/// Tells of coordinates so far from zero that float32 is coarse for the mesh around them.
void note_far(const std::string& input, const PositionBox& box, const LoadOptions& options) {
  if (!options.note || !box.is_far())
    return;
  const std::string text = fmt::format("{}: coordinates up to {:.7g} of a mesh of {:.3g}", input,
                                       box.farthest(), box.size());
  if (options.origin)
    options.note(fmt::format(
        "{}: float32 rounds them by up to {:.2g}; a local origin (encode --origin) keeps more",
        text, box.rounding()));
  else
    options.note(
        fmt::format("{}: they are kept from the origin {}", text, fmt::join(box.middle(), ",")));
}

/// Loads from the origin of the options; without one from zero, and once more where the mesh is far from it.
template <typename Load>
auto load_near(const std::string& input, const LoadOptions& options, const Load& load) {
  LoadOptions own = options;
  own.origin = options.origin.value_or(Point());
  std::vector<std::string> notes;
  if (options.note && !options.origin)
    own.note = [&](const std::string& text) { notes.push_back(text); };
  PositionBox box;
  auto loaded = load(own, &box);
  if (!options.origin && box.is_far()) {
    loaded = {};
    own.origin = box.middle();
    notes.clear();
    PositionBox near;
    loaded = load(own, &near);
  }
  for (const std::string& text : notes)
    options.note(text);
  note_far(input, box, options);
  return loaded;
}

/// `standard_input`: its bytes, where it is the input.
MeshSequence load_from(std::span<const std::string> inputs, const std::string& standard_input,
                       const LoadOptions& options) {
  MeshSequence sequence;
  bool has_rate = false;  // that a PC2 makes of the one given
  if (inputs.size() == 1 && inputs[0] == "-") {
    load_standard_input(standard_input, options, sequence);
  } else {
    std::vector<std::string> paths = expand(inputs);
    sequence.name = fs::path(paths[0]).stem().string();
    load(paths, options, sequence);
    has_rate = std::ranges::any_of(
        paths, [](const std::string& path) { return format_of(path)->counts_frames; });
  }
  if (options.rate && !has_rate) {
    sequence.rate = *options.rate;
    sequence.rate.assumed = false;
    for (ClipTiming& clip : sequence.clips)
      clip.rate = sequence.rate;
  }
  sequence.origin = *options.origin;
  return sequence;
}

Scene load_topologies_from(std::span<const std::string> inputs, const LoadOptions& options) {
  const std::vector<std::string> paths = expand(inputs);
  const FileFormat& format = *format_of(paths[0]);
  if (paths.size() > kMaxFrames)
    fail_usage(std::to_string(paths.size()) + " frames; at most 2^24 - 1 are possible");
  if (format.read_meshes) {
    if (paths.size() > 1)
      fail_usage(paths[1] + ": is a second input, but " + paths[0] + " is a whole clip");
    Scene scene = format.read_meshes({paths[0]}, options);
    scene.clip.name = fs::path(paths[0]).stem().string();
    scene.clip.origin = *options.origin;
    return scene;
  }
  if (!has_vertices(format))
    fail_without_vertices(paths[0]);
  MeshReader reader(paths[0], options);
  ChangesOfFrames changes(options);
  Scene scene;
  scene.clip.origin = *options.origin;
  scene.clip.name = fs::path(paths[0]).stem().string();
  if (options.rate) {
    scene.clip.rate = *options.rate;
    scene.clip.rate.assumed = false;
  }
  scene.clip.frame_count = static_cast<uint32_t>(paths.size());
  std::vector<SceneMesh>& runs = scene.meshes;
  for (uint32_t f = 0; f < paths.size(); ++f) {
    if (format_of(paths[f]) != &format)
      fail_usage(paths[f] + ": frames are of one format, but " + paths[0] + " is of another");
    MeshDetails details;
    const Mesh* mesh = &reader.read(paths[f], &details);
    if (runs.empty() || mesh->vertex_count() != runs.back().sequence.vertex_count ||
        mesh->polygons != runs.back().sequence.polygons) {
      MeshSequence& run = runs.emplace_back().sequence;
      static_cast<MeshDetails&>(run) = std::move(details);
      run.vertex_count = static_cast<uint32_t>(mesh->vertex_count());
      run.polygons = mesh->polygons;
      reader.read_looks(paths[f], options, run.materials);
      runs.back().present_in = {{f, 0}};
      changes.begin(reader);
    } else {
      changes.compare(reader, paths[f], runs.back().sequence, details);
      add_frame(details.attributes, runs.back().sequence.frame_count,
                runs.back().sequence.attributes);
    }
    MeshSequence& run = runs.back().sequence;
    run.positions.insert(run.positions.end(), mesh->positions.begin(), mesh->positions.end());
    ++run.frame_count;
    ++runs.back().present_in[0].count;
    report(options.progress, f + 1, paths.size());
  }
  reader.note_left_out(paths[0], options);
  note_rounding(paths[0], reader.origin(), options);
  return scene;
}

}  // namespace

bool is_sequence_input(const std::string& path) {
  return format_of(path) != nullptr;
}

std::vector<std::string> sequence_files(std::span<const std::string> inputs) {
  if (inputs.empty())
    fail_usage("no input is given");
  return expand(inputs);
}

MeshSequence load_sequence(std::span<const std::string> inputs, const LoadOptions& options) {
  if (inputs.empty())
    fail_usage("no input is given");
  std::string standard_input;
  if (inputs.size() == 1 && inputs[0] == "-")
    read_standard_input(standard_input);
  return load_near(inputs[0], options, [&](const LoadOptions& own, PositionBox* box) {
    MeshSequence sequence = load_from(inputs, standard_input, own);
    box->add(sequence.positions);
    return sequence;
  });
}

Scene load_topologies(std::span<const std::string> inputs, const LoadOptions& options) {
  if (inputs.empty())
    fail_usage("no input is given");
  return load_near(inputs[0], options, [&](const LoadOptions& own, PositionBox* box) {
    Scene scene = load_topologies_from(inputs, own);
    for (const SceneMesh& mesh : scene.meshes)
      box->add(mesh.sequence.positions);
    return scene;
  });
}

}  // namespace anicodec::tools
