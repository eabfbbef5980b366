// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/played_clip.h"
#include "tools/inputs/turned_axes.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/gltf/glb_vertices.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/textures/basis_textures.h"
#include "tools/textures/frame_textures.h"
#include "tools/textures/vat_shaders.h"
#include "tools/words/names.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"
#include "tools/words/word_table.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kExportVatFooter =
    R"(FOLDER gets textures of the clip, its surface at rest as NAME.glb, whose second texture coordinates
are the place of each vertex in the textures, and a JSON file with the numbers that a shader wants.
y points up and the unit is a metre in all of them. The errors are those of the files, read back.

Forms:
  basis    NAME_basis, NAME_weights, NAME_basis.json: sums of a few components, many times smaller;
           --shaders puts the shader for an engine beside them
  openvat  NAME_vat, NAME-remap_info.json: every frame, for the shaders of OpenVAT (packed normals)
  houdini  NAME_pos, NAME_rot, NAME_data.json, NAME_mesh.glb: every frame, for the shader graphs of
           SideFX Labs Vertex Animation Textures 3 for Unity (soft bodies)

EXR holds 16-bit floats, PNG 16-bit numbers; Godot and browsers read PNG with 8 bits. In the engine:
no colour space, no filter, no mipmaps, no compression. Data that the textures lack are named. With
--json one object: form, name, vertices, frames, files (each with file, bytes, and of a texture
width, height, memory_bytes), memory_bytes, largest_error, rmse (both in metres), left_out, and with
normals largest_normal_error, rms_normal_error (degrees).

Examples:
  anicodec export-vat dance.anic -o dance --shaders godot
  anicodec export-vat dance.anic -o dance --rmse 0.02% --normal-error 2
  anicodec export-vat flag.anic -o flag --form openvat --frames ::2
  anicodec export-vat flag.anic -o flag --form houdini --image png)";

enum class Form : uint8_t { kBasis, kOpenVat, kHoudini };

constexpr Word<Form> kForms[] = {
    {Form::kBasis, "basis"}, {Form::kOpenVat, "openvat"}, {Form::kHoudini, "houdini"}};
constexpr Word<bool> kImages[] = {{false, "exr"}, {true, "png"}};

struct ExportVatCommand {
  std::string input, output, clip, frames, rmse, normal_error, shaders;
  Form form = Form::kBasis;
  bool png = false, no_normals = false;
  uint32_t max_size = 8192;
};

/// Data that no texture and no mesh holds, and work that shaders will not do.
std::vector<std::string> left_out(const PlayedClip& clip, const MeshSequence& described) {
  std::vector<std::string> lost;
  for (const Attribute& a : described.attributes) {
    if (!GlbVertices::is_written(a))
      lost.push_back(fmt::format("the {} attribute '{}'", name_of(a.kind), a.name));
  }
  if (clip.play_attributes(clip.meshes()))
    lost.emplace_back("the motion of attributes, which stay as in the first frame");
  if (!described.parts.names.empty())
    lost.push_back(counted(described.parts.names.size(), "name of a part", "names of parts"));
  const std::vector<ClipTiming> clips = clip.timings();
  if (std::ranges::any_of(clips, [](const ClipTiming& c) { return !c.times.empty(); }))
    lost.emplace_back("times of frames, which are taken as even");
  if (std::ranges::any_of(clips, [](const ClipTiming& c) { return !c.events.empty(); }))
    lost.emplace_back("named times");
  for (uint32_t m : clip.meshes()) {
    const std::vector<FrameRun>& runs = clip.present_in(m);
    if (runs.size() == 1 && runs[0].count == clip.frame_count())
      continue;
    lost.emplace_back("the absence of meshes, which shrink to a point and stretch between frames");
    break;
  }
  if (described.origin != Point())
    lost.push_back(fmt::format("the local origin {:.10g} {:.10g} {:.10g}", described.origin[0],
                               described.origin[1], described.origin[2]));
  return lost;
}

/// The clips of a file, or the chosen frames of its one clip.
std::vector<VatClip> played(const PlayedClip& clip, const FrameRange& range) {
  std::vector<VatClip> all;
  uint32_t first = 0;
  for (const anic_clip& of_file : clip.clips()) {
    const uint32_t frames = of_file.frame_count;
    VatClip& one = all.emplace_back();
    one.name = of_file.name;
    one.first_frame = first;
    one.frame_count = of_file.loop && of_file.closed && frames > 1 ? frames - 1 : frames;
    one.rate = FrameRate{of_file.rate_numerator, of_file.rate_denominator}.value();
    one.loop = of_file.loop != 0;
    first += frames;
  }
  if (range.size() < clip.frame_count())
    all = {{all[0].name, 0, range.size(), all[0].rate / range.step}};
  return all;
}

/// Positions times a factor.
FrameSource scaled(FrameSource frames, double factor) {
  if (factor == 1)
    return frames;
  auto scaled = std::make_shared<std::vector<float>>();
  return [frames = std::move(frames), factor, scaled](uint32_t f) -> std::span<const float> {
    const std::span<const float> positions = frames(f);
    scaled->resize(positions.size());
    std::ranges::transform(positions, scaled->begin(),
                           [factor](float x) { return static_cast<float>(double{x} * factor); });
    return *scaled;
  };
}

VatResult made(const ExportVatCommand& command, const VatSource& source, const VatOptions& options,
               double metres_per_unit) {
  const std::pair<bool, const char*> of_basis[] = {
      {!command.rmse.empty(), "--rmse"},
      {!command.normal_error.empty(), "--normal-error"},
      {!command.shaders.empty(), "--shaders"}};
  for (const auto& [given, name] : of_basis) {
    if (given && command.form != Form::kBasis)
      throw Error(ErrorKind::kUsage, fmt::format("{}: is for --form basis", name));
  }
  if (command.form == Form::kOpenVat)
    return make_openvat(source, options);
  if (command.form == Form::kHoudini)
    return make_houdini(source, options);
  BasisBounds bounds;
  if (!command.rmse.empty()) {
    bounds.rmse = parse_length(command.rmse, "--rmse");
    if (!bounds.rmse.percent)
      bounds.rmse.value = bounds.rmse.in_scene_units(metres_per_unit, "--rmse").value *
                          (metres_per_unit > 0 ? metres_per_unit : 1);
  }
  if (!command.normal_error.empty())
    bounds.rms_angle = parse_positive(command.normal_error, "--normal-error");
  VatResult result = make_basis(source, options, bounds);
  for (const VatShader& shader : shaders_for(command.shaders))
    result.files.push_back({std::string(shader.file), std::string(shader.text)});
  return result;
}

uint64_t memory_of(const VatResult& result) {
  uint64_t bytes = 0;
  for (const VatFile& file : result.files)
    bytes += file.memory;
  return bytes;
}

void print_result(const ExportVatCommand& command, const VatSource& source, const VatResult& result,
                  const std::vector<std::string>& lost, const CommonOptions& common) {
  const VatError& error = result.error;
  if (common.json) {
    nlohmann::ordered_json json{{"form", word_of(kForms, command.form)},
                                {"name", source.name},
                                {"vertices", source.mesh.vertex_count()},
                                {"frames", source.frame_count},
                                {"files", nlohmann::ordered_json::array()}};
    for (const VatFile& file : result.files) {
      nlohmann::ordered_json entry{{"file", file.name}, {"bytes", file.bytes.size()}};
      if (file.width > 0) {
        entry["width"] = file.width;
        entry["height"] = file.height;
        entry["memory_bytes"] = file.memory;
      }
      json["files"].push_back(std::move(entry));
    }
    json["memory_bytes"] = memory_of(result);
    json["largest_error"] = error.largest();
    json["rmse"] = error.rmse();
    if (error.has_normals()) {
      json["largest_normal_error"] = error.largest_angle();
      json["rms_normal_error"] = error.rms_angle();
    }
    json["left_out"] = lost;
    return print_json(json);
  }
  if (!lost.empty())
    print_line(stderr, "anicodec: {}: left out: {}", command.input, fmt::join(lost, "; "));
  if (common.quiet)
    return;
  for (const VatFile& file : result.files) {
    if (file.width > 0)
      print_line("{}: {} x {} texels, {}", file.name, file.width, file.height,
                 readable_bytes(file.bytes.size()));
    else
      print_line("{}: {}", file.name, readable_bytes(file.bytes.size()));
  }
  const uint64_t vectors = error.has_normals() ? 2 : 1;
  const uint64_t plain = 8 * vectors * source.mesh.vertex_count() * source.frame_count;
  const uint64_t memory = memory_of(result);
  print_line("memory of the textures: {}{}", readable_bytes(memory),
             command.form != Form::kBasis
                 ? ""
                 : fmt::format("; of every frame in 16-bit floats: {}, {:.1f} times as much",
                               readable_bytes(plain),
                               static_cast<double>(plain) / static_cast<double>(memory)));
  print_line("error: largest {:.4g} m, RMSE {:.4g} m", error.largest(), error.rmse());
  if (error.has_normals())
    print_line("error of normals: largest {:.3g} degrees, root mean square {:.3g}",
               error.largest_angle(), error.rms_angle());
}

void run(const ExportVatCommand& command, const CommonOptions& common) {
  ProgressLine line(common.quiet || common.json);
  std::string bytes = read_bytes(command.input);
  PlayedClip clip(command.input, view_of(bytes));
  clip.verify();
  clip.choose(command.clip.empty() ? "all" : command.clip);
  bytes = {};
  FrameRange range{0, clip.frame_count(), 1};
  if (!command.frames.empty())
    range = parse_frames(command.frames, "--frames", clip.frame_count());
  clip.check_empty_frames(range);

  MeshSequence described = clip.describe(clip.meshes());
  std::vector<std::string> lost = left_out(clip, described);
  const AxisTurn turn(described.up, described.up == UpAxis::kZ ? UpAxis::kY : described.up);
  const double metres = described.metres_per_unit;
  turn.turn(described.attributes);
  const FrameSource all = scaled(turn.turned(clip.play(clip.meshes())), metres > 0 ? metres : 1);
  const TexelMesh mesh(std::move(described));
  const VatSource source{
      command.input == "-" ? "clip" : std::filesystem::path(command.input).stem().string(), mesh,
      [&all, range](uint32_t f) { return all(range.first + f * range.step); }, range.size(),
      played(clip, range)};

  const VatResult result =
      made(command, source, {command.png, !command.no_normals, command.max_size, line.callback()},
           metres);
  lost.insert(lost.end(), result.left_out.begin(), result.left_out.end());
  std::vector<AtomicFile> files;
  for (const VatFile& file : result.files) {
    AtomicFile& to = files.emplace_back(
        (std::filesystem::path(command.output) / file.name).string(), common.overwrite);
    to.write(file.bytes);
    to.close();
  }
  commit_all(files);
  line.clear();
  print_result(command, source, result, lost, common);
}

}  // namespace

void add_export_vat(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<ExportVatCommand>();
  Options& options = add_command(
      commands, common, kForce | kQuiet | kThreads | kJson,
      {"export-vat", "CLIP.anic -o FOLDER [options]",
       "Write vertex-animation textures for engines without a plug-in", kExportVatFooter},
      [c, &common] { run(*c, common); });
  options.argument("CLIP", c->input, "The .anic file").required();
  options.option("-o,--output", c->output, "FOLDER", "The folder for the files").required();
  options.choice("--form", c->form, {kForms}, "Layout of the textures (default basis)");
  options.choice("--image", c->png, {kImages}, "Format of the textures (default exr)");
  options.option("--clip", c->clip, "NAME",
                 "The clip, of a file that has several (default: all, one after the other)");
  options.option("--frames", c->frames, "A:B[:STEP]",
                 "Frames A to B - 1, every STEP-th (default: all)");
  options.option("--rmse", c->rmse, "LEN",
                 "basis: root mean square of the distances, in scene units or in per cent of the "
                 "diagonal (default 0.1%)");
  options.option("--normal-error", c->normal_error, "DEG",
                 "basis: root mean square of the normals' angles, in degrees (default 5)");
  options.flag("--no-normals", c->no_normals, "Positions alone");
  options.option("--shaders", c->shaders, "ENGINE,...",
                 "basis: add shaders for godot, unity, unreal, three, separated by commas");
  options.number("--max-size", c->max_size, "N", {16, 65536},
                 "Most texels of a side (default 8192)");
}

}  // namespace anicodec::tools
