// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_LIVE_QUEUE_H_
#define ANICODEC_CODEC_LIVE_QUEUE_H_

#include "codec/encode_live.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace anicodec {

struct LiveOptions {
  double piece = 1;              ///< seconds of a file
  double key_every = kKeyEvery;  ///< see LiveEncoder
  /// The diagonal that percentages are of, scene units; 0: that of the first file's frames.
  double box = 0;
  /// Frames that may wait for being encoded, at least those of a file; 0: any number.
  uint64_t most_waiting = 0;
  size_t threads = 0;  ///< that encode; 0: all of the machine
};

/// A file of a stream, and its place.
struct QueuedPiece : LivePiece {
  uint64_t first_frame = 0;
  double start_time = 0;      ///< of its first frame, on the clock of the clip
  double encode_seconds = 0;  ///< that it took
};

/// How far a queue is.
struct LiveState {
  uint64_t pushed_frames = 0;
  uint64_t waiting_frames = 0;  ///< of these, frames of which no file is made yet
  /// Frames of these in full pieces that the encoder has not begun: 0 while it keeps up.
  uint64_t late_frames = 0;
  uint64_t waiting_pieces = 0;  ///< files made, and not taken
  double encode_seconds = 0;    ///< that the last file took
  bool ended = false;           ///< end() was called, and all files are taken
};

/// Frames in, files of a live stream out: a thread of its own encodes. One thread may push while another takes.
class LiveQueue {
 public:
  /// As LiveEncoder.
  LiveQueue(MeshSequence mesh, const EncodeOptions& options, const LiveOptions& live);

  /// Lets go of what was not taken.
  ~LiveQueue();

  LiveQueue(const LiveQueue&) = delete;
  LiveQueue& operator=(const LiveQueue&) = delete;

  /// Copies a frame: vertices x 3 floats, and elements x components of each attribute that moves. Waits so many seconds at
  /// most for room; false where there is none. Throws Error(kInput) for sizes that do not fit and numbers that are not finite, which changes nothing; Error(kUsage)
  /// behind end(); what ended the encoding.
  bool push(std::span<const float> positions, std::span<const std::span<const float>> values = {},
            double wait = 0);

  /// No frame follows: the last file gets those that are there.
  void end();

  /// The next file, once it is made; waits so many seconds at most. Nothing: there is none, or all are taken. Throws what ended
  /// the encoding, once all before it are taken: an Error names the first frame.
  std::optional<QueuedPiece> take(double wait = 0);

  /// Ends the encoding of what is there, and whoever waits; push() and take() throw from now on.
  void stop();

  LiveState state() const;

  uint32_t frames_of_piece() const { return frames_of_piece_; }

  /// All but the frames.
  const MeshSequence& mesh() const { return mesh_; }

 private:
  /// Frames of a file.
  struct Frames {
    uint64_t first = 0;
    uint32_t count = 0;
    FrameArray positions;
    std::vector<FrameArray> values;
  };

  template <class Condition>
  bool wait_for(std::unique_lock<std::mutex>& lock, double seconds, const Condition& condition);
  void check_frame(std::span<const float> positions,
                   std::span<const std::span<const float>> values) const;
  void add_frame(std::span<const float> positions, std::span<const std::span<const float>> values);
  void close_piece();
  void run();
  QueuedPiece encode(Frames frames);

  MeshSequence mesh_;
  std::vector<size_t> moving_;  ///< numbers that a frame has of each attribute that moves
  LiveEncoder encoder_;
  LiveOptions live_;
  uint32_t frames_of_piece_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Frames open_;              ///< grows
  std::deque<Frames> full_;  ///< wait for the encoder
  std::deque<QueuedPiece> pieces_;
  LiveState state_;
  bool no_more_ = false, stopped_ = false, encoding_ = false;
  std::exception_ptr fault_;
  std::thread worker_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_LIVE_QUEUE_H_
