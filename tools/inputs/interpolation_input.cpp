// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/interpolation_input.h"

#include "codec/sequence/error.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/compared_clip.h"
#include "tools/inputs/number_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr double kSumTolerance = 1e-5;

template <typename T>
std::optional<T> number(std::string_view text) {
  T value{};
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

/// "clip.pc2@12" as the file and 12; without a number, the whole and none.
std::pair<std::string, std::optional<uint32_t>> split_frame(const std::string& argument) {
  const size_t at = argument.rfind('@');
  if (at != std::string::npos) {
    if (auto frame = number<uint32_t>(std::string_view(argument).substr(at + 1)))
      return {argument.substr(0, at), frame};
  }
  return {argument, std::nullopt};
}

std::vector<uint32_t> parse_vertices(std::string_view text) {
  std::vector<uint32_t> vertices;
  while (true) {
    const std::string_view item = text.substr(0, text.find(','));
    const size_t dash = item.find('-');
    const auto first = number<uint32_t>(item.substr(0, dash));
    const auto last =
        dash == std::string_view::npos ? first : number<uint32_t>(item.substr(dash + 1));
    if (!first || !last || *last < *first || *last - *first >= (1U << 24))
      throw Error(ErrorKind::kUsage, fmt::format("--pin: '{}' is no vertex or range", item));
    for (uint32_t v = *first; v <= *last; ++v)
      vertices.push_back(v);
    if (item.size() == text.size())
      return vertices;
    text.remove_prefix(item.size() + 1);
  }
}

}  // namespace

MeshSequence load_poses(std::span<const std::string> arguments, const std::string& mesh,
                        const Progress& progress) {
  std::map<std::string, std::unique_ptr<ComparedClip>> clips;
  MeshSequence poses;
  for (const std::string& argument : arguments) {
    auto [path, frame] = split_frame(argument);
    std::unique_ptr<ComparedClip>& clip = clips[path];
    if (!clip)
      clip = std::make_unique<ComparedClip>(path, mesh, progress);
    const MeshSequence& sequence = clip->sequence();
    if (!frame && sequence.frame_count != 1)
      throw Error(ErrorKind::kUsage, fmt::format("{} has {} frames: say which, as {}@0", path,
                                                 sequence.frame_count, path));
    if (frame && *frame >= sequence.frame_count)
      throw Error(ErrorKind::kUsage, fmt::format("{}: there is no frame {}, the last is {}", path,
                                                 *frame, sequence.frame_count - 1));
    if (poses.frame_count == 0) {
      poses.name = sequence.name;
      static_cast<MeshDetails&>(poses) = sequence;
      poses.polygons = sequence.polygons;
      poses.vertex_count = sequence.vertex_count;
      poses.up = sequence.up;
      poses.metres_per_unit = sequence.metres_per_unit;
    } else if (poses.vertex_count != sequence.vertex_count) {
      throw Error(ErrorKind::kInput,
                  fmt::format("{} has {} vertices, but {} has {}", path, sequence.vertex_count,
                              arguments[0], poses.vertex_count));
    } else if (!same_faces(poses.polygons, sequence.polygons)) {
      throw Error(ErrorKind::kInput,
                  fmt::format("{} and {} have different faces", path, arguments[0]));
    }
    const std::span<const float> positions = clip->frames()(frame.value_or(0));
    poses.positions.insert(poses.positions.end(), positions.begin(), positions.end());
    ++poses.frame_count;
  }
  check(poses);
  return poses;
}

WeightRows read_weights(const std::string& path, size_t meshes) {
  WeightRows rows;
  for (NumberRow& row : read_number_rows(path)) {
    double sum = 0;
    for (double w : row.numbers)
      sum += w;
    if (row.numbers.size() != meshes)
      throw Error(ErrorKind::kInput, fmt::format("{}:{}: {} weights for {} meshes", path, row.line,
                                                 row.numbers.size(), meshes));
    if (!(std::abs(sum - 1) <= kSumTolerance))
      throw Error(ErrorKind::kInput,
                  fmt::format("{}:{}: the weights sum to {}, not to 1", path, row.line, sum));
    rows.push_back(std::move(row.numbers));
  }
  if (rows.empty())
    throw Error(ErrorKind::kInput, fmt::format("{}: there are no weights", path));
  return rows;
}

WeightRows path_weights(size_t meshes, uint32_t frames, double first, double last) {
  WeightRows rows;
  for (uint32_t f = 0; f < frames; ++f) {
    const double share = frames > 1 ? static_cast<double>(f) / (frames - 1) : 0;
    const double place = (1 - share) * first + share * last;
    const double between = std::clamp(std::floor(place), 0.0, static_cast<double>(meshes - 2));
    std::vector<double> row(meshes, 0.0);
    row[static_cast<size_t>(between)] = 1 - (place - between);
    row[static_cast<size_t>(between) + 1] = place - between;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::pair<double, double> parse_range(const std::string& text, const std::string& option) {
  const size_t colon = text.find(':');
  std::optional<double> first, last;
  if (colon != std::string::npos) {
    first = number<double>(std::string_view(text).substr(0, colon));
    last = number<double>(std::string_view(text).substr(colon + 1));
  }
  if (!first || !last || !std::isfinite(*first) || !std::isfinite(*last))
    throw Error(ErrorKind::kUsage, fmt::format("{}: '{}' is not FROM:TO", option, text));
  return {*first, *last};
}

std::span<const float> Pins::at(size_t frame) const {
  const size_t size = 3 * vertices.size();
  return {positions.data() + (positions.size() == size ? 0 : frame * size), size};
}

Pins read_pins(const std::string& text, uint32_t vertex_count, size_t frames) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw Error(ErrorKind::kUsage, "--pin: '" + text + "' is not VERTICES=FILE");
  const std::string path = text.substr(equals + 1);
  Pins pins;
  pins.vertices = parse_vertices(std::string_view(text).substr(0, equals));
  for (uint32_t v : pins.vertices) {
    if (v >= vertex_count)
      throw Error(ErrorKind::kUsage,
                  fmt::format("--pin: there is no vertex {}, the meshes have {}", v, vertex_count));
  }
  size_t rows = 0;
  for (const NumberRow& row : read_number_rows(path)) {
    if (row.numbers.size() != 3)
      throw Error(ErrorKind::kInput, fmt::format("{}:{}: {} coordinates instead of 3", path,
                                                 row.line, row.numbers.size()));
    for (double x : row.numbers) {
      const auto coordinate = static_cast<float>(x);
      if (!std::isfinite(coordinate))
        throw Error(ErrorKind::kInput, fmt::format("{}:{}: {} is too large", path, row.line, x));
      pins.positions.push_back(coordinate);
    }
    ++rows;
  }
  if (rows != pins.vertices.size() && rows != pins.vertices.size() * frames)
    throw Error(ErrorKind::kInput, fmt::format("{}: {} positions for {} pins and {} frames", path,
                                               rows, pins.vertices.size(), frames));
  return pins;
}

}  // namespace anicodec::tools
