// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_BENCH_ENCODE_H_
#define ANICODEC_TESTS_BENCH_BENCH_ENCODE_H_

#include "codec/encode.h"
#include "sdk/clip/clip.h"

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace anicodec::bench {

/// Shares of the bytes of a file of one mesh.
struct ByteShares {
  uint64_t mesh = 0;         ///< connectivity and what restores the source's mesh
  uint64_t pose = 0;         ///< reference pose, key-frames
  uint64_t weights = 0;      ///< in time
  uint64_t basis = 0;        ///< coefficients of the components and their parameters
  uint64_t corrections = 0;  ///< of single vertices
  uint64_t rest = 0;         ///< header, table, clip record, rigid motions, padding
};

ByteShares byte_shares(ByteView file);

/// Opens what was encoded, or ends the program.
void open_encoded(ByteView file, Clip& clip, const OpenOptions& options = {});

/// The work of opening it, to be timed.
inline auto opening_of(ByteView file, const OpenOptions& options = {}) {
  return [=] {
    Clip clip;
    open_encoded(file, clip, options);
  };
}

/// The same of the first bytes of a file.
inline auto opening_of_prefix(ByteView bytes) {
  OpenOptions options;
  options.prefix = true;
  return opening_of(bytes, options);
}

/// The bytes that a host has once the first chunk of a type is there.
ByteView up_to_the_first(const char (&type)[5], ByteView file);

/// An encoding with what it took.
struct TimedEncode {
  EncodeResult result;
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< of all threads
  nlohmann::ordered_json stages =
      nlohmann::ordered_json::object();  ///< processor seconds by stage, in the order of first use
};

/// Encodes with the program's defaults but for these; with `verbose` the trials and stages go to
/// stderr.
TimedEncode encode_timed(MeshSequence sequence, const Target& target, BasisChoice basis,
                         Effort effort, bool verbose, OrderMode order = OrderMode::kFree,
                         bool smallest = false);

/// Bits per frame and vertex.
double bpfv(uint64_t bytes, const MeshSequence& sequence);

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_BENCH_ENCODE_H_
