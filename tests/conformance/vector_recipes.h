// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files made by recipe rather than by the search of the encoder, for special_vectors.cpp and
// random_vectors.cpp.
#ifndef ANICODEC_TESTS_CONFORMANCE_VECTOR_RECIPES_H_
#define ANICODEC_TESTS_CONFORMANCE_VECTOR_RECIPES_H_

#include "codec/search/encoder_input.h"
#include "codec/segment/linear_segment_encode.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/bytes.h"
#include "sdk/clip/clip.h"
#include "sdk/prediction/vertex_order.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace anicodec {

/// Numbers that look random, the same everywhere.
class Numbers {
 public:
  explicit Numbers(uint64_t seed = 1) : state_(seed) {}

  uint32_t below(uint32_t count) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<uint32_t>((state_ >> 33) % count);
  }

  int32_t within(int32_t limit) {
    return static_cast<int32_t>(below(2 * static_cast<uint32_t>(limit) + 1)) - limit;
  }

 private:
  uint64_t state_;
};

/// Changes the streams of a segment before it is opened and hashed.
using StreamChange = std::function<void(EncodedSegment&, const EncoderInput&)>;

/// How a range of frames is coded.
struct Recipe {
  uint32_t frames = 0;
  BasisKind kind = BasisKind::kEigentrajectories;
  LinearSettings settings;
  StreamChange change = {};
  /// The region of each of so many vertices, and how many regions there are; none: there is one.
  std::function<Vector<uint8_t>(uint32_t)> region_of = {};
  uint32_t regions = 1;
};

/// A file of one mesh, one segment after the other, each over a reference pose that is in the file
/// for it alone. Its errors are measured. `layout`: of the mesh; null: that of the encoder.
Bytes file_of(MeshSequence clip, const std::vector<Recipe>& recipes,
              const std::function<void(ClipsRecord&)>& describe = {},
              const MeshLayout* layout = nullptr);

Recipe recipe(uint32_t frames, BasisKind kind, double step, uint8_t neighbours, uint8_t passes,
              uint8_t radius, RefitSchedule schedule);

/// A vertex of more than 32 neighbours, vertices without any, and a pose finer than the grid that
/// orders them: every rule of the vertex order has to act.
MeshSequence hub();

/// Pairs of hubs, side by side, of 18 to 45 spokes: degrees on both sides of each limit of the vertex
/// order, where the limit decides.
MeshSequence rings();

/// Three groups of so many vertices that are all neighbours of one another: with 17 a level removes less
/// than one in sixteen.
MeshSequence cliques(uint32_t size);

/// A limb of the corpus and the same half a turn further, apart.
MeshSequence turned_pair(uint32_t vertices, uint32_t frames);

/// The reference pose by partners without reason in runs along the vertices: more strands than are
/// told apart, vertices that are like themselves.
void with_partners(EncodedSegment& segment, const EncoderInput& input);

/// The same with exact coordinates.
void exactly_with_partners(EncodedSegment& segment, const EncoderInput& input);

/// Each vertex of turned_pair() like its image, in one strand of half a turn or in a strand for almost
/// every vertex: more than are told apart.
StreamChange with_turned_partners(bool many_strands);

/// Weights in time that are these, of component j of the base and then of the basis, in steps, each
/// component by a predictor.
StreamChange with_weights(
    const std::function<double(uint32_t j, uint32_t row, uint32_t frame)>& weight,
    const std::function<uint32_t(uint32_t j)>& predictor);

/// Weights in time by each predictor, of numbers that suit none.
void scramble_weights(EncodedSegment& segment, const EncoderInput& input);

/// The order in which the vertices of an encoded segment are decoded.
VertexOrder order_of(const EncodedSegment& segment, const Topology& topology);

/// Coefficients of other residuals: of component j, channel c and rank r. `omega` changes the weights of
/// samples.
StreamChange with_residuals(
    const std::function<int32_t(uint32_t j, uint32_t c, uint32_t r)>& residual,
    const std::function<uint8_t(uint32_t j)>& omega);

/// Residuals at their limits: predictions saturate.
void scramble_coefficients(EncodedSegment& segment, const EncoderInput& input);

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CONFORMANCE_VECTOR_RECIPES_H_
