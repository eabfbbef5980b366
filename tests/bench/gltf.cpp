// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf.h"

#include "codec/sequence/error.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tools/inputs/clip_input.h"
#include "tools/io/files/byte_source.h"
#include "tools/peers/gltfpack.h"
#include "tools/words/names.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <set>

#include <fmt/format.h>

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

/// Faces, texture coordinates and hard edges as our decoder gets them: its faces have an order of
/// their own.
void take_decoded_mesh(const Bytes& file, MeshSequence& sequence) {
  Clip clip;
  if (!clip.open(file).ok())
    throw Error(ErrorKind::kInternal, "the encoded file cannot be opened");
  MeshSequence decoded = describe_clip(clip, meshes_of(clip));
  sequence.polygons = std::move(decoded.polygons);
  static_cast<MeshDetails&>(sequence) = std::move(decoded);
}

ordered_json measure(const std::string& word, const BenchOptions& options, double kg,
                     const std::optional<FrameRate>& rate, bool normals) {
  const auto [file, animation] = split(word);
  const GltfDocument document = read_document(file);
  MeshSequence sequence = bake_gltf(document, {.rate = rate, .clip = animation});
  const uint64_t raw = raw_bytes(document, sequence.name);
  // Neither side stores anything else.
  std::vector<Attribute> kept;
  std::ranges::copy_if(sequence.attributes, std::back_inserter(kept), [&](const Attribute& a) {
    return normals && (a.kind == AttributeKind::kUv || a.kind == AttributeKind::kNormal);
  });
  static_cast<MeshDetails&>(sequence) = {};
  sequence.attributes = std::move(kept);
  const TimedEncode timed = encode_timed(sequence, {ErrorMetric::kKg, kg, false}, options.basis,
                                         options.effort, options.verbose, OrderMode::kVertices);
  const EncodeResult& result = timed.result;
  const auto bytes = static_cast<double>(result.file.size());
  ordered_json row{{"clip", fs::path(file).filename().string()},
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
  if (gltfpack_version().empty())
    return row;
  if (normals)
    take_decoded_mesh(result.file, sequence);
  const GltfpackClip packed =
      gltfpack_at_kg(sequence, kg, normals ? GltfpackInput::kNormals : GltfpackInput::kPositions);
  row["gltfpack_bits"] = packed.bits;
  row["gltfpack_vertices"] = packed.vertices;
  row["gltfpack_kg"] = packed.kg;
  row["morph_bytes"] = packed.source_bytes;
  row["gltfpack_bytes"] = packed.bytes;
  row["gltfpack_ratio"] = static_cast<double>(packed.bytes) / bytes;
  return row;
}

}  // namespace

Table run_gltf(const BenchOptions& options, double kg, const std::optional<FrameRate>& rate,
               bool normals) {
  if (options.clips.empty())
    throw Error(ErrorKind::kUsage, "no clip is named");
  if (gltfpack_version().empty())
    fmt::print(stderr, "gltfpack cannot be run and is left out; Debian has it in gltfpack\n");
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
               {"gltfpack_bits", "-vp", ""},
               {"gltfpack_vertices", "vertices", ""},
               {"gltfpack_kg", "KG", "{:.4f}"},
               {"morph_bytes", "morph GLB bytes", ""},
               {"gltfpack_bytes", "gltfpack bytes", ""},
               {"gltfpack_ratio", "ratio", "{:.1f}"},
               {"raw_bytes", "bytes in the source", ""},
               {"ours_to_raw", "ours : source", "{:.2f}"}});
  for (const std::string& word : options.clips)
    table.add(measure(word, options, kg, rate, normals));
  return table;
}

}  // namespace anicodec::bench
