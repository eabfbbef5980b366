// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/massage_quality.h"

#include "codec/massage/welded_surface.h"
#include "codec/surface/closest_point.h"

#include <algorithm>

namespace anicodec {

MassageQuality massage_quality(const MeshSequence& surfaces, const MeshSequence& sequence,
                               uint32_t reference) {
  MassageQuality quality;
  const WeldedSurface clip(surfaces);
  if (clip.topology.triangles.empty() || sequence.frame_count == 0)
    return quality;
  const Positions before = clip.frame(sequence.frame(reference));
  quality.distortion.conformal_mean = quality.distortion.area_mean = 0;
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    const Positions v = clip.frame(sequence.frame(f));
    const Distortion d = distortion(clip.topology, before, v);
    const Surface surface(clip.topology, clip.frame(surfaces.frame(f)));
    Distortion& all = quality.distortion;
    all.conformal_mean += d.conformal_mean;
    all.area_mean += d.area_mean;
    all.conformal_max = std::max(all.conformal_max, d.conformal_max);
    all.area_max = std::max(all.area_max, d.area_max);
    quality.radius_ratio += radius_ratio(clip.topology, v).mean;
    quality.turned += turned_in_place(v, surface).size();
  }
  const double frames = sequence.frame_count;
  quality.distortion.conformal_mean /= frames;
  quality.distortion.area_mean /= frames;
  quality.radius_ratio /= frames;
  return quality;
}

TriangleComparison compare_triangles(const Polygons& a, const FrameSource& a_frames,
                                     const Polygons& b, const FrameSource& b_frames,
                                     uint32_t frame_count) {
  TriangleComparison result;
  SurfaceTopology first, second;
  for (uint32_t f = 0; f < frame_count; ++f) {
    const Positions p = positions_of(a_frames(f));
    const Positions q = positions_of(b_frames(f));
    if (f == 0) {
      first = SurfaceTopology(fan_triangles(a), static_cast<uint32_t>(p.rows()));
      second = SurfaceTopology(fan_triangles(b), static_cast<uint32_t>(q.rows()));
      result.mapped = a == b && p.rows() == q.rows();
      if (result.mapped)
        result.distortion.conformal_mean = result.distortion.area_mean = 0;
    }
    result.radius_ratio_a += radius_ratio(first, p).mean / frame_count;
    result.radius_ratio_b += radius_ratio(second, q).mean / frame_count;
    if (!result.mapped)
      continue;
    const Distortion d = distortion(first, p, q);
    Distortion& all = result.distortion;
    all.conformal_mean += d.conformal_mean / frame_count;
    all.area_mean += d.area_mean / frame_count;
    all.conformal_max = std::max(all.conformal_max, d.conformal_max);
    all.area_max = std::max(all.area_max, d.area_max);
  }
  return result;
}

}  // namespace anicodec
