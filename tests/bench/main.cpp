// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "corpus/poses.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tools/io/base/frame_rate.h"

#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

namespace anicodec::bench {
namespace {

constexpr const char* kFooter = R"(
A CLIP is the name of a clip of the corpus (waves), the name of a mesh and its cache in the folder
$ANICODEC_DATA (classic/dance), or files joined by commas (mesh.obj,cache.pc2). INPUT is names of
clips, or together the files of one clip as anicodec encode takes them.)";

struct Arguments {
  std::vector<std::string> inputs, clips;
  BenchOptions bench;
  bool json = false, csv = false;
  int threads = 0;
  std::vector<double> kg{0.1, 0.02};
  double one_kg = 0.1;
  double max_error = 0.002;
  std::string fps;
  bool normals = false;
  int runs = 5;
  uint32_t vertices = 210000, frames = 100, shapes = 30;
  std::vector<uint32_t> play_vertices{7000, 42000, 210000}, components{16, 43, 100, 163};
  uint32_t step = 8;
  std::vector<uint32_t> keyframes{4, 8};
  std::vector<uint32_t> sizes{7000, 42000, 210000};
  std::vector<std::string> parts{"sliding", "auto", "fit", "transfer"};
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

CLI::App* add(CLI::App& app, Arguments& a, const char* name, const char* description,
              const Run& run) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(kFooter);
  command->add_option("INPUT", a.inputs, "Names of clips, or the files of one clip");
  command->add_option("--clip", a.clips, "A clip; may be repeated")
      ->option_text("CLIP")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--effort", a.bench.effort, "As for anicodec encode (default 5)")
      ->option_text("N")
      ->check(CLI::Range(1, 9));
  command->add_option("-j,--threads", a.threads, "Threads of the encoder (default: all)")
      ->option_text("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("-v,--verbose", a.bench.verbose, "Trials and times of the encoder on stderr");
  CLI::Option* json = command->add_flag("--json", a.json, "Print one JSON object");
  command->add_flag("--csv", a.csv, "Print comma-separated values")->excludes(json);
  command->callback([&a, name, run] {
    std::optional<tbb::global_control> limit;
    if (a.threads > 0)
      limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(a.threads));
    a.print(name, run(a));
  });
  return command;
}

void add_basis(CLI::App& command, Arguments& a) {
  command.add_option("--basis", a.bench.basis, "Kind of basis (default auto)")
      ->transform(CLI::CheckedTransformer(std::vector<std::pair<std::string, BasisChoice>>{
          {"auto", BasisChoice::kAuto},
          {"keyframes", BasisChoice::kKeyframes},
          {"eigenshapes", BasisChoice::kEigenshapes},
          {"eigentrajectories", BasisChoice::kEigentrajectories}}));
}

void add_rate(CLI::App& app, Arguments& a) {
  CLI::App* command = add(app, a, "rate", "Bytes at a KG error, against Draco and frame deltas",
                          [](Arguments& args) {
                            args.bench.clips = clip_words(args.inputs, args.clips);
                            return std::vector{run_rate(args.bench, args.kg)};
                          });
  command->add_option("--kg", a.kg, "KG errors in per cent (default 0.1,0.02)")
      ->option_text("PCT,...")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  add_basis(*command, a);
}

void add_gltf(CLI::App& app, Arguments& a) {
  CLI::App* command =
      add(app, a, "gltf", "Bytes of glTF files' clips, against gltfpack", [](Arguments& args) {
        args.bench.clips = args.clips;
        args.bench.clips.insert(args.bench.clips.begin(), args.inputs.begin(), args.inputs.end());
        std::optional<FrameRate> rate;
        if (!args.fps.empty())
          rate = tools::parse_frame_rate(args.fps);
        return std::vector{run_gltf(args.bench, args.one_kg, rate, args.normals)};
      });
  command->footer(
      "\nINPUT and CLIP are .gltf and .glb files, FILE@ANIMATION for other than the first "
      "animation\nthat moves something.");
  command->add_option("--kg", a.one_kg, "KG error in per cent (default 0.1)")
      ->option_text("PCT")
      ->check(CLI::PositiveNumber);
  command->add_option("--fps", a.fps, "Frames per second (default: the rate of the keys)")
      ->option_text("N[/D]");
  command->add_flag("--normals", a.normals,
                    "With normals of every frame, and texture coordinates on our side");
}

void add_near(CLI::App& app, Arguments& a) {
  CLI::App* command = add(app, a, "near", "Bytes at a small maximum error, against frame deltas",
                          [](Arguments& args) {
                            args.bench.clips = clip_words(args.inputs, args.clips);
                            return std::vector{run_near(args.bench, args.max_error)};
                          });
  command->add_option("--max-error", a.max_error, "Per cent of the diagonal (default 0.002)")
      ->option_text("PCT")
      ->check(CLI::PositiveNumber);
  add_basis(*command, a);
}

void add_decode(CLI::App& app, Arguments& a) {
  CLI::App* command =
      add(app, a, "decode", "Time to open and play, against Draco", [](Arguments& args) {
        std::vector<Table> tables;
        // The large clip first: its peak memory is that of the process.
        if (args.vertices > 0)
          tables.push_back(
              run_large(args.bench, args.vertices, args.frames, args.shapes, args.runs));
        if (!args.inputs.empty() || !args.clips.empty() || tables.empty()) {
          args.bench.clips = clip_words(args.inputs, args.clips);
          tables.push_back(run_decode(args.bench, args.one_kg, args.runs));
        }
        return tables;
      });
  command->add_option("--kg", a.one_kg, "KG error in per cent (default 0.1)")
      ->option_text("PCT")
      ->check(CLI::PositiveNumber);
  command->add_option("--runs", a.runs, "Runs to take the median of (default 5)")
      ->option_text("N")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--vertices", a.vertices,
                   "Vertices of the generated clip (default 210000; 0: none)")
      ->option_text("N");
  command->add_option("--frames", a.frames, "Frames of the generated clip (default 100)")
      ->option_text("N");
  command->add_option("--shapes", a.shapes, "Shapes of the generated clip (default 30)")
      ->option_text("N");
  add_basis(*command, a);
}

void add_play(CLI::App& app, Arguments& a) {
  CLI::App* command = add(
      app, a, "play", "Time to play a frame, against Draco, Eigen and the machine's limits",
      [](Arguments& args) {
        if (!args.inputs.empty() || !args.clips.empty())
          args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_play(args.bench, args.play_vertices, args.components, args.runs)};
      });
  command
      ->add_option("--vertices", a.play_vertices, "Vertices (default 7000,42000,210000; 0: none)")
      ->option_text("N,...")
      ->delimiter(',');
  command->add_option("--components", a.components, "Components (default 16,43,100,163)")
      ->option_text("N,...")
      ->delimiter(',');
  command->add_option("--runs", a.runs, "Runs to take the median of (default 5)")
      ->option_text("N")
      ->check(CLI::Range(1, 1000));
}

void add_auto(CLI::App& app, Arguments& a) {
  CLI::App* command =
      add(app, a, "auto", "Bytes with each kind of basis and with auto", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_auto(args.bench, args.one_kg)};
      });
  command->add_option("--kg", a.one_kg, "KG error in per cent (default 0.1)")
      ->option_text("PCT")
      ->check(CLI::PositiveNumber);
}

void add_poses(CLI::App& app, Arguments& a) {
  add(app, a, "poses", "Errors of interpolations half way between two poses", [](Arguments& args) {
    std::vector<std::string> words = args.clips;
    words.insert(words.begin(), args.inputs.begin(), args.inputs.end());
    if (words.empty()) {
      for (std::string_view name : corpus::pose_names())
        words.emplace_back(name);
    }
    return std::vector{run_poses(words)};
  });
}

void add_between(CLI::App& app, Arguments& a) {
  CLI::App* command =
      add(app, a, "between", "KG error of interpolated in-betweens", [](Arguments& args) {
        return std::vector{run_between(clip_words(args.inputs, args.clips), args.step)};
      });
  command->add_option("--step", a.step, "Every which frame is kept (default 8)")
      ->option_text("N")
      ->check(CLI::Range(2, 1000));
}

void add_keyframes(CLI::App& app, Arguments& a) {
  CLI::App* command =
      add(app, a, "keyframes", "KG error of clips coded by a few key-frames", [](Arguments& args) {
        args.bench.clips = clip_words(args.inputs, args.clips);
        return std::vector{run_keyframes(args.bench, args.keyframes)};
      });
  command->add_option("--counts", a.keyframes, "Numbers of key-frames (default 4,8)")
      ->option_text("N,...")
      ->delimiter(',')
      ->check(CLI::Range(1, 10000));
}

void add_msgi(CLI::App& app, Arguments& a) {
  CLI::App* command =
      add(app, a, "msgi", "Time of multi-scale geometry interpolation",
          [](Arguments& args) { return std::vector{run_msgi_speed(args.sizes, args.runs)}; });
  command->add_option("--sizes", a.sizes, "Vertices (default 7000,42000,210000)")
      ->option_text("N,...")
      ->delimiter(',')
      ->check(CLI::Range(200, 10000000));
  command->add_option("--runs", a.runs, "Runs to take the median of (default 5)")
      ->option_text("N")
      ->check(CLI::Range(1, 1000));
}

void add_massage(CLI::App& app, Arguments& a) {
  CLI::App* command = add(app, a, "massage", "What the massage does to clips", [](Arguments& args) {
    args.bench.clips = clip_words(args.inputs, args.clips);
    std::vector<Table> tables;
    for (const std::string& part : args.parts) {
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
  command->add_option("--parts", a.parts, "sliding, auto, fit, transfer (default all)")
      ->option_text("PART,...")
      ->delimiter(',')
      ->check(CLI::IsMember({"sliding", "auto", "fit", "transfer"}));
  command->add_option("--kg", a.one_kg, "KG error in per cent (default 0.1)")
      ->option_text("PCT")
      ->check(CLI::PositiveNumber);
  command->add_option("--edges", a.edges, "Noise of sliding vertices in edges (default 0.3)")
      ->option_text("X")
      ->check(CLI::PositiveNumber);
  command->add_option("--first-frames", a.first_frames, "Use only so many frames (default all)")
      ->option_text("N");
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  CLI::App app("Measures anicodec on clips against other ways to store them.", "anicodec_bench");
  app.require_subcommand(1);
  app.footer(kFooter);
  for (auto add_command : {add_rate, add_gltf, add_near, add_decode, add_play, add_auto, add_poses,
                           add_between, add_keyframes, add_msgi, add_massage})
    add_command(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : static_cast<int>(ErrorKind::kUsage);
  } catch (const Error& e) {
    fmt::print(stderr, "anicodec_bench: {}\n", e.what());
    return static_cast<int>(e.kind());
  }
  return std::fflush(stdout) == 0 ? 0 : static_cast<int>(ErrorKind::kInternal);
}

}  // namespace
}  // namespace anicodec::bench

int main(int argc, char** argv) {
  try {
    return anicodec::bench::run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "anicodec_bench: %s\n", e.what());
    return static_cast<int>(anicodec::ErrorKind::kInternal);
  }
}
