// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The options of a host, of which each is one of the encoder's.
// bindings/generate wrote this from encode_options.py.

#ifndef ANICODEC_CODEC_API_HOST_CHOICES_H_
#define ANICODEC_CODEC_API_HOST_CHOICES_H_

#include "codec/api/encoder_objects.h"
#include "codec/api/host_values.h"

#include <cstdint>
#include <optional>

// clang-format off
namespace anicodec {

/// Flags that this version knows.
inline constexpr uint64_t kKnownFlags =
    ANIC_ENCODE_PERCENT |
    ANIC_ENCODE_CAP_PERCENT |
    ANIC_ENCODE_ERROR_PERCENT |
    ANIC_ENCODE_NO_ATTRIBUTES |
    ANIC_ENCODE_ROOT_MOTION |
    ANIC_ENCODE_LOSSLESS |
    ANIC_ENCODE_SMALLEST;

/// Throws EncoderFailure(ANIC_E_ARGUMENT).
inline void set_choices(const anic_encode_options& host, EncodeOptions* options) {
  constexpr BasisChoice kBasis[] = {
      BasisChoice::kAuto, BasisChoice::kKeyframes, BasisChoice::kEigenshapes, BasisChoice::kEigentrajectories};
  options->basis = chosen(host.basis, kBasis, "basis");
  constexpr KeyframeMethod kKeyframeSelection[] = {
      KeyframeMethod::kPivot, KeyframeMethod::kGas, KeyframeMethod::kUniform};
  options->select = chosen(host.selection, kKeyframeSelection, "selection");
  constexpr std::optional<InterpolationChoice> kInterpolation[] = {
      std::nullopt, InterpolationChoice::kLinear, InterpolationChoice::kMsgi, InterpolationChoice::kAuto};
  options->interpolation = chosen(host.interpolation, kInterpolation, "interpolation");
  constexpr KeyframePoses kKeyframeCoder[] = {
      KeyframePoses::kNative, KeyframePoses::kDraco, KeyframePoses::kAuto};
  options->keyframe_poses = chosen(host.keyframe_coder, kKeyframeCoder, "keyframe_coder");
  constexpr OrderMode kOrder[] = {
      OrderMode::kVertices, OrderMode::kFree, OrderMode::kAll};
  options->order = chosen(host.order, kOrder, "order");
  constexpr Effort kEffort[] = {
      Effort::kNormal, Effort::kFast, Effort::kBest};
  options->effort = chosen(host.effort, kEffort, "effort");
  options->smallest = (host.flags & ANIC_ENCODE_SMALLEST) != 0;
  constexpr MassageMode kMassage[] = {
      MassageMode::kOff, MassageMode::kOn, MassageMode::kAuto};
  options->massage.mode = chosen(host.massage, kMassage, "massage");
  if (amount(host.massage_strength, "massage_strength") > 0)
    options->massage.options.strength = host.massage_strength;
  if (amount(host.massage_tolerance, "massage_tolerance") > 0)
    options->massage.options.tolerance = host.massage_tolerance;
  options->attributes.keep = (host.flags & ANIC_ENCODE_NO_ATTRIBUTES) == 0;
  options->attributes.uv_bits = within(host.uv_bits, options->attributes.uv_bits, 24, "uv_bits");
  options->attributes.colour_bits = within(host.colour_bits, options->attributes.colour_bits, 16, "colour_bits");
  if (amount(host.normal_error, "normal_error") > 0)
    options->attributes.normals = host.normal_error;
  options->root_motion = (host.flags & ANIC_ENCODE_ROOT_MOTION) != 0;
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_API_HOST_CHOICES_H_
