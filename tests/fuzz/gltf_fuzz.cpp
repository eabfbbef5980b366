// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/fuzz/fuzz_mesh.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/gltf/glb_output.h"
#include "tools/io/gltf/gltf.h"

using namespace anicodec;
using namespace anicodec::tools;

namespace {

/// Whatever is accepted is a valid sequence, and its GLB has the same counts.
void round_trip(const MeshSequence& sequence, const GltfResolver& resolve,
                const GltfOptions& options) {
  check(sequence);
  GlbOutput output(sequence, false);
  for (uint32_t f = 0; f < sequence.frame_count; ++f)
    output.add_frame(sequence.frame(f), attributes_of_frame(sequence.attributes, f));
  std::vector<float> times;
  for (uint32_t f = 0; f < sequence.frame_count; ++f)
    times.push_back(static_cast<float>(f));
  const std::string written = output.finish(times);
  if (sequence.polygons.size() == 0)
    return;
  try {
    const MeshSequence again = parse_gltf(written, "again", resolve, options);
    require(again.vertex_count == sequence.vertex_count);
    require(again.polygons.size() == sequence.polygons.size());
  } catch (const Error&) {
    // Differences of the largest floats are not finite.
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const GltfResolver resolve = [](const std::string&) { return std::string(64, '\1'); };
  GltfOptions options;
  options.memory_limit = 1 << 20;
  options.isolate = false;  // a fault is to be found, not contained
  try {
    const MeshSequence sequence = parse_gltf(as_text(data, size), "fuzz", resolve, options);
    if (sequence.frame_count <= 64)
      round_trip(sequence, resolve, options);
  } catch (const Error& error) {
    require(error.kind() != ErrorKind::kInternal && *error.what() != '\0');
  }
  return 0;
}
