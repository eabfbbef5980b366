// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "corpus/poses.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tools/inputs/encode_arguments.h"
#include "tools/io/base/frame_rate.h"
#include "tools/program/command.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace anicodec::bench {
namespace {

constexpr const char* kFooter =
    R"(A CLIP is the name of a clip of the corpus (waves), the name of a mesh and its cache in the folder
$ANICODEC_DATA (classic/dance), or files joined by commas (mesh.obj,cache.pc2). INPUT is names of
clips, or together the files of one clip as anicodec encode takes them.)";

struct Arguments {
  std::vector<std::string> inputs, clips, without;
  BenchOptions bench;
  bool json = false, csv = false;
  std::vector<double> kg{0.1, 0.02};
  double one_kg = 0.1;
  double max_error = 0.002;
  std::string fps;
  int runs = 5;
  uint32_t vertices = 210000, frame_count = 100, shapes = 30;
  uint32_t live_frames = 30;
  double key_every = 4, live_max_error = 0;
  std::vector<uint32_t> play_vertices{7000, 42000, 210000}, components{16, 43, 100, 163};
  std::vector<uint32_t> blend_vertices = {7000, 42000};
  std::vector<uint32_t> encode_vertices{1000, 10000}, encode_frames{50, 200};
  uint32_t step = 8;
  std::vector<uint32_t> keyframes{4, 8};
  std::vector<uint32_t> sizes{7000, 42000, 210000};
  std::string parts = "sliding,auto,fit,transfer";
  double edges = 0.3;
  uint32_t first_frames = 0;

  void print(const std::string& command, const std::vector<Table>& tables) const {
    TableStyle style = csv ? TableStyle::kCsv : TableStyle::kText;
    if (json) {
      nlohmann::ordered_json all{{"command", command}};
      all["rows"] = nlohmann::ordered_json::array();
      for (const Table& table : tables)
        all["rows"].insert(all["rows"].end(), table.rows().begin(), table.rows().end());
      fmt::print("{}\n", all.dump(2));
      return;
    }
    for (size_t i = 0; i < tables.size(); ++i)
      fmt::print("{}{}", i ? "\n" : "", tables[i].print(style));
  }
};

using Run = std::function<std::vector<Table>(Arguments&)>;

/// Shared by the commands: their table, the values of their options, and the common options.
struct Bench {
  tools::Commands& commands;
  tools::CommonOptions& common;
  Arguments& arguments;
};

tools::Options& add(Bench& bench, const char* name, const char* description, const Run& run,
                    const char* footer = kFooter) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      tools::add_command(bench.commands, bench.common, tools::kVerbose | tools::kThreads,
                         {name, "[INPUT...] [options]", description, footer}, [bench, name, run] {
                           bench.arguments.bench.verbose = bench.common.verbosity > 0;
                           bench.arguments.print(name, run(bench.arguments));
                         });
  options.arguments("INPUT", a.inputs, "Names of clips, or the files of one clip");
  options.repeated("--clip", a.clips, "CLIP", "A clip; may be repeated");
  options.choice("--effort", a.bench.effort, {tools::kEfforts},
                 "As for anicodec encode (default normal)");
  options.flag("--json", a.json, "Print one JSON object");
  options.flag("--csv", a.csv, "Print comma-separated values");
  options.exclude({"--json", "--csv"});
  return options;
}

constexpr tools::Word<BasisChoice> kBases[] = {
    {BasisChoice::kAuto, "auto"},
    {BasisChoice::kKeyframes, "keyframes"},
    {BasisChoice::kEigenshapes, "eigenshapes"},
    {BasisChoice::kEigentrajectories, "eigentrajectories"}};

void add_basis(tools::Options& options, Arguments& a) {
  options.choice("--basis", a.bench.basis, {kBases}, "Kind of basis (default auto)");
}

/// Above 0.
constexpr tools::Bounds<double> kPositive = {std::numeric_limits<double>::min()};

void add_rate(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "rate", "Bytes at a KG error, where they go, and raw caches", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_rate(args.bench, args.kg)};
      });
  options.numbers("--kg", a.kg, "PCT,...", kPositive, "KG errors in per cent (default 0.1,0.02)");
  add_basis(options, a);
}

void add_gltf(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options = add(
      bench, "gltf", "Bytes of glTF files' clips, against those of the files",
      [](Arguments& args) {
        args.bench.clips = args.clips;
        args.bench.clips.insert(args.bench.clips.begin(), args.inputs.begin(), args.inputs.end());
        std::optional<FrameRate> rate;
        if (!args.fps.empty())
          rate = tools::parse_frame_rate(args.fps);
        return std::vector{run_gltf(args.bench, args.one_kg, rate)};
      },
      "INPUT and CLIP are .gltf and .glb files, FILE@ANIMATION for other than the first animation\n"
      "that moves something.");
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.option("--fps", a.fps, "N[/D]", "Frames per second (default: the rate of the keys)");
}

void add_near(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options = add(
      bench, "near", "Bytes at a small maximum error, against frame deltas", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_near(args.bench, args.max_error)};
      });
  options.number("--max-error", a.max_error, "PCT", kPositive,
                 "Per cent of the diagonal (default 0.002)");
  add_basis(options, a);
}

void add_lossless(Bench& bench) {
  add_basis(add(bench, "lossless", "Bytes of lossless files, against zstd and xz",
                [](Arguments& args) {
                  args.bench.clips = clip_words(args.inputs, args.clips);
                  return std::vector{run_lossless(args.bench)};
                }),
            bench.arguments);
}

void add_ablate(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "ablate", "Bytes without each thing that the search may do", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_ablate(args.bench, args.one_kg, args.without)};
      });
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.repeated("--without", a.without, "NAME", "One thing; may be repeated (default: each)");
  add_basis(options, a);
}

void add_encode(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options = add(
      bench, "encode", "Time and memory to encode, by one thread and by all", [](Arguments& args) {
        if (!args.inputs.empty() || !args.clips.empty())
          args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{
            run_encode(args.bench, args.one_kg, args.encode_vertices, args.encode_frames)};
      });
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.numbers("--vertices", a.encode_vertices, "N,...", {1},
                  "Vertices of generated limbs, without INPUT (default 1000,10000)");
  options.numbers("--frame-counts", a.encode_frames, "N,...", {1},
                  "Frames of generated limbs (default 50,200)");
  add_basis(options, a);
}

void add_decode(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "decode", "Time to open and play, against Draco", [](Arguments& args) {
        std::vector<Table> tables;
        // The large clip first: its peak memory is that of the process.
        if (args.vertices > 0)
          tables.push_back(
              run_large(args.bench, args.vertices, args.frame_count, args.shapes, args.runs));
        if (!args.inputs.empty() || !args.clips.empty() || tables.empty()) {
          args.bench.clips = clip_words(args.inputs, args.clips);
          tables.push_back(run_decode(args.bench, args.one_kg, args.runs));
        }
        return tables;
      });
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.number("--runs", a.runs, "N", {1, 1000}, "Runs to take the median of (default 5)");
  options.number("--vertices", a.vertices, "N", {},
                 "Vertices of the generated clip (default 210000; 0: none)");
  options.number("--frame-count", a.frame_count, "N", {},
                 "Frames of the generated clip (default 100)");
  options.number("--shapes", a.shapes, "N", {}, "Shapes of the generated clip (default 30)");
  add_basis(options, a);
}

void add_open(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "open", "Bytes and time to open, step by step, smallest and balanced",
          [](Arguments& args) {
            args.bench.clips = clip_words(args.inputs, args.clips);
            return std::vector{run_open(args.bench, args.one_kg, args.runs)};
          });
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.number("--runs", a.runs, "N", {1, 1000}, "Runs to take the median of (default 5)");
  add_basis(options, a);
}

void add_live(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "live", "Bytes of live streams and whole clips, time to encode and open files",
          [](Arguments& args) {
            args.bench.clips = clip_words(args.inputs, args.clips);
            const Target target = args.live_max_error > 0
                                      ? Target{ErrorMetric::kMaxError, args.live_max_error, true}
                                      : Target{ErrorMetric::kKg, args.one_kg, false};
            return std::vector{
                run_live(args.bench, target, args.live_frames, args.key_every, args.runs)};
          });
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.number("--frames", a.live_frames, "N", {1, 100000}, "Frames of a file (default 30)");
  options.number("--max-error", a.live_max_error, "PCT", kPositive,
                 "Largest error, in per cent of the whole clip's diagonal, instead");
  options.number("--key-every", a.key_every, "SECONDS", {0, 1e6},
                 "As for anicodec encode (default 4)");
  options.number("--runs", a.runs, "N", {1, 1000}, "Runs to take the median of (default 5)");
  add_basis(options, a);
}

void add_play(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options = add(
      bench, "play", "Time to play a frame, against Draco, Eigen and the machine's limits",
      [](Arguments& args) {
        if (!args.inputs.empty() || !args.clips.empty())
          args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_play(args.bench, args.play_vertices, args.components, args.runs)};
      });
  options.numbers("--vertices", a.play_vertices, "N,...", {},
                  "Vertices (default 7000,42000,210000; 0: none)");
  options.numbers("--components", a.components, "N,...", {}, "Components (default 16,43,100,163)");
  options.number("--runs", a.runs, "N", {1, 1000}, "Runs to take the median of (default 5)");
}

void add_blend(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "blend", "Time of a frame of one clip, and of a cross-fade of two",
          [](Arguments& args) {
            return std::vector{run_blend(args.bench, args.blend_vertices, args.runs)};
          });
  options.numbers("--vertices", a.blend_vertices, "N,...", {1}, "Vertices (default 7000,42000)");
  options.number("--runs", a.runs, "N", {1, 1000}, "Pairs to take the median of (default 5)");
}

void add_auto(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "auto", "Bytes with each kind of basis and with auto", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_auto(args.bench, args.one_kg)};
      });
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
}

void add_poses(Bench& bench) {
  add(bench, "poses", "Errors of interpolations half way between two poses", [](Arguments& args) {
    std::vector<std::string> words = args.clips;
    words.insert(words.begin(), args.inputs.begin(), args.inputs.end());
    if (words.empty()) {
      for (std::string_view name : corpus::pose_names())
        words.emplace_back(name);
    }
    return std::vector{run_poses(words)};
  });
}

void add_between(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "between", "KG error of interpolated in-betweens", [](Arguments& args) {
        return std::vector{run_between(clip_words(args.inputs, args.clips), args.step)};
      });
  options.number("--step", a.step, "N", {2, 1000}, "Every which frame is kept (default 8)");
}

void add_keyframes(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "keyframes", "KG error of clips coded by a few key-frames", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_keyframes(args.bench, args.keyframes)};
      });
  options.numbers("--counts", a.keyframes, "N,...", {1, 10000},
                  "Numbers of key-frames (default 4,8)");
}

void add_mesh(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "mesh", "Bytes and time of connectivity, against Draco", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_mesh(args.bench, args.runs)};
      });
  options.number("--runs", a.runs, "N", {1, 1000}, "Runs to take the median of (default 5)");
}

void add_pose(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "pose", "Bytes and time of a reference pose, against Draco", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_static_pose(args.bench, args.one_kg, args.runs)};
      });
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.number("--runs", a.runs, "N", {1, 1000}, "Runs to take the median of (default 5)");
}

void add_msgi(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "msgi", "Time of multi-scale geometry interpolation",
          [](Arguments& args) { return std::vector{run_msgi_speed(args.sizes, args.runs)}; });
  options.numbers("--sizes", a.sizes, "N,...", {200, 10000000},
                  "Vertices (default 7000,42000,210000)");
  options.number("--runs", a.runs, "N", {1, 1000}, "Runs to take the median of (default 5)");
}

/// The words between commas.
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    words.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

void add_massage(Bench& bench) {
  Arguments& a = bench.arguments;
  tools::Options& options =
      add(bench, "massage", "What the massage does to clips", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        std::vector<Table> tables;
        for (const std::string& part : words_of(args.parts)) {
          if (part == "sliding")
            tables.push_back(
                run_massage_sliding(args.bench, args.one_kg, args.edges, args.first_frames));
          else if (part == "auto")
            tables.push_back(run_massage_auto(args.bench, args.one_kg));
          else if (part == "fit")
            tables.push_back(run_massage_fit(args.bench));
          else
            tables.push_back(run_massage_transfer(args.bench, args.first_frames));
        }
        return tables;
      });
  options.option("--parts", a.parts, "PART,...", "sliding, auto, fit, transfer (default all)");
  options.number("--kg", a.one_kg, "PCT", kPositive, "KG error in per cent (default 0.1)");
  options.number("--edges", a.edges, "X", kPositive,
                 "Noise of sliding vertices in edges (default 0.3)");
  options.number("--first-frames", a.first_frames, "N", {},
                 "Use only so many frames (default all)");
}

void declare(tools::Commands& commands, tools::CommonOptions& common, Arguments& arguments) {
  Bench bench{commands, common, arguments};
  for (auto add_bench : {add_rate, add_gltf, add_near, add_lossless, add_ablate, add_encode,
                         add_decode, add_open, add_live, add_play, add_blend, add_auto, add_poses,
                         add_between, add_keyframes, add_mesh, add_pose, add_msgi, add_massage})
    add_bench(bench);
}

}  // namespace
}  // namespace anicodec::bench

int main(int argc, char** argv) {
  using namespace anicodec;
  bench::Arguments arguments;
  return tools::run_program(
      {"anicodec_bench", "Measures anicodec on clips against other ways to store them.",
       bench::kFooter,
       [&](tools::Commands& commands, tools::CommonOptions& common) {
         bench::declare(commands, common, arguments);
       }},
      argc, argv);
}
