// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_massaged.h"

#include "codec/file/encoding_memory.h"
#include "codec/metrics/hausdorff.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <span>
#include <utility>

namespace anicodec {
namespace {

constexpr uint32_t kFewestFrames = 3, kSampleFrames = 16;
constexpr double kLeastGain = 0.1;
constexpr double kSampleKg = 0.1;

bool is_error(ErrorMetric metric) {
  return metric == ErrorMetric::kKg || metric == ErrorMetric::kMaxError ||
         metric == ErrorMetric::kRmse || is_motion(metric);
}

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

/// Whether massaging a few frames makes them code clearly smaller.
bool sample_shrinks(const MeshSequence& sequence, MassageOptions massage_options,
                    EncodeOptions options, MassageVerdict* verdict, const Progress& progress) {
  options.effort = std::min(options.effort, Effort::kNormal);
  options.cap.reset();
  options.keyframes.reset();
  if (!is_error(options.target.metric))
    options.target = {ErrorMetric::kKg, kSampleKg, false};
  const MeshSequence sample = sample_of(sequence, massage_options.reference);
  massage_options.reference = 0;
  massage_options.remove_noise = false;
  try {
    MassageResult massaged = massage(sample, massage_options, progress);
    verdict->sample_plain_bytes = encode(sample, options, progress).file.size();
    verdict->sample_massaged_bytes =
        encode(std::move(massaged.sequence), options, progress).file.size();
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::kInput && e.kind() != ErrorKind::kUsage)
      throw;
    verdict->sample_massaged_bytes = 0;
    return false;
  }
  return static_cast<double>(verdict->sample_massaged_bytes) <=
         (1 - kLeastGain) * static_cast<double>(verdict->sample_plain_bytes);
}

}  // namespace

EncodeResult encode_massaged(MeshSequence sequence, MassageMode mode,
                             const MassageOptions& massage_options, const EncodeOptions& options,
                             MassageVerdict* verdict, const Progress& progress) {
  *verdict = {};
  if (mode != MassageMode::kOff && is_lossless(options.target))
    throw Error(ErrorKind::kUsage, "lossless goes without massage, which moves the vertices");
  if (mode != MassageMode::kOff && !sequence.clips.empty())
    throw Error(ErrorKind::kUsage, "several clips are not massaged together");
  if (mode == MassageMode::kAuto) {
    check(sequence);
    if (sequence.frame_count < kFewestFrames ||
        !sample_shrinks(sequence, massage_options, options, verdict, progress))
      mode = MassageMode::kOff;
  }
  if (mode == MassageMode::kOff)
    return encode(std::move(sequence), options, progress);
  const double source = EncodingMemory::of(sequence, {}).positions();
  MeshSequence massaged = massage(sequence, massage_options, progress).sequence;
  const HausdorffDistance moved = compare_surfaces(sequence, massaged).total;
  EncodeOptions changed = options;
  changed.most_bytes = most_bytes_beside(source, options.most_bytes);
  changed.surface_change = SurfaceChange{moved.mean(), moved.max()};
  EncodeResult result = encode(std::move(massaged), changed, progress);
  if (mode == MassageMode::kAuto && is_error(options.target.metric)) {
    EncodeResult plain = encode(std::move(sequence), options, progress);
    verdict->plain_bytes = plain.file.size();
    if (plain.file.size() <= result.file.size())
      return plain;
  }
  verdict->change = changed.surface_change;
  return result;
}

}  // namespace anicodec
