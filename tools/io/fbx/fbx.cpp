// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/fbx/fbx.h"

#include "codec/sequence/error.h"
#include "tools/io/base/file_format.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"
#include "tools/io/gltf/gltf_format.h"

#ifdef ANICODEC_UFBX
#include "tools/io/fbx/fbx_message.h"
#include "tools/io/fbx/fbx_scene.h"
#include "tools/io/fbx/fbx_take.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/guard/guarded_call.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <set>
#include <span>
#include <utility>
#endif

namespace anicodec::tools {

#ifdef ANICODEC_UFBX
namespace {

/// A take of a file, in the child.
struct Stack {
  std::string name;
  const ufbx_anim* anim;
};

class FbxReader {
 public:
  FbxReader(const std::string& path, const GltfOptions& options)
      : options_(options),
        note_([this](const std::string& text) {
          if (told_.insert(text).second)
            message_.note(text);
        }),
        scene_(path, options, note_) {
    const ufbx_anim_stack_list& list = scene_.scene().anim_stacks;
    for (size_t i = 0; i < list.count; ++i) {
      const std::string name = text_of(list.data[i]->name);
      stacks_.push_back({name.empty() ? "clip " + std::to_string(i) : name, list.data[i]->anim});
    }
  }

  /// One take: that of options.clip, else the first that moves something.
  std::string read_one() {
    if (options_.clip == "none" ||
        (options_.clip.empty() && stacks_.empty() && !scene_.has_caches())) {
      bake("", nullptr);
    } else if (!options_.clip.empty()) {
      const UfbxAnim anim = named(options_.clip);
      bake(stacks_.size() > 1 ? options_.clip : "", anim.get());
    } else if (!bake_first_that_moves()) {
      bake("", stacks_.empty() ? nullptr : stacks_[0].anim);
      message_.keep_first_frame();
    }
    return message_.finish();
  }

  /// The takes that are named, or all that move anything; with no name and nothing that moves, one frame.
  std::string read_clips(const std::vector<std::string>& names) {
    if (!names.empty() && names != std::vector<std::string>{"all"}) {
      std::vector<UfbxAnim> anims;
      std::deque<FbxTake> takes;
      for (const std::string& name : names) {
        anims.push_back(named(name));
        takes.emplace_back(scene_, anims.back().get(), options_, note_);
      }
      const std::vector<FbxTake::Facings> facings = facings_of(takes);
      for (size_t i = 0; i < names.size(); ++i)
        takes[i].bake(unlike_others(names[i]), facings, message_);
      return message_.finish();
    }
    std::vector<std::string> still;
    std::deque<FbxTake> takes;  // of stacks that may move
    for (const Stack& stack : stacks_) {
      if (may_move(scene_, *stack.anim))
        takes.emplace_back(scene_, stack.anim, options_, note_);
    }
    const std::vector<FbxTake::Facings> facings = facings_of(takes);
    size_t moving = 0, next = 0;
    for (const Stack& stack : stacks_) {
      bool moves = may_move(scene_, *stack.anim);
      if (moves) {
        takes[next++].bake(unlike_others(stack.name), facings, message_);
        moves = !message_.stands_still();
        if (!moves)
          message_.drop_clip();
      }
      moving += moves ? 1 : 0;
      if (!moves)
        still.push_back(stack.name);
    }
    if (moving == 0) {
      if (!names.empty())
        fail_usage(scene_.path(), "no take moves anything");
      return read_one();
    }
    if (!still.empty())
      note_("left out, as they move no vertex: " + listed(still));
    return message_.finish();
  }

 private:
  static std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
      text += (text.empty() ? "'" : ", '") + printable(name) + "'";
    return text.empty() ? "none" : text;
  }

  void bake(const std::string& name, const ufbx_anim* anim) {
    std::deque<FbxTake> take;
    take.emplace_back(scene_, anim, options_, note_);
    take[0].bake(name, facings_of(take), message_);
  }

  /// Takes become clips of one mesh: a surface is in it if any take shows it.
  static std::vector<FbxTake::Facings> facings_of(const std::deque<FbxTake>& takes) {
    std::vector<FbxTake::Facings> facings;
    for (const FbxTake& take : takes)
      take.add_facings(&facings);
    return facings;
  }

  bool bake_first_that_moves() {
    std::vector<std::string> others;
    bool found = false;
    if (stacks_.empty())
      stacks_.push_back({"", scene_.scene().anim});
    for (const Stack& stack : stacks_) {
      if (!may_move(scene_, *stack.anim))
        continue;
      if (found) {
        others.push_back(stack.name);
        continue;
      }
      bake(stacks_.size() > 1 ? stack.name : "", stack.anim);
      found = !message_.stands_still();
      if (!found)
        message_.drop_clip();
    }
    if (!others.empty())
      note_("other takes are left out: " + listed(others) +
            "; --clip chooses one, encode takes all as clips");
    return found;
  }

  const Stack* find(const std::string& name) const {
    for (const Stack& stack : stacks_) {
      if (stack.name == name)
        return &stack;
    }
    size_t number = 0;
    const auto [last, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    const bool known =
        error == std::errc() && last == name.data() + name.size() && number < stacks_.size();
    return known ? &stacks_[number] : nullptr;
  }

  /// The take of a name or number, or several with a plus between them, played together: what several move
  /// moves as in the last.
  UfbxAnim named(const std::string& clips) const {
    std::vector<const Stack*> found{find(clips)};
    if (found[0] == nullptr) {
      found.clear();
      for (size_t at = 0; at <= clips.size();) {
        const size_t end = std::min(clips.find('+', at), clips.size());
        found.push_back(find(clips.substr(at, end - at)));
        at = end + 1;
      }
    }
    std::vector<uint32_t> layers;
    double begin = 0, end = 0;
    for (const Stack* stack : found) {
      if (stack == nullptr) {
        std::vector<std::string> names;
        for (const Stack& known : stacks_)
          names.push_back(known.name);
        fail_usage(scene_.path(),
                   "there is no clip '" + printable(clips) + "'; the clips are: " + listed(names));
      }
      for (ufbx_anim_layer* layer :
           std::span(stack->anim->layers.data, stack->anim->layers.count)) {
        if (layer ==
            stack->anim->layers.data[0])  // the ground of its take, to which others are added
          layer->blended = layer->additive = false;
        layers.push_back(layer->typed_id);
      }
      begin = layers.empty() || stack == found[0] ? stack->anim->time_begin
                                                  : std::min(begin, stack->anim->time_begin);
      end = stack == found[0] ? stack->anim->time_end : std::max(end, stack->anim->time_end);
    }
    ufbx_anim_opts options = {};
    options.layer_ids = {layers.data(), layers.size()};
    ufbx_error error;
    UfbxAnim anim(ufbx_create_anim(&scene_.scene(), &options, &error));
    if (!anim)
      fail_fbx(scene_.path(), error);
    anim->time_begin = begin;
    anim->time_end = end;
    return anim;
  }

  std::string unlike_others(const std::string& name) {
    std::string text = name;
    for (int number = 2; !names_.insert(text).second; ++number)
      text = name + " " + std::to_string(number);
    return text;
  }

  const GltfOptions& options_;
  std::set<std::string> told_;
  FbxMessage message_;
  FbxNote note_;
  FbxScene scene_;
  std::vector<Stack> stacks_;
  std::set<std::string> names_;
};

template <typename Read>
std::vector<MeshSequence> read_guarded(const std::string& path, const GltfOptions& options,
                                       const Read& read) {
  // Few frames of many vertices take that long, as many frames of few do.
  constexpr uint32_t kSeconds = 1800;
  GuardLimits limits = GuardLimits::for_input(file_source(path).size, options.memory_limit);
  limits.seconds = std::max(limits.seconds, kSeconds);
  const std::string bytes = run_guarded(path, limits, [&] {
    FbxReader reader(path, options);
    return read(reader);
  });
  FbxResult result = read_fbx_message(bytes, path);
  for (const std::string& note : result.notes) {
    if (options.note)
      options.note(note);
  }
  if (result.clips.empty())
    fail_input(path, "holds no clip");
  return std::move(result.clips);
}

}  // namespace

bool reads_fbx() {
  return true;
}

MeshSequence load_fbx(const std::string& path, const GltfOptions& options) {
  return std::move(
      read_guarded(path, options, [](FbxReader& reader) { return reader.read_one(); })[0]);
}

std::vector<MeshSequence> load_fbx_clips(const std::string& path, const GltfOptions& options,
                                         const std::vector<std::string>& names) {
  return read_guarded(path, options, [&](FbxReader& reader) { return reader.read_clips(names); });
}

#else

bool reads_fbx() {
  return false;
}

MeshSequence load_fbx(const std::string& path, const GltfOptions&) {
  throw Error(
      ErrorKind::kUnsupported,
      path + ": this build is without ufbx, which reads FBX; export the clip as glTF or Alembic");
}

std::vector<MeshSequence> load_fbx_clips(const std::string& path, const GltfOptions& options,
                                         const std::vector<std::string>&) {
  return {load_fbx(path, options)};
}

#endif

const FileFormat kFbx = {.name = "FBX",
                         .extensions = ".fbx",
                         .role = FileRole::kScene,
                         .read_clip = [](const InputFile& file, const LoadOptions& options) {
                           const GltfOptions scene = gltf_options(options);
                           return load_animations(
                               options, [&] { return load_fbx(file.name, scene); },
                               [&] { return load_fbx_clips(file.name, scene, options.clips); });
                         }};

}  // namespace anicodec::tools
