// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files that the encoder never writes, so that the conformance files need every branch of a decoder:
// rare parameters, streams of numbers without meaning, metadata at its limits.
//
// usage: special_vectors NAME FILE.anic      (without arguments: lists the names)
#include "codec/encode.h"
#include "codec/file/clip_file.h"
#include "codec/file/clip_record.h"
#include "codec/metrics/metrics.h"
#include "codec/search/encoder_input.h"
#include "codec/segment/exact_encode.h"
#include "codec/segment/linear_segment_encode.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/bytes.h"
#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_model.h"
#include "format/coding/rans_coder.h"
#include "format/coding/time_weights.h"
#include "sdk/clip/clip.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/prediction/vertex_order.h"
#include "sdk/segment/keyframe_segment.h"
#include "tests/conformance/reading_vectors.h"
#include "tests/conformance/vector_recipes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

/// All schedules of refits, numbers of neighbours and passes; a reference pose for each segment.
Bytes schedules() {
  const MeshSequence clip = corpus::make_scaled("limb", 220, 40);
  const double step = 0.002 * diagonal(clip);
  return file_of(
      clip, {recipe(10, BasisKind::kEigenshapes, step, 8, 1, 1, RefitSchedule::kNone),
             recipe(10, BasisKind::kEigentrajectories, step, 12, 8, 255, RefitSchedule::kSparse),
             recipe(10, BasisKind::kEigenshapes, step, 24, 4, 12, RefitSchedule::kMedium),
             recipe(10, BasisKind::kEigentrajectories, step, 20, 2, 5, RefitSchedule::kMedium)});
}

/// Priors renewed by motion, by little and by much of it; the last meets numbers that are not finite.
Bytes alike() {
  const MeshSequence clip = corpus::make_scaled("limb", 220, 52);
  const double step = 0.002 * diagonal(clip);
  std::vector<Recipe> recipes = {
      recipe(13, BasisKind::kEigenshapes, step, 8, 1, 12, RefitSchedule::kNone),
      recipe(13, BasisKind::kEigentrajectories, step, 16, 2, 12, RefitSchedule::kSparse),
      recipe(13, BasisKind::kEigentrajectories, step, 24, 1, 40, RefitSchedule::kMedium),
      recipe(13, BasisKind::kEigenshapes, step, 12, 1, 5, RefitSchedule::kMedium)};
  constexpr uint8_t kWeights[] = {1, 32, 255, 8};
  for (size_t i = 0; i < recipes.size(); ++i)
    recipes[i].settings.alike = kWeights[i];
  recipes.back().change = scramble_coefficients;
  return file_of(clip, recipes);
}

/// A recipe of three layers.
Recipe layered(BasisKind kind, double step, bool anew) {
  Recipe r = recipe(9, kind, step, 12, 1, 12, RefitSchedule::kMedium);
  r.settings.layers = 3;
  r.settings.layers_anew = anew;
  return r;
}

Bytes vertex_order() {
  Recipe r = recipe(9, BasisKind::kEigentrajectories, 0.004, 16, 3, 12, RefitSchedule::kMedium);
  r.settings.pose_factor = 0.02;  // the grid of the order shifts it
  return file_of(hub(), {r}, [](ClipsRecord& file) {
    ClipRecord& record = file.clips[0];
    record.name = String("tab\there \"quoted\" \xff");
    record.rate_numerator = 30000;
    record.rate_denominator = 1001;
    record.rate_assumed = false;
    record.loop = record.massaged = true;
    file.up = 2;
    record.start_time = -1.5;
    file.metres_per_unit = 0.01;
    record.surface_error = 0.25;
    record.surface_error_mean = 0.125;
  });
}

Bytes rings_by_degree() {
  return file_of(
      rings(), {recipe(4, BasisKind::kEigentrajectories, 0.004, 16, 3, 12, RefitSchedule::kSparse),
                recipe(3, BasisKind::kEigenshapes, 0.004, 20, 1, 12, RefitSchedule::kNone)});
}

Bytes cliques_of_vertices() {
  return file_of(cliques(17),
                 {recipe(4, BasisKind::kEigenshapes, 0.004, 16, 2, 12, RefitSchedule::kSparse)});
}

Bytes partners() {
  const MeshSequence clip = corpus::make_scaled("limb", 1600, 12);
  const double step = 0.004 * diagonal(clip);
  Recipe named = recipe(6, BasisKind::kEigentrajectories, step, 12, 1, 12, RefitSchedule::kSparse);
  named.change = with_partners;
  Recipe exact = named;
  exact.change = exactly_with_partners;
  return file_of(clip, {named, exact});
}

Bytes turned() {
  const MeshSequence clip = turned_pair(800, 4);
  const double step = 0.004 * diagonal(clip);
  std::vector<Recipe> recipes;
  for (const bool many_strands : {false, true}) {
    recipes.push_back(recipe(2, BasisKind::kEigenshapes, step, 8, 1, 12, RefitSchedule::kNone));
    recipes.back().change = with_turned_partners(many_strands);
  }
  return file_of(clip, recipes);
}

Bytes weights_in_time() {
  const MeshSequence clip = corpus::make_scaled("waves", 100, 300);
  const double step = 0.01 * diagonal(clip);
  Recipe shapes =
      recipe(170, BasisKind::kEigentrajectories, step, 8, 1, 12, RefitSchedule::kSparse);
  Recipe short_one =
      recipe(130, BasisKind::kEigentrajectories, step, 8, 1, 12, RefitSchedule::kNone);
  for (Recipe* r : {&shapes, &short_one}) {
    r->settings.components = {9};
    r->change = scramble_weights;
  }
  return file_of(clip, {shapes, short_one});
}

/// Clips whose borders lie within a segment, with weight steps of their own, and between segments;
/// every predictor over runs of many lengths.
Bytes clips() {
  MeshSequence library = corpus::make_scaled("waves", 100, 300);
  const double step = 0.01 * diagonal(library);
  for (uint32_t frames : {1U, 70U, 29U, 2U, 68U, 130U}) {
    ClipTiming& clip = library.clips.emplace_back();
    clip.name = "clip of " + std::to_string(frames);
    clip.frame_count = frames;
    clip.rate = {frames, 3, false};
    clip.loop = frames == 70;
    clip.start_time = frames;
  }
  for (uint32_t f = 0; f < 29; ++f)
    library.clips[2].times.push_back(0.01 * f * f);
  Recipe shared =
      recipe(150, BasisKind::kEigentrajectories, step, 8, 1, 12, RefitSchedule::kSparse);
  Recipe next = recipe(150, BasisKind::kEigentrajectories, step, 8, 1, 12, RefitSchedule::kNone);
  shared.settings.run_steps = {0, 7, 64, 16, 3};  // the last of these clips goes on in the next
  for (Recipe* r : {&shared, &next}) {
    r->settings.components = {9};
    r->change = scramble_weights;
  }
  return file_of(library, {shared, next});
}

Bytes saturated() {
  const MeshSequence clip = corpus::make_scaled("limb", 120, 32);
  const double step = 0.001 * diagonal(clip);
  Recipe shapes = recipe(16, BasisKind::kEigenshapes, step, 16, 1, 12, RefitSchedule::kMedium);
  Recipe curves =
      recipe(16, BasisKind::kEigentrajectories, step, 16, 2, 12, RefitSchedule::kMedium);
  for (Recipe* r : {&shapes, &curves}) {
    r->settings.components = {14};  // the largest residuals are those of the 11th and 12th
    r->change = scramble_coefficients;
  }
  return file_of(clip, {shapes, curves});
}

/// Layers that go on or begin anew, and residuals at the coder's limits.
Bytes layers() {
  const MeshSequence clip = corpus::make_scaled("limb", 400, 48);
  const double step = 0.001 * diagonal(clip);
  Recipe wild = layered(BasisKind::kEigentrajectories, step, false);
  wild.frames = 12;
  wild.settings.components = {11};  // more than are told apart
  wild.change = scramble_coefficients;
  return file_of(clip, {layered(BasisKind::kEigenshapes, step, false),
                        layered(BasisKind::kEigentrajectories, step, true),
                        layered(BasisKind::kEigentrajectories, step, false),
                        layered(BasisKind::kEigenshapes, step, true), wild});
}

/// Regions along the vertices, a few of which have fewer components or none; and scattered ones, over
/// clips with steps of their own. Corrections.
Bytes regions() {
  const MeshSequence clip = corpus::make_scaled("limb", 600, 24);
  const double step = 0.0008 * diagonal(clip);
  Recipe bands = layered(BasisKind::kEigentrajectories, step, false);
  bands.frames = 12;
  bands.regions = 8;
  bands.region_of = [](uint32_t n) {
    Vector<uint8_t> result(n);
    for (uint32_t v = 0; v < n; ++v)
      result[v] = static_cast<uint8_t>(uint64_t{v} * 8 / n);
    return result;
  };
  bands.settings.components = {9, 3, 0, 8, 5, 9, 1, 2};
  bands.change = [](EncodedSegment& segment, const EncoderInput& input) {
    Segment opened = open_encoded(segment, input.layout);
    const FrameView frames = input.frames(0, 12);
    const double bound = 0.6 * measure(opened, frames, input.copies).max;
    correct(frames, input.copies, std::vector<double>(frames.frame_count, bound), opened, segment);
  };
  Recipe scattered = layered(BasisKind::kEigentrajectories, step, true);
  scattered.frames = 12;
  scattered.regions = 3;
  scattered.settings.passes_per_level = 2;
  scattered.settings.components = {4, 7, 6};
  scattered.region_of = [](uint32_t n) {
    Numbers numbers;
    Vector<uint8_t> result(n);
    for (uint8_t& region : result)
      region = static_cast<uint8_t>(numbers.below(3));
    return result;
  };
  return file_of(clip, {bands, scattered});
}

/// Exact positions of a surface in regions.
Bytes exact_regions() {
  const MeshSequence clip = corpus::make_scaled("limb", 120, 6);
  Recipe r = recipe(6, BasisKind::kEigentrajectories, 0.004 * diagonal(clip), 12, 1, 12,
                    RefitSchedule::kSparse);
  r.regions = 2;
  r.settings.components = {3, 4};
  r.region_of = [](uint32_t n) {
    Vector<uint8_t> result(n);
    for (uint32_t v = n / 3; v < n; ++v)
      result[v] = 1;
    return result;
  };
  r.change = [](EncodedSegment& segment, const EncoderInput& input) {
    segment.exact = encode_exact(input.frames(0, segment.sizes.frames), input.layout.topology);
    segment.sizes.exact = true;
  };
  return file_of(clip, {r});
}

/// Several meshes that come and go, several segments of one of them.
Bytes scene() {
  Scene whole;
  whole.clip.name = "scene";
  whole.clip.frame_count = 12;
  const MeshSequence box = corpus::make_clip("quad_box"),
                     triangle = corpus::make_clip("one_triangle");
  auto shown = [](const MeshSequence& clip, std::vector<FrameRun> runs, const char* name) {
    MeshSequence part = clip;
    part.mesh_name = name;
    part.frame_count = 0;
    for (const FrameRun& run : runs)
      part.frame_count += run.count;
    part.positions.resize(size_t{3} * part.vertex_count * part.frame_count);
    for (uint32_t f = 0; f < part.frame_count; ++f)
      std::ranges::copy(clip.frame(f % clip.frame_count), part.frame(f).begin());
    part.times.clear();
    return SceneMesh{part, std::move(runs)};
  };
  whole.meshes.push_back(shown(box, {{0, 12}}, "box"));
  whole.meshes.push_back(shown(triangle, {{1, 3}, {7, 2}}, "triangle"));
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 1, false};
  return encode(whole, options).file;
}

/// Two shapes in turns: a key-frame is nearest to the one before the last.
Bytes alternating(KeyframePoses poses, uint32_t keyframes) {
  MeshSequence clip = hub();
  Numbers numbers;
  std::vector<float> away(size_t{3} * clip.vertex_count);
  for (float& x : away)
    x = static_cast<float>(numbers.within(64)) / 64;
  for (uint32_t f = 1; f < clip.frame_count; f += 2)
    std::ranges::transform(clip.frame(f), away, clip.frame(f).begin(), std::plus<>());
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.keyframes = keyframes;
  options.keyframe_poses = poses;
  return encode(clip, options).file;
}

Bytes other_parents() {
  return alternating(KeyframePoses::kNative, 6);
}

Bytes draco_parents() {
  return alternating(KeyframePoses::kDraco, 4);
}

/// Faces, copies and an order of vertices for which every rule of spec/07 has to act.
class Tangle {
 public:
  MeshSequence make() {
    sheet();
    fan();
    book();
    flower(30);
    flower(100);
    crossings();
    crowd();
    leftovers();
    scramble();
    return std::move(clip_);
  }

  MeshSequence make_flowers() {
    for (const uint32_t petals : {20U, 40U, 63U, 64U, 65U, 100U})
      flower(petals);
    number_as_they_are();
    return std::move(clip_);
  }

 private:
  using Polygon = std::vector<uint32_t>;

  void number_as_they_are() {
    std::vector<uint32_t> number(places_.size());
    std::iota(number.begin(), number.end(), 0U);
    place(number);
    for (const Polygon& polygon : polygons_)
      clip_.polygons.add(polygon);
  }

  /// A vertex at a place; vertices of one place and kind are copies of one another.
  uint32_t vertex(uint32_t place) {
    places_.push_back(place);
    return static_cast<uint32_t>(places_.size() - 1);
  }

  uint32_t new_place() { return place_count_++; }

  /// Adds a polygon, now and then several times.
  void add(Polygon polygon, uint32_t one_in = 9) {
    const uint32_t times = numbers_.below(one_in) == 0 ? 2 + numbers_.below(4) : 1;
    polygons_.insert(polygons_.end(), times, polygon);
  }

  /// Triangles to nonagons with holes, turned here and there; seams of copies run through it.
  void sheet() {
    constexpr uint32_t kSide = 14;
    uint32_t place[kSide][kSide];
    std::vector<uint32_t> copies[kSide][kSide];
    for (auto& row : place)
      for (uint32_t& p : row)
        p = new_place();
    const auto corner = [&](uint32_t x, uint32_t y) {
      std::vector<uint32_t>& here = copies[y][x];
      if (here.empty() || numbers_.below(7) == 0)
        here.push_back(vertex(place[y][x]));
      return here[numbers_.below(3) == 0 ? numbers_.below(static_cast<uint32_t>(here.size()))
                                         : here.size() - 1];
    };
    for (uint32_t y = 0; y + 1 < kSide; ++y) {
      for (uint32_t x = 0; x + 1 < kSide; ++x) {
        if (numbers_.below(8) == 0)
          continue;
        Polygon quad{corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)};
        if (x + 4 < kSide && numbers_.below(5) == 0) {  // a long one over several columns
          const uint32_t columns = 2 + numbers_.below(3);
          quad.clear();
          for (uint32_t i = 0; i <= columns; ++i)
            quad.push_back(corner(x + i, y));
          for (uint32_t i = columns + 1; i-- > 0;)
            quad.push_back(corner(x + i, y + 1));
          x += columns - 1;
        } else if (numbers_.below(3) == 0) {
          add({quad[0], quad[1], quad[2]});
          quad.erase(quad.begin() + 1);
        }
        if (numbers_.below(12) == 0)
          std::ranges::reverse(quad);
        add(quad);
      }
    }
  }

  /// More triangles at one vertex than are looked at, in no order, some from the other side.
  void fan() {
    constexpr uint32_t kBlades = 100;
    const uint32_t hub = vertex(new_place());
    Polygon rim;
    for (uint32_t i = 0; i < kBlades; ++i)
      rim.push_back(vertex(new_place()));
    for (uint32_t i = 0; i < kBlades; ++i) {
      const uint32_t a = rim[i * 37 % kBlades], b = rim[(i * 37 + 1) % kBlades];
      add(i % 5 == 0 ? Polygon{hub, b, a} : Polygon{hub, a, b}, 30);
    }
    for (uint32_t i = 0; i < 40; ++i)  // beside the fan: their edges are far down the list
      add({hub, rim[i], vertex(new_place())}, 30);
  }

  /// Many triangles at one edge, in either direction.
  void book() {
    const uint32_t a = vertex(new_place()), b = vertex(new_place());
    for (uint32_t i = 0; i < 90; ++i)
      add(i % 3 == 0 ? Polygon{a, b, vertex(new_place())} : Polygon{b, a, vertex(new_place())}, 30);
  }

  /// Quads from one vertex to another that share no side there: as many open gates from the latter. A
  /// last triangle closes the first of them.
  void flower(uint32_t petals) {
    const uint32_t base = vertex(new_place()), tip = vertex(new_place());
    uint32_t first = 0, last = 0;
    for (uint32_t i = 0; i < petals; ++i) {
      const uint32_t x = vertex(new_place()), y = vertex(new_place());
      if (i == 0)
        first = x;
      else
        polygons_.push_back({base, last, x});
      polygons_.push_back({base, x, tip, y});
      last = y;
    }
    polygons_.push_back({base, last, tip});
    polygons_.push_back({base, tip, first});
  }

  /// Polygons over the same few vertices, so that far ones meet.
  void crossings() {
    Polygon few;
    for (uint32_t i = 0; i < 40; ++i)
      few.push_back(vertex(new_place()));
    for (uint32_t i = 0; i < 130; ++i) {
      Polygon polygon;
      for (uint32_t tries = 0, n = 3 + numbers_.below(4); polygon.size() < n && tries < 30;
           ++tries) {
        const uint32_t v = few[(i + numbers_.below(i % 2 ? 6 : 40)) % 40];
        if (std::ranges::find(polygon, v) == polygon.end())
          polygon.push_back(v);
      }
      if (polygon.size() >= 3)
        add(polygon);
    }
  }

  /// Many copies at few places, asked for at random.
  void crowd() {
    constexpr uint32_t kCopies = 40;
    Polygon at[4];
    for (Polygon& copies : at) {
      const uint32_t place = new_place();
      for (uint32_t i = 0; i < kCopies; ++i)
        copies.push_back(vertex(place));
    }
    for (uint32_t i = 0; i < 150; ++i) {
      const uint32_t shown = std::min(i / 2 + 1, kCopies);
      add({at[0][numbers_.below(shown)], at[1][numbers_.below(shown)],
           at[2 + i % 2][numbers_.below(shown)]});
    }
  }

  /// Vertices of no polygon, at places of others and alone; polygons that are none.
  void leftovers() {
    for (uint32_t i = 0; i < 12; ++i)
      vertex(i % 3 == 0 ? new_place() : numbers_.below(place_count_));
    const auto any = [&] { return numbers_.below(static_cast<uint32_t>(places_.size())); };
    for (uint32_t i = 0; i < 10; ++i) {
      const uint32_t v = any(), w = any();
      add(i % 3 == 0 ? Polygon{v, w} : i % 3 == 1 ? Polygon{v, w, v} : Polygon{v, v, w, w});
    }
  }

  /// Positions of the vertices, which have new numbers.
  void place(const std::vector<uint32_t>& number) {
    clip_.name = "tangle";
    clip_.vertex_count = static_cast<uint32_t>(places_.size());
    clip_.frame_count = 2;
    clip_.positions.resize(size_t{6} * places_.size());
    for (size_t v = 0; v < places_.size(); ++v) {
      const uint32_t p = places_[v];
      const float at[] = {static_cast<float>(p % 16), static_cast<float>(p / 16),
                          static_cast<float>(p * 7 % 5)};
      for (size_t c = 0; c < 3; ++c) {
        clip_.positions[3 * number[v] + c] = at[c];
        clip_.positions[3 * (places_.size() + number[v]) + c] = at[c] + (c == 2 ? 1 : 0);
      }
    }
  }

  /// Numbers the vertices row by row, with jumps, back and forth; polygons start at any corner.
  void scramble() {
    std::vector<uint32_t> number(places_.size());
    std::iota(number.begin(), number.end(), 0U);
    for (size_t i = 0; i + 1 < number.size(); ++i) {
      const size_t reach = i / 60 % 3 == 0 ? 1 : i / 60 % 3 == 1 ? 5 : number.size();
      std::swap(
          number[i],
          number[std::min(i + numbers_.below(static_cast<uint32_t>(reach)), number.size() - 1)]);
    }
    std::reverse(number.begin() + 100, number.begin() + 180);
    place(number);
    for (size_t i = 0; i + 1 < polygons_.size(); ++i) {
      if (numbers_.below(6) == 0)
        std::swap(polygons_[i], polygons_[std::min(i + numbers_.below(40), polygons_.size() - 1)]);
    }
    for (Polygon& polygon : polygons_) {
      for (uint32_t& v : polygon)
        v = number[v];
      if (numbers_.below(4) == 0)
        std::ranges::rotate(
            polygon, polygon.begin() + numbers_.below(static_cast<uint32_t>(polygon.size())));
      clip_.polygons.add(polygon);
    }
  }

  Numbers numbers_;
  MeshSequence clip_;
  uint32_t place_count_ = 0;
  std::vector<uint32_t> places_;  ///< of each vertex
  std::vector<Polygon> polygons_;
};

/// A file of key-frames alone, in the order of the source.
Bytes flat(const MeshSequence& clip) {
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.keyframes = 1;
  options.order = OrderMode::kAll;
  return encode(clip, options).file;
}

Bytes tangle() {
  return flat(Tangle().make());
}

/// Many open gates from one vertex, and polygons that close old ones, as they stand in the file.
Bytes flowers() {
  return flat(Tangle().make_flowers());
}

/// A character of a few vertices that walks in a curve, stands, and walks again: three clips, of which
/// one has no motion of its own, with events and corrections.
Bytes walk_on_ground(UpAxis up) {
  constexpr uint32_t kVertices = 12, kFrames = 8;
  MeshSequence all;
  all.vertex_count = kVertices;
  all.up = up;
  for (uint32_t v = 0; v + 2 < kVertices; ++v)
    all.polygons.add(std::vector<uint32_t>{v, v + 1, v + 2});
  for (uint32_t c = 0; c < 3; ++c) {
    for (uint32_t f = 0; f < kFrames; ++f) {
      const double turn = c == 0 ? 0.3 * f : 0, way = c == 1 ? 0 : 0.5 * f;
      for (uint32_t v = 0; v < kVertices; ++v) {
        const double x = 0.4 * (v % 3) + 0.05 * ((v * 5 + f * (c + 1)) % 7),
                     y = 0.3 * (v % 2 + v % 5), z = 0.2 * v + 0.02 * (f * v % 5);
        all.positions.push_back(
            static_cast<float>(3 + x * std::cos(turn) - y * std::sin(turn) + way));
        all.positions.push_back(
            static_cast<float>(x * std::sin(turn) + y * std::cos(turn) - way / 2));
        all.positions.push_back(static_cast<float>(z));
        if (up == UpAxis::kY)  // x, y, z become z, x, y
          std::rotate(all.positions.end() - 3, all.positions.end() - 2, all.positions.end());
      }
    }
    ClipTiming clip;
    clip.name = c == 0 ? "turn" : c == 1 ? "stand" : "walk";
    clip.frame_count = kFrames;
    clip.rate = {10, 1, false};
    if (c != 1)
      clip.events = {{"left", 0.1}, {"right", 0.1}, {"", 0.65}};
    all.clips.push_back(clip);
  }
  all.frame_count = 3 * kFrames;
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 6, false};
  options.cap = Target{ErrorMetric::kMaxError, 1, true};
  options.basis = BasisChoice::kEigentrajectories;
  options.root_motion = true;
  return encode(all, options).file;
}

Bytes walk() {
  return walk_on_ground(UpAxis::kZ);
}

Bytes walk_y_up() {
  return walk_on_ground(UpAxis::kY);
}

/// Exact positions: steps that binary32 rounds twice along x, fractions of 1024 along z, anything along y.
Bytes exact() {
  constexpr uint32_t kSide = 7, kVertices = kSide * kSide + 2, kFrames = 9;
  MeshSequence clip;
  clip.vertex_count = kVertices;
  clip.frame_count = kFrames;
  for (uint32_t v = 0; v + kSide + 1 < kSide * kSide; ++v) {
    if (v % kSide + 1 < kSide)
      clip.polygons.add(std::vector<uint32_t>{v, v + 1, v + kSide + 1, v + kSide});
  }
  for (uint32_t f = 0; f < kFrames; ++f) {
    const uint32_t g = f == 6 ? 2 : f;  // a frame comes again
    for (uint32_t v = 0; v < kVertices; ++v) {
      const uint32_t x = v % kSide, y = v / kSide;
      const uint32_t noise = (v * 2654435761U + g * 40503U) >> 20;
      clip.positions.push_back(static_cast<float>(10 * x + 3 * g + noise % 8) * 1.1e-4F + 3.3F);
      clip.positions.push_back(v % 9 == 0   ? -0.0F
                               : v % 9 == 1 ? 1e-40F * static_cast<float>(g)
                                            : static_cast<float>(y + 1e-3 * (noise % 11) * x));
      clip.positions.push_back(
          static_cast<float>((90 * (x ^ y) + 11 * g + noise % 16) / 1024.0 - 0.25));
    }
  }
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0, false};
  options.basis = BasisChoice::kEigentrajectories;
  return encode(clip, options).file;
}

/// A shell of quadrangles, triangles and a vertex in no face whose attributes move, in the source's order: texture
/// coordinates of corners that scroll but for one corner of a fan that turns on its own, four numbers of each
/// polygon, one of each vertex that differs in copies, and colours of polygons that rest.
/// `empty`: and a polygon without corners, whose numbers move like those of the others.
Bytes domains_of(bool empty) {
  constexpr uint32_t kSide = 5, kFrames = 7, kVertices = kSide * kSide + 3;
  MeshSequence clip;
  clip.vertex_count = kVertices;
  clip.frame_count = kFrames;
  for (uint32_t y = 0; y + 1 < kSide; ++y) {
    for (uint32_t x = 0; x + 1 < kSide; ++x) {
      const uint32_t v = y * kSide + x;
      if ((x + y) % 4 == 3) {
        clip.polygons.add(std::vector<uint32_t>{v, v + 1, v + kSide + 1});
        clip.polygons.add(std::vector<uint32_t>{v + kSide, v, v + kSide + 1});
      } else {
        clip.polygons.add(std::vector<uint32_t>{v + 1, v + kSide + 1, v + kSide, v});
      }
    }
  }
  clip.polygons.add(
      std::vector<uint32_t>{kSide * kSide, kSide * kSide + 1, 7});  // copies of the first two
  if (empty)
    clip.polygons.add(std::vector<uint32_t>{});
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (uint32_t v = 0; v < kVertices; ++v) {
      const uint32_t of = v == kSide * kSide ? 0 : v == kSide * kSide + 1 ? 1 : v;
      const double x = of % kSide, y = of / kSide;
      clip.positions.push_back(static_cast<float>(x + 0.1 * std::sin(0.9 * f + y)));
      clip.positions.push_back(static_cast<float>(y));
      clip.positions.push_back(static_cast<float>(0.3 * std::cos(0.5 * f + x)));
    }
  }
  const size_t corners = clip.polygons.corners.size(), polygons = clip.polygons.size();
  Attribute uv{.kind = AttributeKind::kUv,
               .name = "uv",
               .domain = AttributeDomain::kCorner,
               .frames = kFrames,
               .values = {}};
  Attribute cells{.name = "cells",
                  .domain = AttributeDomain::kPolygon,
                  .components = 4,
                  .frames = kFrames,
                  .values = {}};
  Attribute heat{.name = "heat", .components = 1, .frames = kFrames, .values = {}};
  cells.kind = heat.kind = AttributeKind::kCustom;
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (size_t c = 0; c < corners; ++c) {
      const uint32_t v = clip.polygons.corners[c];
      const double turn = c == 9 ? 0.2 * f : 0, seam = c % 11 == 0 ? 0.5 : 0;
      uv.values.push_back(static_cast<float>(0.1 * (v % kSide) + seam + 0.03 * f + turn));
      uv.values.push_back(static_cast<float>(0.1 * (v / kSide) - 0.01 * f));
    }
    for (size_t p = 0; p < polygons; ++p) {
      for (int k = 0; k < 4; ++k)
        cells.values.push_back(
            static_cast<float>(10 * k + std::sin(0.4 * p + 0.6 * f * (k + 1)) * (k + 1)));
    }
    for (uint32_t v = 0; v < kVertices; ++v)
      heat.values.push_back(
          static_cast<float>(20 + std::cos(0.3 * v + f) + (v == kSide * kSide ? 2.0 * f : 0)));
  }
  Attribute paint{.kind = AttributeKind::kColour,
                  .name = "paint",
                  .domain = AttributeDomain::kPolygon,
                  .components = 3,
                  .values = {}};
  for (size_t i = 0; i < 3 * polygons; ++i)
    paint.values.push_back(static_cast<float>(i / 12 % 3) / 2);
  clip.attributes = {uv, cells, heat, paint};
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 1, false};
  options.basis = BasisChoice::kEigentrajectories;
  options.order = OrderMode::kAll;
  return encode(clip, options).file;
}

Bytes domains() {
  return domains_of(false);
}

Bytes empty_polygon() {
  return domains_of(true);
}

constexpr SpecialVector kVectors[] = {{"schedules", schedules},
                                      {"alike", alike},
                                      {"vertex_order", vertex_order},
                                      {"rings", rings_by_degree},
                                      {"weights_in_time", weights_in_time},
                                      {"clips", clips},
                                      {"walk", walk},
                                      {"walk_y_up", walk_y_up},
                                      {"exact", exact},
                                      {"domains", domains},
                                      {"empty_polygon", empty_polygon},
                                      {"saturated", saturated},
                                      {"layers", layers},
                                      {"regions", regions},
                                      {"exact_regions", exact_regions},
                                      {"partners", partners},
                                      {"other_parents", other_parents},
                                      {"draco_parents", draco_parents},
                                      {"scene", scene},
                                      {"cliques", cliques_of_vertices},
                                      {"turned", turned},
                                      {"flowers", flowers},
                                      {"tangle", tangle}};

int run(int argc, char** argv) {
  std::vector<SpecialVector> vectors(std::begin(kVectors), std::end(kVectors));
  vectors.insert(vectors.end(), reading_vectors().begin(), reading_vectors().end());
  for (const SpecialVector& vector : vectors) {
    if (argc == 1)
      std::printf("%s\n", vector.name);
    if (argc != 3 || std::string(argv[1]) != vector.name)
      continue;
    const Bytes bytes = vector.make();
    std::ofstream file(argv[2], std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return file.good() ? 0 : 1;
  }
  return argc == 1 ? 0 : 2;
}

}  // namespace
}  // namespace anicodec

int main(int argc, char** argv) {
  try {
    return anicodec::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "special_vectors: %s\n", error.what());
    return 1;
  }
}
