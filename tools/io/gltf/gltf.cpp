// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf.h"

#include "codec/sequence/error.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/gltf/gltf_animation.h"
#include "tools/io/gltf/gltf_bake.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace anicodec::tools {
namespace {

constexpr double kLeastRate = 30, kMostRate = 240;  // of keys on no grid

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + ("'" + shown(name) + "'");
  return text.empty() ? "none" : text;
}

std::string animation_path(uint32_t animation) {
  return "/animations/" + std::to_string(animation);
}

/// The animation of a name, else of a number.
std::optional<uint32_t> find_animation(const GltfDocument& document, std::string_view clip) {
  for (uint32_t i = 0; i < document.animations.size(); ++i) {
    if (document.animations[i].name == clip)
      return i;
  }
  uint32_t number = 0;
  const auto [last, error] = std::from_chars(clip.data(), clip.data() + clip.size(), number);
  const bool known = error == std::errc() && last == clip.data() + clip.size() &&
                     number < document.animations.size();
  return known ? std::optional(number) : std::nullopt;
}

[[noreturn]] void fail_unknown(const GltfDocument& document, std::string_view clip) {
  std::vector<std::string> names;
  for (const GltfAnimation& animation : document.animations)
    names.push_back(animation.name);
  throw Error(ErrorKind::kUsage, document.name + ": there is no clip '" + shown(std::string(clip)) +
                                     "'; the clips are: " + listed(names));
}

uint32_t named_animation(const GltfDocument& document, std::string_view clip) {
  const std::optional<uint32_t> one = find_animation(document, clip);
  if (!one)
    fail_unknown(document, clip);
  return *one;
}

/// The animation of a name or number, or several with a plus between them.
std::vector<uint32_t> named_animations(const GltfDocument& document, std::string_view clips) {
  if (const std::optional<uint32_t> one = find_animation(document, clips))
    return {*one};
  std::vector<uint32_t> found;
  for (std::string_view rest = clips; !rest.empty();) {
    const size_t end = rest.find('+');
    found.push_back(named_animation(document, rest.substr(0, end)));
    rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
  }
  return found;
}

[[noreturn]] void fail_empty(const GltfDocument& document, uint32_t animation) {
  fail_gltf(document, animation_path(animation),
            "the animation has no channel that moves a vertex, and so no keys; --clip none takes "
            "the pose without");
}

/// The first animation with a length, else the first with keys, which has one frame.
uint32_t first_animation(const GltfDocument& document, uint64_t memory_limit) {
  uint32_t any = kGltfNone;
  for (uint32_t i = 0; i < document.animations.size(); ++i) {
    if (document.animations[i].channels.empty())
      continue;
    const GltfClip clip(document, i, memory_limit);
    if (clip.last_time() > clip.first_time())
      return i;
    if (any == kGltfNone)
      any = i;
  }
  if (any == kGltfNone)
    fail_empty(document, 0);
  return any;
}

std::string name_of_animation(const GltfDocument& document, uint32_t animation) {
  const std::string& name = document.animations[animation].name;
  return name.empty() ? "clip " + std::to_string(animation) : name;
}

std::string listed(const GltfDocument& document, const std::vector<uint32_t>& animations) {
  constexpr size_t kMostNames = 8;
  std::vector<std::string> names;
  for (size_t i = 0; i < std::min(kMostNames, animations.size()); ++i)
    names.push_back(name_of_animation(document, animations[i]));
  const size_t more = animations.size() - names.size();
  return listed(names) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

/// Animations, each played together with those that move something else.
class Takes {
 public:
  Takes(const GltfDocument& document, const std::vector<bool>& nodes, uint64_t memory_limit) {
    for (uint32_t i = 0; i < document.animations.size(); ++i) {
      const GltfAnimation& animation = document.animations[i];
      if (animation.channels.empty())
        continue;
      const GltfClip clip(document, i, memory_limit);
      if (clip.last_time() <= clip.first_time())
        continue;
      if (!clip.moves(nodes)) {
        still_.push_back(i);
        continue;
      }
      Moved moved{i, {}};
      for (const GltfChannel& channel : animation.channels) {
        if (nodes[channel.node])
          moved.tracks.emplace(channel.node, channel.path, channel.element);
      }
      moving_.push_back(std::move(moved));
    }
    std::vector<bool> taken(moving_.size());
    for (size_t first = 0; first < moving_.size(); ++first) {
      if (!taken[first])
        add(first, taken);
    }
    if (takes_.empty())
      takes_.push_back({first_animation(document, memory_limit)});
  }

  /// Sets of animations, the first in the order of the file; at least one set.
  const std::vector<std::vector<uint32_t>>& sets() const { return takes_; }

  /// Animations with a length that move no vertex.
  const std::vector<uint32_t>& still() const { return still_; }

  /// The animations that move a vertex, in the order of the file.
  std::vector<uint32_t> moving() const {
    std::vector<uint32_t> animations;
    for (const Moved& moved : moving_)
      animations.push_back(moved.animation);
    return animations;
  }

 private:
  using Track = std::tuple<uint32_t, GltfPath, uint32_t>;  ///< node, path, element

  struct Moved {
    uint32_t animation;
    std::set<Track> tracks;
  };

  /// Adds the set that begins with an animation: others that fit are those in no set yet, then the rest.
  void add(size_t first, std::vector<bool>& taken) {
    std::vector<size_t> set{first};
    std::set<Track> tracks = moving_[first].tracks;
    for (const bool again : {false, true}) {
      for (size_t i = 0; i < moving_.size(); ++i) {
        const auto& own = moving_[i].tracks;
        if (i == first || taken[i] != again ||
            std::ranges::any_of(own, [&](const auto& track) { return tracks.contains(track); }))
          continue;
        set.push_back(i);
        tracks.insert(own.begin(), own.end());
      }
    }
    std::vector<uint32_t>& take = takes_.emplace_back();
    for (const size_t i : set) {
      taken[i] = true;
      take.push_back(moving_[i].animation);
    }
  }

  std::vector<Moved> moving_;
  std::vector<uint32_t> still_;
  std::vector<std::vector<uint32_t>> takes_;
};

/// The first animation that moves what is baked, and with it those that move something else.
std::vector<uint32_t> usual_animations(const GltfDocument& document, const std::vector<bool>& nodes,
                                       const GltfOptions& options) {
  const Takes takes(document, nodes, options.memory_limit);
  const std::vector<uint32_t>& usual = takes.sets()[0];
  std::vector<uint32_t> others = takes.moving();
  std::erase_if(others, [&](uint32_t i) { return std::ranges::find(usual, i) != usual.end(); });
  if (!others.empty() && options.note)
    options.note("other takes are left out: " + listed(document, others) +
                 "; --clip chooses one, encode takes all as clips");
  return usual;
}

FrameRate default_rate(const GltfAnimation& animation, const GltfClip& clip,
                       const GltfOptions& options) {
  if (!animation.rate.empty()) {
    try {
      return parse_frame_rate(animation.rate);
    } catch (const Error&) {
      // Not what anicodec writes.
    }
  }
  const double length = clip.last_time() - clip.first_time();
  if (length == 0)
    return {};
  if (const std::optional<FrameRate> grid = clip.key_grid())
    return *grid;
  const FrameRate rate =
      covering_rate(length, std::clamp(std::round(clip.key_density()), kLeastRate, kMostRate));
  if (options.note)
    options.note("the keys stand on no common frames: sampled at " + std::to_string(rate.value()) +
                 " frames per second, a whole number of them");
  return rate;
}

uint32_t count_frames(const GltfDocument& document, uint32_t animation, const GltfClip& clip,
                      const FrameRate& rate, const GltfOptions& options) {
  constexpr double kRounding = 1e-3;  // of a frame: times are floats
  const double length = (clip.last_time() - clip.first_time()) * rate.value();
  const double frames = std::floor(length + kRounding) + 1;
  if (frames > static_cast<double>(kMaxFrames))
    fail_gltf(document, animation_path(animation),
              "from " + std::to_string(clip.first_time()) + " to " +
                  std::to_string(clip.last_time()) + " s there are more than 2^24 - 1 frames");
  if (length - (frames - 1) > kRounding && options.note)
    options.note("the last " + std::to_string((length - (frames - 1)) / rate.value()) +
                 " s of the animation lie behind the last frame");
  return static_cast<uint32_t>(frames);
}

/// Names what a file does not keep, in one line.
void note_left_out(const GltfDocument& document, const GltfOptions& options) {
  const std::string text = document.left_out.text();
  if (options.note && !options.scene_stays && !text.empty())
    options.note("not kept: " + text + "; encode to a .glb keeps all of the scene");
}

/// Tells what the parts of a scene tell of themselves once, whatever the number of clips.
std::function<void(const std::string&)> told_once(std::function<void(const std::string&)> note) {
  if (!note)
    return note;
  return [note = std::move(note), told = std::set<std::string>()](const std::string& text) mutable {
    if (told.insert(text).second)
      note(text);
  };
}

/// Adds the events of an animation to a clip that begins at `first_time`.
void add_events(const GltfDocument& document, const GltfAnimation& animation, double first_time,
                const GltfOptions& options, ClipTiming* timing) {
  for (NamedTime event : animation.events) {
    event.seconds -= first_time;
    try {
      add_event(event, timing);
    } catch (const Error& e) {
      if (options.note)
        options.note(document.name + ": " + e.what() + ", and is left out");
    }
  }
}

/// Times of frames that are not all those of a clock.
void set_times(const std::vector<uint32_t>& ticks, uint32_t all, const GltfOptions& options,
               MeshSequence& out) {
  std::vector<double> times;
  for (const uint32_t tick : ticks)
    times.push_back(out.start_time + tick / out.rate.value());
  if (options.note)
    options.note("keys are far apart: " + std::to_string(ticks.size()) +
                 " frames where the motion changes, instead of " + std::to_string(all) +
                 "; --fps takes them by the clock");
  Timing timing = timing_of(times, 0, options.mesh);
  out.rate = timing.rate;
  out.times = std::move(timing.times);
}

/// Some animations played together; of none the pose that the nodes have.
MeshSequence bake_animations(const GltfDocument& document, const GltfOptions& options,
                             const std::vector<uint32_t>& animations) {
  GltfBake bake(document, options);
  MeshSequence out = bake.still();
  if (animations.empty()) {
    bake.add_frames(nullptr, {{0}}, options, out);
    return out;
  }
  const uint32_t animation = animations[0];
  if (document.animations[animation].channels.empty())
    fail_empty(document, animation);
  GltfClip clip(document, animation, options.memory_limit);
  for (size_t i = 1; i < animations.size(); ++i)
    clip.join(GltfClip(document, animations[i], options.memory_limit));
  out.rate =
      options.rate ? *options.rate : default_rate(document.animations[animation], clip, options);
  out.start_time = clip.first_time();
  if (animations.size() < document.animations.size())
    out.name = document.animations[animation].name;
  const uint32_t frames = count_frames(document, animation, clip, out.rate, options);
  std::vector<uint32_t> ticks;
  if (options.rate || !document.animations[animation].rate.empty()) {
    ticks.resize(frames);
    std::iota(ticks.begin(), ticks.end(), 0U);
  } else {
    ticks = bake.needed_ticks(clip, frames, out.rate.value());
  }
  bake.add_frames(&clip, ticks, options, out);
  if (ticks.size() < frames)
    set_times(ticks, frames, options, out);
  ClipTiming timing = clips_of(out)[0];
  for (const uint32_t a : animations)
    add_events(document, document.animations[a], clip.first_time(), options, &timing);
  out.events = std::move(timing.events);
  return out;
}

/// A name that none of the clips has.
std::string unlike(const std::vector<MeshSequence>& clips, const std::string& name) {
  const auto is_taken = [&](const std::string& text) {
    return std::ranges::any_of(clips, [&](const MeshSequence& clip) { return clip.name == text; });
  };
  std::string text = name;
  for (int number = 2; is_taken(text); ++number)
    text = name + " " + std::to_string(number);
  return text;
}

/// The sets of animations that are clips: each of those named, all that move anything each by itself,
/// or of no name the takes.
std::vector<std::vector<uint32_t>> sets_of(const GltfDocument& document, const GltfOptions& options,
                                           const std::vector<std::string>& names) {
  std::vector<std::vector<uint32_t>> sets;
  if (!names.empty() && names != std::vector<std::string>{"all"}) {
    for (const std::string& wanted : names)
      sets.push_back({named_animation(document, wanted)});
    return sets;
  }
  if (document.animations.empty())
    return names.empty() ? std::vector<std::vector<uint32_t>>{{}} : sets;
  const Takes takes(document, GltfBake(document, options).moving_nodes(), options.memory_limit);
  if (!takes.still().empty() && options.note)
    options.note("left out, as they move no vertex: " + listed(document, takes.still()));
  if (names.empty())
    return takes.sets();
  for (const uint32_t animation : takes.moving())
    sets.push_back({animation});
  return sets;
}

}  // namespace

MeshSequence parse_gltf(std::string_view bytes, std::string_view name, const GltfResolver& resolve,
                        const GltfOptions& options) {
  const GltfDocument document =
      parse_gltf_document(bytes, name, resolve, options.memory_limit, options.allow_outside);
  note_left_out(document, options);
  return bake_gltf(document, options);
}

std::vector<MeshSequence> parse_gltf_clips(std::string_view bytes, std::string_view name,
                                           const GltfResolver& resolve, GltfOptions options,
                                           const std::vector<std::string>& names) {
  options.note = told_once(options.note);
  const GltfDocument document =
      parse_gltf_document(bytes, name, resolve, options.memory_limit, options.allow_outside);
  note_left_out(document, options);
  const std::vector<std::vector<uint32_t>> sets = sets_of(document, options, names);
  if (sets.empty())
    throw Error(ErrorKind::kUsage, document.name + ": no animation moves anything");
  std::vector<MeshSequence> clips;
  for (const std::vector<uint32_t>& set : sets) {
    MeshSequence clip = bake_animations(document, options, set);
    if (sets.size() > 1 || !names.empty())
      clip.name = unlike(clips, name_of_animation(document, set[0]));
    options.memory_limit -=
        std::min(options.memory_limit, uint64_t{clip.positions.size()} * sizeof(float));
    clips.push_back(std::move(clip));
  }
  return clips;
}

MeshSequence bake_gltf(const GltfDocument& document, const GltfOptions& options) {
  if (options.clip == "none" || (options.clip.empty() && document.animations.empty()))
    return bake_animations(document, options, {});
  return bake_animations(
      document, options,
      options.clip.empty()
          ? usual_animations(document, GltfBake(document, options).moving_nodes(), options)
          : named_animations(document, options.clip));
}

}  // namespace anicodec::tools
