// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage_quality.h"

#include "codec/welded_clip.h"

#include <algorithm>

namespace anicodec {

MassageQuality massage_quality(const MeshSequence& surfaces, const MeshSequence& sequence,
                               uint32_t reference) {
  MassageQuality quality;
  const WeldedClip clip(surfaces);
  if (clip.topology.triangles.empty() || sequence.frame_count == 0)
    return quality;
  const Positions before = clip.frame(sequence.frame(reference));
  quality.distortion.conformal_mean = quality.distortion.area_mean = 0;
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    const Positions v = clip.frame(sequence.frame(f));
    const Distortion d = distortion(clip.topology, before, v);
    Surface surface(clip.topology, clip.frame(surfaces.frame(f)));
    surface.build_index();
    Distortion& all = quality.distortion;
    all.conformal_mean += d.conformal_mean;
    all.area_mean += d.area_mean;
    all.conformal_max = std::max(all.conformal_max, d.conformal_max);
    all.area_max = std::max(all.area_max, d.area_max);
    quality.radius_ratio += radius_ratio(clip.topology, v).mean;
    quality.turned += turned_triangles(clip.topology, v, surface).size();
  }
  const double frames = sequence.frame_count;
  quality.distortion.conformal_mean /= frames;
  quality.distortion.area_mean /= frames;
  quality.radius_ratio /= frames;
  return quality;
}

}  // namespace anicodec
