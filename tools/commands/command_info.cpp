// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/live_stream.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/container.h"
#include "format/records.h"
#include "sdk/clip/sample.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/stream_input.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/names.h"
#include "tools/words/quantity.h"

#include <anicodec/anicodec.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

/// The parts of the root motion that are kept apart.
nlohmann::ordered_json root_words(uint8_t holds) {
  nlohmann::ordered_json words = nlohmann::ordered_json::array();
  if (holds & RootRecord::kMoves)
    words.push_back("moves");
  if (holds & RootRecord::kTurns)
    words.push_back("turns");
  return words;
}

nlohmann::ordered_json events_json(const ClipRecord& clip) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (const ClipEvent& event : clip.events)
    events.push_back({{"name", event.name}, {"seconds", event.seconds}});
  return events;
}

constexpr const char* kInfoFooter =
    R"(--json prints an object a file: file, bytes, ratio (float32 positions against the file),
bpfv, resident_bytes, opening_bytes, context_bytes (memory of the SDK: while open, at most while
opening, for each instance), format, encoder, name, vertices, coded_vertices, faces (of the first
mesh), meshes (name, vertices, coded_vertices, faces, frames: pairs of first and end of the frames
that show it), frames, fps, fps_assumed, start_time, loop, closed (the last frame repeats the
first), up, metres_per_unit, origin (positions count from it), order, diagonal, asked (metric,
value), max_error, max_error_percent, rmse, kg, massaged, surface_error, surface_error_mean (for
several clips, of the first one), clips (name, first_frame, frames, fps, fps_assumed, start_time,
loop, closed, diagonal, asked, max_error, max_error_percent, rmse, kg), attributes (mesh, kind, of,
name, components, labels, looks, moves; of numbers, unit, whole: exact once rounded, ranges of
components; of moving ones, bytes, max_error, rmse in units of their values), segments (mesh, basis,
of, reconstruction, first_frame, frames, components, regions, corrections; coder of key-frames),
chunks (type, offset, size, required, mesh, segment). Lengths are in scene units, errors those the
encoder measured. A live stream is described as the clip that its files make, with stream: files
(offset, bytes, start_time, frames, has_mesh, key: begins anew, plays), losses, incomplete_bytes. If
a file was lost, the stream stands alone, and the status is 3; the same, with status 0, of files
that have different meshes.)";

struct Contents {
  uint64_t bytes = 0;
  anic_requirements memory = ANIC_INIT(anic_requirements);  ///< as the SDK announces it
  ContainerReader container;
  Clip clip;
  nlohmann::ordered_json metadata = nlohmann::ordered_json::object();
};

/// The runs of frames that show a mesh. O(its segments).
std::vector<FrameRun> frames_of_mesh(const Clip& clip, uint32_t mesh) {
  std::vector<FrameRun> runs;
  const Track& track = clip.tracks()[mesh];
  for (uint32_t i = track.begin; i < track.end; ++i) {
    const Segment& segment = clip.segments()[clip.by_frame()[i]];
    if (runs.empty() || runs.back().first + runs.back().count != segment.first_frame)
      runs.push_back({segment.first_frame, 0});
    runs.back().count += segment.frames;
  }
  return runs;
}

double percent(const ClipRecord& record) {
  return record.max_error == 0 ? 0 : 100 * record.max_error / record.diagonal;
}

double positions(const Clip& clip) {
  double count = 0;
  for (const Limits::Segment& s : clip.limits().segments) {
    if (s.attribute == kPositions)
      count += static_cast<double>(clip.vertex_count(s.mesh)) * s.frames;
  }
  return count;
}

/// The name of what a segment moves.
std::string moved_by(const Limits::Segment& s) {
  return s.attribute == kPositions
             ? std::string("positions")
             : fmt::format("attribute {} from component {}", s.attribute, s.first_component);
}

bool moves(const Clip& clip, uint32_t mesh, uint32_t attribute) {
  const auto [first, last] = clip.attribute_tracks(mesh, attribute);
  return first != last;
}

/// Bytes of the segments of an attribute.
uint64_t moving_bytes(const Contents& c, uint32_t mesh, uint32_t attribute) {
  uint64_t bytes = 0;
  for (const Chunk& chunk : c.container.chunks()) {
    if (chunk.segment == kNoSegment)
      continue;
    const Limits::Segment& s = c.clip.limits().segments[chunk.segment];
    if (s.mesh == mesh && s.attribute == attribute)
      bytes += chunk.size;
  }
  return bytes;
}

/// The error that the encoder measured of an attribute that moves, if it did.
const AttributeError* error_of(const ClipRecord& record, uint32_t mesh, uint32_t attribute) {
  for (const AttributeError& e : record.attribute_errors) {
    if (e.mesh == mesh && e.attribute == attribute)
      return &e;
  }
  return nullptr;
}

/// The field of the metadata that is about an attribute's numbers; null if there is none.
nlohmann::ordered_json field_of(const Contents& c, const MeshAttribute& attribute) {
  const auto fields = c.metadata.find("fields");
  if (fields == c.metadata.end() || !fields->is_object())
    return nullptr;
  const auto field =
      fields->find(std::string(attribute.header.name.begin(), attribute.header.name.end()));
  return field == fields->end() || !field->is_object() ? nlohmann::ordered_json() : *field;
}

std::string unit_of(const Contents& c, const MeshAttribute& attribute) {
  const nlohmann::ordered_json field = field_of(c, attribute);
  const auto unit = field.find("unit");
  return field.is_null() || unit == field.end() || !unit->is_string() ? std::string()
                                                                      : unit->get<std::string>();
}

bool is_whole(const Contents& c, const MeshAttribute& attribute) {
  const nlohmann::ordered_json field = field_of(c, attribute);
  const auto whole = field.find("whole");
  return !field.is_null() && whole != field.end() && *whole == true;
}

using Range = std::pair<float, float>;

/// Least and largest value of each component, over all frames that show the mesh; empty without values.
std::vector<Range> ranges_of(const Contents& c, uint32_t mesh, uint32_t number) {
  const MeshAttribute& attribute = c.clip.meshes()[mesh].attributes[number];
  std::vector<float> values(attribute.values.begin(), attribute.values.end());
  std::vector<Range> ranges;
  const uint32_t n = attribute.header.components();
  if (values.empty())
    return ranges;
  for (uint32_t i = 0; i < n; ++i)
    ranges.emplace_back(values[i], values[i]);
  const auto widen = [&] {
    for (size_t i = 0; i < values.size(); ++i) {
      auto& [low, high] = ranges[i % n];
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
  };
  if (!moves(c.clip, mesh, number)) {
    widen();
    return ranges;
  }
  bool is_first = true;
  for (const FrameRun& run : frames_of_mesh(c.clip, mesh)) {
    for (uint32_t f = run.first; f < run.first + run.count; ++f) {
      show_attribute(c.clip, mesh, number, f, values.data());
      for (uint32_t i = 0; is_first && i < n; ++i)
        ranges[i] = {values[i], values[i]};
      is_first = false;
      widen();
    }
  }
  return ranges;
}

/// The coder of key-frames.
const char* coder_of(const Limits::Segment& segment) {
  return segment.draco_bytes > 0 ? "draco" : "native";
}

/// One object for each material, null where its look is unknown.
nlohmann::ordered_json looks_json(const Vector<MaterialLook>& looks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MaterialLook& look : looks) {
    nlohmann::ordered_json& json = list.emplace_back();
    if (!look.known)
      continue;
    json = {{"base_colour", look.base_colour},
            {"metallic", look.metallic},
            {"roughness", look.roughness},
            {"emissive", look.emissive},
            {"alpha", word_of(kAlphaModes, look.alpha)},
            {"double_sided", look.double_sided}};
    if (look.alpha == AlphaMode::kMask)
      json["alpha_cutoff"] = look.alpha_cutoff;
    for (const Word<TextureSlot>& slot : kTextures) {
      if (const String& texture = look.texture(slot.value); !texture.empty())
        json["textures"][slot.text] = texture;
    }
  }
  return list;
}

nlohmann::ordered_json json_of(const std::string& path, const Contents& c) {
  const ClipRecord& record = c.clip.clips()[0];
  const Limits& limits = c.clip.limits();
  nlohmann::ordered_json json;
  json["file"] = path;
  json["bytes"] = c.bytes;
  json["ratio"] = 12 * positions(c.clip) / static_cast<double>(c.bytes);
  json["bpfv"] = 8 * static_cast<double>(c.bytes) / positions(c.clip);
  json["resident_bytes"] = c.memory.resident_bytes;
  json["opening_bytes"] = c.memory.opening_bytes;
  json["context_bytes"] = c.memory.context_bytes;
  json["format"] = fmt::format("{}.{}", c.container.version_major(), c.container.version_minor());
  json["features"] = feature_list(c.container.features());
  json["encoder"] = c.clip.record().encoder;
  json["metadata"] = c.metadata;
  json["name"] = record.name;
  json["vertices"] = limits.meshes[0].source_vertices;
  json["coded_vertices"] = limits.meshes[0].coded_vertices;
  json["faces"] = limits.meshes[0].polygons;
  json["meshes"] = nlohmann::ordered_json::array();
  for (uint32_t m = 0; m < limits.meshes.size(); ++m) {
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    for (const FrameRun& run : frames_of_mesh(c.clip, m))
      frames.push_back({run.first, run.first + run.count});
    json["meshes"].push_back({{"name", c.clip.meshes()[m].name},
                              {"vertices", limits.meshes[m].source_vertices},
                              {"coded_vertices", limits.meshes[m].coded_vertices},
                              {"faces", limits.meshes[m].polygons},
                              {"frames", frames}});
  }
  json["frames"] = limits.frames;
  json["fps"] = {record.rate_numerator, record.rate_denominator};
  json["fps_assumed"] = record.rate_assumed;
  json["start_time"] = record.start_time;
  json["loop"] = record.loop;
  json["closed"] = record.closed;
  json["up"] = up_name(c.clip.record().up);
  json["metres_per_unit"] = nullptr;
  if (c.clip.record().metres_per_unit > 0)
    json["metres_per_unit"] = c.clip.record().metres_per_unit;
  json["origin"] = c.clip.record().origin;
  json["order"] = name_of(c.clip.record().order);
  json["diagonal"] = record.diagonal;
  json["asked"] = {{"metric", name_of(record.asked)}, {"value", record.asked_value}};
  json["max_error"] = record.max_error;
  json["max_error_percent"] = percent(record);
  json["rmse"] = record.rmse;
  json["kg"] = record.kg;
  json["max_displacement_error"] = record.max_displacement_error;
  json["massaged"] = record.massaged;
  json["surface_error"] = record.surface_error;
  json["surface_error_mean"] = record.surface_error_mean;
  json["clips"] = nlohmann::ordered_json::array();
  for (const ClipRecord& clip : c.clip.clips())
    json["clips"].push_back(
        {{"name", clip.name},
         {"first_frame", clip.first_frame},
         {"frames", clip.frames},
         {"fps", {clip.rate_numerator, clip.rate_denominator}},
         {"fps_assumed", clip.rate_assumed},
         {"start_time", clip.start_time},
         {"loop", clip.loop},
         {"closed", clip.closed},
         {"diagonal", clip.diagonal},
         {"asked", {{"metric", name_of(clip.asked)}, {"value", clip.asked_value}}},
         {"max_error", clip.max_error},
         {"max_error_percent", percent(clip)},
         {"rmse", clip.rmse},
         {"kg", clip.kg},
         {"max_displacement_error", clip.max_displacement_error},
         {"root_motion",
          root_words(c.clip.root().holds(static_cast<uint32_t>(&clip - c.clip.clips().data())))},
         {"events", events_json(clip)}});
  json["attributes"] = nlohmann::ordered_json::array();
  for (uint32_t m = 0; m < limits.meshes.size(); ++m) {
    const Vector<MeshAttribute>& attributes = c.clip.meshes()[m].attributes;
    for (uint32_t i = 0; i < attributes.size(); ++i) {
      const MeshAttribute& a = attributes[i];
      nlohmann::ordered_json entry = {{"mesh", m},
                                      {"kind", name_of(a.header.kind)},
                                      {"of", name_of(a.header.domain)},
                                      {"name", a.header.name},
                                      {"components", a.header.components()},
                                      {"labels", a.header.labels},
                                      {"moves", moves(c.clip, m, i)}};
      if (!a.header.looks.empty())
        entry["looks"] = looks_json(a.header.looks);
      if (a.header.components() > 0) {
        entry["unit"] = unit_of(c, a);
        entry["whole"] = is_whole(c, a);
        entry["ranges"] = ranges_of(c, m, i);
      }
      if (const AttributeError* error = error_of(record, m, i)) {
        entry["bytes"] = moving_bytes(c, m, i);
        entry["max_error"] = error->max_error;
        entry["rmse"] = error->rmse;
      }
      json["attributes"].push_back(entry);
    }
  }
  json["segments"] = nlohmann::ordered_json::array();
  for (size_t i = 0; i < limits.segments.size(); ++i) {
    const Limits::Segment& s = limits.segments[i];
    json["segments"].push_back({{"mesh", s.mesh},
                                {"basis", name_of(s.kind)},
                                {"of", moved_by(s)},
                                {"reconstruction", name_of(s.reconstruction)},
                                {"first_frame", s.first_frame},
                                {"frames", s.frames},
                                {"components", s.components},
                                {"regions", s.regions},
                                {"corrections", s.corrections}});
    if (s.kind == BasisKind::kKeyframes)
      json["segments"].back()["coder"] = coder_of(s);
  }
  json["chunks"] = nlohmann::ordered_json::array();
  for (const Chunk& chunk : c.container.chunks()) {
    nlohmann::ordered_json entry = {
        {"type", chunk_name(chunk.type)}, {"offset", chunk.offset}, {"size", chunk.size},
        {"required", chunk.required},     {"mesh", nullptr},        {"segment", nullptr}};
    if (chunk.mesh != kNoMesh)
      entry["mesh"] = chunk.mesh;
    if (chunk.segment != kNoSegment)
      entry["segment"] = chunk.segment;
    json["chunks"].push_back(entry);
  }
  return json;
}

std::string asked_text(const ClipRecord& record) {
  double value = record.asked_value;
  switch (record.asked) {
    case ErrorMetric::kNone:
      return "a number of key-frames";
    case ErrorMetric::kKg:
      return fmt::format("KG error of at most {:.4g} %", value);
    case ErrorMetric::kMaxError:
      if (value == 0)
        return "the source's positions, bit for bit";
      return fmt::format("max error of at most {:.4g}", value);
    case ErrorMetric::kRmse:
      return fmt::format("RMSE of at most {:.4g}", value);
    case ErrorMetric::kDisplacement:
      return fmt::format("moves from frame to frame with an error of at most {:.4g}", value);
    case ErrorMetric::kSted:
      return fmt::format("STED of at most {:.4g}", value);
    case ErrorMetric::kSize:
      return fmt::format("at most {} bytes", grouped(static_cast<uint64_t>(value)));
    case ErrorMetric::kBpfv:
      return fmt::format("at most {:.4g} bits per frame and vertex", value);
  }
  return "unknown";
}

std::string rate_text(const ClipRecord& record) {
  double value = static_cast<double>(record.rate_numerator) / record.rate_denominator;
  return fmt::format("{:.6g} fps{}{}", value, record.rate_assumed ? " (assumed)" : "",
                     record.times.empty() ? "" : ", uneven times");
}

void print_chunks(const Contents& c) {
  auto number = [](uint32_t value, uint32_t none) {
    return value == none ? std::string() : fmt::format("{}", value);
  };
  fmt::print("\n{:<6} {:>5} {:>8} {:>12} {:>12} {:>7}\n", "chunk", "mesh", "segment", "offset",
             "bytes", "share");
  for (const Chunk& chunk : c.container.chunks()) {
    fmt::print("{:<6} {:>5} {:>8} {:>12} {:>12} {:>5.1f} %\n", chunk_name(chunk.type),
               number(chunk.mesh, kNoMesh), number(chunk.segment, kNoSegment), chunk.offset,
               grouped(chunk.size),
               100 * static_cast<double>(chunk.size) / static_cast<double>(c.bytes));
  }
}

std::string attribute_text(const Contents& c, uint32_t mesh, uint32_t number) {
  const MeshAttribute& attribute = c.clip.meshes()[mesh].attributes[number];
  const AttributeHeader& a = attribute.header;
  std::string text = fmt::format("{} of {}", name_of(a.kind), name_of(a.domain));
  if (!a.name.empty())
    text += fmt::format(" \"{}\"", a.name);
  if (a.has_labels())
    return text + fmt::format(", {}{}", counted(a.labels.size(), "name"),
                              a.looks.empty() ? "" : " with their values");
  if (a.components() == 0)
    return text + ": hard edges";
  text += fmt::format(", {} in steps of {:.3g}", counted(a.components(), "component"),
                      1 / a.grids[0].scale);
  const std::vector<Range> ranges = ranges_of(c, mesh, number);
  if (ranges.empty())
    return text;
  Range all = ranges[0];
  for (const auto& [low, high] : ranges)
    all = {std::min(all.first, low), std::max(all.second, high)};
  const std::string unit = unit_of(c, attribute);
  return text + fmt::format(", {:.6g} to {:.6g}{}{}{}", all.first, all.second,
                            unit.empty() ? "" : " ", unit,
                            is_whole(c, attribute) ? ", whole numbers, exact" : "");
}

void row(const char* name, const std::string& value) {
  print_line("{:<10} {}", name, value);
}

/// The meshes, where there are several, and what they have beside positions.
void print_meshes(const Contents& c) {
  const Limits& limits = c.clip.limits();
  for (uint32_t m = 0; m < limits.meshes.size(); ++m) {
    const anicodec::Mesh& mesh = c.clip.meshes()[m];
    if (limits.meshes.size() > 1) {
      std::string frames;
      for (const FrameRun& run : frames_of_mesh(c.clip, m))
        frames +=
            fmt::format("{} {}:{}", frames.empty() ? "" : ",", run.first, run.first + run.count);
      row("mesh", fmt::format("{}{}{} vertices ({} coded), {} faces, frames{}", mesh.name,
                              mesh.name.empty() ? "" : ": ", limits.meshes[m].source_vertices,
                              limits.meshes[m].coded_vertices, limits.meshes[m].polygons, frames));
    }
    for (uint32_t i = 0; i < mesh.attributes.size(); ++i) {
      row("attribute", attribute_text(c, m, i));
      if (const AttributeError* error = error_of(c.clip.clips()[0], m, i))
        row("", fmt::format("{}, {} bytes, max error {:.4g}, RMSE {:.4g}",
                            moves(c.clip, m, i) ? "moves" : "as in frame 0",
                            grouped(moving_bytes(c, m, i)), error->max_error, error->rmse));
    }
  }
}

void print_segments(const Clip& clip) {
  const Limits& limits = clip.limits();
  for (size_t i = 0; i < limits.segments.size(); ++i) {
    const Limits::Segment& s = limits.segments[i];
    row("segment",
        fmt::format("{}{}frames {}:{}, {}{}{}{}, {}",
                    limits.meshes.size() > 1 ? fmt::format("mesh {}, ", s.mesh) : "",
                    s.attribute == kPositions ? "" : moved_by(s) + ", ", s.first_frame,
                    s.first_frame + s.frames, counted_components(s.components, s.kind),
                    s.regions > 1 ? fmt::format(" in {} regions", s.regions) : "",
                    s.reconstruction == Reconstruction::kMsgi ? " by msgi" : "",
                    s.kind == BasisKind::kKeyframes ? fmt::format(", coder {}", coder_of(s)) : "",
                    counted(s.corrections, "correction")));
  }
}

std::string traits_of(const ClipRecord& clip) {
  return fmt::format("{}{}", clip.loop ? ", loops" : "",
                     clip.closed ? ", the last frame repeats the first" : "");
}

void print_promise(const ClipRecord& clip) {
  row("asked", asked_text(clip));
  row("measured",
      fmt::format(
          "max error {:.4g} ({:.3g} % of the diagonal), RMSE {:.4g}, KG {:.4g} %, of a move from "
          "frame to frame {:.4g}",
          clip.max_error, percent(clip), clip.rmse, clip.kg, clip.max_displacement_error));
  if (clip.massaged)
    row("massaged", fmt::format("the surface moved by {:.4g} on average, {:.4g} at most",
                                clip.surface_error_mean, clip.surface_error));
}

/// Prints the root motion that is kept, and named times.
void print_extras(const Contents& c, const ClipRecord& clip) {
  const auto number = static_cast<uint32_t>(&clip - c.clip.clips().data());
  std::string root, events;
  for (const auto& word : root_words(c.clip.root().holds(number)))
    root += (root.empty() ? "" : ", ") + word.get<std::string>();
  for (const ClipEvent& event : clip.events)
    events += fmt::format(
        "{}{} {:.6g} s", events.empty() ? "" : ", ",
        event.name.empty() ? "(no name)" : std::string(event.name.begin(), event.name.end()),
        event.seconds);
  if (!root.empty())
    row("root", root);
  if (!events.empty())
    row("events", events);
}

/// The clips of a file that has several.
void print_clips(const Contents& c) {
  for (const ClipRecord& clip : c.clip.clips()) {
    row("clip", fmt::format("{}: frames {}:{}, {}{}", clip.name, clip.first_frame,
                            clip.first_frame + clip.frames, rate_text(clip), traits_of(clip)));
    print_extras(c, clip);
    print_promise(clip);
  }
}

void print_text(const std::string& path, const Contents& c) {
  const ClipsRecord& all = c.clip.record();
  const ClipRecord& record = c.clip.clips()[0];
  const bool several = c.clip.clips().size() > 1;
  const Limits& limits = c.clip.limits();
  const Limits::Mesh& mesh = limits.meshes[0];
  row("file", path);
  if (!several)
    row("name", std::string(record.name.begin(), record.name.end()));
  row("format", fmt::format("{}.{}, written by {}", c.container.version_major(),
                            c.container.version_minor(), all.encoder));
  if (c.container.features() != 0)
    row("needs", feature_names(c.container.features()) + ", which decoders may lack");
  for (const auto& [key, value] : c.metadata.items())
    row(key.c_str(), value.is_string() ? value.get<std::string>() : value.dump());
  const std::string what =
      limits.meshes.size() > 1
          ? fmt::format("{} meshes", limits.meshes.size())
          : fmt::format("{} vertices ({} coded), {} faces", mesh.source_vertices,
                        mesh.coded_vertices, mesh.polygons);
  row(several ? "clips" : "clip",
      several
          ? fmt::format("{}, {} clips, {}", what, c.clip.clips().size(),
                        counted(limits.frames, "frame"))
          : fmt::format("{}, {} at {}", what, counted(limits.frames, "frame"), rate_text(record)));
  row("", fmt::format(
              "up {}, unit {}{}", up_name(all.up),
              all.metres_per_unit > 0 ? fmt::format("{:.6g} m", all.metres_per_unit) : "unknown",
              several ? "" : traits_of(record)));
  if (all.has_origin())
    row("origin", fmt::format("{}: positions count from it", fmt::join(all.origin, ",")));
  print_meshes(c);
  row("order", name_of(all.order));
  row("size", fmt::format("{} bytes, {:.1f} : 1, {:.3f} bpfv", grouped(c.bytes),
                          12 * positions(c.clip) / static_cast<double>(c.bytes),
                          8 * static_cast<double>(c.bytes) / positions(c.clip)));
  row("memory",
      fmt::format("{} open, {} at most while opening, {} for each instance",
                  readable_bytes(c.memory.resident_bytes), readable_bytes(c.memory.opening_bytes),
                  readable_bytes(c.memory.context_bytes)));
  if (several) {
    print_clips(c);
  } else {
    print_extras(c, record);
    print_promise(record);
  }
  print_segments(c.clip);
  print_chunks(c);
}

/// A file of a live stream: what a program that joins or has lost another one wants to know.
const char* word_of(const StreamedFile& file) {
  return file.has_mesh ? "with meshes"
         : file.is_key ? "begins anew"
         : file.plays  ? "goes on"
                       : "continues a lost one";
}

nlohmann::ordered_json json_of(const StreamContents& stream) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const StreamedFile& file : stream.files)
    files.push_back({{"offset", file.offset},
                     {"bytes", file.size},
                     {"start_time", file.start},
                     {"frames", file.frames},
                     {"has_mesh", file.has_mesh},
                     {"key", file.is_key},
                     {"plays", file.plays}});
  return {{"files", files}, {"losses", stream.losses}, {"incomplete_bytes", stream.incomplete}};
}

void print_text(const StreamContents& stream) {
  fmt::print("\n{:<6} {:>10} {:>12} {:>12} {:>7}  of the stream\n", "file", "seconds", "offset",
             "bytes", "frames");
  for (size_t i = 0; i < stream.files.size(); ++i) {
    const StreamedFile& file = stream.files[i];
    fmt::print("{:<6} {:>10.2f} {:>12} {:>12} {:>7}  {}\n", i + 1, file.start, file.offset,
               grouped(file.size), file.frames, word_of(file));
  }
}

/// `stream`: the files of the live stream that the clip is of, or null.
void print_clip(const std::string& path, const std::string& bytes, const StreamContents* stream,
                const CommonOptions& common) {
  Contents contents;
  contents.bytes = bytes.size();
  if (Failure failure = contents.clip.open(view_of(bytes)); !failure.ok())
    fail_clip(path, failure);
  if (Failure failure = contents.container.open(view_of(bytes)); !failure.ok())
    fail_clip(path, failure);
  anic_options options = ANIC_INIT(anic_options);
  options.max_bytes = UINT64_MAX;
  anic_get_requirements(bytes.data(), bytes.size(), &options,
                        &contents.memory);  // it is open: nothing fails
  const char* text;
  size_t size;
  if (anic_read_metadata(bytes.data(), bytes.size(), &text, &size) == ANIC_OK) {
    contents.metadata = nlohmann::ordered_json::parse(text, text + size, nullptr, false);
    if (!contents.metadata.is_object())
      throw Error(ErrorKind::kCorrupt, path + ": chunk META: is not a JSON object");
  }
  if (common.json) {
    nlohmann::ordered_json json = json_of(path, contents);
    if (stream)
      json["stream"] = json_of(*stream);
    print_json(json);
    return;
  }
  print_text(path, contents);
  if (stream)
    print_text(*stream);
}

/// The clip that the files of a live stream make, and the files; there is no clip where one was lost, or brings other meshes.
void print_stream(const std::string& path, const std::string& bytes, const CommonOptions& common) {
  const StreamContents stream =
      read_stream(path, view_of(bytes), [](const auto&, const auto&, const auto&) {});
  if (stream.losses.empty() && std::ranges::count_if(stream.files, &StreamedFile::has_mesh) == 1)
    return print_clip(path, join_stream(path, bytes), &stream, common);
  if (common.json) {
    print_json({{"file", path}, {"bytes", bytes.size()}, {"stream", json_of(stream)}});
  } else {
    row("file", path);
    print_text(stream);
  }
  check_losses(path, stream);
}

void print_contents(const std::string& path, const CommonOptions& common) {
  const std::string bytes = read_clip_bytes(path);
  if (is_live_stream(view_of(bytes)))
    print_stream(path, bytes, common);
  else
    print_clip(path, bytes, nullptr, common);
}

}  // namespace

void add_info(Commands& commands, CommonOptions& common) {
  auto inputs = std::make_shared<std::vector<std::string>>();
  Options& options = add_command(
      commands, common, kJson, {"info", "FILE.anic...", "Say what is in .anic files", kInfoFooter},
      [inputs, &common] {
        run_for_each(*inputs, common,
                     [&](const std::string& path) { print_contents(path, common); });
      });
  options.arguments("FILE", *inputs, "The .anic files to read").required();
}

}  // namespace anicodec::tools
