// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_ENCODE_ARGUMENTS_H_
#define ANICODEC_TOOLS_INPUTS_ENCODE_ARGUMENTS_H_

#include "codec/encode.h"
#include "codec/encode_live.h"
#include "codec/sequence/mesh_sequence.h"
#include "tools/inputs/encode_choices.h"
#include "tools/io/load_sequence.h"
#include "tools/options/options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace anicodec::tools {

/// The arguments of encode on the command line.
struct EncodeArguments : EncodeChoices {
  std::vector<std::string> inputs;
  std::string output, mesh, clip, clips, names, batch, memory, part;
  bool live = false;
  double piece = 1;              ///< of a live stream, seconds
  double key_every = kKeyEvery;  ///< the same
  std::string box;               ///< of a live stream: the diagonal that percentages are of
  /// "--option=value" for all that an output depends on beside its clip.
  std::vector<std::string> given;
  bool allow_outside = false;
  bool no_weld = false;
  std::string origin;  ///< "auto", "none" or "X,Y,Z"; empty: auto
  /// Told what of the input is left out; may be empty.
  std::function<void(const std::string& text)> note;
};

/// Declares the options of a command that adds a clip to a file: target, method, metadata.
void add_clip_arguments(Options& options, EncodeArguments& arguments);

/// Declares the options, which write to `arguments`.
void add_arguments(Options& options, EncodeArguments& arguments);

/// The order that is kept of a clip of these files.
OrderMode order_of(OrderChoice choice, const std::vector<std::string>& inputs);

/// The encoder's options for them, but for lengths with a unit of their own. Throws Error(kUsage)
/// naming the option.
EncodeOptions encode_options(const EncodeArguments& arguments);

/// Sets the target for a clip whose scene unit has so many metres (0: unknown). Throws Error(kUsage)
/// naming the option, also for a length in a unit of its own where the clip's is unknown.
void set_target(const EncodeArguments& arguments, double metres_per_unit, EncodeOptions* options);

/// Sets the target and the massage's tolerance for a scene. Throws as set_target().
void set_lengths(const EncodeArguments& arguments, const Scene& scene, EncodeOptions* options);

/// The importers' options from them.
LoadOptions load_options(const EncodeArguments& arguments, const Progress& progress);

/// Axes, unit and loop that they give a clip.
void set_metadata(const EncodeArguments& arguments, MeshSequence& sequence);

/// Drops the numbers that are not among those to be kept, and gives bounds and units to attributes by their names.
/// `meshes` are those of a file. Throws Error(kUsage) naming the option for a name that none has.
void set_fields(const EncodeArguments& arguments, const std::vector<MeshDetails*>& meshes);

/// All that an output depends on beside its clip, for comparing.
std::string settings_of(const EncodeArguments& arguments, const EncodeOptions& options);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_ENCODE_ARGUMENTS_H_
