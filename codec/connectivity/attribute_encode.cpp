// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/attribute_encode.h"

#include "codec/sequence/error.h"
#include "codec/sequence/shared_normals.h"
#include "format/attribute_record.h"
#include "sdk/clip/attribute_coding.h"
#include "sdk/clip/attribute_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>

namespace anicodec {
namespace {

constexpr double kLargest = 1 << 28;   // of the integers on a grid
constexpr double kRounding = 0x1p-23;  // of a value in binary32, against its magnitude
constexpr float kLargestExact = 1 << 24, kLargestExactMoving = 1 << 18;

bool is_exact(const Attribute& attribute) {
  return attribute.bound && attribute.bound->measure == AttributeBound::Measure::kExact;
}

String text(const std::string& s) {
  return String(s.begin(), s.end());
}

/// Least and largest value of a component over all frames.
std::pair<double, double> range_of(const Attribute& attribute, uint32_t component) {
  double low = INFINITY, high = -INFINITY;
  for (size_t i = component; i < attribute.values.size(); i += attribute.components) {
    low = std::min(low, static_cast<double>(attribute.values[i]));
    high = std::max(high, static_cast<double>(attribute.values[i]));
  }
  return {low, high};
}

/// A value as decoders get it.
double on_grid(double value, const AttributeHeader::Grid& grid) {
  return grid.origin + std::round((value - grid.origin) * grid.scale) / grid.scale;
}

/// Steps to 1 that keep all vectors of an attribute within an angle, in degrees: of a vector whose
/// components are off by half a step the end is off by the root of 3 times as much. A whole number,
/// so that 1 is kept.
double direction_scale(const Attribute& attribute, double angle) {
  constexpr double kShortest = 1e-3;  // vectors below have no direction worth keeping
  double shortest = 1;
  for (size_t i = 0; i + 2 < attribute.values.size(); i += attribute.components) {
    const float* v = attribute.values.data() + i;
    const auto length = static_cast<double>(std::hypot(v[0], v[1], v[2]));
    if (length >= kShortest)
      shortest = std::min(shortest, length);
  }
  const double off = shortest * std::sin(std::min(angle, 90.0) * std::numbers::pi / 180);
  return std::ceil(std::numbers::sqrt3 / 2 / off);
}

/// The corner of the source that each canonical corner is.
std::vector<uint32_t> corner_sources(const MeshSequence& sequence, const MeshLayout& layout) {
  std::vector<uint32_t> sources(layout.topology.polygon_corners.size());
  for (size_t i = 0; i < layout.polygon_source.size(); ++i) {
    const uint32_t begin = layout.topology.polygon_offsets[i];
    const uint32_t n = layout.topology.polygon_offsets[i + 1] - begin;
    const uint32_t source = sequence.polygons.offsets[layout.polygon_source[i]];
    for (uint32_t k = 0; k < n; ++k)  // the source's first corner is number polygon_first
      sources[begin + (layout.polygon_first[i] + k) % n] = source + k;
  }
  return sources;
}

/// Lists attributes and codes their values.
class AttributeWriter {
 public:
  AttributeWriter(const MeshSequence& sequence, const AttributeOptions& options,
                  const MeshLayout& layout)
      : sequence_(sequence),
        options_(options),
        layout_(layout),
        graph_(layout.topology),
        corners_(corner_sources(sequence, layout)) {}

  void run() {
    const bool told = !sequence_.shared_normals.empty();
    bool has_normals = false;
    for (uint32_t i = 0; i < sequence_.attributes.size(); ++i) {
      const Attribute& attribute = sequence_.attributes[i];
      if (attribute.kind == AttributeKind::kNormal && !options_.normals) {
        if (!told && !has_normals)
          add_shared(normals_shared(attribute));
        has_normals = true;
      } else if (attribute.kind != AttributeKind::kTangent || options_.normals) {
        const auto number = static_cast<uint32_t>(headers_.size());
        StoredAttribute& stored = stored_.emplace_back();
        stored.source = i;
        stored.number = number;
        stored.rows = rows_of(attribute);
        add_numbers(attribute, &stored_.back());
      }
    }
    if (told) {
      check_count(sequence_.shared_normals.size(), corners_.size(), "shared normals");
      std::vector<uint32_t> shared;
      for (uint32_t c : corners_)
        shared.push_back(sequence_.shared_normals[c]);
      add_shared(shared);
    }
    add_labels(AttributeKind::kMaterial, sequence_.materials);
    add_labels(AttributeKind::kPart, sequence_.parts);
  }

  const Vector<AttributeHeader>& headers() const { return headers_; }

  std::vector<StoredAttribute> stored() && { return std::move(stored_); }

  Bytes finish() {
    const Bytes stream = coder_.finish();
    AttributeRecord record;
    record.attributes = headers_;
    record.stream = stream;
    return record.write();
  }

 private:
  static void check_count(size_t count, size_t wanted, const std::string& name) {
    if (count != wanted)
      throw Error(ErrorKind::kInput, name + ": " + std::to_string(count) + " values for " +
                                         std::to_string(wanted) + " vertices or corners");
  }

  /// "temperature: frame 3, vertex 17", of a number among the values.
  static std::string place_of(const Attribute& attribute, size_t number) {
    constexpr const char* kElements[] = {"vertex", "corner", "polygon"};
    const size_t element = number / attribute.components,
                 elements = attribute.values.size() / attribute.components / attribute.frames;
    return attribute.name + (attribute.name.empty() ? "an attribute: frame " : ": frame ") +
           std::to_string(element / elements) + ", " +
           kElements[static_cast<size_t>(attribute.domain)] + " " +
           std::to_string(element % elements);
  }

  /// Throws unless all values are finite, and whole where they are to be exact.
  static void check_values(const Attribute& attribute) {
    const bool exact = is_exact(attribute);
    const float most = attribute.frames > 1 ? kLargestExactMoving : kLargestExact;
    for (size_t i = 0; i < attribute.values.size(); ++i) {
      const float value = attribute.values[i];
      if (!std::isfinite(value))
        throw Error(ErrorKind::kInput, place_of(attribute, i) + ": the value is not finite");
      if (exact && !(value == std::round(value) && std::abs(value) <= most))
        throw Error(ErrorKind::kInput, place_of(attribute, i) + ": " + std::to_string(value) +
                                           " cannot be exact: it is no whole number of at most " +
                                           std::to_string(static_cast<uint32_t>(most)));
    }
  }

  AttributeHeader& add_header(AttributeKind kind, AttributeDomain domain, const std::string& name) {
    if (headers_.size() == kMaxAttributes)
      throw Error(ErrorKind::kInput, "more than 256 attributes");
    AttributeHeader& header = headers_.emplace_back();
    header.kind = kind;
    header.domain = domain;
    header.name = text(name);
    return header;
  }

  /// The source's row of each element in canonical order.
  std::vector<uint32_t> rows_of(const Attribute& attribute) const {
    if (attribute.per_corner())
      return corners_;
    if (!attribute.per_vertex())
      return {layout_.polygon_source.begin(), layout_.polygon_source.end()};
    return {layout_.vertex_source.begin(), layout_.vertex_source.end()};
  }

  void add_numbers(const Attribute& attribute, StoredAttribute* stored) {
    const std::vector<uint32_t>& rows = stored->rows;
    const uint32_t n = attribute.components;
    if (n == 0 || n > kMaxAttributeComponents)
      throw Error(ErrorKind::kInput,
                  attribute.name + ": 1 to 16 components are possible, not " + std::to_string(n));
    check_count(attribute.values.size(), rows.size() * n * attribute.frames, attribute.name);
    check_values(attribute);
    AttributeHeader& header = add_header(attribute.kind, attribute.domain, attribute.name);
    stored->moves = moves(attribute, stored->source);
    for (uint32_t i = 0; i < n; ++i)
      header.grids.push_back(grid_of(attribute, i));
    if (stored->moves || attribute.bound)
      stored->bound = error_bound(attribute, stored->source);
    if (stored->moves)
      refine(attribute, stored->bound, &header);
    else if (attribute.bound)
      coarsen(attribute, stored->bound, &header);
    std::vector<int32_t> truth;
    truth.reserve(rows.size() * n);
    for (uint32_t row : rows) {
      for (uint32_t i = 0; i < n; ++i) {
        const AttributeHeader::Grid& grid = header.grids[i];
        const auto value = static_cast<double>(attribute.values[size_t{row} * n + i]);
        const double integer = std::round((value - grid.origin) * grid.scale);
        if (!(std::abs(integer) <= kLargest))
          throw Error(ErrorKind::kInput, place_of(attribute, size_t{row} * n + i) +
                                             ": the value is too large for its grid");
        truth.push_back(static_cast<int32_t>(integer));
      }
    }
    stored->header = header;
    if (!stored->moves)
      return static_cast<void>(code(header, truth));
    stored->rest = values_on_grid(attribute, header);
    const std::vector<uint32_t> tracks = trajectories(attribute, *stored);
    stored->surface = attribute_surface(graph_, header.domain, code(header, truth, tracks.data()));
  }

  /// A number for each element: those at one coded vertex whose values stay close to those of the first have its
  /// number.
  std::vector<uint32_t> trajectories(const Attribute& attribute,
                                     const StoredAttribute& stored) const {
    constexpr double kShare = 0.125;  // of the error
    constexpr size_t kMost = 256;     // looked at
    const std::vector<uint32_t>& rows = stored.rows;
    const auto allowed = static_cast<float>(kShare * stored.bound);
    const size_t n = attribute.components, frame = n * rows.size();
    const auto close = [&](uint32_t a, uint32_t b) {
      for (size_t f = 0; f < attribute.frames; ++f) {
        const float* values = attribute.values.data() + f * frame;
        for (size_t i = 0; i < n; ++i) {
          if (!(std::abs(values[n * rows[a] + i] - values[n * rows[b] + i]) <= allowed))
            return false;
        }
      }
      return true;
    };
    std::vector<uint32_t> result(rows.size());
    std::iota(result.begin(), result.end(), 0U);
    if (attribute.domain == AttributeDomain::kPolygon || !options_.share)
      return result;
    std::vector<std::vector<uint32_t>> at(layout_.topology.coded_vertices);
    for (uint32_t e = 0; e < rows.size(); ++e) {
      std::vector<uint32_t>& known =
          at[attribute.per_corner() ? graph_.coded(e) : layout_.topology.vertex_coded[e]];
      const size_t looked_at = std::min(known.size(), kMost);
      const auto found = std::find_if(known.end() - static_cast<ptrdiff_t>(looked_at), known.end(),
                                      [&](uint32_t other) { return close(e, other); });
      if (found == known.end())
        known.push_back(e);
      else
        result[e] = *found;
    }
    return result;
  }

  /// Whether later frames of a live stream move it.
  bool will_move(uint32_t number) const { return std::ranges::count(options_.moving, number) > 0; }

  bool moves(const Attribute& attribute, uint32_t number) const {
    if (attribute.kind == AttributeKind::kNormal || attribute.kind == AttributeKind::kTangent)
      return false;
    const size_t row = attribute.values.size() / attribute.frames;
    return will_move(number) || !std::equal(attribute.values.begin() + static_cast<ptrdiff_t>(row),
                                            attribute.values.end(), attribute.values.begin());
  }

  /// The largest error that an attribute which moves may have.
  double error_bound(const Attribute& attribute, uint32_t number) const {
    constexpr AttributeBound kDefault{AttributeBound::Measure::kPercent, 0.1};
    constexpr double kExact = 0.4;  // which rounding to whole numbers undoes
    const std::optional<AttributeBound>& asked = attribute.bound ? attribute.bound : options_.error;
    if (!asked && attribute.kind == AttributeKind::kColour)
      return 0.5 / (std::exp2(options_.colour_bits) - 1);
    const AttributeBound bound = asked.value_or(kDefault);
    if (bound.measure == AttributeBound::Measure::kExact)
      return kExact;
    if (!(std::isfinite(bound.value) && bound.value > 0))
      throw Error(ErrorKind::kUsage, attribute.name + ": the largest error must be greater than 0");
    if (bound.measure == AttributeBound::Measure::kUnits)
      return bound.value;
    double range = 0;
    for (uint32_t i = 0; i < attribute.components; ++i) {
      const auto [low, high] = range_of(attribute, i);
      range = std::max(range, high - low);
    }
    if (range == 0 && will_move(number))
      range = 1;  // nobody knows yet
    return bound.value / 100 * range;
  }

  /// The coarsest grids that keep an attribute which rests within its own bound.
  static void coarsen(const Attribute& attribute, double bound, AttributeHeader* header) {
    if (is_exact(attribute))
      return;
    double largest = 0;
    for (float value : attribute.values)
      largest = std::max(largest, std::abs(static_cast<double>(value)));
    const double half_step = bound - kRounding * largest;
    if (bound > 0 && !(half_step > bound / 2))
      throw Error(ErrorKind::kUsage,
                  attribute.name + ": the error asked for is finer than float32 values can keep");
    for (AttributeHeader::Grid& grid : header->grids) {
      if (bound > 0)  // else all values are the same
        grid.scale = 0.5 / half_step;
    }
  }

  static std::vector<float> values_on_grid(const Attribute& attribute,
                                           const AttributeHeader& header) {
    std::vector<float> values(attribute.values.size() / attribute.frames);
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(on_grid(static_cast<double>(attribute.values[i]),
                                             header.grids[i % attribute.components]));
    return values;
  }

  static void refine(const Attribute& attribute, double bound, AttributeHeader* header) {
    constexpr double kShare = 0.25, kFinest = 1 << 20;  // of the error; steps to the range
    const double allowed = kShare * bound;
    const uint32_t n = attribute.components;
    const size_t count = attribute.values.size() / attribute.frames;
    for (uint32_t i = 0; i < n; ++i) {
      const auto [low, high] = range_of(attribute, i);
      AttributeHeader::Grid& grid = header->grids[i];
      auto too_coarse = [&] {
        for (size_t at = i; at < count; at += n) {
          const auto value = static_cast<double>(attribute.values[at]);
          if (std::abs(on_grid(value, grid) - value) > allowed)
            return true;
        }
        return false;
      };
      while (grid.scale * (high - low) < kFinest && too_coarse())
        grid.scale *= 2;
    }
  }

  AttributeHeader::Grid grid_of(const Attribute& attribute, uint32_t component) const {
    AttributeHeader::Grid grid;
    if (is_exact(attribute))
      return grid;
    auto steps = [](uint32_t bits) { return std::exp2(bits); };
    switch (attribute.kind) {
      case AttributeKind::kUv:
        grid.scale = steps(options_.uv_bits);
        return grid;
      case AttributeKind::kColour:
        grid.scale = steps(options_.colour_bits) - 1;
        return grid;
      case AttributeKind::kNormal:
      case AttributeKind::kTangent:
        grid.scale = direction_scale(attribute, *options_.normals);
        return grid;
      default:
        break;
    }
    const auto [low, high] = range_of(attribute, component);
    if (std::isfinite(low))
      grid.origin = low;
    if (high > low && std::isfinite(high - low))
      grid.scale = (steps(options_.other_bits) - 1) / (high - low);
    return grid;
  }

  /// A number for each canonical corner; those at a coded vertex with nearly the same normal share
  /// one.
  std::vector<uint32_t> normals_shared(const Attribute& normals) const {
    check_count(normals.values.size(),
                rows_of(normals).size() * size_t{normals.components} * normals.frames,
                normals.name);
    const std::vector<uint32_t> of_corners = rows_of_corners(sequence_.polygons, normals.domain);
    std::vector<uint32_t> rows(corners_.size()), places(corners_.size());
    for (uint32_t c = 0; c < corners_.size(); ++c) {
      rows[c] = of_corners[corners_[c]];
      places[c] = graph_.coded(c);
    }
    return share_normals(normals, rows, places, layout_.topology.coded_vertices);
  }

  void add_shared(const std::vector<uint32_t>& shared) {
    if (!shared.empty())
      code(add_header(AttributeKind::kNormal, AttributeDomain::kCorner, ""),
           std::vector<int32_t>(shared.begin(), shared.end()));
  }

  AttributeEntries code(const AttributeHeader& header, const std::vector<int32_t>& truth,
                        const uint32_t* apart = nullptr) {
    AttributeEntries entries;
    AttributeCoding<BinaryEncoder> coding(coder_, graph_, header.domain, header.components(),
                                          truth.data(), &entries, apart);
    if (coding.run() != Status::kOk)
      throw Error(ErrorKind::kInternal, "an attribute could not be coded");
    return entries;
  }

  void add_labels(AttributeKind kind, const PolygonLabels& labels) {
    if (labels.names.empty() || labels.of_polygon.empty())
      return;
    check_count(labels.of_polygon.size(), sequence_.polygons.size(), "labels");
    AttributeHeader& header = add_header(kind, AttributeDomain::kPolygon, "");
    for (const std::string& name : labels.names)
      header.labels.push_back(text(name));
    const auto known = [](const MaterialLook& look) { return look.known; };
    if (std::ranges::any_of(labels.looks, known)) {
      check_count(labels.looks.size(), labels.names.size(), "materials");
      header.looks.assign(labels.looks.begin(), labels.looks.end());
    }
    Vector<uint32_t> values;
    for (uint32_t p : layout_.polygon_source) {
      const uint32_t label = labels.of_polygon[p];
      if (label != kNoLabel && label >= labels.names.size())
        throw Error(ErrorKind::kInput, "face " + std::to_string(p) + " has label " +
                                           std::to_string(label) + " of " +
                                           std::to_string(labels.names.size()));
      values.push_back(label == kNoLabel ? 0 : label + 1);
    }
    if (code_labels(coder_, graph_, static_cast<uint32_t>(labels.names.size()) + 1, &values) !=
        Status::kOk)
      throw Error(ErrorKind::kInternal, "labels could not be coded");
  }

  const MeshSequence& sequence_;
  const AttributeOptions& options_;
  const MeshLayout& layout_;
  const CornerGraph graph_;
  const std::vector<uint32_t> corners_;
  Vector<AttributeHeader> headers_;
  std::vector<StoredAttribute> stored_;
  BinaryEncoder coder_;
};

}  // namespace

bool moves_as_stored(const Attribute& attribute, const StoredAttribute& stored) {
  constexpr double kShare = 0.25;  // of the error
  const auto allowed = static_cast<float>(kShare * stored.bound);
  const Vector<uint32_t>& entries = stored.surface.vertex_coded;
  const size_t n = attribute.components;
  std::vector<uint32_t> first(stored.surface.coded_vertices, UINT32_MAX);
  for (size_t e = 0; e < entries.size(); ++e) {
    uint32_t& row = first[entries[e]];
    if (row == UINT32_MAX) {
      row = stored.rows[e];
      continue;
    }
    for (size_t f = 0; f < attribute.frames; ++f) {
      const float* values = attribute.values.data() + f * n * entries.size();
      for (size_t i = 0; i < n; ++i) {
        const size_t a = n * stored.rows[e] + i, b = n * row + i;
        if (!(std::abs((values[a] - stored.rest[a]) - (values[b] - stored.rest[b])) <= allowed))
          return false;
      }
    }
  }
  return true;
}

std::vector<StoredAttribute> encode_attributes(const MeshSequence& sequence,
                                               const AttributeOptions& options,
                                               MeshLayout* layout) {
  if (!options.keep)
    return {};
  AttributeWriter writer(sequence, options, *layout);
  writer.run();
  if (writer.headers().empty())
    return {};
  count_attributes(writer.headers(), &layout->sizes);
  layout->attributes = writer.finish();
  return std::move(writer).stored();
}

}  // namespace anicodec
