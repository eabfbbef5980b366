// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/encoding/batch.h"

#include "codec/parallel/thread_count.h"
#include "codec/plan/encoding_memory.h"
#include "codec/sequence/error.h"
#include "format/checksum.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/files/output_folder.h"
#include "tools/io/files/staging.h"
#include "tools/io/files/synchronize.h"
#include "tools/program/print.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

/// Hashes values one after the other.
class ContentHash {
 public:
  template <typename T, typename Allocator>
  void add(const std::vector<T, Allocator>& values) {
    add(values.data(), values.size() * sizeof(T));
  }

  void add(const std::string& text) { add(text.data(), text.size()); }

  template <typename T>
  void add_value(T value) {
    add(&value, sizeof value);
  }

  uint64_t digest() const {
    return xxh64(
        {reinterpret_cast<const uint8_t*>(parts_.data()), parts_.size() * sizeof(uint64_t)});
  }

 private:
  void add(const void* data, size_t size) {
    parts_.push_back(size);
    parts_.push_back(xxh64({static_cast<const uint8_t*>(data), size}));
  }

  std::vector<uint64_t> parts_;
};

/// Finished clips, each done once a file of its hash is there: a line "content output name" of two
/// hashes for each clip, the last one counts. Lines are only ever appended, so that runs may share
/// the file.
class Journal {
 public:
  explicit Journal(const std::string& folder)
      : path_((fs::path(folder) / ".anicodec-batch").string()) {
    std::string text, line;
    is_named_ = fs::exists(path_);
    if (is_named_)
      read_file(path_, text);
    torn_ = !text.empty() && text.back() != '\n';
    text.erase(text.rfind('\n') + 1);
    for (std::istringstream lines(text); std::getline(lines, line);) {
      const size_t first = line.find(' '), second = line.find(' ', first + 1);
      if (second != std::string::npos)
        done_[line.substr(second + 1)] = line.substr(0, second);
    }
  }

  bool has(const std::string& name, const std::string& hashes) const {
    auto found = done_.find(name);
    return found != done_.end() && found->second == hashes;
  }

  bool knows(const std::string& name) const { return done_.contains(name); }

  /// Has the line on disk when it returns.
  void add(const std::string& name, const std::string& hashes) {
    const std::lock_guard lock(mutex_);
    std::FILE* file = std::fopen(path_.c_str(), "a");
    // The line of a run that was killed may have no end.
    const std::string line = (torn_ ? "\n" : "") + hashes + " " + name + "\n";
    bool ok = file && std::fputs(line.c_str(), file) >= 0 && std::fflush(file) == 0 &&
              synchronize(::fileno(file));
    if (file)
      ok &= std::fclose(file) == 0;
    if (!is_named_)
      synchronize_folder(fs::path(path_).parent_path().string());
    is_named_ = true;
    torn_ = false;
    if (!ok)
      throw Error(ErrorKind::kInternal, path_ + ": cannot be written");
  }

 private:
  std::string path_;
  std::map<std::string, std::string> done_;
  bool is_named_ = false;  ///< on disk
  bool torn_ = false;
  std::mutex mutex_;
};

/// Memory shared by clips at work.
class Budget {
 public:
  explicit Budget(uint64_t bytes) : bytes_(bytes) {}

  /// Waits until there is room, or nobody else has any.
  void take(uint64_t bytes) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return used_ == 0 || used_ + bytes <= bytes_; });
    used_ += bytes;
  }

  void give(uint64_t bytes) {
    {
      const std::lock_guard lock(mutex_);
      used_ -= bytes;
    }
    changed_.notify_all();
  }

 private:
  uint64_t bytes_, used_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

struct Taken {
  Taken(Budget& from, uint64_t amount) : budget(from), bytes(amount) { budget.take(bytes); }

  Taken(const Taken&) = delete;
  Taken& operator=(const Taken&) = delete;

  ~Taken() { budget.give(bytes); }

  Budget& budget;
  uint64_t bytes;
};

/// The line about a clip that is there.
struct BatchLine {
  std::string text;
  nlohmann::ordered_json json;
};

uint64_t hash_of(std::string_view bytes) {
  return xxh64({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
}

std::string hashes(uint64_t content, uint64_t output) {
  return fmt::format("{:016x} {:016x}", content, output);
}

class Batch {
 public:
  Batch(const std::vector<BatchClip>& clips, const BatchOptions& options, const BatchLoad& load,
        const BatchEncode& encode)
      : clips_(clips),
        options_(options),
        load_(load),
        encode_(encode),
        journal_(options.folder),
        budget_(options.memory),
        faults_(clips.size()) {}

  void run() {
    recover();
    std::vector<std::future<void>> workers;  // which are waited for, also if one cannot be begun
    const unsigned jobs = std::min<unsigned>(options_.jobs, static_cast<unsigned>(clips_.size()));
    const unsigned all = std::max(1U, std::thread::hardware_concurrency());
    for (unsigned i = 0; i < jobs; ++i) {
      workers.push_back(std::async(std::launch::async, [this, threads = std::max(1U, all / jobs)] {
        with_threads(threads, [this] {
          for (size_t clip = next_++; clip < clips_.size(); clip = next_++)
            run_clip(clip);
        });
      }));
    }
    for (std::future<void>& worker : workers)
      worker.get();
    summarise();
  }

 private:
  std::string output_of(const BatchClip& clip) const {
    return (fs::path(options_.folder) / (clip.name + ".anic")).string();
  }

  /// A killed run may have left something although all clips are done, when nothing is written.
  void recover() const {
    std::set<std::string> folders;
    for (const BatchClip& clip : clips_)
      folders.insert(fs::path(output_of(clip)).parent_path().string());
    for (const std::string& folder : folders)
      recover_folder(folder);
  }

  void run_clip(size_t i) {
    const BatchClip& clip = clips_[i];
    try {
      std::vector<std::string> notes;
      BatchLine line = process(clip, notes);
      if (options_.json) {
        line.json["notes"] = notes;
        print(line.json);
      } else {
        print(i, line.text, options_.quiet, notes);
      }
    } catch (const Error& e) {
      fail(i, e.kind(), e.what());
    } catch (const std::bad_alloc&) {
      fail(i, ErrorKind::kInternal, "not enough memory");
    } catch (const std::exception& e) {
      fail(i, ErrorKind::kInternal, fmt::format("internal error: {}", e.what()));
    }
  }

  void fail(size_t i, ErrorKind kind, const std::string& reason) {
    faults_[i] = kind;
    if (options_.json)
      print({{"clip", clips_[i].name}, {"error", reason}, {"status", static_cast<int>(kind)}});
    else
      print(i, "FAILED: " + reason, false);
  }

  void print(size_t i, const std::string& text, bool quiet,
             const std::vector<std::string>& notes = {}) {
    const std::lock_guard lock(print_);
    ++finished_;
    if (!quiet) {
      print_line("[{}/{}] {}: {}", finished_, clips_.size(), clips_[i].name, text);
      for (const std::string& note : notes)
        print_line("  {}", note);
      std::fflush(stdout);
    }
  }

  void print(const nlohmann::ordered_json& json) {
    const std::lock_guard lock(print_);
    print_json(json);
    std::fflush(stdout);
  }

  BatchLine process(const BatchClip& clip, std::vector<std::string>& notes) {
    const std::string path = output_of(clip);
    // One clip is read at a time: until it has been, nobody knows how much memory it takes.
    std::unique_lock reading(read_);
    MeshSequence sequence = load_(clip, [&](const std::string& text) { notes.push_back(text); });
    const uint64_t bytes = sequence.positions.size() * sizeof(float);
    const EncodingMemory needs = EncodingMemory::of(sequence);
    const Taken memory(
        budget_, static_cast<uint64_t>(needs.kept({}) +
                                       static_cast<double>(thread_count()) * needs.thread({})));
    reading.unlock();

    ContentHash hash;
    hash.add_value(content_hash(sequence));
    hash.add(options_.settings);
    const uint64_t content = hash.digest();
    if (fs::exists(path)) {
      std::string before;
      read_file(path, before);
      if (journal_.has(clip.name, hashes(content, hash_of(before)))) {
        ++skipped_;
        output_bytes_ += before.size();
        return {
            fmt::format("{} bytes, done before", grouped(before.size())),
            {{"clip", clip.name}, {"file", path}, {"bytes", before.size()}, {"done_before", true}}};
      }
    }
    AtomicFile output(path, options_.overwrite || journal_.knows(clip.name));
    const EncodeResult result = encode_(clip, std::move(sequence));
    const std::string_view file(reinterpret_cast<const char*>(result.file.data()),
                                result.file.size());
    output.write(file);
    output.close();
    // First: a run that is killed in between must not take its own output for a stranger's.
    journal_.add(clip.name, hashes(content, hash_of(file)));
    output.commit();
    ++encoded_;
    output_bytes_ += file.size();
    const double ratio = static_cast<double>(bytes) / static_cast<double>(file.size());
    return {fmt::format("{} bytes, {:.1f} : 1, {} x {}, max error {:.4g}, KG {:.3g} %",
                        grouped(file.size()), ratio, counted(result.vertices, "vertex", "vertices"),
                        counted(result.frames, "frame"), result.max_error, result.kg),
            {{"clip", clip.name},
             {"file", path},
             {"bytes", file.size()},
             {"done_before", false},
             {"ratio", ratio},
             {"vertices", result.vertices},
             {"frames", result.frames},
             {"max_error", result.max_error},
             {"kg", result.kg}}};
  }

  void summarise() const {
    const auto failed = static_cast<size_t>(std::count_if(
        faults_.begin(), faults_.end(), [](const auto& fault) { return fault.has_value(); }));
    if (options_.json)
      print_json({{"encoded", encoded_.load()},
                  {"done_before", skipped_.load()},
                  {"failed", failed},
                  {"bytes", output_bytes_.load()},
                  {"folder", options_.folder}});
    else
      print_line("{} encoded, {} done before, {} failed; {} in {}", encoded_.load(),
                 skipped_.load(), failed, readable_bytes(output_bytes_), options_.folder);
    for (size_t i = 0; i < clips_.size(); ++i) {
      if (faults_[i])
        throw Error(*faults_[i], fmt::format("{} of {} clips failed, the first is {}", failed,
                                             clips_.size(), clips_[i].name));
    }
  }

  const std::vector<BatchClip>& clips_;
  const BatchOptions& options_;
  const BatchLoad& load_;
  const BatchEncode& encode_;
  Journal journal_;
  Budget budget_;
  std::vector<std::optional<ErrorKind>> faults_;
  std::atomic<size_t> next_ = 0, encoded_ = 0, skipped_ = 0;
  std::atomic<uint64_t> output_bytes_ = 0;
  size_t finished_ = 0;
  std::mutex print_, read_;
};

void add_events(const std::vector<NamedTime>& events, ContentHash& hash) {
  for (const NamedTime& event : events) {
    hash.add(event.name);
    hash.add_value(event.seconds);
  }
}

void add_look(const MaterialLook& look, ContentHash& hash) {
  std::vector<float> numbers{look.metallic, look.roughness, look.alpha_cutoff};
  numbers.insert(numbers.end(), look.base_colour.begin(), look.base_colour.end());
  numbers.insert(numbers.end(), look.emissive.begin(), look.emissive.end());
  hash.add(numbers);
  for (const int kind : {int{look.known}, static_cast<int>(look.alpha), int{look.double_sided}})
    hash.add_value(kind);
  for (const String& texture : look.textures)
    hash.add(std::string(texture.begin(), texture.end()));
}

}  // namespace

uint64_t content_hash(const MeshSequence& sequence) {
  ContentHash hash;
  hash.add(sequence.name);
  hash.add(sequence.polygons.offsets);
  hash.add(sequence.polygons.corners);
  hash.add_value(sequence.vertex_count);
  hash.add_value(sequence.frame_count);
  hash.add(sequence.positions);
  hash.add_value(sequence.rate.numerator);
  hash.add_value(sequence.rate.denominator);
  hash.add_value(sequence.rate.assumed);
  hash.add_value(sequence.start_time);
  hash.add(sequence.times);
  hash.add_value(sequence.up);
  hash.add_value(sequence.metres_per_unit);
  hash.add_value(sequence.origin);
  hash.add_value(sequence.loop);
  for (const ClipTiming& clip : sequence.clips) {
    hash.add(clip.name);
    hash.add_value(clip.frame_count);
    hash.add_value(clip.rate.numerator);
    hash.add_value(clip.rate.denominator);
    hash.add_value(clip.start_time);
    hash.add(clip.times);
    add_events(clip.events, hash);
  }
  add_events(sequence.events, hash);
  for (const Attribute& attribute : sequence.attributes) {
    hash.add(attribute.name);
    hash.add_value(attribute.kind);
    hash.add_value(attribute.domain);
    hash.add_value(attribute.components);
    hash.add(attribute.values);
  }
  hash.add(sequence.shared_normals);
  for (const PolygonLabels* labels : {&sequence.materials, &sequence.parts}) {
    for (const std::string& name : labels->names)
      hash.add(name);
    hash.add(labels->of_polygon);
  }
  for (const MaterialLook& look : sequence.materials.looks)
    add_look(look, hash);
  return hash.digest();
}

void run_batch(const std::vector<BatchClip>& clips, const BatchOptions& options,
               const BatchLoad& load, const BatchEncode& encode) {
  OutputFolder folder((fs::path(options.folder) / "clip").string());
  folder.keep();
  Batch(clips, options, load, encode).run();
}

}  // namespace anicodec::tools
