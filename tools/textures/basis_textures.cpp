// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/basis_textures.h"

#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/trajectory_gram.h"
#include "codec/sequence/error.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Json = nlohmann::ordered_json;

/// Components of a texel, columns of the motion of the whole, and texels of a row whose places are exact in half floats.
constexpr uint32_t kGroup = 4, kMotion = 2, kHalfPlaces = 1024;

/// Vectors of all vertices and frames.
struct Field {
  uint32_t frames, vertices;
  FrameArray values;

  Field(uint32_t f, uint32_t v) : frames(f), vertices(v), values(size_t{3} * f * v) {}

  float* frame(uint32_t f) { return values.data() + size_t{3} * f * vertices; }

  FrameView view() const { return {values.data(), frames, vertices}; }

  double squares() const {
    double sum = 0;
    for (float x : values)
      sum += double{x} * double{x};
    return sum;
  }
};

/// A field as functions of the vertices, whose largest value is 1, times vectors of the frames.
struct Components {
  MatrixXd functions;  ///< vertices x components
  MatrixXd weights;    ///< 3 frames x components

  uint32_t count() const { return static_cast<uint32_t>(functions.cols()); }

  uint32_t groups() const { return (count() + kGroup - 1) / kGroup; }
};

/// Orthonormal combinations of the 3 frames' coordinates, those that explain most first: enough that `allowed` is left of
/// the squares.
MatrixXd leading_weights(const FrameView& view, double squares, double allowed, uint32_t most) {
  constexpr Index kDirect = 320;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const auto rows = static_cast<Index>(3 * view.frame_count);
  Index count = 0;
  auto enough = [&](const Eigenpairs& pairs, Index reliable) {
    double left = squares;
    for (count = 0; left > allowed && count < std::min(reliable, pairs.values.size()); ++count)
      left -= pairs.values[count];
    return left <= allowed;
  };
  // Below this, what is left is rounding.
  const double smallest = 1e-13 * squares;
  if (rows <= kDirect) {
    const Eigenpairs pairs =
        leading_eigenpairs(trajectory_gram(view, origin), rows, smallest, kDirect);
    enough(pairs, rows);
    return pairs.vectors.leftCols(count);
  }
  for (Index wanted = 32;; wanted *= 2) {
    wanted = std::min<Index>({wanted, rows, static_cast<Index>(most) + 1});
    const Eigenpairs pairs = leading_eigenspace(
        [&](const MatrixXd& columns) { return times_trajectory_gram(view, origin, columns); }, rows,
        wanted, 4 * wanted);
    if (enough(pairs, wanted) || wanted > static_cast<Index>(most) ||
        pairs.values.size() < wanted || wanted == rows)
      return pairs.vectors.leftCols(count);
  }
}

Components reduced(const Field& field, double allowed, uint32_t most) {
  Components parts;
  const FrameView view = field.view();
  parts.weights = leading_weights(view, field.squares(), allowed, most);
  parts.functions.resize(field.vertices, parts.weights.cols());
  combine_rows(view, Eigen::Vector3d::Zero(), parts.weights,
               [&](size_t first, const MatrixXd& block) {
                 parts.functions.middleRows(static_cast<Index>(first), block.rows()) = block;
               });
  for (Index j = 0; j < parts.functions.cols(); ++j) {
    const double largest = parts.functions.col(j).cwiseAbs().maxCoeff();
    if (largest > 0) {
      parts.functions.col(j) /= largest;
      parts.weights.col(j) *= largest;
    }
  }
  return parts;
}

/// A box around points.
struct Extent {
  std::array<float, 3> least{}, most{};

  void add(std::span<const float> positions, bool first) {
    for (size_t i = 0; i < positions.size(); ++i) {
      const bool is_new = first && i < 3;
      least[i % 3] = is_new ? positions[i] : std::min(least[i % 3], positions[i]);
      most[i % 3] = is_new ? positions[i] : std::max(most[i % 3], positions[i]);
    }
  }

  double diagonal() const {
    return std::hypot(double{most[0]} - double{least[0]}, double{most[1]} - double{least[1]},
                      double{most[2]} - double{least[2]});
  }
};

double diagonal(const VatSource& source) {
  Extent box;
  for (uint32_t f = 0; f < source.frame_count; ++f)
    box.add(source.frames(f), f == 0);
  return box.diagonal();
}

/// A clip as what the textures hold.
struct Basis {
  std::vector<float> rest;     ///< of the clip's vertices
  std::vector<float> at_rest;  ///< of the texels
  MatrixXd motion;             ///< frames x 3
  Components positions, normals;
  Extent box;  ///< of all frames
};

void check_count(const VatSource& source, const Components& parts, const BasisBounds& bounds,
                 std::string_view what, std::string_view option) {
  if (parts.count() > bounds.most)
    throw Error(ErrorKind::kInput,
                fmt::format("{}: {} within the bound take more than {} components; {} allows more "
                            "error",
                            source.name, what, bounds.most, option));
}

Basis find_basis(const VatSource& source, const VatOptions& options, const BasisBounds& bounds) {
  const TexelMesh& mesh = source.mesh;
  const uint32_t frames = source.frame_count, vertices = mesh.vertex_count();
  const uint32_t own = mesh.clip().vertex_count;
  const bool with_normals = options.normals && mesh.has_normals();
  Basis basis;
  basis.motion = MatrixXd::Zero(frames, 3);
  Field offsets(frames, vertices), normals(with_normals ? frames : 0, vertices);
  std::vector<double> sums(size_t{3} * own);
  for (uint32_t f = 0; f < frames; ++f) {
    if (options.progress)
      options.progress("reading", static_cast<double>(f) / frames);
    const std::span<const float> frame = source.frames(f);
    basis.box.add(frame, f == 0);
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < frame.size(); ++i)
      centre[static_cast<Index>(i % 3)] += double{frame[i]};
    basis.motion.row(f) = centre.transpose() / std::max(own, 1U);
    for (size_t i = 0; i < frame.size(); ++i)
      sums[i] += double{frame[i]} - basis.motion(f, static_cast<Index>(i % 3));
    std::ranges::copy(mesh.positions(frame), offsets.frame(f));
    if (with_normals)
      std::ranges::copy(mesh.normals(frame), normals.frame(f));
  }
  // The mesh rests where the clip is on average, which is what its box should be about.
  const Eigen::RowVector3d middle = basis.motion.colwise().mean();
  basis.motion.rowwise() -= middle;
  for (size_t i = 0; i < sums.size(); ++i)
    basis.rest.push_back(static_cast<float>(sums[i] / frames + middle[static_cast<Index>(i % 3)]));
  basis.at_rest = mesh.positions(basis.rest);
  for (uint32_t f = 0; f < frames; ++f) {
    float* x = offsets.frame(f);
    for (size_t i = 0; i < basis.at_rest.size(); ++i)
      x[i] = static_cast<float>(double{x[i]} - double{basis.at_rest[i]} -
                                basis.motion(f, static_cast<Index>(i % 3)));
  }
  if (options.progress)
    options.progress("finding components", 0);
  const double all = static_cast<double>(frames) * vertices;
  const double rmse =
      bounds.rmse.percent ? bounds.rmse.value / 100 * basis.box.diagonal() : bounds.rmse.value;
  basis.positions = reduced(offsets, all * rmse * rmse, bounds.most);
  check_count(source, basis.positions, bounds, "positions", "--rmse");
  if (with_normals) {
    // The chord of an angle between unit vectors.
    const double chord = 2 * std::sin(bounds.rms_angle * std::numbers::pi / 360);
    basis.normals = reduced(normals, all * chord * chord, bounds.most);
    check_count(source, basis.normals, bounds, "normals", "--normal-error (or --no-normals)");
  }
  return basis;
}

/// How texels become numbers: texel x scale + bias.
struct Decoding {
  double scale = 1, bias = 0;

  float texel(double x) const { return static_cast<float>((x - bias) / scale); }

  double number(float texel) const { return double{texel} * scale + bias; }
};

/// Decoding of PNG, for numbers from -largest to largest: 0 is a texel.
Decoding of_png(double largest) {
  constexpr double kSteps = 65535, kZero = 32768;
  const double scale = std::max(largest, 1e-30) * kSteps / (kSteps - kZero);
  return {scale, -scale * kZero / kSteps};
}

/// The number of a 16-bit float, or nearly so if it is a small one.
double as_half(double x) {
  constexpr int kDigits = 11;
  int exponent = 0;
  const double digits = std::round(std::ldexp(std::frexp(x, &exponent), kDigits));
  return std::ldexp(digits, exponent - kDigits);
}

/// The two textures, and what tells shaders about them.
struct Textures {
  TexelGrid grid;
  uint32_t rows_of_weights = 0, columns = 0;
  uint32_t position_layers = 0, normal_layers = 0;
  Decoding basis_numbers, weight_numbers;
  DataTexture basis, weights;

  uint32_t layers() const { return position_layers + normal_layers; }

  uint32_t first_normal_weight() const { return kMotion + kGroup * position_layers; }

  const float* weight(uint32_t f, uint32_t column) const {
    return weights.at(column + f / rows_of_weights * columns, f % rows_of_weights);
  }

  float* weight(uint32_t f, uint32_t column) {
    return weights.at(column + f / rows_of_weights * columns, f % rows_of_weights);
  }
};

void lay_out(const VatSource& source, const VatOptions& options, Textures& t) {
  const uint32_t vertices = source.mesh.vertex_count();
  t.grid = TexelGrid(vertices, std::min(kHalfPlaces, options.max_size));
  if (uint64_t{t.grid.rows} * t.layers() > options.max_size)
    t.grid = TexelGrid(vertices, options.max_size);
  check_rows(source, uint64_t{t.grid.rows} * t.layers(), options);
  t.columns = kMotion + kGroup * t.layers();
  t.rows_of_weights = std::min(source.frame_count, options.max_size);
  const uint64_t width = uint64_t{t.columns} * ((source.frame_count - 1) / t.rows_of_weights + 1);
  if (width > options.max_size)
    throw Error(ErrorKind::kInput,
                fmt::format("{}: weights of {} frames take a texture of {} columns, and {} are the "
                            "most; --frames takes some",
                            source.name, source.frame_count, width, options.max_size));
  t.basis = DataTexture(t.grid.width, t.grid.rows * std::max(t.layers(), 1U));
  t.weights = DataTexture(static_cast<uint32_t>(width), t.rows_of_weights);
}

void fill_layers(const Components& parts, uint32_t first_layer, uint32_t first_column,
                 uint32_t frames, Textures& t) {
  for (uint32_t j = 0; j < parts.count(); ++j) {
    const uint32_t row = (first_layer + j / kGroup) * t.grid.rows;
    for (uint32_t v = 0; v < parts.functions.rows(); ++v)
      t.basis.at(t.grid.x(v), row + t.grid.y(v))[j % kGroup] =
          t.basis_numbers.texel(parts.functions(v, j));
    for (uint32_t f = 0; f < frames; ++f) {
      for (uint32_t c = 0; c < 3; ++c)
        t.weight(f, first_column + j)[c] = t.weight_numbers.texel(parts.weights(3 * f + c, j));
    }
  }
}

Textures filled(const VatSource& source, const VatOptions& options, const Basis& basis) {
  Textures t;
  t.position_layers = basis.positions.groups();
  t.normal_layers = basis.normals.groups();
  if (options.png) {
    auto largest = [](const MatrixXd& x) { return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0; };
    t.basis_numbers = of_png(1);
    t.weight_numbers = of_png(std::max(
        {largest(basis.motion), largest(basis.positions.weights), largest(basis.normals.weights)}));
  }
  lay_out(source, options, t);
  std::ranges::fill(t.basis.texels, t.basis_numbers.texel(0));
  std::ranges::fill(t.weights.texels, t.weight_numbers.texel(0));
  for (uint32_t f = 0; f < source.frame_count; ++f) {
    for (uint32_t c = 0; c < 3; ++c) {
      const double whole = basis.motion(f, c), rough = options.png ? whole : as_half(whole);
      t.weight(f, 0)[c] = t.weight_numbers.texel(rough);
      t.weight(f, 1)[c] = t.weight_numbers.texel(whole - rough);
    }
  }
  fill_layers(basis.positions, 0, kMotion, source.frame_count, t);
  fill_layers(basis.normals, t.position_layers, t.first_normal_weight(), source.frame_count, t);
  return t;
}

/// The sum that a shader computes for a vertex, over some layers.
std::array<double, 3> sum(const Textures& t, uint32_t v, uint32_t f, uint32_t first_layer,
                          uint32_t layers, uint32_t column) {
  std::array<double, 3> x{};
  for (uint32_t layer = 0; layer < layers; ++layer) {
    const float* texel = t.basis.at(t.grid.x(v), (first_layer + layer) * t.grid.rows + t.grid.y(v));
    for (uint32_t k = 0; k < kGroup; ++k, ++column) {
      const double b = t.basis_numbers.number(texel[k]);
      const float* w = t.weight(f, column);
      for (size_t c = 0; c < 3; ++c)
        x[c] += b * t.weight_numbers.number(w[c]);
    }
  }
  return x;
}

void measure(const VatSource& source, const VatOptions& options, const Basis& basis,
             const Textures& t, VatError* error) {
  const uint32_t vertices = source.mesh.vertex_count();
  const bool with_normals = options.normals && source.mesh.has_normals();
  std::vector<double> x(size_t{3} * vertices), n(with_normals ? x.size() : 0);
  for (uint32_t f = 0; f < source.frame_count; ++f) {
    if (options.progress)
      options.progress("measuring", static_cast<double>(f) / source.frame_count);
    const std::span<const float> frame = source.frames(f);
    const std::vector<float> positions = source.mesh.positions(frame);
    const std::vector<float> normals =
        with_normals ? source.mesh.normals(frame) : std::vector<float>();
    for (uint32_t v = 0; v < vertices; ++v) {
      const auto offset = sum(t, v, f, 0, t.position_layers, kMotion);
      for (size_t c = 0; c < 3; ++c)
        x[3 * v + c] = double{basis.at_rest[3 * v + c]} +
                       t.weight_numbers.number(t.weight(f, 0)[c]) +
                       t.weight_numbers.number(t.weight(f, 1)[c]) + offset[c];
      if (!with_normals)
        continue;
      const auto normal = sum(t, v, f, t.position_layers, t.normal_layers, t.first_normal_weight());
      std::ranges::copy(normal, n.begin() + std::ptrdiff_t{3} * v);
    }
    error->add(positions, x, normals, n);
  }
}

Json description(const VatSource& source, const Basis& basis, const Textures& t,
                 const VatResult& result) {
  Json clips = Json::array();
  for (const VatClip& clip : source.clips)
    clips.push_back({{"name", clip.name},
                     {"first_frame", clip.first_frame},
                     {"frame_count", clip.frame_count},
                     {"rate", clip.rate},
                     {"loop", clip.loop}});
  Json json{{"form", "basis"},
            {"basis", result.files[0].name},
            {"weights", result.files[1].name},
            {"mesh", source.name + ".glb"},
            {"width", t.grid.width},
            {"rows", t.grid.rows},
            {"position_layers", t.position_layers},
            {"normal_layers", t.normal_layers},
            {"basis_scale", t.basis_numbers.scale},
            {"basis_bias", t.basis_numbers.bias},
            {"weight_scale", t.weight_numbers.scale},
            {"weight_bias", t.weight_numbers.bias},
            {"frames", source.frame_count},
            {"clips", clips}};
  json["box"] = {{"min", basis.box.least}, {"max", basis.box.most}};
  return json;
}

/// The textures of bounds on what is left out, which rounding and unit length add to.
VatResult attempt(const VatSource& source, const VatOptions& options, const BasisBounds& bounds) {
  const Basis basis = find_basis(source, options, bounds);
  Textures t = filled(source, options, basis);
  VatResult result;
  const TexelKind kind = options.png ? TexelKind::kPng16 : TexelKind::kExrHalf;
  t.basis = result.add_texture(source.name + "_basis", t.basis, kind);
  t.weights = result.add_texture(source.name + "_weights", t.weights, kind);
  measure(source, options, basis, t, &result.error);
  result.files.push_back(
      {source.name + "_basis.json", description(source, basis, t, result).dump(2) + "\n"});
  result.files.push_back(
      {source.name + ".glb",
       source.mesh.glb(basis.rest, t.grid.places(source.mesh.vertex_count(), 1, t.grid.rows))});
  return result;
}

}  // namespace

VatResult make_basis(const VatSource& source, const VatOptions& options,
                     const BasisBounds& bounds) {
  constexpr int kAttempts = 4;
  constexpr double kMargin = 0.98;
  BasisBounds tried = bounds;
  tried.rmse = {bounds.rmse.percent ? bounds.rmse.value / 100 * diagonal(source)
                                    : bounds.rmse.value};
  const double rmse = tried.rmse.value;
  for (int i = 1;; ++i) {
    VatResult result = attempt(source, options, tried);
    const double positions = result.error.rmse() / rmse;
    const double normals = result.error.rms_angle() / bounds.rms_angle;
    if (i == kAttempts || (positions <= 1 && normals <= 1)) {
      if (positions > 1)
        result.left_out.emplace_back("the bound of --rmse, which rounded numbers pass");
      if (normals > 1)
        result.left_out.emplace_back("the bound of --normal-error, which rounded numbers pass");
      return result;
    }
    if (positions > 1)
      tried.rmse.value *= kMargin / positions;
    if (normals > 1)
      tried.rms_angle *= kMargin / normals;
  }
}

}  // namespace anicodec::tools
