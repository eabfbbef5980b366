// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_BENCHES_H_
#define ANICODEC_TESTS_BENCH_BENCHES_H_

#include "codec/encode.h"
#include "tests/bench/table.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anicodec::peers {}

namespace anicodec::bench {

using namespace peers;  // what is compared with

/// Options that the sub-commands share.
struct BenchOptions {
  std::vector<std::string> clips;  ///< words for load_clip()
  BasisChoice basis = BasisChoice::kAuto;
  Effort effort = Effort::kNormal;
  bool verbose = false;
};

/// Bytes at KG errors in per cent, and of float32 caches through zstd and xz.
Table run_rate(const BenchOptions& options, const std::vector<double>& targets);

/// Bytes of glTF files' clips, positions and faces, at a KG error, order kept, against what the file
/// itself spends on the clip. A word is FILE or FILE@ANIMATION.
Table run_gltf(const BenchOptions& options, double kg, const std::optional<FrameRate>& rate);

/// Bytes at a maximum error in per cent of the diagonal, and frame deltas at the same.
Table run_near(const BenchOptions& options, double max_error_percent);

/// Bytes of lossless files, against float32 caches through zstd and xz, which keep no mesh; processor
/// time of encoding, and of opening with all positions.
Table run_lossless(const BenchOptions& options);

/// Time and memory of encoding at a KG error, by one thread and by all of the machine: of the clips of
/// the options, or without any of limbs of so many vertices and frames. Each in a process of its own.
Table run_encode(const BenchOptions& options, double kg, const std::vector<uint32_t>& vertices,
                 const std::vector<uint32_t>& frames);

/// Bytes at a KG error without each of `means`, names of search_means(), or of all that there are.
Table run_ablate(const BenchOptions& options, double kg, const std::vector<std::string>& means);

/// Opening and playing all frames, against Draco decoding them one by one; one thread.
Table run_decode(const BenchOptions& options, double kg, int runs);

/// Bytes, opening time and its steps with and without `encode --smallest`; one thread.
Table run_open(const BenchOptions& options, double kg, int runs);

/// Clips as live streams of so many frames a file: time to encode a file, and to open one as a stream does, which keeps the
/// meshes, or with its meshes.
Table run_live(const BenchOptions& options, const Target& target, uint32_t frames, double key_every,
               int runs);

/// Bytes and opening time per vertex of frame 0 as a reference pose, against
/// Draco on the same grid.
Table run_static_pose(const BenchOptions& options, double kg, int runs);

/// Bytes and decoding time per coded vertex of faces and of the vertices' order, against a mesh of
/// Draco's with its positions; one thread.
Table run_mesh(const BenchOptions& options, int runs);

/// A wave grid of eigenshapes: encoding, its memory, and opening against one Draco mesh.
Table run_large(const BenchOptions& options, uint32_t vertices, uint32_t frames, uint32_t shapes,
                int runs);

/// Playing one frame, and four per pass, of random bases of so many vertices and components,
/// against Draco decoding a frame, Eigen's float product, reading the coefficients and the limit of
/// multiply-adds; one thread. The clips of the options count as vertices too, with their Draco
/// frame.
Table run_play(const BenchOptions& options, const std::vector<uint32_t>& vertices,
               const std::vector<uint32_t>& components, int runs);

/// Playing a frame of a clip, and a cross-fade of two clips that share a basis, in turns; one thread.
Table run_blend(const BenchOptions& options, const std::vector<uint32_t>& vertices, int runs);

/// Bytes with each kind of basis and with the choice between them.
Table run_auto(const BenchOptions& options, double kg);

/// Errors of all ways to interpolate half way between two poses: poses of the corpus, or the two
/// frames of a clip between which straight lines do worst.
Table run_poses(const std::vector<std::string>& words);

/// KG error of clips of which every step-th frame is kept and the others are interpolated by time,
/// by straight lines, tracked deformation gradients and MSGI.
Table run_between(const std::vector<std::string>& clips, uint32_t step);

/// KG error of clips coded by so many key-frames: exact ones with free weights, then files with
/// each choice of interpolation.
Table run_keyframes(const BenchOptions& options, const std::vector<uint32_t>& counts);

/// Multi-scale geometry interpolation of generated meshes in one thread, processor time, against
/// that of tracked deformation gradients in the same run.
Table run_msgi_speed(const std::vector<uint32_t>& vertex_counts, int runs);

/// Clips whose vertices slide by noise of so many mean edges, and massaged: size at a KG error and
/// surface distance against the clean clip. `frames`: only the first ones; 0: all.
Table run_massage_sliding(const BenchOptions& options, double kg, double edges, uint32_t frames);

/// The decisions of the automatic massage on clips as they are.
Table run_massage_auto(const BenchOptions& options, double kg);

/// Frame 0 decimated to a quarter of its vertices by quadrics and fitted to itself.
Table run_massage_fit(const BenchOptions& options);

/// Clips of which every frame is decimated differently, given one connectivity again.
Table run_massage_transfer(const BenchOptions& options, uint32_t frames);

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_BENCHES_H_
