// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/shaded_view.h"

#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"
#include "codec/sequence/frame_normals.h"
#include "codec/sequence/shared_normals.h"
#include "codec/sequence/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace anicodec::tools {
namespace {

using Eigen::Vector3f;

constexpr double kViewAngle = 30;  // degrees, of the shorter side
constexpr uint32_t kSamples = 2;   // in each direction of a pixel
const Vector3f kSurface(0.72F, 0.74F, 0.78F);
const Vector3f kSky(0.97F, 0.975F, 0.985F), kGround(0.87F, 0.88F, 0.90F);

Vector3f at(std::span<const float> values, size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

uint8_t to_srgb(float linear) {
  const float x = std::clamp(linear, 0.F, 1.F);
  const float s = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
  return static_cast<uint8_t>(std::lround(255 * s));
}

/// Colours are given as they look; light is added up linearly.
Vector3f linear(const Vector3f& srgb) {
  return srgb.array().pow(2.2F);
}

/// The camera of a frame: rows right, up and backward, seen from `eye` at the unit ball.
struct ViewPoint {
  Eigen::Matrix3f view;
  Vector3f eye;
  float half;  ///< tangent of half the angle of view

  explicit ViewPoint(const Camera& camera) {
    const auto radians = [](double degrees) {
      return static_cast<float>(degrees * std::numbers::pi / 180);
    };
    const float a = radians(camera.azimuth), e = radians(camera.elevation);
    Vector3f back(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
    Vector3f above = Vector3f::UnitY();
    if (camera.z_up) {  // z up, the front towards -y
      back = Vector3f(back.x(), -back.z(), back.y());
      above = Vector3f::UnitZ();
    }
    const Vector3f right = above.cross(back).normalized();
    view << right.transpose(), back.cross(right).transpose(), back.transpose();
    eye = back * (1.02F / std::sin(radians(kViewAngle / 2)));
    half = std::tan(radians(kViewAngle / 2));
  }
};

/// The nearest triangle at a sample of a picture.
struct Sample {
  float nearness = 0;  ///< inverse of the distance along the view, 0: nothing there
  uint32_t triangle = 0;
  float weights[3] = {};  ///< of its corners, on the surface
};

/// A rectangle of samples of a frame, filled triangle by triangle.
struct Raster {
  uint32_t width, first_row, rows;
  std::vector<Sample> samples;

  Raster(uint32_t w, uint32_t first, uint32_t count)
      : width(w), first_row(first), rows(count), samples(size_t{w} * count) {}

  /// Corners on the picture in samples; z is the nearness, which is linear there.
  void add(uint32_t triangle, const Vector3f& a, const Vector3f& b, const Vector3f& c);
};

void Raster::add(uint32_t triangle, const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  const auto least = [](float x, float y, float z) { return std::min({x, y, z}); };
  const auto most = [](float x, float y, float z) { return std::max({x, y, z}); };
  const auto first = static_cast<float>(first_row), last = static_cast<float>(first_row + rows);
  const float left = std::max(least(a.x(), b.x(), c.x()), 0.F);
  const float right = std::min(most(a.x(), b.x(), c.x()), static_cast<float>(width));
  const float top = std::max(least(a.y(), b.y(), c.y()), first);
  const float bottom = std::min(most(a.y(), b.y(), c.y()), last);
  const auto side = [](const Vector3f& p, const Vector3f& q, double x, double y) {
    return (double{q.x()} - double{p.x()}) * (y - double{p.y()}) -
           (double{q.y()} - double{p.y()}) * (x - double{p.x()});
  };
  const double area = side(a, b, double{c.x()}, double{c.y()});
  if (!(left < right && top < bottom && std::abs(area) > 0))
    return;
  for (auto y = static_cast<uint32_t>(top); y < first_row + rows && static_cast<float>(y) < bottom;
       ++y) {
    for (auto x = static_cast<uint32_t>(left); x < width && static_cast<float>(x) < right; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double wa = side(b, c, px, py) / area, wb = side(c, a, px, py) / area;
      const double wc = 1 - wa - wb;
      if (!(wa >= 0 && wb >= 0 && wc >= 0))
        continue;
      const double na = wa * double{a.z()}, nb = wb * double{b.z()}, nc = wc * double{c.z()};
      const double nearness = na + nb + nc;
      Sample& sample = samples[size_t{y - first_row} * width + x];
      if (!(nearness > double{sample.nearness}))
        continue;
      sample = {static_cast<float>(nearness),
                triangle,
                {static_cast<float>(na / nearness), static_cast<float>(nb / nearness),
                 static_cast<float>(nc / nearness)}};
    }
  }
}

}  // namespace

void Box::add(std::span<const float> positions) {
  for (size_t i = 0; i < positions.size(); ++i) {
    const size_t c = i % 3;
    if (empty && i < 3)
      low[c] = high[c] = positions[i];
    low[c] = std::min(low[c], positions[i]);
    high[c] = std::max(high[c], positions[i]);
  }
  empty &= positions.empty();
}

namespace {

/// The surface that normals are made from, without positions.
MeshSequence surface_of(const MeshSequence& sequence) {
  MeshSequence surface;
  surface.polygons = sequence.polygons;
  surface.vertex_count = sequence.vertex_count;
  surface.shared_normals = known_shared_normals(sequence);
  return surface;
}

}  // namespace

struct ShadedView::Scene {
  Polygons polygons;                     ///< until they are cut
  std::vector<uint32_t> triangles;       ///< three vertices each
  std::vector<uint32_t> normal_numbers;  ///< of the same corners
  FrameNormals frame_normals;
  Vector3f centre;
  float scale;  ///< into the unit ball, so that no clip is too small or too large
  uint32_t width, height;
  std::vector<Vector3f> points;
  std::vector<float> normals;

  explicit Scene(const MeshSequence& sequence)
      : polygons(sequence.polygons), frame_normals(surface_of(sequence)) {}

  bool has_face() const {
    for (size_t p = 0; p < polygons.size(); ++p) {
      if (polygons[p].size() >= 3)
        return true;
    }
    return false;
  }

  /// Cuts the polygons by the first frame that is drawn.
  void cut(std::span<const float> positions) {
    for (const uint32_t corner : corner_triangles(polygons, positions)) {
      triangles.push_back(polygons.corners[corner]);
      normal_numbers.push_back(frame_normals.of_corner(corner));
    }
    polygons = {};
  }

  void place(std::span<const float> positions);
  Vector3f colour_of(const Sample& sample, std::span<const float> colours,
                     const ViewPoint& from) const;
};

ShadedView::ShadedView(const MeshSequence& sequence, const Box& box, uint32_t width,
                       uint32_t height)
    : scene_(std::make_unique<Scene>(sequence)) {
  Scene& s = *scene_;
  if (!s.has_face())
    throw Error(ErrorKind::kInput, "there is no face to draw");
  s.width = width;
  s.height = height;
  const Vector3f low(box.low.data()), high(box.high.data());
  s.centre = low / 2 + high / 2;
  const float radius = (high / 2 - low / 2).norm();
  s.scale = radius > 0 ? 1 / radius : 1;
}

ShadedView::~ShadedView() = default;

void ShadedView::Scene::place(std::span<const float> positions) {
  if (triangles.empty())
    cut(positions);
  points.resize(positions.size() / 3);
  for (size_t v = 0; v < points.size(); ++v)
    points[v] = (at(positions, v) - centre) * scale;
  normals = frame_normals.compute({points[0].data(), 3 * points.size()});
}

/// Lights go with the camera.
Vector3f ShadedView::Scene::colour_of(const Sample& sample, std::span<const float> colours,
                                      const ViewPoint& from) const {
  const size_t t = size_t{3} * sample.triangle;
  Vector3f normal = Vector3f::Zero(), colour = Vector3f::Zero(), point = Vector3f::Zero();
  for (size_t i = 0; i < 3; ++i) {
    const float weight = sample.weights[i];
    normal += weight * at(normals, normal_numbers[t + i]);
    colour += weight * (colours.empty() ? kSurface : at(colours, triangles[t + i]));
    point += weight * points[triangles[t + i]];
  }
  if (!(normal.squaredNorm() > 0)) {
    const Vector3f &a = points[triangles[t]], &b = points[triangles[t + 1]];
    normal = (b - a).cross(points[triangles[t + 2]] - a);
  }
  normal = (from.view * normal).normalized();
  const bool back = normal.dot(from.view * (point - from.eye)) > 0;
  if (back)
    normal = -normal;
  const float key = std::max(0.F, normal.dot(Vector3f(-0.45F, 0.65F, 0.6F).normalized()));
  const float fill = std::max(0.F, normal.dot(Vector3f(0.7F, 0.1F, 0.5F).normalized()));
  const float sky = 0.5F + 0.5F * normal.y();
  const float light = (0.16F + 0.16F * sky + 0.72F * key + 0.16F * fill) * (back ? 0.75F : 1.F);
  return linear(colour) * light;
}

Image ShadedView::draw(std::span<const float> positions, const Camera& camera,
                       std::span<const float> colours) {
  Scene& s = *scene_;
  s.place(positions);
  const ViewPoint from(camera);
  const auto width = static_cast<float>(kSamples * s.width);
  const auto height = static_cast<float>(kSamples * s.height);
  // The whole ball lies before the eye, so that every point has a place on the picture.
  std::vector<Vector3f> places(s.points.size());
  for (size_t v = 0; v < places.size(); ++v) {
    const Vector3f p = from.view * (s.points[v] - from.eye);
    const float nearness = -1 / p.z();
    const float pixels = nearness / from.half * std::min(width, height) / 2;
    places[v] = {width / 2 + p.x() * pixels, height / 2 - p.y() * pixels, nearness};
  }

  Image image(s.width, s.height);
  constexpr uint32_t kRows = 16;  // of pixels that a task draws
  parallel_for(uint32_t{0}, (s.height + kRows - 1) / kRows, [&](uint32_t task) {
    const uint32_t first = task * kRows, rows = std::min(kRows, s.height - first);
    Raster raster(kSamples * s.width, kSamples * first, kSamples * rows);
    for (uint32_t t = 0; t < s.triangles.size() / 3; ++t) {
      const uint32_t* corners = &s.triangles[size_t{3} * t];
      raster.add(t, places[corners[0]], places[corners[1]], places[corners[2]]);
    }
    for (uint32_t y = first; y < first + rows; ++y) {
      const float down = (static_cast<float>(y) + 0.5F) / static_cast<float>(s.height);
      const Vector3f behind = linear(kSky * (1 - down) + kGround * down);
      for (uint32_t x = 0; x < s.width; ++x) {
        Vector3f sum = Vector3f::Zero();
        for (uint32_t i = 0; i < kSamples * kSamples; ++i) {
          const size_t row = size_t{kSamples} * (y - first) + i / kSamples;
          const Sample& sample = raster.samples[row * raster.width + kSamples * x + i % kSamples];
          sum += sample.nearness > 0 ? s.colour_of(sample, colours, from) : behind;
        }
        uint8_t* out = image.pixel(x, y);
        for (int c = 0; c < 3; ++c)
          out[c] = to_srgb(sum[c] / (kSamples * kSamples));
      }
    }
  });
  return image;
}

std::array<float, 3> error_colour(double share) {
  constexpr std::array<float, 3> kStops[] = {{0.80F, 0.82F, 0.85F},
                                             {0.98F, 0.90F, 0.55F},
                                             {0.98F, 0.62F, 0.24F},
                                             {0.84F, 0.19F, 0.15F},
                                             {0.25F, 0.02F, 0.10F}};
  constexpr int kLast = 4;
  const double x = std::clamp(share, 0.0, 1.0) * kLast;
  const int i = std::min(static_cast<int>(x), kLast - 1);
  const auto t = static_cast<float>(x - i);
  std::array<float, 3> colour;
  for (size_t c = 0; c < 3; ++c)
    colour[c] = kStops[i][c] * (1 - t) + kStops[i + 1][c] * t;
  return colour;
}

}  // namespace anicodec::tools
