// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The options of encoding on the command line.
// bindings/generate wrote this from encode_options.py.

#ifndef ANICODEC_TOOLS_INPUTS_ENCODE_CHOICES_H_
#define ANICODEC_TOOLS_INPUTS_ENCODE_CHOICES_H_

#include "codec/plan/encode_options.h"
#include "codec/sequence/mesh_sequence.h"
#include "tools/options/options.h"
#include "tools/words/word_table.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// clang-format off
namespace anicodec::tools {

/// Targets that have a name.
enum class Quality : uint8_t { kGood, kBetter, kBest };

/// The part of the source's order that is kept. kAuto: that of the vertices, but nothing of scenes
/// (glTF, FBX and what else assimp reads), which carry their own faces and attributes: nobody
/// counts on the numbers of their vertices.
enum class OrderChoice : uint8_t { kAuto, kVertices, kFree, kAll };

/// The treatment of frames whose faces differ: an error, meshes of one file, or one mesh that has
/// the faces of the first frame.
enum class TopologyChanges : uint8_t { kRefuse, kKeep, kTransfer };

inline constexpr Word<std::optional<Quality>> kQualityWords[] = {
    {Quality::kGood, "good"},
    {Quality::kBetter, "better"},
    {Quality::kBest, "best"}};

inline constexpr Word<BasisChoice> kBasisWords[] = {
    {BasisChoice::kAuto, "auto"},
    {BasisChoice::kKeyframes, "keyframes"},
    {BasisChoice::kEigenshapes, "eigenshapes"},
    {BasisChoice::kEigentrajectories, "eigentrajectories"}};

inline constexpr Word<KeyframeMethod> kKeyframeSelectionWords[] = {
    {KeyframeMethod::kGas, "gas"},
    {KeyframeMethod::kPivot, "pivot"},
    {KeyframeMethod::kUniform, "uniform"}};

inline constexpr Word<std::optional<InterpolationChoice>> kInterpolationWords[] = {
    {InterpolationChoice::kLinear, "linear"},
    {InterpolationChoice::kMsgi, "msgi"},
    {InterpolationChoice::kAuto, "auto"}};

inline constexpr Word<KeyframePoses> kKeyframeCoderWords[] = {
    {KeyframePoses::kNative, "native"},
    {KeyframePoses::kDraco, "draco"},
    {KeyframePoses::kAuto, "auto"}};

inline constexpr Word<OrderChoice> kOrderWords[] = {
    {OrderChoice::kAuto, "auto"},
    {OrderChoice::kVertices, "vertices"},
    {OrderChoice::kFree, "free"},
    {OrderChoice::kAll, "all"}};

inline constexpr Word<TopologyChanges> kTopologyChangesWords[] = {
    {TopologyChanges::kRefuse, "refuse"},
    {TopologyChanges::kKeep, "keep"},
    {TopologyChanges::kTransfer, "transfer"}};

inline constexpr Word<Effort> kEfforts[] = {
    {Effort::kFast, "fast"},
    {Effort::kNormal, "normal"},
    {Effort::kBest, "best"}};

inline constexpr Word<MassageMode> kMassageWords[] = {
    {MassageMode::kOff, "off"},
    {MassageMode::kOn, "on"},
    {MassageMode::kAuto, "auto"}};

/// The STED of each Quality.
inline constexpr double kQualitySteds[] = {0.05, 0.02, 0.01};

/// Their values. Texts are read by the command.
struct EncodeChoices {
  std::string max_error;
  std::string kg;
  std::string rmse;
  std::string displacement;
  std::string sted;
  std::optional<Quality> quality;
  std::string size;
  std::string bpfv;
  bool lossless = false;
  BasisChoice basis = BasisChoice::kAuto;
  uint32_t keyframes = 0;
  KeyframeMethod selection = KeyframeMethod::kPivot;
  std::optional<InterpolationChoice> interpolation;
  KeyframePoses keyframe_coder = KeyframePoses::kNative;
  OrderChoice order = OrderChoice::kAuto;
  TopologyChanges topology_changes = TopologyChanges::kRefuse;
  bool split_objects = false;
  Effort effort = Effort::kNormal;
  bool smallest = false;
  MassageMode massage = MassageMode::kOff;
  double massage_strength = MassageOptions().strength;
  std::string massage_tolerance;
  bool no_attributes = false;
  uint32_t uv_bits = AttributeOptions().uv_bits;
  uint32_t colour_bits = AttributeOptions().colour_bits;
  std::string attribute_error;
  std::string fields;
  std::vector<std::string> field_errors;
  std::vector<std::string> field_units;
  std::string normal_error;
  std::string rate;
  UpAxis up = UpAxis::kUnknown;
  std::string unit;
  std::vector<std::string> events;
  std::vector<std::string> metadata;
  std::string metadata_file;
  bool root_motion = false;
  bool loop = false;
};

/// Declares them, which write to `choices`.
void add_encode_choices(Options& options, EncodeChoices& choices);

/// Declares those of a clip that is added to a file.
void add_clip_choices(Options& options, EncodeChoices& choices);

/// Sets the encoder's options that they are one to one.
void copy_choices(const EncodeChoices& choices, EncodeOptions* options);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_ENCODE_CHOICES_H_
