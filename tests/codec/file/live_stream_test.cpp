// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/live_stream.h"

#include "codec/encode_live.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"

#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(LiveStream, EndsAnywhereAndRefusesWhatIsNoStream) {
  const MeshSequence clip = corpus::make_clip("limb");
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.5, true};
  options.effort = Effort::kFast;
  LiveEncoder encoder(clip, options);
  std::vector<Bytes> files;
  for (int i = 0; i < 2; ++i)
    files.push_back(encoder
                        .encode({clip.positions.begin(),
                                 clip.positions.begin() + ptrdiff_t{6} * clip.vertex_count})
                        .file);
  Bytes stream = files[0];
  stream.insert(stream.end(), files[1].begin(), files[1].end());
  EXPECT_FALSE(is_live_stream(files[0]));
  const size_t first = files[0].size();
  for (const size_t n : {first + 1, first + 60, stream.size() - 1}) {
    const LiveStream cut = read_live_stream({"cut", {stream.data(), n}});
    EXPECT_EQ(cut.files.size(), 1U);
    EXPECT_EQ(cut.incomplete, n - first);
  }
  EXPECT_THROW(read_live_stream({"second", files[1]}), Error);
  Bytes garbage = stream;
  garbage[first + 3] ^= 1;
  EXPECT_FALSE(is_live_stream(garbage));
  EXPECT_THROW(read_live_stream({"garbage", garbage}), Error);
}

}  // namespace
}  // namespace anicodec
