// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The tables of a mesh that Draco predicts over, for encoder and decoder (spec/07-topology.md,
// section 8): the connectivity is ours, so that a bitstream holds poses alone.
#ifndef ANICODEC_SDK_MESH_DRACO_CORNERS_H_
#define ANICODEC_SDK_MESH_DRACO_CORNERS_H_

#include "sdk/mesh/half_edges.h"
#include "sdk/mesh/split_vertices.h"

#include <cstdint>
#include <memory>

#include <draco/compression/attributes/mesh_attribute_indices_encoding_data.h>
#include <draco/compression/mesh/traverser/max_prediction_degree_traverser.h>
#include <draco/compression/mesh/traverser/mesh_attribute_indices_encoding_observer.h>
#include <draco/compression/mesh/traverser/mesh_traversal_sequencer.h>
#include <draco/mesh/corner_table.h>
#include <draco/mesh/mesh.h>

namespace anicodec {

/// A mesh as Draco's predictions see it.
class DracoCorners {
 public:
  explicit DracoCorners(const SplitMesh& split) {
    const auto corner = [](uint32_t c) { return draco::CornerIndex(c); };
    table_.Reset(static_cast<int>(split.corners.size() / 3));
    table_.SetNumVertices(static_cast<int>(split.points));
    for (uint32_t c = 0; c < split.corners.size(); ++c) {
      const draco::VertexIndex point(split.corners[c]);
      table_.MapCornerToVertex(corner(c), point);
      table_.SetLeftMostCorner(point, corner(c));
      // Draco names an edge by the corner that faces it.
      if (split.opposite[c] != SplitMesh::kNone)
        table_.SetOppositeCorner(corner(previous_corner(c)),
                                 corner(previous_corner(split.opposite[c])));
    }
    for (uint32_t p = 0; p < split.points; ++p)
      table_.UpdateVertexToCornerMap(draco::VertexIndex(p));
    order_.Init(static_cast<int>(split.points));
  }

  const draco::CornerTable* table() const { return &table_; }

  /// In which order values come: known once a sequencer ran.
  const draco::MeshAttributeIndicesEncodingData* order() const { return &order_; }

  /// The points and triangles alone.
  static void set_connectivity(const SplitMesh& split, draco::Mesh* mesh) {
    mesh->set_num_points(split.points);
    mesh->SetNumFaces(split.corners.size() / 3);
    for (uint32_t t = 0; t < split.corners.size() / 3; ++t) {
      draco::Mesh::Face face;
      for (size_t i = 0; i < 3; ++i)
        face[i] = draco::PointIndex(split.corners[size_t{3} * t + i]);
      mesh->SetFace(draco::FaceIndex(t), face);
    }
  }

  /// Makes the order of the values, by the degree of prediction. To be used once.
  std::unique_ptr<draco::PointsSequencer> make_sequencer(const draco::Mesh* mesh) {
    using Observer = draco::MeshAttributeIndicesEncodingObserver<draco::CornerTable>;
    using Traverser = draco::MaxPredictionDegreeTraverser<draco::CornerTable, Observer>;
    auto sequencer = std::make_unique<draco::MeshTraversalSequencer<Traverser>>(mesh, &order_);
    Traverser traverser;
    traverser.Init(&table_, Observer(&table_, mesh, sequencer.get(), &order_));
    sequencer->SetTraverser(traverser);
    return sequencer;
  }

 private:
  draco::CornerTable table_;
  draco::MeshAttributeIndicesEncodingData order_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_DRACO_CORNERS_H_
