// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/massage_quality.h"
#include "codec/metrics/hausdorff.h"
#include "codec/metrics/metrics.h"
#include "codec/sequence/error.h"
#include "codec/sequence/frame_normals.h"
#include "tools/inputs/compared_clip.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/base/signed_axes.h"
#include "tools/io/file_formats.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/names.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kCompareFooter =
    R"(A is the original, B what is compared with it. Each is one argument: an .anic file, a quoted pattern
of frames ('frames/*.obj'), a vertex cache (.pc2, .mdd) with the mesh of the same stem beside it or
the one of --mesh, or a scene (.gltf, .glb), which is baked at the rate of the other side.

--frames-a and --frames-b take a part of a side's frames (A:B is A to B - 1, counted from 0).
--axes-b x,z,-y takes (x, z, -y) of B for its positions. Without it B is turned to the axes of A
where the files of both say which axis points up.

Clips of equally many vertices are compared vertex by vertex: KG error and RMSE over all frames,
the largest error and where it is, PSNR against the diagonal, STED (edges in space and time), the
error of the moves from frame to frame, and for equal faces how far normals turn (with the hard
edges of A, where they are known), and attributes that both have by the same name. If the vertices
differ in number, or in order because an .anic file was encoded with --order free, or with
--surface, the distance of the surfaces is measured (Hausdorff) and the shapes of the triangles.

--json prints one object: a, b, vertices, faces, frames, diagonal, bytes, bpfv (of B if it is an
.anic file), method (vertices or surface), kg, rmse, max_error, max_error_percent, max_frame,
max_vertex, psnr, sted, sted_spatial, sted_temporal, displacement_error, normal_error_mean,
normal_error_max (degrees), hausdorff, hausdorff_percent, hausdorff_frame, hausdorff_mean,
hausdorff_rms, radius_ratio_a, radius_ratio_b (of the triangles, 1 if equilateral), conformal_mean,
conformal_max, area_mean, area_max (how much B changes the triangles of A, 1 if not; for equal
faces), attributes (kind, name, max_error, rmse of single numbers), note. Numbers not measured are
null, and so is an infinite PSNR.

Examples:
  anicodec compare dance.pc2 dance.anic
  anicodec compare 'frames/*.obj' 'decoded/*.ply' --json
  anicodec compare man.mdd man.glb --axes-b x,-z,y --frames-b 1:)";

struct CompareCommand {
  std::string a, b, mesh, rate, axes, clip;
  ComparedPart part_a, part_b;
  bool surface = false, no_sted = false;
};

/// The measured errors, and the reason if not all were measured.
struct Measured {
  double diagonal = 0;
  std::optional<Comparison> vertices;
  std::optional<SurfaceComparison> surface;
  std::optional<TriangleComparison> triangles;
  std::optional<NormalError> normals;
  std::vector<AttributeDifference> attributes;
  std::string note;
};

/// Passes frames on and shows how far a comparison is.
FrameSource watched(FrameSource frames, uint32_t count, ProgressLine& line) {
  return [frames = std::move(frames), count, &line](uint32_t f) {
    line.show("comparing", static_cast<double>(f) / count);
    return frames(f);
  };
}

/// "x,z,-y": each axis once.
SignedAxes parse_axes(const std::string& text) {
  SignedAxes axes;
  bool used[3] = {false, false, false};
  size_t at = 0;
  auto accept = [&](char c) {
    const bool found = at < text.size() && text[at] == c;
    at += found ? 1 : 0;
    return found;
  };
  bool ok = true;
  for (size_t i = 0; i < 3 && ok; ++i) {
    ok = i == 0 || accept(',');
    axes[i].sign = accept('-') ? -1.0F : 1.0F;
    for (axes[i].axis = 0; axes[i].axis < 3 && !accept("xyz"[axes[i].axis]);)
      ++axes[i].axis;
    ok = ok && axes[i].axis < 3 && !std::exchange(used[axes[i].axis], true);
  }
  if (!ok || at != text.size())
    throw Error(ErrorKind::kUsage, "--axes-b: '" + text + "' is not like x,z,-y");
  return axes;
}

/// The turn of B to the axes of A.
SignedAxes axes_of(const CompareCommand& command, UpAxis a, UpAxis b) {
  if (!command.axes.empty())
    return parse_axes(command.axes);
  if (a == b || a == UpAxis::kUnknown || b == UpAxis::kUnknown)
    return kSameAxes;
  return parse_axes(b == UpAxis::kZ ? "x,z,-y" : "x,-z,y");
}

/// Frames of B with the axes and the origin of A.
FrameSource brought(FrameSource frames, const SignedAxes& axes, const Point& from,
                    const Point& to) {
  Point move{};
  for (size_t k = 0; k < 3; ++k)
    move[k] = static_cast<double>(axes[k].sign) * from[axes[k].axis] - to[k];
  if (axes == kSameAxes && move == Point())
    return frames;
  auto positions = std::make_shared<std::vector<float>>();
  return [frames = std::move(frames), axes, move, positions](uint32_t f) -> std::span<const float> {
    const std::span<const float> source = frames(f);
    positions->resize(source.size());
    for (size_t i = 0; i + 2 < source.size(); i += 3) {
      for (size_t k = 0; k < 3; ++k)
        (*positions)[i + k] = static_cast<float>(
            static_cast<double>(axes[k].sign * source[i + axes[k].axis]) + move[k]);
    }
    return *positions;
  };
}

Measured measure(const ComparedClip& a, const ComparedClip& b, const CompareCommand& command,
                 ProgressLine& line) {
  const MeshSequence &p = a.sequence(), &q = b.sequence();
  if (p.frame_count != q.frame_count)
    throw Error(ErrorKind::kInput, fmt::format("{}: {} frames, but {} has {}", b.path(),
                                               q.frame_count, a.path(), p.frame_count));
  a.check_empty_frames();
  b.check_empty_frames();
  Measured m;
  bool by_vertex = false;
  if (p.vertex_count != q.vertex_count)
    m.note = fmt::format("{} and {} vertices: the surfaces are compared", p.vertex_count,
                         q.vertex_count);
  else if ((a.has_free_order() || b.has_free_order()) && p.polygons != q.polygons)
    m.note = "the vertices are in another order (--order free): the surfaces are compared";
  else
    by_vertex = true;
  if (by_vertex && !same_faces(p.polygons, q.polygons))
    m.note = "the faces differ: the vertices are compared by their number";

  uint32_t frames = p.frame_count;
  const SignedAxes axes = axes_of(command, p.up, q.up);
  auto frames_of_b = [&] { return brought(b.frames(), axes, q.origin, p.origin); };
  if (by_vertex) {
    CompareOptions options;
    options.sted = !command.no_sted;
    m.vertices = compare(p.polygons, p.vertex_count, frames, watched(a.frames(), frames, line),
                         frames_of_b(), options);
    m.diagonal = m.vertices->diagonal;
    if (m.note.empty())  // the same faces
      m.normals = normal_error(p, a.frames(), frames_of_b());
    m.attributes =
        attribute_differences(a.attributes(), b.attributes(), frames, p.polygons == q.polygons);
  }
  if (!by_vertex || command.surface) {
    m.surface = compare_surfaces(p.polygons, watched(a.frames(), frames, line), q.polygons,
                                 frames_of_b(), frames);
    m.diagonal = m.surface->diagonal;
    m.triangles = compare_triangles(p.polygons, a.frames(), q.polygons, b.frames(), frames);
  }
  return m;
}

double bpfv_of(const ComparedClip& clip) {
  const MeshSequence& sequence = clip.sequence();
  return 8 * static_cast<double>(clip.bytes()) /
         (static_cast<double>(sequence.vertex_count) * sequence.frame_count);
}

nlohmann::ordered_json json_of(const ComparedClip& a, const ComparedClip& b, const Measured& m) {
  nlohmann::ordered_json json;
  json["a"] = a.path();
  json["b"] = b.path();
  json["vertices"] = b.sequence().vertex_count;
  json["faces"] = b.sequence().polygons.size();
  json["frames"] = b.sequence().frame_count;
  json["diagonal"] = m.diagonal;
  json["bytes"] = nullptr;
  json["bpfv"] = nullptr;
  if (b.bytes() > 0) {
    json["bytes"] = b.bytes();
    json["bpfv"] = bpfv_of(b);
  }
  json["method"] = m.vertices ? "vertices" : "surface";
  for (const char* key : {"kg",
                          "rmse",
                          "max_error",
                          "max_error_percent",
                          "max_frame",
                          "max_vertex",
                          "psnr",
                          "sted",
                          "sted_spatial",
                          "sted_temporal",
                          "displacement_error",
                          "max_displacement_error",
                          "normal_error_mean",
                          "normal_error_max",
                          "hausdorff",
                          "hausdorff_percent",
                          "hausdorff_frame",
                          "hausdorff_mean",
                          "hausdorff_rms",
                          "radius_ratio_a",
                          "radius_ratio_b",
                          "conformal_mean",
                          "conformal_max",
                          "area_mean",
                          "area_max"})
    json[key] = nullptr;
  if (const auto& c = m.vertices) {
    json["kg"] = c->kg;
    json["rmse"] = c->rmse;
    json["max_error"] = c->max_error;
    json["max_error_percent"] = c->percent(c->max_error);
    json["max_frame"] = c->max_frame;
    json["max_vertex"] = c->max_vertex;
    json["psnr"] = c->psnr;
    if (c->has_sted) {
      json["sted"] = c->sted.sted;
      json["sted_spatial"] = c->sted.spatial;
      json["sted_temporal"] = c->sted.temporal;
    }
    json["displacement_error"] = c->displacement_error;
    json["max_displacement_error"] = c->max_displacement_error;
  }
  if (const auto& n = m.normals) {
    json["normal_error_mean"] = n->mean;
    json["normal_error_max"] = n->max;
  }
  if (const auto& s = m.surface) {
    json["hausdorff"] = s->total.max();
    json["hausdorff_percent"] = s->percent(s->total.max());
    json["hausdorff_frame"] = s->max_frame;
    json["hausdorff_mean"] = s->total.mean();
    json["hausdorff_rms"] = s->total.rms();
  }
  if (const auto& t = m.triangles) {
    json["radius_ratio_a"] = t->radius_ratio_a;
    json["radius_ratio_b"] = t->radius_ratio_b;
    if (t->mapped) {
      json["conformal_mean"] = t->distortion.conformal_mean;
      json["conformal_max"] = t->distortion.conformal_max;
      json["area_mean"] = t->distortion.area_mean;
      json["area_max"] = t->distortion.area_max;
    }
  }
  json["attributes"] = nlohmann::ordered_json::array();
  for (const AttributeDifference& d : m.attributes)
    json["attributes"].push_back(
        {{"kind", name_of(d.kind)}, {"name", d.name}, {"max_error", d.max}, {"rmse", d.rmse}});
  json["note"] = m.note;
  return json;
}

void print_text(const ComparedClip& b, const Measured& m, int verbosity) {
  auto row = [](const char* name, const std::string& value) {
    print_line("{:<20} {}", name, value);
  };
  if (!m.note.empty())
    row("note", m.note);
  row("vertices x frames",
      fmt::format("{} x {}", b.sequence().vertex_count, b.sequence().frame_count));
  if (b.bytes() > 0)
    row("size", fmt::format("{} bytes, {:.3f} bpfv", grouped(b.bytes()), bpfv_of(b)));
  if (const auto& c = m.vertices) {
    row("KG error", fmt::format("{:.4g} %", c->kg));
    row("RMSE", fmt::format("{:.4g} ({:.3g} % of the diagonal)", c->rmse, c->percent(c->rmse)));
    row("max error", fmt::format("{:.4g} ({:.3g} %) at frame {}, vertex {}", c->max_error,
                                 c->percent(c->max_error), c->max_frame, c->max_vertex));
    row("PSNR", std::isinf(c->psnr) ? "infinite" : fmt::format("{:.1f} dB", c->psnr));
    if (c->has_sted)
      row("STED", fmt::format("{:.4g}", c->sted.sted));
    row("displacement error",
        fmt::format("{:.4g} ({:.4g} at most)", c->displacement_error, c->max_displacement_error));
  }
  if (const auto& n = m.normals)
    row("normal error", fmt::format("{:.3g} degrees on average, {:.3g} at most", n->mean, n->max));
  for (const AttributeDifference& d : m.attributes)
    row(name_of(d.kind),
        fmt::format("max error {:.4g}, RMSE {:.4g} of \"{}\"", d.max, d.rmse, d.name));
  if (const auto& s = m.surface) {
    row("Hausdorff distance", fmt::format("{:.4g} ({:.3g} %) at frame {}", s->total.max(),
                                          s->percent(s->total.max()), s->max_frame));
    row("surface RMS, mean", fmt::format("{:.4g}, {:.4g}", s->total.rms(), s->total.mean()));
  }
  if (const auto& t = m.triangles) {
    row("radius ratio", fmt::format("{:.4f}, of A {:.4f}", t->radius_ratio_b, t->radius_ratio_a));
    if (t->mapped)
      row("distortion", fmt::format("conformal {:.4f} (at most {:.4g}), area {:.4f} ({:.4g})",
                                    t->distortion.conformal_mean, t->distortion.conformal_max,
                                    t->distortion.area_mean, t->distortion.area_max));
  }
  if (verbosity > 0 && m.vertices) {
    fmt::print("frame        RMSE   max error  at vertex\n");
    for (size_t f = 0; f < m.vertices->frames.size(); ++f) {
      const FrameError& e = m.vertices->frames[f];
      fmt::print("{:>5} {:>11.4g} {:>11.4g} {:>10}\n", f, e.rmse, e.max, e.max_vertex);
    }
  }
}

void run(const CompareCommand& command, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  ComparedPart parts[] = {command.part_a, command.part_b};
  for (ComparedPart& part : parts)
    part.clip = part.clip.empty() ? command.clip : part.clip;
  const std::string* paths[] = {&command.a, &command.b};
  std::optional<ComparedClip> clips[2];
  if (!command.rate.empty()) {
    for (int side : {0, 1}) {
      if (is_scene(*paths[side]))
        parts[side].rate = parse_frame_rate(command.rate);
    }
  }
  // A scene has no frames of its own: it is read last, and takes the rate of the other side.
  const int first = is_scene(command.a) ? 1 : 0;
  for (int side : {first, 1 - first}) {
    clips[side].emplace(*paths[side], command.mesh, line.callback(), parts[side]);
    ComparedPart& other = parts[1 - side];
    if (is_scene(*paths[1 - side]) && !other.rate)
      other.rate = clips[side]->sequence().rate;
  }
  const ComparedClip &a = *clips[0], &b = *clips[1];
  Measured measured = measure(a, b, command, line);
  line.clear();
  if (common.json)
    print_json(json_of(a, b, measured));
  else
    print_text(b, measured, common.verbosity);
}

}  // namespace

void add_compare(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<CompareCommand>();
  Options& options = add_command(
      commands, common, kQuiet | kVerbose | kThreads | kJson,
      {"compare", "A B [options]", "Measure how far two clips are apart", kCompareFooter},
      [c, &common] { run(*c, common); });
  options.argument("A", c->a, "The original").required();
  options.argument("B", c->b, "The clip compared with it").required();
  options.option("--mesh", c->mesh, "FILE",
                 "Mesh of a vertex cache (default: same stem beside it)");
  options.option("--fps", c->rate, "N[/D]",
                 "Frames per second of a scene (default: of the other side)");
  options.option("--clip", c->clip, "NAME",
                 "Clip of both sides: of an .anic file, or animation of a scene");
  options.option("--clip-a", c->part_a.clip, "NAME", "The same of A alone");
  options.option("--clip-b", c->part_b.clip, "NAME", "The same of B alone");
  options.option("--frames-a", c->part_a.frames, "A:B[:STEP]", "Part of the frames of A");
  options.option("--frames-b", c->part_b.frames, "A:B[:STEP]", "Part of the frames of B");
  options.option("--axes-b", c->axes, "AXES", "How positions of B are turned, such as x,z,-y");
  options.flag("--surface", c->surface, "Measure the distance of the surfaces as well");
  options.flag("--no-sted", c->no_sted, "Leave out STED, which takes most of the time");
}

}  // namespace anicodec::tools
