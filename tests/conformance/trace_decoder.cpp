// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Prints the integers of each step of decoding a file, so that who writes a decoder finds the first
// step that differs (README.md, section "Traces").
//
// usage: trace_decoder FILE.anic
#include "sdk/clip/sample.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace anicodec {
namespace {

constexpr size_t kShownCalls = 8, kShownValues = 24;

/// FNV-1a over the bytes of integers of 32 bits, least byte first.
class Digest {
 public:
  void add(int32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
      state_ = (state_ ^ (static_cast<uint32_t>(value) >> shift & 0xFF)) * 16777619U;
  }

  uint32_t value() const { return state_; }

 private:
  uint32_t state_ = 2166136261U;
};

/// Prints the first lists of a step, and a total when another step begins.
class Printer : public DecodingTrace {
 public:
  void step(const char* name, const int32_t* values, size_t count) override {
    if (name_ != name) {
      finish();
      name_ = name;
    }
    Digest digest;
    for (size_t i = 0; i < count; ++i) {
      digest.add(values[i]);
      total_.add(values[i]);
    }
    values_ += count;
    if (++lists_ > kShownCalls)
      return;
    std::printf("%s %zu: %zu integers, digest %08" PRIx32 ":", name, lists_ - 1, count,
                digest.value());
    for (size_t i = 0; i < count && i < kShownValues; ++i)
      std::printf(" %" PRId32, values[i]);
    std::printf(count > kShownValues ? " ...\n" : "\n");
  }

  void finish() {
    if (lists_ > 1)
      std::printf("%s: %zu lists, %zu integers, digest %08" PRIx32 "\n", name_.c_str(), lists_,
                  values_, total_.value());
    name_.clear();
    lists_ = values_ = 0;
    total_ = {};
  }

 private:
  std::string name_;
  size_t lists_ = 0, values_ = 0;
  Digest total_;
};

/// The first positions of a frame; the last digits may differ from one decoder to another.
Status print_positions(const Clip& clip, uint32_t mesh, uint32_t frame) {
  std::vector<float> positions(size_t{3} * clip.vertex_count(mesh));
  const Status s = show_positions(clip, mesh, frame, positions.data());
  if (s != Status::kOk)
    return s == Status::kAbsent ? Status::kOk : s;
  std::printf("positions of mesh %" PRIu32 " in frame %" PRIu32 ":", mesh, frame);
  for (size_t i = 0; i < positions.size() && i < kShownValues; ++i)
    std::printf(" %.7g", double{positions[i]});
  std::printf(positions.size() > kShownValues ? " ...\n" : "\n");
  return Status::kOk;
}

int trace(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file),
                                std::istreambuf_iterator<char>()};
  Printer printer;
  OpenOptions options;
  options.limits.resident_bytes = uint64_t{256} << 20;
  options.trace = &printer;
  Clip clip;
  Failure failure =
      clip.open({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, options);
  printer.finish();
  for (uint32_t m = 0; m < clip.meshes().size() && failure.ok(); ++m) {
    for (uint32_t f = 0; f < clip.frame_count() && failure.ok();
         f += f == 0 ? std::max(clip.frame_count() - 1, 1U) : 1)
      failure.status = print_positions(clip, m, f);
  }
  if (failure.ok())
    return 0;
  std::fprintf(stderr, "%s: %s: %s\n", path, status_string(failure.status), failure.detail);
  return 1;
}

}  // namespace
}  // namespace anicodec

int main(int argc, char** argv) {
  if (argc != 2)
    return std::fprintf(stderr, "usage: trace_decoder FILE.anic\n"), 2;
  return anicodec::trace(argv[1]);
}
