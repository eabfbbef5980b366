// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Decodes a file or a live stream for tests/conformance/run.py: positions and faces of each mesh, and all
// else that it holds as JSON; a stream as one clip. The exit status of a file that is refused is its code.
//
// usage: sdk_decoder FILE.anic OUT
#include "format/bounds_record.h"
#include "format/container.h"
#include "format/continuation.h"
#include "format/metadata.h"
#include "sdk/clip/file_checks.h"
#include "sdk/clip/kept_learning.h"
#include "sdk/clip/sample.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

using Positions = std::vector<std::vector<float>>;  // by frame

std::string number(double value) {
  if (std::isnan(value))
    return "null";
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// With all its digits.
std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// Bytes that are not ASCII are written as the characters of the same number.
std::string quoted(const String& text) {
  std::string out = "\"";
  for (const char byte : text) {
    const auto c = static_cast<unsigned char>(byte);
    char escape[8];
    std::snprintf(escape, sizeof escape, "\\u%04x", unsigned{c});
    if (c >= 0x20 && c < 0x7F && c != '"' && c != '\\')
      out += byte;
    else
      out += escape;
  }
  return out + "\"";
}

template <class Values, class Print>
std::string list(const Values& values, Print print) {
  std::string out = "[";
  for (const auto& value : values)
    out += (out.size() > 1 ? "," : "") + print(value);
  return out + "]";
}

std::string integer(uint64_t value) {
  return std::to_string(value);
}

/// `"key":value` lists between braces.
class Object {
 public:
  Object& add(const char* key, const std::string& value) {
    text_ += (text_.empty() ? "\"" : ",\n\"") + std::string(key) + "\":" + value;
    return *this;
  }

  Object& add(const char* key, bool value) {
    return add(key, std::string(value ? "true" : "false"));
  }

  std::string str() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A PC2 vertex cache; frames without the mesh are not-a-number throughout.
std::string cache(const Positions& frames, uint32_t vertices) {
  const float start = 0, rate = 1;
  const uint32_t version = 1, count = static_cast<uint32_t>(frames.size());
  std::string out("POINTCACHE2\0", 12);
  auto put = [&](const void* data, size_t size) {
    out.append(static_cast<const char*>(data), size);
  };
  put(&version, 4);
  put(&vertices, 4);
  put(&start, 4);
  put(&rate, 4);
  put(&count, 4);
  for (const std::vector<float>& frame : frames)
    put(frame.data(), frame.size() * sizeof(float));
  return out;
}

std::string faces(const Topology& topology) {
  std::string out;
  for (size_t p = 0; p + 1 < topology.polygon_offsets.size(); ++p) {
    out += "f";
    for (uint32_t c = topology.polygon_offsets[p]; c < topology.polygon_offsets[p + 1]; ++c)
      out += " " + std::to_string(topology.polygon_corners[c] + 1);
    out += "\n";
  }
  return out;
}

std::string numbers(const float* from, size_t count) {
  return list(std::vector<float>(from, from + count), [](float x) { return number(double{x}); });
}

std::string look(const MaterialLook& look) {
  if (!look.known)
    return "null";
  Object out;
  out.add("base_colour", numbers(look.base_colour.data(), 4));
  out.add("metallic", number(double{look.metallic}));
  out.add("roughness", number(double{look.roughness}));
  out.add("emissive", numbers(look.emissive.data(), 3));
  out.add("alpha", integer(static_cast<uint64_t>(look.alpha)));
  out.add("alpha_cutoff", number(double{look.alpha_cutoff}));
  out.add("double_sided", look.double_sided);
  out.add("textures", list(Vector<String>(look.textures.begin(), look.textures.end()), quoted));
  return out.str();
}

std::string attribute(const Clip& clip, uint32_t mesh, uint32_t which) {
  const MeshAttribute& a = clip.meshes()[mesh].attributes[which];
  const auto [first, end] = clip.attribute_tracks(mesh, which);
  Object out;
  out.add("kind", integer(static_cast<uint64_t>(a.header.kind)));
  out.add("domain", integer(static_cast<uint64_t>(a.header.domain)));
  out.add("name", quoted(a.header.name));
  out.add("components", integer(a.header.components()));
  out.add("labels", list(a.header.labels, quoted));
  out.add("moves", first != end);
  out.add("groups", list(a.labels, integer));
  out.add("looks", list(a.header.looks, look));
  std::vector<std::vector<float>> values{{a.values.begin(), a.values.end()}};
  for (uint32_t f = 1; first != end && f < clip.frame_count(); ++f) {
    values.emplace_back(a.values.size());
    if (show_attribute(clip, mesh, which, f, values.back().data()) != Status::kOk)
      values.back().clear();
  }
  if (first != end && show_attribute(clip, mesh, which, 0, values[0].data()) != Status::kOk)
    values[0].clear();
  out.add("values", list(values, [](const auto& frame) {
            return list(frame, [](float x) { return number(double{x}); });
          }));
  return out.str();
}

/// A file that is open, and what it says without being decoded.
struct OpenFile {
  Bytes bytes;
  Clip clip;
  std::string metadata;                 ///< JSON; empty: there is none
  std::vector<std::vector<Box>> boxes;  ///< of each mesh and frame; empty: there are none
};

Failure read_unopened(OpenFile* out) {
  ContainerReader file;
  file.open(out->bytes);
  const Limits& limits = out->clip.limits();
  for (const Chunk& chunk : file.chunks()) {
    ByteView payload;
    if (chunk.type != chunk_type("META") && chunk.type != chunk_type("BNDS"))
      continue;
    if (Failure f = file.payload(chunk, &payload); !f.ok())
      return f;
    if (chunk.type == chunk_type("META")) {
      if (!is_metadata(payload))
        return failure_in(chunk, Status::kRecord,
                          "the metadata is too long, too deep, or no UTF-8");
      out->metadata.assign(payload.data, payload.data + payload.size);
      continue;
    }
    const Limits::Segment& segment = limits.segments[chunk.segment];
    BoundsRecord bounds;
    if (Status s = BoundsRecord::read(payload, segment.frames, &bounds); s != Status::kOk)
      return failure_in(chunk, s, "the boxes are malformed");
    out->boxes.resize(limits.meshes.size());
    std::vector<Box>& boxes = out->boxes[chunk.mesh];
    boxes.resize(limits.frames, Box{{1, 1, 1}, {0, 0, 0}});
    for (uint32_t f = 0; f < segment.frames; ++f)
      boxes[segment.first_frame + f] = bounds.of_frame(f);
  }
  return {};
}

/// Sides of the box of each frame: x, y, z of the low ones, then of the high ones; null where there is none.
std::string boxes_of(const std::vector<Box>& boxes) {
  return list(boxes, [](const Box& box) {
    if (box.low[0] > box.high[0])
      return std::string("null");
    std::vector<float> sides(box.low.begin(), box.low.end());
    sides.insert(sides.end(), box.high.begin(), box.high.end());
    return numbers(sides.data(), sides.size());
  });
}

std::string mesh_facts(const OpenFile& file, uint32_t mesh, const Positions& frames) {
  const Clip& clip = file.clip;
  const Mesh& m = clip.meshes()[mesh];
  std::vector<float> low(3, std::numeric_limits<float>::max()), high(3, -low[0]);
  for (const std::vector<float>& frame : frames) {
    for (size_t i = 0; i < frame.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], frame[i]);
      high[i % 3] = std::max(high[i % 3], frame[i]);
    }
  }
  std::vector<std::string> attributes;
  for (uint32_t a = 0; a < m.attributes.size(); ++a)
    attributes.push_back(attribute(clip, mesh, a));
  Object out;
  out.add("name", quoted(m.name));
  out.add("low", numbers(low.data(), 3)).add("high", numbers(high.data(), 3));
  out.add("attributes", list(attributes, [](const std::string& a) { return a; }));
  if (!file.boxes.empty() && !file.boxes[mesh].empty())
    out.add("boxes", boxes_of(file.boxes[mesh]));
  return out.str();
}

std::string clip_facts(const Clip& clip, uint32_t of, const ClipRecord& r) {
  Object out;
  out.add("name", quoted(r.name)).add("frames", integer(r.frames));
  out.add("rate", list(std::vector<uint64_t>{r.rate_numerator, r.rate_denominator}, integer));
  out.add("rate_assumed", r.rate_assumed).add("loop", r.loop).add("closed", r.closed);
  out.add("massaged", r.massaged);
  out.add("start_time", number(r.start_time));
  std::vector<double> times(r.times.begin(), r.times.end());
  for (uint32_t f = 0; r.times.empty() && f < r.frames; ++f)
    times.push_back(1.0 * f * r.rate_denominator / r.rate_numerator);
  out.add("times", list(times, number));
  out.add("asked", integer(static_cast<uint64_t>(r.asked)));
  for (const auto& [key, value] : {std::pair{"asked_value", r.asked_value},
                                   {"max_error", r.max_error},
                                   {"rmse", r.rmse},
                                   {"kg", r.kg},
                                   {"max_displacement_error", r.max_displacement_error},
                                   {"diagonal", r.diagonal},
                                   {"surface_error", r.surface_error},
                                   {"surface_error_mean", r.surface_error_mean}})
    out.add(key, number(value));
  out.add("attribute_errors", list(r.attribute_errors, [](const AttributeError& e) {
            return "[" + integer(e.mesh) + "," + integer(e.attribute) + "," + number(e.max_error) +
                   "," + number(e.rmse) + "]";
          }));
  if (!r.events.empty())
    out.add("events", list(r.events, [](const ClipEvent& e) {
              return "[" + quoted(e.name) + "," + number(e.seconds) + "]";
            }));
  if (clip.root().holds(of) != 0) {
    std::vector<uint32_t> frames(r.frames);
    std::iota(frames.begin(), frames.end(), 0U);
    out.add("root", list(frames, [&](uint32_t f) {
              const RootState s = clip.root().at(of, f);
              return "[" + number(s.turn) + "," + number(s.move[0]) + "," + number(s.move[1]) +
                     "," + number(s.pivot[0]) + "," + number(s.pivot[1]) + "]";
            }));
  }
  return out.str();
}

/// The promise of the files of a stream as one clip (spec/05-file-layout.md, section 8).
ClipRecord joined(const std::vector<OpenFile>& files) {
  ClipRecord all = files[0].clip.clips()[0];
  double squares = 0, scaled = 0, before = 0;
  all.frames = 0;
  for (const OpenFile& file : files) {
    const ClipRecord& r = file.clip.clips()[0];
    squares += r.frames * r.rmse * r.rmse;
    scaled += r.kg > 0 ? r.frames * std::pow(100 * r.rmse / r.kg, 2) : 0;
    for (const double error :
         {r.max_displacement_error, all.frames > 0 ? before + r.max_error : 0.0})
      all.max_displacement_error = std::max(all.max_displacement_error, error);
    all.frames += r.frames;
    all.max_error = std::max(all.max_error, r.max_error);
    all.diagonal = std::max(all.diagonal, r.diagonal);
    all.surface_error = std::max(all.surface_error, r.surface_error);
    before = r.max_error;
  }
  all.rmse = std::sqrt(squares / all.frames);
  all.kg = scaled > 0 ? 100 * std::sqrt(squares / scaled) : 0;
  return all;
}

std::string facts(const std::vector<OpenFile>& files, const std::vector<Positions>& positions) {
  const Clip& clip = files[0].clip;
  Object out;
  out.add("encoder", quoted(clip.record().encoder));
  out.add("up", integer(clip.record().up));
  out.add("order", integer(static_cast<uint64_t>(clip.record().order)));
  out.add("metres_per_unit", number(clip.record().metres_per_unit));
  if (clip.record().has_origin())
    out.add("origin", list(clip.record().origin, [](double x) { return exact(x); }));
  if (!files[0].metadata.empty())
    out.add("metadata", files[0].metadata);
  std::vector<std::string> clips;
  for (uint32_t c = 0; c < clip.clips().size(); ++c)
    clips.push_back(clip_facts(clip, c, files.size() > 1 ? joined(files) : clip.clips()[c]));
  out.add("clips", list(clips, [](const std::string& c) { return c; }));
  std::vector<std::string> meshes;
  for (uint32_t m = 0; m < clip.meshes().size(); ++m)
    meshes.push_back(mesh_facts(files[0], m, positions[m]));
  out.add("meshes", list(meshes, [](const std::string& m) { return m; }));
  return out.str();
}

int refused(const Failure& failure) {
  std::fprintf(stderr, "%d %s: %s\n", static_cast<int>(failure.status),
               status_string(failure.status), failure.detail);
  return static_cast<int>(failure.status);
}

/// Whether a continuation follows a file with the meshes that it needs.
Failure check_meshes(const ContainerReader& file, const OpenOptions& options,
                     const ContainerReader& before) {
  Limits limits;
  if (Failure f = read_limits(file, options, &limits); !f.ok())
    return f;
  if (!limits.continued_meshes)
    return {Status::kRecord, 0, chunk_type("LIMI"),
            "the file does not say which meshes it continues"};
  if (*limits.continued_meshes != mesh_hash(before))
    return {Status::kMeshes, 0, chunk_type("LIMI"), "the file continues a file with other meshes"};
  return {};
}

/// The files of a live stream, each as it is with its meshes; of bytes that are none, these bytes.
Failure files_of(const Bytes& bytes, const OpenOptions& options, std::vector<OpenFile>* files) {
  Bytes base;
  size_t at = 0;
  do {
    const ByteView rest{bytes.data() + at, bytes.size() - at};
    ContainerReader file, before;
    Failure failure = file.open_of_stream(rest);
    const bool more = failure.ok() && file.file_size() < rest.size;
    if (at == 0 && (!more || file.is_continuation() ||
                    rest.data[file.file_size()] != kMagic[0])) {  // no stream
      files->emplace_back().bytes = bytes;
      return {};
    }
    if (failure.status == Status::kMagic)
      return {Status::kTrailingBytes, at, 0, "bytes follow the last file of the stream"};
    if (!failure.ok())
      return failure;
    if (!file.is_complete())
      return {Status::kTruncated, 0, 0, "the last file of the stream is not complete"};
    const Bytes part(rest.data, rest.data + file.file_size());
    if (file.is_continuation()) {
      before.open(base);
      if (Failure f = check_meshes(file, options, before); !f.ok())
        return f;
      files->emplace_back().bytes = with_meshes(before, file);
    } else {
      base = part;
      files->emplace_back().bytes = part;
    }
    at += part.size();
  } while (at < bytes.size());
  return {};
}

int decode(const char* path, const std::string& out) {
  std::ifstream file(path, std::ios::binary);
  OpenOptions options;
  options.limits.resident_bytes = uint64_t{256} << 20;
  std::vector<OpenFile> files;
  if (Failure f = files_of(Bytes(std::istreambuf_iterator<char>(file), {}), options, &files);
      !f.ok())
    return refused(f);
  std::vector<Positions> positions;
  KeptLearning learning;
  options.learning = files.size() > 1 ? &learning : nullptr;
  for (OpenFile& part : files) {
    Clip& clip = part.clip;
    if (Failure f = clip.open(part.bytes, options); !f.ok())
      return refused(f);
    if (Failure f = clip.check_hashes(); !f.ok())
      return refused(f);
    if (Failure f = read_unopened(&part); !f.ok())
      return refused(f);
    positions.resize(clip.meshes().size());
    for (uint32_t m = 0; m < positions.size(); ++m) {
      for (uint32_t f = 0; f < clip.frame_count(); ++f) {
        std::vector<float>& frame = positions[m].emplace_back(size_t{3} * clip.vertex_count(m));
        const Status s = show_positions(clip, m, f, frame.data());
        if (s == Status::kAbsent)
          std::fill(frame.begin(), frame.end(), std::numeric_limits<float>::quiet_NaN());
        else if (s != Status::kOk)
          return refused({s, 0, 0, "a frame cannot be played"});
      }
    }
  }
  for (uint32_t m = 0; m < positions.size(); ++m) {
    const std::string stem = out + (m == 0 ? "" : "." + std::to_string(m));
    write(stem + ".pc2", cache(positions[m], files[0].clip.vertex_count(m)));
    write(stem + ".obj", faces(files[0].clip.meshes()[m].topology));
  }
  write(out + ".json", facts(files, positions));
  return 0;
}

}  // namespace
}  // namespace anicodec

int main(int argc, char** argv) {
  if (argc != 3)
    return std::fprintf(stderr, "usage: sdk_decoder FILE.anic OUT\n"), 2;
  return anicodec::decode(argv[1], argv[2]);
}
