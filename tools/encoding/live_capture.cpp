// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/encoding/live_capture.h"

#include "codec/encode_live.h"
#include "codec/sequence/error.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/files/synchronize.h"
#include "tools/io/load_sequence.h"
#include "tools/program/print.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const {
    if (file != stdout)
      std::fclose(file);
  }
};

/// An output that grows: each file of the stream is there, and on disk, as soon as it is written. The first one takes
/// the place of what was there before.
class GrowingOutput {
 public:
  GrowingOutput(const std::string& path, bool overwrite) : path_(path) {
    if (path == "-")
      file_.reset(stdout);
    else
      first_.emplace(path, overwrite);
  }

  void write(const Bytes& bytes) {
    if (first_) {
      first_->write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
      first_->commit();
      first_.reset();
      file_.reset(std::fopen(path_.c_str(), "ab"));
      return;
    }
    if (!file_ || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() ||
        std::fflush(file_.get()) != 0 || (file_.get() != stdout && !synchronize(::fileno(file_.get()))))
      throw Error(ErrorKind::kInternal, fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
  }

 private:
  std::string path_;
  std::optional<AtomicFile> first_;  // until it is written
  std::unique_ptr<std::FILE, FileCloser> file_;
};

/// Up to `frames` frames of the standard input; fewer at its end. Throws Error(kInput) for part of a frame.
FrameArray read_frames(size_t frames, size_t vertices) {
  const size_t frame_bytes = 12 * vertices;
  std::string bytes(frames * frame_bytes, '\0');
  const size_t size = std::fread(bytes.data(), 1, bytes.size(), stdin);
  if (std::ferror(stdin))
    throw Error(ErrorKind::kInput, fmt::format("the standard input cannot be read: {}", std::strerror(errno)));
  if (size % frame_bytes != 0)
    throw Error(ErrorKind::kInput,
                fmt::format("the standard input ends inside a frame: {} of {} bytes ({} vertices of three "
                            "float32)",
                            size % frame_bytes, frame_bytes, vertices));
  FrameArray positions(size / 4);
  for (size_t i = 0; i < positions.size(); ++i)
    positions[i] = load<float>(bytes.data() + 4 * i, std::endian::little);
  return positions;
}

MeshSequence load_mesh(const EncodeArguments& command) {
  if (command.inputs.size() != 1)
    throw Error(ErrorKind::kUsage, "encode --live: one INPUT is wanted, the mesh");
  MeshSequence mesh = load_sequence(command.inputs, load_options(command, {}));
  set_metadata(command, mesh);
  return mesh;
}

/// The diagonal that percentages are of, scene units; 0: that of the first piece.
double box_of(const EncodeArguments& command, double metres_per_unit) {
  if (command.box.empty())
    return 0;
  const Length length = parse_length(command.box, "--box").in_scene_units(metres_per_unit, "--box");
  if (length.percent)
    throw Error(ErrorKind::kUsage, "--box: percentages are of this length, so it is none itself");
  return length.value;
}

/// Says what a percentage of the first piece's box is.
void report_bound(const EncodeOptions& options, const EncodeResult& first) {
  for (const Target& target : {options.target, options.cap.value_or(Target{})}) {
    if (target.percent)
      print_line(stderr, "{:g} % is {:.4g}, of the diagonal {:.4g} of the first piece's box; --box gives another",
                 target.value, in_scene_units(target, first.diagonal).value, first.diagonal);
  }
}

void check_goes_with(const EncodeArguments& command) {
  const auto refuse = [](bool given, const char* option) {
    if (given)
      throw Error(ErrorKind::kUsage, fmt::format("{} needs all frames, and --live gets them one by one", option));
  };
  refuse(!command.part.empty(), "--part");
  refuse(!command.batch.empty(), "--batch");
  refuse(command.split_objects, "--split-objects");
  refuse(command.topology_changes != TopologyChanges::kRefuse, "--topology-changes");
  refuse(command.massage != MassageMode::kOff, "--massage");
  refuse(command.loop, "--loop");
  refuse(!command.events.empty(), "--event");
}

/// What is said of a file of the stream.
void report(const EncodeResult& result, double start, double seconds, const CommonOptions& common) {
  if (common.json)
    print_json({{"start", start}, {"frames", result.frames}, {"bytes", result.file.size()},
                {"max_error", result.max_error}, {"kg", result.kg}, {"seconds", seconds}});
  else if (!common.quiet)
    print_line(stderr, "{:.2f} s: {}, {} bytes, max error {:.4g}, KG {:.3g} %, encoded in {:.2f} s", start,
               counted(result.frames, "frame"), grouped(result.file.size()), result.max_error, result.kg,
               seconds);
}

}  // namespace

void encode_live(const EncodeArguments& command, const CommonOptions& common) {
  check_goes_with(command);
  MeshSequence mesh = load_mesh(command);
  EncodeOptions options = encode_options(command);
  set_target(command, mesh.metres_per_unit, &options);
  if (const double box = box_of(command, mesh.metres_per_unit); box > 0) {
    options.target = in_scene_units(options.target, box);
    if (options.cap)
      options.cap = in_scene_units(*options.cap, box);
  }
  const size_t vertices = mesh.vertex_count;
  const double rate = mesh.rate.value();
  const auto frames = static_cast<size_t>(std::max(1.0, std::round(command.piece * rate)));
  LiveEncoder encoder(std::move(mesh), options, command.key_every);
  GrowingOutput output(command.output, common.overwrite);
  // Frames are read while those before them are encoded.
  const auto read = [&] { return std::async(std::launch::async, read_frames, frames, vertices); };
  std::future<FrameArray> next = read();
  uint64_t first = 0;
  for (FrameArray positions; !(positions = next.get()).empty();) {
    next = read();
    const auto begin = std::chrono::steady_clock::now();
    EncodeResult result;
    try {
      result = encoder.encode(std::move(positions));
    } catch (const Error& e) {
      throw Error(e.kind(), fmt::format("the frames from {} on: {}", first, e.what()));
    }
    output.write(result.file);
    if (first == 0 && !common.quiet && !common.json)
      report_bound(options, result);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    report(result, static_cast<double>(first) / rate, took.count(), common);
    first += result.frames;
  }
  if (first == 0)
    throw Error(ErrorKind::kInput, "the standard input has no frame");
}

}  // namespace anicodec::tools
