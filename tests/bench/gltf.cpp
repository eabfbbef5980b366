// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf.h"

#include "codec/sequence/error.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tools/io/files/byte_source.h"
#include "tools/words/names.h"

#include <filesystem>
#include <limits>
#include <set>

namespace anicodec::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using namespace tools;

struct Word {
  std::string file, animation;
};

Word split(const std::string& word) {
  const size_t at = word.rfind('@');
  if (at == std::string::npos || fs::exists(word))
    return {word, ""};
  return {word.substr(0, at), word.substr(at + 1)};
}

GltfDocument read_document(const std::string& path) {
  std::string bytes;
  read_file(path, bytes);
  return parse_gltf_document(
      bytes, path,
      [&path](const std::string& name) {
        std::string file;
        read_file((fs::path(path).parent_path() / name).string(), file);
        return file;
      },
      std::numeric_limits<uint64_t>::max());
}

/// Adds up the uncompressed bytes of a document's parts, each once.
class RawBytes {
 public:
  explicit RawBytes(const GltfDocument& document) : document_(document) {}

  void add_accessor(uint32_t index) {
    if (index == kGltfNone || !seen_.insert(index).second)
      return;
    const GltfAccessor& a = document_.accessors[index];
    const uint64_t element = uint64_t{a.components} * size_of(a.type);
    if (a.view != kGltfNone)
      sum_ += a.count * element;
    if (a.sparse)
      sum_ += a.sparse->count * (element + size_of(a.sparse->index_type));
  }

  void add_node(uint32_t index) {
    const GltfNode& node = document_.nodes[index];
    if (node.mesh != kGltfNone) {
      for (const GltfPrimitive& primitive : document_.meshes[node.mesh].primitives)
        add_primitive(primitive);
    }
    if (node.skin != kGltfNone)
      add_accessor(document_.skins[node.skin].inverse_binds);
    for (uint32_t child : node.children)
      add_node(child);
  }

  void add_animation(const GltfAnimation& animation) {
    for (const GltfSampler& sampler : animation.samplers) {
      add_accessor(sampler.input);
      add_accessor(sampler.output);
    }
  }

  uint64_t sum() const { return sum_; }

 private:
  void add_primitive(const GltfPrimitive& primitive) {
    add_accessor(primitive.indices);
    for (const auto& [name, accessor] : primitive.attributes) {
      if (name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"))
        add_accessor(accessor);
    }
    for (const auto& target : primitive.targets) {
      if (const auto found = target.find("POSITION"); found != target.end())
        add_accessor(found->second);
    }
  }

  const GltfDocument& document_;
  std::set<uint32_t> seen_;
  uint64_t sum_ = 0;
};

/// Positions, targets, faces, joints, weights, inverse binds and the animation's samplers.
uint64_t raw_bytes(const GltfDocument& document, const std::string& animation) {
  RawBytes bytes(document);
  for (uint32_t root : document.roots)
    bytes.add_node(root);
  for (const GltfAnimation& candidate : document.animations) {
    if (document.animations.size() == 1 || candidate.name == animation) {
      bytes.add_animation(candidate);
      break;
    }
  }
  return bytes.sum();
}

ordered_json measure(const std::string& word, const BenchOptions& options, double kg,
                     const std::optional<FrameRate>& rate) {
  const auto [file, animation] = split(word);
  const GltfDocument document = read_document(file);
  MeshSequence sequence = bake_gltf(document, {.rate = rate, .clip = animation});
  const uint64_t raw = raw_bytes(document, sequence.name);
  static_cast<MeshDetails&>(sequence) = {};  // nor are other things counted in the source
  const TimedEncode timed = encode_timed(sequence, {ErrorMetric::kKg, kg, false}, options.basis,
                                         options.effort, options.verbose, OrderMode::kVertices);
  const EncodeResult& result = timed.result;
  const auto bytes = static_cast<double>(result.file.size());
  return {{"clip", fs::path(file).filename().string()},
          {"animation", sequence.name},
          {"vertices", sequence.vertex_count},
          {"frames", sequence.frame_count},
          {"fps", sequence.rate.value()},
          {"asked_kg", kg},
          {"kg", result.kg},
          {"bytes", result.file.size()},
          {"basis", name_of(result.kind)},
          {"components", result.components},
          {"encode_cpu_seconds", timed.cpu_seconds},
          {"raw_bytes", raw},
          {"ours_to_raw", bytes / static_cast<double>(raw)}};
}

}  // namespace

Table run_gltf(const BenchOptions& options, double kg, const std::optional<FrameRate>& rate) {
  if (options.clips.empty())
    throw Error(ErrorKind::kUsage, "no clip is named");
  Table table({{"clip", "file", ""},
               {"animation", "animation", ""},
               {"vertices", "vertices", ""},
               {"frames", "frames", ""},
               {"fps", "fps", "{:g}"},
               {"kg", "KG", "{:.4f}"},
               {"bytes", "bytes", ""},
               {"basis", "kind", ""},
               {"components", "k", ""},
               {"encode_cpu_seconds", "CPU s", "{:.1f}"},
               {"raw_bytes", "bytes in the source", ""},
               {"ours_to_raw", "ours : source", "{:.2f}"}});
  for (const std::string& word : options.clips)
    table.add(measure(word, options, kg, rate));
  return table;
}

}  // namespace anicodec::bench
