// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/trial_files.h"

#include "codec/file/clip_file.h"
#include "codec/file/clip_record.h"

#include <string>
#include <utility>

namespace anicodec {

TrialFiles::TrialFiles(const EncoderInput& input)
    : input_(input),
      record_(clips_record(input.sequence, input.described,
                           std::vector<ClipGoal>(input.clips.size()))) {}

Solution TrialFiles::unlisted(std::vector<CodedSegment> segments) const {
  Solution solution;
  solution.segments = std::move(segments);
  for (CodedSegment& segment : solution.segments) {
    const Limits::Segment& sizes = segment.encoded.sizes;
    FrameView frames = input_.frames(sizes.first_frame, sizes.frames);
    if (input_.caps_errors()) {
      correct(frames, input_.copies, input_.caps(sizes.first_frame, sizes.frames), segment.opened,
              segment.encoded);
      segment.error = measure(segment.opened, frames, input_.copies);
    }
  }
  solution.bytes = clip_file_bytes(record_, input_.layout, solution.encoded());
  return solution;
}

Solution TrialFiles::put_together(std::vector<CodedSegment> segments) {
  Solution solution = unlisted(std::move(segments));
  std::string what;
  for (const CodedSegment& segment : solution.segments)
    what += (what.empty() ? "" : " + ") + segment.what;
  trials_.push_back(
      {what, solution.bytes, input_.rmse(solution.squared_error()), solution.max_error()});
  return solution;
}

}  // namespace anicodec
