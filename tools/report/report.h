// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_REPORT_REPORT_H_
#define ANICODEC_TOOLS_REPORT_REPORT_H_

#include "codec/metrics/metrics.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/studies/basis_error.h"
#include "codec/studies/shape_spaces.h"
#include "tools/render/image.h"
#include "tools/report/massage_study.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// A clip stored one way: a point of a rate-error curve.
struct RatePoint {
  std::string codec;
  uint64_t bytes = 0;
  double bpfv = 0;
  double kg = 0;                 ///< per cent
  double max_error_percent = 0;  ///< of the diagonal
  double sted = 0;
};

/// Whether a codec is this project's.
inline bool is_own(const std::string& codec) {
  return codec.rfind("anicodec", 0) == 0;
}

/// Bytes of one kind in a file.
struct ByteShare {
  std::string what;
  uint64_t bytes = 0;
};

struct ReportPicture {
  std::string caption;
  Image image;
};

/// All that a report shows of a clip.
struct Report {
  std::string name;
  uint32_t vertices = 0, faces = 0, frames = 0;
  double diagonal = 0;
  FrameRate rate;
  std::vector<RatePoint> rates;
  double shown_kg = 0;            ///< KG error asked for in all that follows
  uint64_t shown_bytes = 0;       ///< of that file
  std::vector<ByteShare> shares;  ///< where they went
  Comparison shown;               ///< that file against the clip, frame by frame
  std::vector<BasisError> basis_errors;
  std::vector<ShapeSpaceError> shape_spaces;
  std::string player;                    ///< a page that plays it, where the viewer is installed
  std::vector<ReportPicture> pictures;   ///< original, decoded, error, side by side
  std::vector<ReportPicture> keyframes;  ///< the contact sheet
  std::optional<MassageStudy> massage;   ///< where it was asked for
};

struct ReportOptions {
  Effort effort = Effort::kFast;
  bool full = false;           ///< other codecs, key-frames and shape spaces, too
  std::vector<size_t> counts;  ///< of key-frames and components
  Progress progress;
};

/// Measures everything. Cost: two encodings and comparisons with STED; in full some ten, and those of other codecs.
Report make_report(const MeshSequence& sequence, const ReportOptions& options);

/// The numbers of a report, without its pictures.
nlohmann::ordered_json report_json(const Report& report);

/// A page that needs nothing else: style, charts as SVG, pictures inside.
std::string report_page(const Report& report);

/// The rate-error curves alone, against the KG error: an SVG file.
std::string rate_figure(const Report& report);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_REPORT_REPORT_H_
