// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage_choice.h"

#include "codec/encode_mesh.h"
#include "codec/massage/massage.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace anicodec {
namespace {

constexpr uint32_t kFewestFrames = 3, kSampleFrames = 16;
constexpr double kLeastGain = 0.1;
constexpr double kSampleKg = 0.1;

/// Evenly spaced frames with the reference first.
MeshSequence sample_of(const MeshSequence& sequence, uint32_t reference) {
  MeshSequence sample = sequence;
  sample.times.clear();
  sample.positions.clear();
  std::erase_if(sample.attributes, [](const Attribute& a) { return a.frames > 1; });
  sample.frame_count = std::min(sequence.frame_count, kSampleFrames);
  for (uint32_t k = 0; k < sample.frame_count; ++k) {
    const auto f = static_cast<uint32_t>(
        (reference + uint64_t{k} * sequence.frame_count / sample.frame_count) %
        sequence.frame_count);
    const std::span<const float> frame = sequence.frame(f);
    sample.positions.insert(sample.positions.end(), frame.begin(), frame.end());
  }
  return sample;
}

uint64_t file_bytes(MeshSequence sequence, const EncodeOptions& options, const Progress& progress) {
  check(sequence);
  const MeshPlan plan = plan_mesh(sequence, options);
  return encode_mesh(std::move(sequence), plan, progress).file().size();
}

}  // namespace

bool massage_pays(const MeshSequence& sequence, const EncodeOptions& options,
                  const Progress& progress, MassageVerdict* verdict) {
  if (sequence.frame_count < kFewestFrames)
    return false;
  EncodeOptions of_sample = options;
  of_sample.effort = std::min(options.effort, Effort::kNormal);
  of_sample.cap.reset();
  of_sample.keyframes.reset();
  const ErrorMetric metric = options.target.metric;
  if (is_size(metric) || metric == ErrorMetric::kNone)
    of_sample.target = {ErrorMetric::kKg, kSampleKg, false};
  const MeshSequence sample = sample_of(sequence, options.massage.options.reference);
  MassageOptions massage_options = options.massage.options;
  massage_options.reference = 0;
  massage_options.remove_noise = false;
  try {
    MassageResult massaged = massage(sample, massage_options, progress);
    verdict->sample_plain_bytes = file_bytes(sample, of_sample, progress);
    verdict->sample_massaged_bytes = file_bytes(std::move(massaged.sequence), of_sample, progress);
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::kInput && e.kind() != ErrorKind::kUsage)
      throw;
    verdict->sample_massaged_bytes = 0;
    return false;
  }
  return static_cast<double>(verdict->sample_massaged_bytes) <=
         (1 - kLeastGain) * static_cast<double>(verdict->sample_plain_bytes);
}

}  // namespace anicodec
