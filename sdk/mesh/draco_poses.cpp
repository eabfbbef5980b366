// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/draco_poses.h"

#include "sdk/mesh/draco_corners.h"
#include "sdk/mesh/draco_profile.h"
#include "sdk/mesh/split_vertices.h"

#include <iterator>
#include <memory>
#include <new>

#include <draco/compression/attributes/sequential_attribute_decoders_controller.h>
#include <draco/compression/attributes/sequential_integer_attribute_decoder.h>
#include <draco/compression/mesh/mesh_decoder.h>

namespace anicodec {
namespace {

ByteView rest_of(const draco::DecoderBuffer& buffer) {
  return {reinterpret_cast<const uint8_t*>(buffer.data_head()),
          static_cast<size_t>(buffer.remaining_size())};
}

/// Values of one attribute, whose coding is looked at before Draco makes room for it.
class BoundedValues : public draco::SequentialIntegerAttributeDecoder {
 protected:
  bool DecodeValues(const std::vector<draco::PointIndex>& points,
                    draco::DecoderBuffer* buffer) override {
    const auto width = static_cast<uint64_t>(attribute()->num_components());
    return check_draco_values(rest_of(*buffer), width * points.size()) &&
           draco::SequentialIntegerAttributeDecoder::DecodeValues(points, buffer);
  }
};

class BoundedAttributes : public draco::SequentialAttributeDecodersController {
 public:
  using draco::SequentialAttributeDecodersController::SequentialAttributeDecodersController;

 protected:
  std::unique_ptr<draco::SequentialAttributeDecoder> CreateSequentialDecoder(uint8_t) override {
    return std::make_unique<BoundedValues>();
  }
};

/// Draco's decoder of attributes over a mesh that it does not decode.
class PosesDecoder : public draco::MeshDecoder {
 public:
  PosesDecoder(const SplitMesh& split, DracoCorners* corners) : split_(split), corners_(*corners) {}

  const draco::CornerTable* GetCornerTable() const override { return corners_.table(); }

  const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int) const override {
    return corners_.order();
  }

 protected:
  bool DecodeConnectivity() override {
    DracoCorners::set_connectivity(split_, mesh());
    return true;
  }

  bool CreateAttributesDecoder(int32_t id) override {
    return SetAttributesDecoder(
        id, std::make_unique<BoundedAttributes>(corners_.make_sequencer(mesh())));
  }

 private:
  const SplitMesh& split_;
  DracoCorners& corners_;
};

Status decode(ByteView bytes, const Topology& topology, uint32_t points, uint32_t poses,
              Vector<Vector<int32_t>>* out) {
  // The head of a Draco file, before the attributes: its name, version 2.2, a triangle mesh by
  // edgebreaker, no flags.
  constexpr uint8_t kHead[] = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0};
  if (!check_draco_attributes(bytes, poses))
    return Status::kDraco;
  const SplitMesh split = split_vertices(topology.triangles, topology.coded_vertices);
  if (split.points != points)
    return Status::kRecord;
  Bytes whole(std::begin(kHead), std::end(kHead));
  whole.insert(whole.end(), bytes.data, bytes.data + bytes.size);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(whole.data()), whole.size());
  DracoCorners corners(split);
  PosesDecoder decoder(split, &corners);
  const auto mesh = std::make_unique<draco::Mesh>();
  const draco::DecoderOptions options;
  if (!decoder.Decode(options, &buffer, mesh.get()).ok() || buffer.remaining_size() != 0)
    return Status::kDraco;
  const size_t coordinates = size_t{3} * topology.vertices_in_triangles;
  for (int a = 0; a < mesh->num_attributes(); ++a) {
    const draco::PointAttribute* attribute = mesh->attribute(a);
    const auto width = static_cast<size_t>(attribute->num_components());
    Vector<int32_t> row(width);
    const size_t first = out->size();
    out->resize(first + width / 3, Vector<int32_t>(coordinates));
    Vector<bool> seen(topology.vertices_in_triangles, false);
    for (size_t c = 0; c < split.corners.size(); ++c) {
      const draco::AttributeValueIndex index =
          attribute->mapped_index(draco::PointIndex(split.corners[c]));
      if (index.value() >= attribute->size())
        return Status::kDraco;
      attribute->GetValue(index, row.data());
      const uint32_t v = topology.triangles[c];
      for (size_t i = 0; i < width; ++i) {
        int32_t& x = (*out)[first + i / 3][size_t{3} * v + i % 3];
        if (seen[v] && x != row[i])
          return Status::kDraco;  // points of one vertex have different values
        x = row[i];
      }
      seen[v] = true;
    }
  }
  return Status::kOk;
}

}  // namespace

bool has_draco() {
  return true;
}

Status decode_draco_poses(ByteView bytes, const Topology& topology, uint32_t points, uint32_t poses,
                          Vector<Vector<int32_t>>* out) {
  try {
    return decode(bytes, topology, points, poses, out);
  } catch (const std::bad_alloc&) {
    return Status::kMemory;
  } catch (...) {
    return Status::kDraco;
  }
}

}  // namespace anicodec
