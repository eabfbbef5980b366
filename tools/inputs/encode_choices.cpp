// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The options of encoding on the command line.
// bindings/generate wrote this from encode_options.py.

#include "tools/inputs/encode_choices.h"

#include "format/records.h"
#include "tools/words/names.h"

// clang-format off
namespace anicodec::tools {

void add_encode_choices(Options& options, EncodeChoices& c) {
  options.group("Target");
  options.option("--max-error", c.max_error, "LEN",
                 "Largest error of any vertex (default 0.05%)");
  options.option("--kg", c.kg, "PCT",
                 "KG error in per cent");
  options.option("--rmse", c.rmse, "LEN",
                 "Root mean square error");
  options.option("--displacement", c.displacement, "LEN",
                 "Largest error of a vertex's move from frame to frame: less jitter");
  options.option("--sted", c.sted, "X",
                 "STED, a perceptual error");
  options.choice("--quality", c.quality, {kQualityWords},
                 "Visible beside the original (good, STED 0.05), hardly (better, 0.02), not (best, 0.01)");
  options.option("--size", c.size, "BYTES",
                 "Smallest error in a file of at most 40000, 40k or 1.5M bytes");
  options.option("--bpfv", c.bpfv, "BITS",
                 "The same, as bits per frame and vertex");
  options.flag("--lossless", c.lossless,
               "The positions come back bit for bit; the file is several times as large");
  options.exclude({"--kg", "--rmse", "--displacement", "--sted", "--quality", "--size", "--bpfv", "--lossless"});
  options.exclude({"--max-error", "--lossless"});
  options.group("Method");
  options.choice("--basis", c.basis, {kBasisWords},
                 "Kind of basis (default auto: the smallest file)");
  options.number("--keyframes", c.keyframes, "K", {1, kMaxFrames},
                 "Number of key-frames (default: as few as do)");
  options.choice("--keyframe-selection", c.selection, {kKeyframeSelectionWords},
                 "How key-frames are chosen (default pivot)");
  options.choice("--interpolation", c.interpolation, {kInterpolationWords},
                 "How frames come from key-frames: linear, msgi, which decoders may lack, or auto (default linear, of --basis auto auto)");
  options.choice("--keyframe-coder", c.keyframe_coder, {kKeyframeCoderWords},
                 "Coder of key-frames: native (default), draco, which decoders may lack, or the smaller (auto)");
  options.choice("--order", c.order, {kOrderWords},
                 "Source order kept: that of vertices, none (free), of faces too (all); default auto: vertices, of glTF and FBX scenes none");
  options.choice("--topology-changes", c.topology_changes, {kTopologyChangesWords},
                 "Frames whose faces differ: refuse them (default), keep them as meshes of the file, or transfer the faces of the first frame to all");
  options.flag("--split-objects", c.split_objects,
               "Store each object of the input as a mesh, present only in the frames that show it (default: as parts of one mesh)");
  options.choice("--effort", c.effort, {kEfforts},
                 "How long to search (default normal)");
  options.flag("--smallest", c.smallest,
               "Make the file as small as can be, however long it takes to open (default: a balance)");
  options.group("Massage");
  options.choice("--massage", c.massage, {kMassageWords},
                 "Move vertices along their surface first (default off)");
  options.number("--massage-strength", c.massage_strength, "X", {},
                 "Weight of shape against distance, between 0 and 1 (default 0.5)");
  options.option("--massage-tolerance", c.massage_tolerance, "LEN",
                 "How far the surface may move anywhere (default: as far as it needs)");
  options.group("Attributes");
  options.flag("--no-attributes", c.no_attributes,
               "Positions and faces alone");
  options.number("--uv-bits", c.uv_bits, "N", {1, 24},
                 "Texture coordinates in steps of 2^-N (default 12)");
  options.number("--colour-bits", c.colour_bits, "N", {1, 16},
                 "Bits for each component of a colour (default 8)");
  options.option("--attribute-error", c.attribute_error, "X",
                 "Largest error of colours, texture coordinates and other numbers that change, in their own units or per cent of their range (default: half a step of --colour-bits for colours, 0.1% for others)");
  options.option("--fields", c.fields, "NAME,...|none",
                 "Numbers beside positions, colours and texture coordinates that are kept (default: all)");
  options.repeated("--field-error", c.field_errors, "NAME=X|exact",
                 "Largest error of one of them, or of another attribute, in its units or per cent of its range; exact: whole numbers stay as they are");
  options.repeated("--field-unit", c.field_units, "NAME=TEXT",
                 "Unit of its values, as K or m/s: shown by info");
  options.option("--store-normals", c.normal_error, "DEG",
                 "Normals and tangents of the first frame as numbers, not only the hard edges: to within an angle in degrees, as 0.05");
  options.group("Metadata (positions stay as they are)");
  options.option("--fps", c.rate, "N[/D]",
                 "Frames per second (default: as in the input, else 24; of a scene: the grid that its keys stand on, or without one a rate of 30 or more that ends with the last)");
  options.choice("--up", c.up, {kUpAxes},
                 "Axis that points up");
  options.option("--unit", c.unit, "METRES",
                 "Length of a scene unit: metres, or m cm mm km in ft");
  options.repeated("--event", c.events, "[CLIP:]NAME=SECONDS",
                 "A named time of the clip, from its first frame on, or of one of several clips");
  options.repeated("--meta", c.metadata, "KEY=VALUE",
                 "Facts to store in the file, as author=, licence=, source=: shown by info");
  options.option("--meta-file", c.metadata_file, "FILE.json",
                 "The same, as a JSON object");
  options.flag("--root-motion", c.root_motion,
               "Keep the motion of the whole along the ground, and its turn about the up axis, apart: a program can leave it out and move the character itself");
  options.flag("--loop", c.loop,
               "The clip is meant to be repeated");
}

void add_clip_choices(Options& options, EncodeChoices& c) {
  options.group("Target");
  options.option("--max-error", c.max_error, "LEN",
                 "Largest error of any vertex (default 0.05%)");
  options.option("--kg", c.kg, "PCT",
                 "KG error in per cent");
  options.option("--rmse", c.rmse, "LEN",
                 "Root mean square error");
  options.option("--displacement", c.displacement, "LEN",
                 "Largest error of a vertex's move from frame to frame: less jitter");
  options.option("--sted", c.sted, "X",
                 "STED, a perceptual error");
  options.choice("--quality", c.quality, {kQualityWords},
                 "Visible beside the original (good, STED 0.05), hardly (better, 0.02), not (best, 0.01)");
  options.option("--size", c.size, "BYTES",
                 "Smallest error in a file of at most 40000, 40k or 1.5M bytes");
  options.option("--bpfv", c.bpfv, "BITS",
                 "The same, as bits per frame and vertex");
  options.flag("--lossless", c.lossless,
               "The positions come back bit for bit; the file is several times as large");
  options.exclude({"--kg", "--rmse", "--displacement", "--sted", "--quality", "--size", "--bpfv", "--lossless"});
  options.exclude({"--max-error", "--lossless"});
  options.group("Method");
  options.choice("--basis", c.basis, {kBasisWords},
                 "Kind of basis (default auto: the smallest file)");
  options.choice("--effort", c.effort, {kEfforts},
                 "How long to search (default normal)");
  options.group("Metadata (positions stay as they are)");
  options.option("--fps", c.rate, "N[/D]",
                 "Frames per second (default: as in the input, else 24; of a scene: the grid that its keys stand on, or without one a rate of 30 or more that ends with the last)");
  options.choice("--up", c.up, {kUpAxes},
                 "Axis that points up");
  options.option("--unit", c.unit, "METRES",
                 "Length of a scene unit: metres, or m cm mm km in ft");
  options.repeated("--event", c.events, "[CLIP:]NAME=SECONDS",
                 "A named time of the clip, from its first frame on, or of one of several clips");
  options.repeated("--meta", c.metadata, "KEY=VALUE",
                 "Facts to store in the file, as author=, licence=, source=: shown by info");
  options.option("--meta-file", c.metadata_file, "FILE.json",
                 "The same, as a JSON object");
  options.flag("--root-motion", c.root_motion,
               "Keep the motion of the whole along the ground, and its turn about the up axis, apart: a program can leave it out and move the character itself");
  options.flag("--loop", c.loop,
               "The clip is meant to be repeated");
}

void copy_choices(const EncodeChoices& c, EncodeOptions* options) {
  options->basis = c.basis;
  options->select = c.selection;
  options->interpolation = c.interpolation;
  options->keyframe_poses = c.keyframe_coder;
  options->effort = c.effort;
  options->smallest = c.smallest;
  options->massage.mode = c.massage;
  options->massage.options.strength = c.massage_strength;
  options->attributes.keep = !c.no_attributes;
  options->attributes.uv_bits = c.uv_bits;
  options->attributes.colour_bits = c.colour_bits;
  options->root_motion = c.root_motion;
}

}  // namespace anicodec::tools
