// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/error.h"
#include "codec/hausdorff.h"
#include "codec/massage_quality.h"
#include "codec/metrics.h"
#include "tools/command.h"
#include "tools/compared_clip.h"
#include "tools/progress.h"
#include "tools/quantity.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kFooter =
    R"(A is the original, B what is compared with it. Each is one argument: an .anic file, a quoted pattern
of frames ('frames/*.obj'), or a vertex cache (.pc2, .mdd) with the mesh of the same stem beside it
or the one of --mesh.

Clips of equally many vertices are compared vertex by vertex: KG error and RMSE over all frames, the
largest error and where it is, PSNR against the diagonal, STED (edges in space and time), and the
error of the moves from frame to frame. If the vertices differ in number, or in order because an
.anic file was encoded with --order free, or with --surface, the distance of the surfaces is
measured (Hausdorff) and the shapes of the triangles.

--json prints one object: a, b, vertices, faces, frames, diagonal, bytes, bpfv (of B if it is an
.anic file), method (vertices or surface), kg, rmse, max_error, max_error_percent, max_frame,
max_vertex, psnr, sted, sted_spatial, sted_temporal, displacement_error, hausdorff,
hausdorff_percent, hausdorff_frame, hausdorff_mean, hausdorff_rms, radius_ratio_a, radius_ratio_b
(of the triangles, 1 if equilateral), conformal_mean, conformal_max, area_mean, area_max (how much B
changes the triangles of A, 1 if not; for equal faces), note. What was not measured is
null, and so is an infinite PSNR.

Examples:
  anicodec compare dance.pc2 dance.anic
  anicodec compare 'frames/*.obj' 'decoded/*.ply' --json)";

struct CompareCommand {
  std::string a, b, mesh;
  bool json = false, surface = false, no_sted = false;
};

/// What was measured, and why not more.
struct Measured {
  double diagonal = 0;
  std::optional<Comparison> vertices;
  std::optional<SurfaceComparison> surface;
  std::optional<TriangleComparison> triangles;
  std::string note;
};

/// Passes frames on and shows how far a comparison is.
FrameSource watched(FrameSource frames, uint32_t count, ProgressLine& line) {
  return [frames = std::move(frames), count, &line](uint32_t f) {
    line.show("comparing", static_cast<double>(f) / count);
    return frames(f);
  };
}

Measured measure(const ComparedClip& a, const ComparedClip& b, const CompareCommand& command,
                 ProgressLine& line) {
  const MeshSequence &p = a.sequence(), &q = b.sequence();
  if (p.frame_count != q.frame_count)
    throw Error(ErrorKind::kInput, fmt::format("{}: {} frames, but {} has {}", b.path(),
                                               q.frame_count, a.path(), p.frame_count));
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
  if (by_vertex) {
    CompareOptions options;
    options.sted = !command.no_sted;
    m.vertices = compare(p.polygons, p.vertex_count, frames, watched(a.frames(), frames, line),
                         b.frames(), options);
    m.diagonal = m.vertices->diagonal;
  }
  if (!by_vertex || command.surface) {
    m.surface = compare_surfaces(p.polygons, watched(a.frames(), frames, line), q.polygons,
                                 b.frames(), frames);
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

void print_json(const ComparedClip& a, const ComparedClip& b, const Measured& m) {
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
  json["note"] = m.note;
  fmt::print("{}\n", json.dump(2));
}

void print_text(const ComparedClip& b, const Measured& m, int verbosity) {
  auto row = [](const char* name, const std::string& value) {
    fmt::print("{:<20} {}\n", name, value);
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
    row("displacement error", fmt::format("{:.4g}", c->displacement_error));
  }
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
  ComparedClip a(command.a, command.mesh, line.callback());
  ComparedClip b(command.b, command.mesh, line.callback());
  Measured measured = measure(a, b, command, line);
  line.clear();
  if (command.json)
    print_json(a, b, measured);
  else
    print_text(b, measured, common.verbosity);
}

}  // namespace

void add_compare(CLI::App& app, CommonOptions& common) {
  auto c = std::make_shared<CompareCommand>();
  CLI::App* command = add_command(
      app, common, {"compare", "A B [options]", "Measure how far two clips are apart", kFooter},
      [c, &common] { run(*c, common); });
  command->add_option("A", c->a, "The original")->required();
  command->add_option("B", c->b, "What is compared with it")->required();
  command->add_option("--mesh", c->mesh, "Mesh of a vertex cache (default: same stem beside it)")
      ->option_text("FILE");
  command->add_flag("--surface", c->surface, "Measure the distance of the surfaces as well");
  command->add_flag("--no-sted", c->no_sted, "Leave out STED, which takes most of the time");
  command->add_flag("--json", c->json, "Print one JSON object");
}

}  // namespace anicodec::tools
