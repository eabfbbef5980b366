// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "codec/studies/basis_error.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/load_sequence.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/report/report.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr const char* kAnalyzeFooter =
    R"(Expresses the clip by K exact key-frames, chosen by Neural Gas (gas), pivoting (pivot) or evenly
(uniform), with free weights (linear), weights that sum to one, or those and a rigid motion of each
frame (rigid), and by K principal components (pca). Nothing is quantised. The table holds KG errors
in per cent; --csv prints method,k,kg,rmse.

--spaces shows principal components of three shape spaces instead: of positions (vertices), of edge
lengths and dihedral angles, rebuilt by multi-scale geometry interpolation (edges), and of
deformation gradients (gradients); frames are compared after the best rigid motion. Beside each
error stand the bytes of mean, components and weights as float32. --csv prints
space,k,kg,numbers,bytes,residual_percent: numbers of one component, and the per cent of the
variance in the space itself that the components leave.

With -o, or --json, the clip is encoded at two errors instead, which takes about as long as encode
with the same --effort: sizes, where bytes and errors are, pictures, and the clip in a player.
--full measures more, for some minutes: sizes at several errors, also with key-frames alone and with
other codecs, key-frames and shape spaces. The page needs nothing but a browser; --json prints its
numbers: name, vertices, faces, frames, frame_rate, diagonal, rates (codec, bytes, bpfv, kg,
max_error_percent, sted), shown_kg, shown_bytes, shares, frame_errors (rmse, max_error),
basis_errors (method, k, kg, rmse), shape_spaces (space, k, kg, numbers, bytes, residual_percent).
With -o x.svg the curves of size against KG error alone.

--massage-study measures instead what anicodec massage does to the clip: KG errors in K principal
components and sizes, of the clip as it is and massaged, how far the surface moved, and the shapes
of the triangles. With --csv: series,x,original,massaged, where series is pca (x components, KG
errors) or bytes (x KG error); with --json components (k, original, massaged), sizes (kg, original,
massaged), hausdorff_mean_percent, hausdorff_rms_percent, hausdorff_percent, before and after
(conformal_mean, area_mean, radius_ratio, turned). With -o it is a section of the page, and
"massage" in its JSON.

Examples:
  anicodec analyze dance.obj dance.pc2
  anicodec analyze dance.obj dance.pc2 -o report.html
  anicodec analyze dance.obj dance.pc2 --full -o rates.svg
  anicodec analyze 'frames/*.obj' --counts 5,10,20,45 --csv > errors.csv
  anicodec analyze dance.obj dance.pc2 --spaces)";

struct AnalyzeCommand {
  std::vector<std::string> inputs;
  std::string mesh, clip, rate, output;
  std::string counts = "1,2,5,10,15,20,30,45,60,80,100";
  bool csv = false, spaces = false, massage = false, full = false;
  Effort effort = Effort::kNormal;
};

void print_csv(const std::vector<BasisError>& rows) {
  fmt::print("method,k,kg,rmse\n");
  for (const BasisError& row : rows)
    fmt::print("{},{},{:.6g},{:.6g}\n", row.method, row.k, row.kg, row.rmse);
}

void print_csv(const std::vector<ShapeSpaceError>& rows) {
  fmt::print("space,k,kg,numbers,bytes,residual_percent\n");
  for (const ShapeSpaceError& row : rows)
    fmt::print("{},{},{:.6g},{},{},{:.6g}\n", row.space, row.k, row.kg, row.numbers, row.bytes,
               row.residual_percent);
}

/// A number of something with so many elements.
struct Cell {
  std::string row;
  size_t k;
  std::string text;
};

/// A row for every name, a column for every k.
void print_table(const std::string& title, const std::vector<Cell>& cells) {
  std::vector<std::string> names;
  std::vector<size_t> counts;
  for (const Cell& cell : cells) {
    if (std::find(names.begin(), names.end(), cell.row) == names.end())
      names.push_back(cell.row);
    if (std::find(counts.begin(), counts.end(), cell.k) == counts.end())
      counts.push_back(cell.k);
  }
  std::sort(counts.begin(), counts.end());
  fmt::print("{:<20}", title);
  for (size_t k : counts)
    fmt::print(" {:>8}", k);
  fmt::print("\n");
  for (const std::string& name : names) {
    fmt::print("{:<20}", name);
    for (size_t k : counts) {
      auto cell = std::find_if(cells.begin(), cells.end(),
                               [&](const Cell& c) { return c.row == name && c.k == k; });
      fmt::print(" {:>8}", cell == cells.end() ? "" : cell->text);
    }
    fmt::print("\n");
  }
}

void print_table(const std::vector<BasisError>& rows) {
  std::vector<Cell> cells;
  for (const BasisError& row : rows)
    cells.push_back({row.method, row.k, fmt::format("{:#.4g}", row.kg)});
  print_table("KG error in % at k =", cells);
}

void print_table(const std::vector<ShapeSpaceError>& rows) {
  std::vector<Cell> errors, sizes;
  for (const ShapeSpaceError& row : rows) {
    errors.push_back({row.space, row.k, fmt::format("{:#.4g}", row.kg)});
    sizes.push_back({row.space, row.k, readable_bytes(row.bytes)});
  }
  print_table("KG error in % at k =", errors);
  print_table("float32 at k =", sizes);
}

void run(const AnalyzeCommand& command, const CommonOptions& common) {
  std::vector<size_t> counts = parse_counts(command.counts, "--counts");
  const std::string kind = std::filesystem::path(command.output).extension();
  std::optional<AtomicFile> output;
  if (!command.output.empty()) {
    if (kind != ".html" && kind != ".svg")
      throw Error(ErrorKind::kUsage,
                  command.output + ": is of unknown kind; .html and .svg can be written");
    output.emplace(command.output, common.overwrite);
  }
  ProgressLine line(common.quiet);
  LoadOptions options;
  options.mesh = command.mesh;
  options.clip = command.clip;
  options.progress = line.callback();
  if (!command.rate.empty())
    options.rate = parse_frame_rate(command.rate);
  MeshSequence sequence = load_sequence(command.inputs, options);
  std::optional<MassageStudy> massage;
  if (command.massage) {
    try {
      massage = study_massage(sequence, counts, command.effort, options.progress);
    } catch (const Error& e) {
      throw Error(e.kind(), fmt::format("{}: {}", command.inputs[0], e.what()));
    }
  }
  if (massage && !output) {
    line.clear();
    if (common.json)
      print_json(massage_json(*massage));
    else
      fmt::print("{}", command.csv ? massage_csv(*massage) : massage_text(*massage));
    return;
  }
  if (output || common.json) {
    Report report = make_report(sequence, {command.effort, command.full, counts, options.progress});
    report.massage = std::move(massage);
    if (output) {
      output->write(kind == ".svg" ? rate_figure(report) : report_page(report));
      output->commit();
    }
    line.clear();
    if (common.json)
      print_json(report_json(report));
    else if (command.csv && command.spaces)
      print_csv(report.shape_spaces);
    else if (command.csv)
      print_csv(report.basis_errors);
    else if (!common.quiet)
      print_line("{}: {} frames of {} vertices, {} ways of storing them", command.output,
                 report.frames, report.vertices, report.rates.size());
    return;
  }
  line.show("analysing", 0);
  if (command.spaces) {
    check(sequence);
    const std::vector<ShapeSpaceError> rows = shape_space_errors(sequence, counts);
    line.clear();
    if (command.csv)
      print_csv(rows);
    else
      print_table(rows);
    return;
  }
  KeyframeFitter fitter{FrameView(sequence)};
  std::vector<BasisError> rows = basis_errors(fitter, counts);
  line.clear();
  if (command.csv)
    print_csv(rows);
  else
    print_table(rows);
}

}  // namespace

void add_analyze(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<AnalyzeCommand>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kThreads | kJson,
                  {"analyze", "INPUT... [options]",
                   "Error against key-frames and components; a report", kAnalyzeFooter},
                  [c, &common] { run(*c, common); });
  options.arguments("INPUT", c->inputs, "As for encode").required();
  options.option("--mesh", c->mesh, "FILE|NAME",
                 "Mesh of a lone vertex cache (default: same stem beside it), "
                 "or the name of one in a scene (default: all)");
  options.option("--clip", c->clip, "NAME|INDEX", "Animation of a scene, or none");
  options.option("--fps", c->rate, "N[/D]", "Frames per second (default: as for encode)");
  options.option("--counts", c->counts, "K,K,...", "Numbers of components to try");
  options.option("-o,--output", c->output, "REPORT.html|x.svg",
                 "Write a report with charts and pictures");
  options.choice("--effort", c->effort, {kEfforts},
                 "Effort of the report's encodings (default normal)");
  options.flag("--full", c->full, "Report other codecs, key-frames and shape spaces, too");
  options.flag("--spaces", c->spaces, "Principal components of three shape spaces instead");
  options.flag("--massage-study", c->massage, "Measure what Mesh Massage does to the clip instead");
  options.flag("--csv", c->csv, "Print comma-separated values");
  options.exclude({"--csv", "--json"});
}

}  // namespace anicodec::tools
