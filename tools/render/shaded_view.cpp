// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/shaded_view.h"

#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

namespace anicodec::tools {
namespace {

using Eigen::Vector3f;

constexpr double kViewAngle = 30;  // degrees, of the shorter side
constexpr int kSamples = 2;        // in each direction of a pixel
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

struct ShadedView::Scene {
  std::vector<uint32_t> triangles;
  uint32_t vertex_count;
  Vector3f centre;
  float scale;  // into the unit ball, so that no clip is too small or too large
  uint32_t width, height;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  std::vector<Vector3f> points, normals;

  ~Scene() {
    if (geometry != nullptr)
      rtcReleaseGeometry(geometry);
    if (scene != nullptr)
      rtcReleaseScene(scene);
    if (device != nullptr)
      rtcReleaseDevice(device);
  }

  void place(std::span<const float> positions);
  Vector3f colour_of(const RTCRayHit& hit, std::span<const float> colours,
                     const Eigen::Matrix3f& view) const;
};

ShadedView::ShadedView(const Polygons& polygons, uint32_t vertex_count, const Box& box,
                       uint32_t width, uint32_t height)
    : scene_(std::make_unique<Scene>()) {
  Scene& s = *scene_;
  s.triangles = fan_triangles(polygons);
  if (s.triangles.empty())
    throw Error(ErrorKind::kInput, "there is no face to draw");
  s.vertex_count = vertex_count;
  s.width = width;
  s.height = height;
  const Vector3f low(box.low.data()), high(box.high.data());
  s.centre = low / 2 + high / 2;
  const float radius = (high / 2 - low / 2).norm();
  s.scale = radius > 0 ? 1 / radius : 1;
  s.device = rtcNewDevice(nullptr);
  s.scene = s.device != nullptr ? rtcNewScene(s.device) : nullptr;
  if (s.scene == nullptr)
    throw Error(ErrorKind::kInternal, "Embree cannot be started");
  s.geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(s.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), s.triangles.size() / 3));
  if (indices == nullptr)
    throw Error(ErrorKind::kInternal, "no memory for a picture");
  std::ranges::copy(s.triangles, indices);
  rtcAttachGeometry(s.scene, s.geometry);
}

ShadedView::~ShadedView() = default;

void ShadedView::Scene::place(std::span<const float> positions) {
  points.resize(vertex_count);
  normals.assign(vertex_count, Vector3f::Zero());
  auto* buffer = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
  if (buffer == nullptr)
    throw Error(ErrorKind::kInternal, "no memory for a picture");
  for (size_t v = 0; v < vertex_count; ++v) {
    points[v] = (at(positions, v) - centre) * scale;
    std::copy_n(points[v].data(), 3, buffer + 3 * v);
  }
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
    const Vector3f normal = (points[b] - points[a]).cross(points[c] - points[a]);
    for (uint32_t v : {a, b, c})
      normals[v] += normal;
  }
  for (Vector3f& n : normals)
    n.normalize();
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene);
}

/// `view` holds the camera's right, up and backward directions in its rows: lights go with it.
Vector3f ShadedView::Scene::colour_of(const RTCRayHit& hit, std::span<const float> colours,
                                      const Eigen::Matrix3f& view) const {
  const size_t t = size_t{3} * hit.hit.primID;
  const float weights[3] = {1 - hit.hit.u - hit.hit.v, hit.hit.u, hit.hit.v};
  Vector3f normal = Vector3f::Zero(), colour = Vector3f::Zero();
  for (size_t i = 0; i < 3; ++i) {
    normal += weights[i] * normals[triangles[t + i]];
    colour += weights[i] * (colours.empty() ? kSurface : at(colours, triangles[t + i]));
  }
  if (!(normal.squaredNorm() > 0))
    normal = Vector3f(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
  const Vector3f direction(hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z);
  normal = (view * normal).normalized();
  const bool back = normal.dot(view * direction) > 0;
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
  Eigen::Matrix3f view;
  view << right.transpose(), back.cross(right).transpose(), back.transpose();
  const float half = std::tan(radians(kViewAngle / 2));
  const Vector3f eye = back * (1.02F / std::sin(radians(kViewAngle / 2)));
  const auto side = static_cast<float>(std::min(s.width, s.height));

  Image image(s.width, s.height);
  tbb::parallel_for(uint32_t{0}, s.height, [&](uint32_t y) {
    for (uint32_t x = 0; x < s.width; ++x) {
      Vector3f sum = Vector3f::Zero();
      for (int sample = 0; sample < kSamples * kSamples; ++sample) {
        const float px =
            static_cast<float>(x) + (static_cast<float>(sample % kSamples) + 0.5F) / kSamples;
        const float py =
            static_cast<float>(y) + (static_cast<float>(sample / kSamples) + 0.5F) / kSamples;
        const float u = (2 * px - static_cast<float>(s.width)) / side * half;
        const float v = (static_cast<float>(s.height) - 2 * py) / side * half;
        const Vector3f direction = (view.transpose() * Vector3f(u, v, -1)).normalized();
        RTCRayHit hit{};
        hit.ray.org_x = eye.x(), hit.ray.org_y = eye.y(), hit.ray.org_z = eye.z();
        hit.ray.dir_x = direction.x(), hit.ray.dir_y = direction.y(), hit.ray.dir_z = direction.z();
        hit.ray.tnear = 0;
        hit.ray.tfar = 100;
        hit.ray.mask = 0xFFFFFFFF;
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(s.scene, &context, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
          const float t = py / static_cast<float>(s.height);
          sum += linear(kSky * (1 - t) + kGround * t);
        } else {
          sum += s.colour_of(hit, colours, view);
        }
      }
      uint8_t* out = image.pixel(x, y);
      for (int c = 0; c < 3; ++c)
        out[c] = to_srgb(sum[c] / (kSamples * kSamples));
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
