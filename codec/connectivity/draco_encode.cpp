// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/draco_encode.h"

#include "sdk/mesh/draco_corners.h"
#include "sdk/mesh/draco_profile.h"
#include "sdk/mesh/split_vertices.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <draco/compression/attributes/sequential_attribute_encoders_controller.h>
#include <draco/compression/config/encoder_options.h>
#include <draco/compression/mesh/mesh_encoder.h>

namespace anicodec {
namespace {

/// Bytes of the head of a file of Draco's own.
constexpr ptrdiff_t kHead = 11;

/// Tables of so many symbols are small, however few values there are.
constexpr int64_t kFewSymbols = 1 << 12;

/// Adds one int32 attribute whose value of point p is written by fill(p, values).
template <class Fill>
void add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, size_t components,
                   Fill fill) {
  draco::GeometryAttribute description;
  description.Init(type, nullptr, static_cast<uint8_t>(components), draco::DT_INT32, false,
                   static_cast<int64_t>(components * sizeof(int32_t)), 0);
  int id = mesh.AddAttribute(description, true, mesh.num_points());
  Vector<int32_t> values(components);
  for (uint32_t p = 0; p < mesh.num_points(); ++p) {
    fill(p, values.data());
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(p), values.data());
  }
}

/// Whether a table of symbols would be longer than the values that it counts.
bool is_wide(const draco::PointAttribute& attribute) {
  const auto count = static_cast<int64_t>(attribute.size()) * attribute.num_components();
  const auto* first =
      reinterpret_cast<const int32_t*>(attribute.GetAddress(draco::AttributeValueIndex(0)));
  const auto [least, largest] = std::minmax_element(first, first + count);
  return int64_t{*largest} - *least > std::max(kFewSymbols, count);
}

/// Draco's encoder of attributes over a mesh that it does not encode.
class PosesEncoder : public draco::MeshEncoder {
 public:
  explicit PosesEncoder(DracoCorners* corners) : corners_(*corners) {}

  uint8_t GetEncodingMethod() const override { return draco::MESH_EDGEBREAKER_ENCODING; }

  const draco::CornerTable* GetCornerTable() const override { return corners_.table(); }

  const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int) const override {
    return corners_.order();
  }

 protected:
  draco::Status EncodeConnectivity() override { return draco::OkStatus(); }

  bool GenerateAttributesEncoder(int32_t id) override {
    if (id > 0) {
      attributes_encoder(0)->AddAttributeId(id);
      return true;
    }
    AddAttributesEncoder(std::make_unique<draco::SequentialAttributeEncodersController>(
        corners_.make_sequencer(mesh()), id));
    return true;
  }

  void ComputeNumberOfEncodedPoints() override {}

  void ComputeNumberOfEncodedFaces() override {}

 private:
  DracoCorners& corners_;
};

/// How many of the poses behind the first an attribute has.
size_t poses_of_attribute(size_t poses) {
  return std::max<size_t>(1, (poses + kMaxDracoAttributes - 3) / (kMaxDracoAttributes - 1));
}

}  // namespace

double draco_symbol_bytes(double points, size_t poses, double span) {
  // Deltas from point to point have twice as many symbols, and an entry has four bytes.
  const auto group = static_cast<double>(poses_of_attribute(poses));
  const double values = 3 * points * group;
  const double searched = std::min(span, std::max(double{kFewSymbols}, values));
  return 8 * searched * std::ceil(static_cast<double>(poses) / group) + 4 * span;
}

DracoPoses encode_draco_poses(const Topology& topology, std::span<const Vector<int32_t>> poses) {
  DracoPoses coded;
  if (topology.triangles.empty() || poses.empty() || poses.size() > kMaxDracoPoses)
    return coded;
  const SplitMesh split = split_vertices(topology.triangles, topology.coded_vertices);
  Vector<uint32_t> vertex(split.points);
  for (size_t c = 0; c < split.corners.size(); ++c)
    vertex[split.corners[c]] = topology.triangles[c];
  draco::Mesh mesh;
  DracoCorners::set_connectivity(split, &mesh);
  add_attribute(mesh, draco::GeometryAttribute::POSITION, 3, [&](uint32_t p, int32_t* x) {
    std::copy_n(poses[0].data() + size_t{3} * vertex[p], 3, x);
  });
  const size_t group = poses_of_attribute(poses.size());
  for (size_t first = 1; first < poses.size(); first += group) {
    const size_t count = std::min(group, poses.size() - first);
    add_attribute(mesh, draco::GeometryAttribute::GENERIC, 3 * count, [&](uint32_t p, int32_t* x) {
      for (size_t i = 0; i < count; ++i)
        std::copy_n(poses[first + i].data() + size_t{3} * vertex[p], 3, x + 3 * i);
    });
  }
  DracoCorners corners(split);
  PosesEncoder encoder(&corners);
  encoder.SetMesh(mesh);
  draco::EncoderOptions options = draco::EncoderOptions::CreateDefaultOptions();
  options.SetSpeed(0, 0);
  // Draco chooses parallelograms whose symbols are frequent, by a table of all symbols for each attribute.
  for (int id = 0; id < mesh.num_attributes(); ++id) {
    if (is_wide(*mesh.attribute(id)))
      options.SetAttributeInt(id, "prediction_scheme", draco::MESH_PREDICTION_PARALLELOGRAM);
  }
  draco::EncoderBuffer buffer;
  if (!encoder.Encode(options, &buffer).ok() || buffer.size() < static_cast<size_t>(kHead))
    return coded;
  coded.bytes.assign(buffer.data() + kHead, buffer.data() + buffer.size());
  coded.points = split.points;
  return coded;
}

}  // namespace anicodec
