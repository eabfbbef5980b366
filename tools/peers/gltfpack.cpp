// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/peers/gltfpack.h"

#include "codec/metrics/metrics.h"
#include "codec/sequence/error.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/files/private_folder.h"
#include "tools/io/gltf/glb_output.h"
#include "tools/io/gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace anicodec::peers {
namespace {

constexpr int kFewestBits = 6, kMostBits = 16;
// The rate of the animation; gltfpack resamples at whole rates, this one without being asked.
constexpr FrameRate kRate{30, 1, false};

/// Runs gltfpack with its output in a file; true when it ends well.
bool run_gltfpack(std::vector<std::string> arguments, const std::string& output) {
  std::vector<char*> words;
  arguments.insert(arguments.begin(), "gltfpack");
  for (std::string& argument : arguments)
    words.push_back(argument.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT,
                                   0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, words[0], &actions, nullptr, words.data(), ::environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return failure == 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) &&
         WEXITSTATUS(status) == 0;
}

std::string content(const std::string& path) {
  std::string bytes;
  tools::read_file(path, bytes);
  return bytes;
}

/// The clip with a morph target per frame, without names and units.
std::string morph_glb(const MeshSequence& sequence, GltfpackInput input) {
  MeshSequence bare;
  bare.polygons = sequence.polygons;
  bare.vertex_count = sequence.vertex_count;
  bare.frame_count = sequence.frame_count;
  bare.rate = kRate;
  if (input == GltfpackInput::kNormals)
    bare.shared_normals = sequence.shared_normals;
  tools::GlbOutput glb(bare, false);
  std::vector<float> times;
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    glb.add_frame(sequence.frame(f), {});
    times.push_back(static_cast<float>(f / kRate.value()));
  }
  return glb.finish(times);
}

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush())
    throw Error(ErrorKind::kInternal, path + ": cannot be written");
}

std::vector<bool> used_vertices(const MeshSequence& sequence) {
  std::vector<bool> used(sequence.vertex_count);
  for (uint32_t v : sequence.polygons.corners)
    used[v] = true;
  return used;
}

/// Squared distance of two trajectories, or some number no smaller than `enough`.
double squared_distance(const MeshSequence& a, uint32_t v, const MeshSequence& b, uint32_t w,
                        double enough) {
  double sum = 0;
  for (size_t f = 0; f < a.frame_count && sum < enough; ++f) {
    const float* p = a.frame(f).data() + size_t{3} * v;
    const float* q = b.frame(f).data() + size_t{3} * w;
    for (size_t c = 0; c < 3; ++c)
      sum += (double{p[c]} - double{q[c]}) * (double{p[c]} - double{q[c]});
  }
  return sum;
}

/// How far a vertex of frame 0 is along a direction that is that of no common axis or grid.
double depth(const MeshSequence& sequence, uint32_t v) {
  constexpr double kDirection[3] = {0.8, 0.48, 0.36};
  const float* p = sequence.positions.data() + size_t{3} * v;
  return kDirection[0] * double{p[0]} + kDirection[1] * double{p[1]} + kDirection[2] * double{p[2]};
}

/// The vertex of `to` whose trajectory is nearest to that of each used vertex of `from`. Candidates
/// are visited by the distance of their depths, which bounds that of the trajectories.
std::vector<uint32_t> nearest_trajectories(const MeshSequence& from, const MeshSequence& to,
                                           const std::vector<bool>& used) {
  std::vector<uint32_t> order(to.vertex_count);
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> depths(to.vertex_count);
  for (uint32_t w = 0; w < to.vertex_count; ++w)
    depths[w] = depth(to, w);
  std::ranges::stable_sort(order, {}, [&](uint32_t w) { return depths[w]; });
  std::ranges::sort(depths);
  std::vector<uint32_t> nearest(from.vertex_count);
  for (uint32_t v = 0; v < from.vertex_count; ++v) {
    if (!used[v])
      continue;
    const double own = depth(from, v);
    double best = std::numeric_limits<double>::infinity();
    auto above = static_cast<size_t>(std::ranges::lower_bound(depths, own) - depths.begin());
    size_t below = above;
    for (;;) {
      constexpr double kNone = std::numeric_limits<double>::infinity();
      const double down = below > 0 ? own - depths[below - 1] : kNone;
      const double up = above < depths.size() ? depths[above] - own : kNone;
      const double gap = std::min(down, up);
      if (gap == kNone || gap * gap >= best)
        break;
      const uint32_t w = order[down < up ? --below : above++];
      if (const double distance = squared_distance(from, v, to, w, best); distance < best) {
        best = distance;
        nearest[v] = w;
      }
    }
  }
  return nearest;
}

/// The frames of a clip that gltfpack has packed, with the source's vertices.
MeshSequence in_order_of(const MeshSequence& source, const MeshSequence& packed) {
  const std::vector<bool> used = used_vertices(source);
  const std::vector<uint32_t> nearest = nearest_trajectories(source, packed, used);
  MeshSequence out = source;
  for (uint32_t f = 0; f < source.frame_count; ++f) {
    for (uint32_t v = 0; v < source.vertex_count; ++v) {
      if (used[v])
        std::ranges::copy(packed.frame(f).subspan(size_t{3} * nearest[v], 3),
                          out.frame(f).begin() + 3 * static_cast<std::ptrdiff_t>(v));
    }
  }
  return out;
}

MeshSequence read_back(const std::string& glb, uint32_t frame_count) {
  MeshSequence clip =
      tools::parse_gltf(glb, "the file of gltfpack", {}, tools::GltfOptions{.rate = kRate});
  if (clip.frame_count != frame_count)
    throw Error(ErrorKind::kInternal, "the file of gltfpack has " +
                                          std::to_string(clip.frame_count) + " frames, not " +
                                          std::to_string(frame_count));
  return clip;
}

}  // namespace

std::string gltfpack_version() {
#if !defined(ANICODEC_MESHOPTIMIZER)
  return {};
#endif
  const tools::PrivateFolder folder;
  if (!run_gltfpack({"-v"}, folder / "version"))
    return {};
  const std::string text = content(folder / "version");
  const size_t space = text.find(' ');
  return text.substr(std::min(space, text.size() - 1) + 1, text.find('\n') - space - 1);
}

GltfpackClip gltfpack_at_kg(const MeshSequence& sequence, double kg, GltfpackInput input) {
  if (gltfpack_version().empty())
    throw Error(ErrorKind::kUnsupported, "there is no gltfpack command");
  if (sequence.frame_count < 2 || sequence.polygons.size() == 0)
    throw Error(ErrorKind::kUsage, "gltfpack takes clips with faces and at least two frames");
  const tools::PrivateFolder folder;
  const std::string source = folder / "clip.glb", packed = folder / "packed.glb";
  GltfpackClip clip;
  {
    const std::string glb = morph_glb(sequence, input);
    clip.source_bytes = glb.size();
    write_file(source, glb);
  }
  CompareOptions without_sted;
  without_sted.sted = false;
  for (clip.bits = kFewestBits; clip.bits <= kMostBits; ++clip.bits) {
    if (!run_gltfpack({"-i", source, "-o", packed, "-cc", "-vp", std::to_string(clip.bits)},
                      folder / "messages"))
      throw Error(ErrorKind::kInternal, "gltfpack has failed: " + content(folder / "messages"));
    const std::string glb = content(packed);
    clip.bytes = glb.size();
    const MeshSequence own_order = read_back(glb, sequence.frame_count);
    clip.vertices = own_order.vertex_count;
    clip.decoded = in_order_of(sequence, own_order);
    clip.kg = compare(sequence, clip.decoded, without_sted).kg;
    if (clip.kg <= kg)
      return clip;
  }
  throw Error(ErrorKind::kUsage, "gltfpack does not reach the error asked for");
}

}  // namespace anicodec::peers
