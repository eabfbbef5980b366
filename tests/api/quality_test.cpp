// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Contexts that play fewer components than their asset has.
#include "tests/api/conformance_file.h"
#include "tests/api/opened.h"

namespace anicodec {
namespace {

/// Every kind of basis, corrections, several segments and clips.
const char* const kFiles[] = {"limb_effort9", "heated",    "other_parents", "quad_box_corrected",
                              "saturated",    "schedules", "vertex_order",  "weights_in_time"};

void seek(const Context& context, double seconds) {
  ASSERT_EQ(anic_seek_time(context.get(), seconds, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP), ANIC_OK);
}

uint32_t components(const Context& context) {
  anic_parts shown = ANIC_INIT(anic_parts);
  EXPECT_EQ(anic_get_parts(context.get(), 0, ANIC_WHEN_CURRENT, &shown), ANIC_OK);
  return shown.components[0];
}

TEST(AnicQuality, ShowsWhatAnAssetOpenedAtThatQualityShows) {
  for (const char* name : kFiles) {
    SCOPED_TRACE(name);
    const Bytes file = conformance_file(name);
    const Asset whole = open(file);
    for (double quality : {0.1, 0.35, 0.5, 1.0}) {
      anic_options options = ANIC_INIT(anic_options);
      options.quality = quality;
      const Asset coarse = open(file, &options);
      const Context context = context_of(whole), expected = context_of(coarse);
      ASSERT_EQ(anic_set_quality(context.get(), quality), ANIC_OK);
      for (double t : {0.0, 0.1, 0.137, 0.61}) {
        seek(context, t);
        seek(expected, t);
        EXPECT_EQ(components(context), components(expected));
        EXPECT_EQ(positions(whole, context), positions(coarse, expected)) << quality << " " << t;
      }
    }
  }
}

TEST(AnicQuality, BeginsWithTheNextSeekAndAllocatesNothing) {
  const Asset asset = open(conformance_file("vertex_order"));
  const Context context = context_of(asset), other = context_of(asset);
  seek(context, 0.1);
  seek(other, 0.1);
  const std::vector<float> fine = positions(asset, context);
  ASSERT_EQ(anic_set_quality(context.get(), 0.25), ANIC_OK);
  EXPECT_EQ(positions(asset, context), fine);
  {
    const HeapCount heap;
    ASSERT_EQ(anic_set_quality(context.get(), 0.25), ANIC_OK);
    seek(context, 0.1);
    EXPECT_EQ(heap.calls(), 0U);
  }
  EXPECT_NE(positions(asset, context), fine);
  EXPECT_EQ(positions(asset, context, ANIC_WHEN_PREVIOUS), fine);
  ASSERT_EQ(anic_set_quality(context.get(), 1), ANIC_OK);
  seek(context, 0.1);
  EXPECT_EQ(positions(asset, context), fine);
  EXPECT_EQ(positions(asset, other), fine) << "another context of the asset";
}

TEST(AnicQuality, PlaysRangesAlike) {
  const Asset asset = open(conformance_file("saturated"));
  const Context context = context_of(asset);
  ASSERT_EQ(anic_set_quality(context.get(), 0.4), ANIC_OK);
  seek(context, 0.2);
  const std::vector<float> whole = positions(asset, context);
  const uint32_t n = vertices_of(asset);
  std::vector<float> pieces(whole.size());
  for (uint32_t first = 0; first < n; first += 37) {
    anic_output output = floats(pieces);
    output.data = pieces.data() + size_t{3} * first;
    output.size -= sizeof(float) * 3 * first;
    ASSERT_EQ(anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, first,
                                   std::min(37U, n - first), &output),
              ANIC_OK);
  }
  EXPECT_EQ(pieces, whole);
}

TEST(AnicQuality, RefusesWhatIsNoShare) {
  const Asset asset = open(conformance_file("limb_default"));
  const Context context = context_of(asset);
  for (double quality : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(anic_set_quality(context.get(), quality), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_set_quality(nullptr, 1), ANIC_E_ARGUMENT);
}

}  // namespace
}  // namespace anicodec
