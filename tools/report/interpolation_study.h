// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_REPORT_INTERPOLATION_STUDY_H_
#define ANICODEC_TOOLS_REPORT_INTERPOLATION_STUDY_H_

#include "codec/interpolation/interpolation.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "tools/render/image.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// Frames by one method.
struct MethodStudy {
  InterpolationMethod method = InterpolationMethod::kMsgi;
  std::vector<EdgeError> frames;  ///< how far each is from what its weights ask for
  std::vector<Image> pictures;    ///< of the frames that InterpolationStudy::shown names

  /// Means over the frames; of largest_length the largest, of folded and collapsed the sums.
  EdgeError summary() const;
};

/// All methods side by side (thesis figures 4.23 to 4.27).
struct InterpolationStudy {
  std::vector<std::vector<double>> weights;  ///< of each frame
  std::vector<uint32_t> shown;               ///< frames that have pictures, ascending
  std::vector<Image> inputs;                 ///< pictures of the meshes themselves
  std::vector<MethodStudy> methods;
};

/// Interpolates between the frames of `poses` by every method at every row of weights. Pictures of up
/// to five of the frames if asked for. Stage: the method. Throws as make_interpolation().
InterpolationStudy study_interpolation(const MeshSequence& poses,
                                       const std::vector<std::vector<double>>& weights,
                                       InterpolationOptions options, bool pictures,
                                       const Progress& progress);

/// A line for each method.
std::string interpolation_text(const InterpolationStudy& study);

nlohmann::ordered_json interpolation_json(const InterpolationStudy& study);

/// A page with pictures of the frames by each method, and their errors against the frame.
std::string interpolation_page(const InterpolationStudy& study, const std::string& name);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_REPORT_INTERPOLATION_STUDY_H_
