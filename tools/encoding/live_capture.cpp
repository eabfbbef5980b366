// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/encoding/live_capture.h"

#include "codec/live_queue.h"
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
#include <cmath>
#include <cstdio>
#include <cstring>
#include <future>
#include <limits>
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
        std::fflush(file_.get()) != 0 ||
        (file_.get() != stdout && !synchronize(::fileno(file_.get()))))
      throw Error(ErrorKind::kInternal,
                  fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
  }

 private:
  std::string path_;
  std::optional<AtomicFile> first_;  // until it is written
  std::unique_ptr<std::FILE, FileCloser> file_;
};

/// Reads a frame of the standard input; false at its end. Throws Error(kInput) for part of a frame.
bool read_frame(std::string& bytes, std::vector<float>& positions) {
  const size_t size = std::fread(bytes.data(), 1, bytes.size(), stdin);
  if (std::ferror(stdin))
    throw Error(ErrorKind::kInput,
                fmt::format("the standard input cannot be read: {}", std::strerror(errno)));
  if (size == 0)
    return false;
  if (size != bytes.size())
    throw Error(
        ErrorKind::kInput,
        fmt::format("the standard input ends inside a frame: {} of {} bytes ({} vertices of three "
                    "float32)",
                    size, bytes.size(), bytes.size() / 12));
  for (size_t i = 0; i < positions.size(); ++i)
    positions[i] = load<float>(bytes.data() + 4 * i, std::endian::little);
  return true;
}

/// Pushes the frames of the standard input from a thread of its own.
class FrameReader {
 public:
  explicit FrameReader(LiveQueue& queue)
      : queue_(queue), done_(std::async(std::launch::async, [this] { read(); })) {}

  ~FrameReader() {
    queue_.stop();  // where the files cannot be written, nobody makes room
    if (done_.valid())
      done_.wait();
  }

  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// Throws what the reading ended with.
  void finish() { done_.get(); }

 private:
  void read() {
    std::vector<float> positions(size_t{3} * queue_.mesh().vertex_count);
    std::string bytes(4 * positions.size(), '\0');
    try {
      while (read_frame(bytes, positions))
        queue_.push(positions, {}, kForever);
    } catch (...) {
      queue_.end();  // with the frames that are there
      throw;
    }
    queue_.end();
  }

  static constexpr double kForever = std::numeric_limits<double>::infinity();

  LiveQueue& queue_;
  std::future<void> done_;
};

MeshSequence load_mesh(const EncodeArguments& command) {
  if (command.inputs.size() != 1)
    throw Error(ErrorKind::kUsage, "encode --live: one INPUT is wanted, the mesh");
  MeshSequence mesh = load_sequence(command.inputs, load_options(command, {}));
  set_metadata(command, mesh);
  set_fields(command, {&mesh});
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
      print_line(
          stderr,
          "{:g} % is {:.4g}, of the diagonal {:.4g} of the first piece's box; --box gives another",
          target.value, bound_of(target, first.diagonal).value, first.diagonal);
  }
}

void check_goes_with(const EncodeArguments& command) {
  const auto refuse = [](bool given, const char* option) {
    if (given)
      throw Error(ErrorKind::kUsage,
                  fmt::format("{} needs all frames, and --live gets them one by one", option));
  };
  refuse(!command.part.empty(), "--part");
  refuse(!command.batch.empty(), "--batch");
  refuse(command.split_objects, "--split-objects");
  refuse(command.topology_changes != TopologyChanges::kRefuse, "--topology-changes");
  refuse(command.massage != MassageMode::kOff, "--massage");
  refuse(command.loop, "--loop");
  refuse(!command.events.empty(), "--event");
}

/// Prints the line of a file of the stream, at once: a program may wait for it.
void report(const QueuedPiece& piece, double rate, const CommonOptions& common) {
  if (common.json) {
    print_json({{"start", piece.start_time},
                {"length", piece.frames / rate},
                {"frames", piece.frames},
                {"bytes", piece.file.size()},
                {"key", piece.is_key},
                {"has_mesh", piece.has_mesh},
                {"max_error", piece.max_error},
                {"kg", piece.kg},
                {"seconds", piece.encode_seconds}});
    std::fflush(stdout);
  } else if (!common.quiet) {
    print_line(stderr, "{:.2f} s: {}, {} bytes, max error {:.4g}, KG {:.3g} %, encoded in {:.2f} s",
               piece.start_time, counted(piece.frames, "frame"), grouped(piece.file.size()),
               piece.max_error, piece.kg, piece.encode_seconds);
  }
}

}  // namespace

void encode_live(const EncodeArguments& command, const CommonOptions& common) {
  check_goes_with(command);
  MeshSequence mesh = load_mesh(command);
  EncodeOptions options = encode_options(command);
  set_target(command, mesh.metres_per_unit, &options);
  LiveOptions live;
  live.piece = command.piece;
  live.key_every = command.key_every;
  live.box = box_of(command, mesh.metres_per_unit);
  live.most_waiting =
      2 * static_cast<uint64_t>(std::max(1.0, std::ceil(live.piece * mesh.rate.value())));
  const double rate = mesh.rate.value();
  LiveQueue queue(std::move(mesh), options, live);
  GrowingOutput output(command.output, common.overwrite);
  FrameReader reader(queue);
  uint64_t bytes = 0;
  double seconds = 0;
  while (const std::optional<QueuedPiece> piece =
             queue.take(std::numeric_limits<double>::infinity())) {
    output.write(piece->file);
    if (bytes == 0 && live.box == 0 && !common.quiet && !common.json)
      report_bound(options, *piece);
    report(*piece, rate, common);
    bytes += piece->file.size();
    seconds += piece->frames / rate;
  }
  reader.finish();
  if (bytes == 0)
    throw Error(ErrorKind::kInput, "the standard input has no frame");
  if (!common.json && !common.quiet)
    print_line(stderr, "{:.2f} s: {} bytes, {:.1f} kbit/s", seconds, grouped(bytes),
               8e-3 * static_cast<double>(bytes) / seconds);
}

}  // namespace anicodec::tools
