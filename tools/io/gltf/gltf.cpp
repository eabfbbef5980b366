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

/// The first animation that moves what is baked, else the first with a length, else the first with
/// keys, which has one frame.
uint32_t first_animation(const GltfDocument& document, const std::vector<bool>& nodes,
                         uint64_t memory_limit) {
  uint32_t longest = kGltfNone, any = kGltfNone;
  for (uint32_t i = 0; i < document.animations.size(); ++i) {
    if (document.animations[i].channels.empty())
      continue;
    const GltfClip clip(document, i, memory_limit);
    const bool has_length = clip.last_time() > clip.first_time();
    if (has_length && clip.moves(nodes))
      return i;
    if (has_length && longest == kGltfNone)
      longest = i;
    if (any == kGltfNone)
      any = i;
  }
  if (any == kGltfNone)
    fail_empty(document, 0);
  return longest != kGltfNone ? longest : any;
}

/// Tells of animations that move the same as one that is taken, and so are other takes of it.
void note_other_takes(const GltfDocument& document, const std::vector<uint32_t>& others,
                      const GltfOptions& options) {
  constexpr size_t kMostNames = 8;
  if (others.empty() || !options.note)
    return;
  std::vector<std::string> names;
  for (const uint32_t i : others) {
    if (names.size() < kMostNames)
      names.push_back(document.animations[i].name.empty() ? std::to_string(i)
                                                          : document.animations[i].name);
  }
  const size_t more = others.size() - names.size();
  options.note("other takes are left out: " + listed(names) +
               (more > 0 ? " and " + std::to_string(more) + " more" : "") +
               "; --clip chooses one, --clips all takes each as a clip");
}

/// The first animation that moves what is baked, and with it those that move something else.
std::vector<uint32_t> usual_animations(const GltfDocument& document, const std::vector<bool>& nodes,
                                       const GltfOptions& options) {
  std::vector<uint32_t> taken{first_animation(document, nodes, options.memory_limit)}, others;
  GltfClip together(document, taken[0], options.memory_limit);
  if (!together.moves(nodes))
    return taken;
  for (uint32_t i = 0; i < document.animations.size(); ++i) {
    if (i == taken[0] || document.animations[i].channels.empty())
      continue;
    GltfClip clip(document, i, options.memory_limit);
    if (clip.last_time() <= clip.first_time() || !clip.moves(nodes))
      continue;
    if (clip.contradicts(together, nodes)) {
      others.push_back(i);
    } else {
      taken.push_back(i);
      together.join(std::move(clip));
    }
  }
  note_other_takes(document, others, options);
  return taken;
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
  if (!options.note || options.scene_stays || document.left_out.empty())
    return;
  std::string text;
  for (const std::string& what : document.left_out)
    text += (text.empty() ? "" : ", ") + what;
  options.note("not kept: " + text + "; encode to a .glb keeps all of the scene");
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
  const GltfDocument document =
      parse_gltf_document(bytes, name, resolve, options.memory_limit, options.allow_outside);
  note_left_out(document, options);
  std::vector<uint32_t> animations;
  for (const std::string& wanted : names)
    animations.push_back(named_animation(document, wanted));
  const std::vector<bool> nodes = GltfBake(document, options).moving_nodes();
  for (uint32_t i = 0; names.empty() && i < document.animations.size(); ++i) {
    if (document.animations[i].channels.empty())
      continue;
    const GltfClip clip(document, i, options.memory_limit);
    if (clip.last_time() > clip.first_time() && clip.moves(nodes))
      animations.push_back(i);
  }
  if (animations.empty())
    throw Error(ErrorKind::kUsage, document.name + ": no animation moves anything");
  std::vector<MeshSequence> clips;
  for (uint32_t i : animations) {
    options.clip = std::to_string(i);
    clips.push_back(bake_gltf(document, options));
    clips.back().name = document.animations[i].name.empty() ? "clip " + std::to_string(i)
                                                            : document.animations[i].name;
  }
  return clips;
}

MeshSequence bake_gltf(const GltfDocument& document, const GltfOptions& options) {
  GltfBake bake(document, options);
  MeshSequence out = bake.still();
  if (options.clip == "none" || (options.clip.empty() && document.animations.empty())) {
    bake.add_frames(nullptr, 1, options, out);
    return out;
  }
  const std::vector<uint32_t> animations =
      options.clip.empty() ? usual_animations(document, bake.moving_nodes(), options)
                           : named_animations(document, options.clip);
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
  bake.add_frames(&clip, count_frames(document, animation, clip, out.rate, options), options, out);
  ClipTiming timing = clips_of(out)[0];
  for (NamedTime event : document.animations[animation].events) {
    event.seconds -= clip.first_time();
    try {
      add_event(event, &timing);
    } catch (const Error& e) {
      if (options.note)
        options.note(document.name + ": " + e.what() + ", and is left out");
    }
  }
  out.events = std::move(timing.events);
  return out;
}

}  // namespace anicodec::tools
