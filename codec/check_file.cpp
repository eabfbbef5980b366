// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/check_file.h"

#include "codec/parallel/task_threads.h"
#include "codec/sequence/error.h"
#include "sdk/api/objects.h"

#include <anicodec/anicodec.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <numeric>
#include <span>
#include <string>

namespace anicodec {
namespace {

/// The file as programs play it. It opens by what a live stream has learnt, too.
class PlayedFile {
 public:
  PlayedFile(const Bytes& file, KeptLearning* learning) {
    anic_options options = ANIC_INIT(anic_options);
    options.max_bytes = HostLimits().resident_bytes;
    const HostThreads threads = task_threads();
    options.threads = {threads.host, threads.run};
    if (const Failure failure = open_asset(file, options, learning, &asset_); !failure.ok())
      throw Error(ErrorKind::kInternal, std::string("the encoded file cannot be opened: ") +
                                            status_string(failure.status));
    if (anic_create_context(asset_, nullptr, &context_) != ANIC_OK) {
      anic_close_asset(asset_);
      throw std::bad_alloc();
    }
    anic_get_asset_info(asset_, &info_);
  }

  PlayedFile(const PlayedFile&) = delete;
  PlayedFile& operator=(const PlayedFile&) = delete;

  ~PlayedFile() {
    anic_destroy_context(context_);
    anic_close_asset(asset_);
  }

  const anic_asset* asset() const { return asset_; }

  const anic_asset_info& info() const { return info_; }

  void seek(uint32_t frame) { check(anic_seek_frame(context_, frame)); }

  void check_hashes() const {
    if (anic_verify_asset(asset_) != ANIC_OK)
      throw Error(ErrorKind::kInternal, "the encoded file decodes to other integers");
  }

  /// Positions of a mesh in the frame sought.
  void positions(uint32_t mesh, std::vector<float>* out) const {
    anic_output output = ANIC_INIT(anic_output);
    output.data = out->data();
    output.size = out->size() * sizeof(float);
    check(anic_write_positions(context_, mesh, ANIC_WHEN_CURRENT, 0,
                               static_cast<uint32_t>(out->size() / 3), &output));
  }

  /// Values of an attribute of the first mesh in the frame sought.
  void attribute(uint32_t number, uint32_t elements, std::vector<float>* out) const {
    anic_value_output output = ANIC_INIT(anic_value_output);
    output.data = out->data();
    output.size = out->size() * sizeof(float);
    check(anic_write_attribute(context_, 0, number, ANIC_WHEN_CURRENT, 0, elements, &output));
  }

 private:
  static void check(anic_status status) {
    if (status != ANIC_OK)
      throw Error(ErrorKind::kInternal, std::string("the encoded file cannot be played: ") +
                                            anic_get_status_text(status));
  }

  anic_asset* asset_ = nullptr;
  anic_context* context_ = nullptr;
  anic_asset_info info_ = ANIC_INIT(anic_asset_info);
};

/// For each vertex of the source, the played vertex that shows it.
std::vector<uint32_t> played_vertices(const PlayedFile& file, const MeshLayout& layout) {
  std::vector<uint32_t> played(layout.source_coded.size());
  if (file.info().order != ANIC_ORDER_FREE) {
    std::iota(played.begin(), played.end(), 0U);
    return played;
  }
  const uint32_t* coded = nullptr;
  anic_get_coded_vertices(file.asset(), 0, &coded);
  std::vector<uint32_t> played_of_coded(layout.sizes.coded_vertices);
  for (uint32_t v = 0; v < played.size(); ++v)
    played_of_coded[coded[v]] = v;
  for (uint32_t v = 0; v < played.size(); ++v)
    played[v] = played_of_coded[layout.source_coded[v]];
  return played;
}

/// Copies rows of three numbers: row rows[v] of `from` to row v.
void copy_rows(const float* from, const std::vector<uint32_t>& rows, std::vector<float>* to) {
  to->resize(3 * rows.size());
  for (size_t v = 0; v < rows.size(); ++v)
    std::copy_n(from + size_t{3} * rows[v], 3, to->data() + 3 * v);
}

/// Positions of the source and of the file, in the source's vertex order whatever the file's.
class BothPositions {
 public:
  BothPositions(PlayedFile* file, const EncoderInput& input)
      : file_(file),
        input_(input),
        played_of_(played_vertices(*file, input.layout)),
        played_(size_t{3} * input.sequence.vertex_count) {}

  /// Valid until the next call.
  std::span<const float> original(uint32_t frame) {
    copy_rows(input_.shown().frame(frame), input_.layout.source_coded, &original_);
    return original_;
  }

  std::span<const float> decoded(uint32_t frame) {
    file_->seek(frame);
    file_->positions(0, &played_);
    copy_rows(played_.data(), played_of_, &decoded_);
    return decoded_;
  }

 private:
  PlayedFile* file_;
  const EncoderInput& input_;
  std::vector<uint32_t> played_of_;
  std::vector<float> played_, original_, decoded_;
};

Comparison compare_positions(BothPositions* both, const EncoderInput& input, const FrameRun& run) {
  CompareOptions options;
  options.sted = false;
  return compare(
      input.sequence.polygons, input.sequence.vertex_count, run.count,
      [&](uint32_t f) { return both->original(run.first + f); },
      [&](uint32_t f) { return both->decoded(run.first + f); }, options);
}

/// Whether a clip without error has the bits of the source, too: zeros with their signs.
bool has_all_bits(BothPositions* both, const FrameRun& run) {
  for (uint32_t f = run.first; f < run.first + run.count; ++f) {
    const std::span<const float> original = both->original(f);
    if (std::memcmp(original.data(), both->decoded(f).data(), original.size_bytes()) != 0)
      return false;
  }
  return true;
}

/// Measures attributes that change over time in some frames.
std::vector<AttributeError> measure(PlayedFile* file, const EncoderInput& input,
                                    const FrameRun& run,
                                    const std::vector<const StoredAttribute*>& moving) {
  std::vector<AttributeError> errors(moving.size());
  std::vector<double> squared(moving.size());
  std::vector<float> played;
  const anic_order order = file->info().order;
  for (uint32_t f = run.first; f < run.first + run.count && !moving.empty(); ++f) {
    file->seek(f);
    for (size_t a = 0; a < moving.size(); ++a) {
      const StoredAttribute& stored = *moving[a];
      const Attribute& attribute = input.sequence.attributes[stored.source];
      const bool canonical =
          order == ANIC_ORDER_FREE || (order == ANIC_ORDER_VERTICES && !attribute.per_vertex());
      const size_t elements = stored.rows.size(), n = attribute.components;
      played.resize(elements * n);
      file->attribute(stored.number, static_cast<uint32_t>(elements), &played);
      const float* source = attribute.values.data() + size_t{f + input.first_frame} * elements * n;
      for (size_t e = 0; e < elements; ++e) {
        const float* values = source + (canonical ? stored.rows[e] : e) * n;
        for (size_t c = 0; c < n; ++c) {
          const double d = static_cast<double>(values[c]) - static_cast<double>(played[e * n + c]);
          squared[a] += d * d;
          errors[a].max_error = std::max(errors[a].max_error, std::abs(d));
        }
      }
    }
  }
  for (size_t a = 0; a < moving.size(); ++a) {
    const size_t values =
        moving[a]->rows.size() * input.sequence.attributes[moving[a]->source].components;
    errors[a].attribute = static_cast<uint16_t>(moving[a]->number);
    errors[a].rmse = std::sqrt(squared[a] / static_cast<double>(values) / run.count);
  }
  return errors;
}

/// A box around points, moved outwards by what decoders may differ by.
Box box_of(const std::vector<float>& points) {
  Box box;
  for (size_t c = 0; c < 3; ++c) {
    box.low[c] = box.high[c] = points[c];
    for (size_t i = c; i < points.size(); i += 3) {
      box.low[c] = std::min(box.low[c], points[i]);
      box.high[c] = std::max(box.high[c], points[i]);
    }
  }
  return box;
}

/// Boxes of the frames of a segment as it plays, with a margin for decoders that round in another way.
BoundsRecord bounds_of(PlayedFile* file, uint32_t number) {
  BoundsRecord bounds;
  anic_basis basis = ANIC_INIT(anic_basis);
  anic_get_basis(file->asset(), number, &basis);
  if (basis.target != ANIC_TARGET_POSITIONS)
    return bounds;
  constexpr float kMargin = 1.0F / (1 << 14);
  std::vector<float> played(size_t{3} * basis.vertex_count);
  Vector<Box> boxes;
  for (uint32_t f = basis.first_frame; f < basis.first_frame + basis.frame_count; ++f) {
    file->seek(f);
    file->positions(basis.mesh, &played);
    Box box = box_of(played);
    float size = 0;
    for (size_t c = 0; c < 3; ++c)
      size = std::max(
          {size, box.high[c] - box.low[c], std::abs(box.low[c]) / 16, std::abs(box.high[c]) / 16});
    for (size_t c = 0; c < 3; ++c) {
      box.low[c] -= size * kMargin;
      box.high[c] += size * kMargin;
    }
    boxes.push_back(box);
  }
  bounds.set(boxes, kFramesOfBox);
  return bounds;
}

}  // namespace

CheckedFile check_file(const Bytes& bytes, const EncoderInput& input,
                       const std::vector<StoredAttribute>& stored, bool is_lossless,
                       KeptLearning* learning, std::vector<AttributeResult>* attributes) {
  PlayedFile file(bytes, learning);
  file.check_hashes();
  std::vector<const StoredAttribute*> moving;
  for (const AttributeResult& result : *attributes)
    moving.push_back(&*std::ranges::find(stored, result.number, &StoredAttribute::number));
  CheckedFile checked;
  BothPositions both(&file, input);
  for (const InputClip& source : input.clips) {
    MeasuredClip& measured = checked.clips.emplace_back();
    measured.positions = compare_positions(&both, input, source.frames);
    if (is_lossless && !has_all_bits(&both, source.frames))
      throw Error(ErrorKind::kInternal, "the encoded file does not have the source's positions");
    const double share = static_cast<double>(source.frames.count) / file.info().frame_count;
    const std::vector<AttributeError> errors = measure(&file, input, source.frames, moving);
    for (size_t a = 0; a < errors.size(); ++a) {
      AttributeResult& result = (*attributes)[a];
      if (errors[a].max_error > result.asked)
        throw Error(ErrorKind::kInternal, result.name + ": the error is above what was asked for");
      result.max_error = std::max(result.max_error, errors[a].max_error);
      result.rmse = std::hypot(result.rmse, errors[a].rmse * std::sqrt(share));
      measured.attributes.push_back(errors[a]);
    }
  }
  for (uint32_t s = 0; s < file.info().segment_count; ++s)
    checked.bounds.push_back(bounds_of(&file, s));
  return checked;
}

void check_hashes(const Bytes& bytes) {
  PlayedFile(bytes, nullptr).check_hashes();
}

}  // namespace anicodec
