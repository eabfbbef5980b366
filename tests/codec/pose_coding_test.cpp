// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_coding.h"

#include "codec/connectivity/mesh_layout.h"
#include "corpus/clips.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(PoseCodingOfCorpus, EveryClipsFirstFrameComesBack) {
  for (const std::string& name : corpus::clip_names()) {
    SCOPED_TRACE(name);
    MeshSequence s = corpus::make_clip(name);
    MeshLayout layout = lay_out_mesh(s, CoderId::kDraco);
    float largest = 0;
    for (size_t i = 0; i < size_t{3} * s.vertex_count; ++i)
      largest = std::max(largest, std::fabs(s.positions[i]));
    Vector<int32_t> pose;
    for (uint32_t v : layout.coded_source) {
      for (size_t i = 0; i < 3; ++i)
        pose.push_back(static_cast<int32_t>(
            std::lround(8191 * s.positions[size_t{3} * v + i] / (largest > 0 ? largest : 1))));
    }
    Bytes bytes = encode_pose(layout.topology, pose);
    Vector<int32_t> decoded;
    PoseSurface surface;
    ASSERT_EQ(decode_pose(bytes, layout.topology, &surface, &decoded), Status::kOk);
    EXPECT_EQ(decoded, pose);
  }
}

}  // namespace
}  // namespace anicodec
