// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_REPORT_MASSAGE_STUDY_H_
#define ANICODEC_TOOLS_REPORT_MASSAGE_STUDY_H_

#include "codec/massage/massage_quality.h"
#include "codec/metrics/hausdorff.h"
#include "codec/plan/encode_options.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// KG error in per cent of a clip in so many principal components.
struct ComponentErrors {
  size_t k = 0;
  double original = 0;
  double massaged = 0;
};

/// Bytes at a KG error, each against its own clip.
struct MassagedSize {
  double kg = 0;  ///< asked for, per cent
  uint64_t original = 0;
  uint64_t massaged = 0;
};

/// The effect of Mesh Massage on a clip: the error in principal components (thesis table 5.5 and figure
/// 5.14), and what the coded size says instead.
struct MassageStudy {
  std::vector<ComponentErrors> components;
  std::vector<MassagedSize> sizes;
  SurfaceComparison moved;  ///< the surfaces
  MassageQuality before, after;
};

/// Cost: a massage and four encodings at this effort.
MassageStudy study_massage(const MeshSequence& sequence, std::span<const size_t> counts,
                           Effort effort, const Progress& progress);

nlohmann::ordered_json massage_json(const MassageStudy& study);

/// series,x,original,massaged: rows "pca" by components (KG error) and "bytes" by KG error.
std::string massage_csv(const MassageStudy& study);

std::string massage_text(const MassageStudy& study);

/// A section of the report's page.
std::string massage_section(const MassageStudy& study);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_REPORT_MASSAGE_STUDY_H_
