// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The functions of encode.h for live streams.
#include "codec/api/encoder_objects.h"
#include "codec/api/guarded.h"
#include "codec/live_queue.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

struct anic_live {
  anicodec::LiveQueue queue;
  anicodec::Bytes file;  ///< that was taken last
  /// A frame as floats from the origin of the clip: of the thread that pushes.
  std::vector<float> positions;
};

namespace anicodec {
namespace {

/// The fault of this thread's last call: two threads may work with one stream.
std::string& live_text() {
  thread_local std::string text;
  return text;
}

double seconds_of(double value, double standard, const char* text) {
  check_argument(std::isfinite(value) && value >= 0, text);
  return value == 0 ? standard : value;
}

LiveOptions live_options(const anic_live_options& host, uint32_t threads) {
  LiveOptions live;
  live.piece = seconds_of(host.piece_seconds, live.piece,
                          "the seconds of a piece are finite and not negative");
  if (host.key_seconds != 0) {
    check_argument(!std::isnan(host.key_seconds), "the seconds between keys are a number");
    live.key_every = std::max(host.key_seconds, 0.0);
  }
  live.box = host.box;
  live.most_waiting = host.most_waiting_frames;
  live.threads = threads;
  return live;
}

std::unique_ptr<anic_live> begun(const anic_encoder& encoder, const anic_encode_options& host,
                                 const anic_live_options& live) {
  if (encoder.clip.frame_count > 0)
    throw EncoderFailure(ANIC_E_STATE, "the clip has frames: a live one has a frame_count of 0");
  if (encoder.meshes.size() != 1)
    throw EncoderFailure(ANIC_E_STATE, "a live stream has one mesh");
  check_argument(!host.progress.report && !host.writer.write,
                 "a live stream has no progress and no writer");
  constexpr uint32_t kMostThreads = 1024;
  check_argument(host.threads <= kMostThreads, "at most 1024 threads are possible");
  const EncodeOptions options = options_of(host);
  MeshSequence mesh = encoder.meshes[0].mesh.sequence;
  set_timing(encoder.clip, &mesh);
  const size_t floats = size_t{3} * mesh.vertex_count;
  return std::unique_ptr<anic_live>(
      new anic_live{{std::move(mesh), options, live_options(live, host.threads)},
                    {},
                    std::vector<float>(floats)});
}

/// Pushes a frame; false where there is no room.
bool push(anic_live* live, const anic_live_frame& frame, double wait) {
  const MeshSequence& mesh = live->queue.mesh();
  check_argument(frame.positions, "a frame has no positions");
  check_argument(frame.scalar == ANIC_SCALAR_FLOAT32 || frame.scalar == ANIC_SCALAR_FLOAT64,
                 "positions are float32 or float64");
  check_argument(frame.value_count == 0 || frame.values, "the values of attributes are missing");
  const size_t scalar = frame.scalar == ANIC_SCALAR_FLOAT64 ? sizeof(double) : sizeof(float);
  const ptrdiff_t stride =
      frame.vertex_stride != 0 ? frame.vertex_stride : static_cast<ptrdiff_t>(3 * scalar);
  copy_positions(frame.positions, stride, frame.scalar, mesh.origin, live->positions);
  std::vector<std::span<const float>> values;
  for (const Attribute& attribute : mesh.attributes) {
    if (attribute.frames > 0)
      continue;
    check_argument(values.size() < frame.value_count && frame.values[values.size()],
                   "a frame has no values of an attribute that moves");
    values.emplace_back(frame.values[values.size()],
                        element_count(mesh, attribute.domain) * attribute.components);
  }
  check_argument(values.size() == frame.value_count,
                 "a frame has values of more attributes than move");
  return live->queue.push(live->positions, values, wait);
}

void give_piece(QueuedPiece piece, anic_live* live, anic_live_piece* out) {
  live->file = std::move(piece.file);
  out->file = live->file.data();
  out->size = live->file.size();
  out->first_frame = piece.first_frame;
  out->frame_count = piece.frames;
  out->start_time = piece.start_time;
  out->encode_seconds = piece.encode_seconds;
  out->max_error = piece.max_error;
  out->rmse = piece.rmse;
  out->kg = piece.kg;
  out->key = piece.is_key;
  out->has_mesh = piece.has_mesh;
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

anic_status anic_begin_live(anic_encoder* encoder, const anic_encode_options* options,
                            const anic_live_options* live, anic_live** out) {
  if (!encoder || !out)
    return ANIC_E_ARGUMENT;
  *out = nullptr;
  return guarded(&encoder->text, [&] {
    *out = begun(*encoder, taken(options, "anic_encode_options"), taken(live, "anic_live_options"))
               .release();
  });
}

void anic_destroy_live(anic_live* live) {
  delete live;
}

const char* anic_get_live_text(void) {
  return live_text().c_str();
}

anic_status anic_push_live_frame(anic_live* live, const anic_live_frame* frame, double wait) {
  if (!live)
    return ANIC_E_ARGUMENT;
  return guarded(&live_text(), [&] {
    check_argument(frame, "there is no frame");
    if (!push(live, taken(frame, "anic_live_frame"), wait))
      throw EncoderFailure(ANIC_E_LIMIT, "as many frames wait as may: the encoder is behind");
  });
}

anic_status anic_end_live(anic_live* live) {
  if (!live)
    return ANIC_E_ARGUMENT;
  return guarded(&live_text(), [&] { live->queue.end(); });
}

anic_status anic_take_live_piece(anic_live* live, double wait, anic_live_piece* out) {
  if (!live || !is_sized(out))
    return ANIC_E_ARGUMENT;
  anic_live_piece ours = ANIC_INIT(anic_live_piece);
  const anic_status status = guarded(&live_text(), [&] {
    std::optional<QueuedPiece> piece = live->queue.take(wait);
    if (!piece)
      throw EncoderFailure(ANIC_E_ABSENT, "no piece is ready");
    give_piece(*std::move(piece), live, &ours);
  });
  give(ours, out);
  return status;
}

anic_status anic_get_live_info(const anic_live* live, anic_live_info* out) {
  if (!live || !is_sized(out))
    return ANIC_E_ARGUMENT;
  const LiveState state = live->queue.state();
  anic_live_info ours = ANIC_INIT(anic_live_info);
  ours.pushed_frames = state.pushed_frames;
  ours.waiting_frames = state.waiting_frames;
  ours.late_frames = state.late_frames;
  ours.waiting_pieces = state.waiting_pieces;
  ours.encode_seconds = state.encode_seconds;
  ours.piece_frames = live->queue.frames_of_piece();
  ours.ended = state.ended;
  give(ours, out);
  return ANIC_OK;
}
