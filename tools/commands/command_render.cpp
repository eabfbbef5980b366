// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "codec/sequence/machine_memory.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/compared_clip.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/files/name_pattern.h"
#include "tools/io/files/output_folder.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/render/image.h"
#include "tools/render/shaded_view.h"
#include "tools/render/video.h"
#include "tools/render/viewer_page.h"
#include "tools/words/names.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"
#include "tools/words/word_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kRenderFooter =
    R"(CLIP and --against are each an .anic file, a quoted pattern of frames ('frames/*.obj'), a scene
(.gltf, .glb), whose first animation is baked, or a vertex cache (.pc2, .mdd) with its mesh of the
same stem beside it or the one of --mesh. OUT is a picture per frame (frame_%04d.png), one picture
of one frame (x.png), or all frames in one file (clip.gif; clip.mp4 by the ffmpeg command, if there
is one). clip.html is one page with the clip and a player inside, which any browser shows without a
network: CLIP is an .anic file then, and so is --against, which stands beside it.

Views stand side by side in the order of --view: clip, original, and error, which colours each
vertex by its distance from the original, from grey (none) over yellow and red to black (the largest
of the frames drawn, or --error-range). Without --against the view is clip, with it
original,clip,error.

Examples:
  anicodec render dance.anic -o dance.gif --frames 0:200:4
  anicodec render dance.anic --against dance.pc2 -o frame_%04d.png --frames 0:10
  anicodec render face.anic -o face.png --frames 20 --camera 0,10 --resolution 800x800
  anicodec render dance.anic -o dance.html)";

enum class View : uint8_t { kClip, kOriginal, kError };

struct RenderCommand {
  std::string input, against, clip, mesh, output, frames, views, resolution = "480x480", camera,
                                                                 error_range;
  UpAxis up = UpAxis::kUnknown;
  bool turntable = false;
};

/// Two numbers with a sign between them, as 480x270 or 30,15.
bool parse_pair(std::string_view text, char between, double* a, double* b) {
  const size_t at = text.find(between);
  if (at == std::string_view::npos)
    return false;
  auto number = [](std::string_view part, double* out) {
    auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), *out);
    return error == std::errc() && end == part.data() + part.size() && std::isfinite(*out);
  };
  return number(text.substr(0, at), a) && number(text.substr(at + 1), b);
}

std::vector<View> parse_views(const RenderCommand& command) {
  std::string text = command.views;
  if (text.empty())
    text = command.against.empty() ? "clip" : "original,clip,error";
  std::vector<View> views;
  for (const std::string& name : split_at_commas(text)) {
    if (name == "clip")
      views.push_back(View::kClip);
    else if (name == "original")
      views.push_back(View::kOriginal);
    else if (name == "error")
      views.push_back(View::kError);
    else
      throw Error(ErrorKind::kUsage, "--view: clip, original or error, separated by commas");
    if (views.back() != View::kClip && command.against.empty())
      throw Error(ErrorKind::kUsage, "--view " + name + " needs --against");
  }
  return views;
}

/// Distance of each vertex from the original.
std::vector<float> distances(std::span<const float> a, std::span<const float> b) {
  std::vector<float> out(a.size() / 3);
  for (size_t v = 0; v < out.size(); ++v)
    out[v] =
        std::hypot(a[3 * v] - b[3 * v], a[3 * v + 1] - b[3 * v + 1], a[3 * v + 2] - b[3 * v + 2]);
  return out;
}

/// Draws frames of a clip, beside its original where there is one.
class Drawing {
 public:
  Drawing(const RenderCommand& command, const Progress& progress)
      : command_(command), views_(parse_views(command)) {
    double width, height;
    if (!parse_pair(command.resolution, 'x', &width, &height) || width < 16 || height < 16 ||
        width > 8192 || height > 8192)
      throw Error(ErrorKind::kUsage, "--resolution: WIDTHxHEIGHT, each 16 to 8192");
    width_ = static_cast<uint32_t>(width);
    height_ = static_cast<uint32_t>(height);
    if (!command.camera.empty() &&
        !(parse_pair(command.camera, ',', &camera_.azimuth, &camera_.elevation) &&
          std::abs(camera_.elevation) <= 89))
      throw Error(ErrorKind::kUsage,
                  "--camera: AZIMUTH,ELEVATION in degrees, the second within 89");
    ComparedPart part;
    part.clip = command.clip;
    clip_.emplace(command.input, command.mesh, progress, part);
    const MeshSequence& sequence = clip_->sequence();
    camera_.z_up = (command.up == UpAxis::kUnknown ? sequence.up : command.up) == UpAxis::kZ;
    range_ = {0, sequence.frame_count, 1};
    if (!command.frames.empty())
      range_ = parse_frames(command.frames, "--frames", sequence.frame_count);
    if (!command.against.empty())
      open_original(progress);
  }

  uint32_t frame_count() const { return range_.size(); }

  /// Bytes of all pictures.
  uint64_t bytes() const { return uint64_t{4} * width_ * views_.size() * height_ * range_.size(); }

  double seconds_per_frame() const { return range_.step / clip_->sequence().rate.value(); }

  /// Reads all frames once: what the camera must show, and the largest error.
  void survey(const Progress& progress) {
    Box box;
    FrameSource clip = clip_->frames(), original;
    if (original_)
      original = original_->frames();
    for (uint32_t i = 0; i < frame_count(); ++i) {
      if (progress)
        progress("looking", static_cast<double>(i) / frame_count());
      std::span<const float> positions = clip(range_.first + i * range_.step);
      box.add(positions);
      if (!original_)
        continue;
      std::span<const float> from = original(range_.first + i * range_.step);
      if (std::ranges::find(views_, View::kError) != views_.end())
        for (float d : distances(positions, from))
          largest_ = std::max(largest_, d);
    }
    if (!command_.error_range.empty())
      largest_ = static_cast<float>(parse_positive(command_.error_range, "--error-range"));
    clip_view_.emplace(clip_->sequence(), box, width_, height_);
    if (original_)
      original_view_.emplace(original_->sequence(), box, width_, height_);
    clip_frames_ = clip_->frames();
    if (original_)
      original_frames_ = original_->frames();
  }

  Image draw(uint32_t i) {
    const uint32_t frame = range_.first + i * range_.step;
    Camera camera = camera_;
    if (command_.turntable)
      camera.azimuth += 360.0 * i / frame_count();
    std::span<const float> positions = clip_frames_(frame), original;
    if (original_)
      original = original_frames_(frame);
    Image all(width_ * static_cast<uint32_t>(views_.size()), height_);
    for (uint32_t v = 0; v < views_.size(); ++v) {
      Image one;
      switch (views_[v]) {
        case View::kClip:
          one = clip_view_->draw(positions, camera);
          break;
        case View::kOriginal:
          one = original_view_->draw(original, camera);
          break;
        case View::kError: {
          std::vector<float> colours;
          for (float d : distances(positions, original)) {
            const auto colour = error_colour(largest_ > 0 ? double{d} / double{largest_} : 0);
            colours.insert(colours.end(), colour.begin(), colour.end());
          }
          one = clip_view_->draw(positions, camera, colours);
          break;
        }
      }
      all.paste(one, v * width_, 0);
    }
    return all;
  }

  float largest_error() const { return largest_; }

 private:
  void open_original(const Progress& progress) {
    ComparedPart part;
    part.clip = command_.clip;
    original_.emplace(command_.against, command_.mesh, progress, part);
    const MeshSequence &a = clip_->sequence(), &b = original_->sequence();
    if (a.frame_count != b.frame_count)
      throw Error(ErrorKind::kInput, fmt::format("{}: {} frames, but {} has {}", command_.against,
                                                 b.frame_count, command_.input, a.frame_count));
    const bool by_vertex = a.vertex_count == b.vertex_count && !clip_->has_free_order() &&
                           !original_->has_free_order();
    if (!by_vertex && std::ranges::find(views_, View::kError) != views_.end())
      throw Error(ErrorKind::kInput,
                  command_.against + ": the vertices do not correspond; use --view original,clip");
  }

  const RenderCommand& command_;
  std::vector<View> views_;
  uint32_t width_ = 0, height_ = 0;
  Camera camera_;
  FrameRange range_;
  float largest_ = 0;
  std::optional<ComparedClip> clip_, original_;
  std::optional<ShadedView> clip_view_, original_view_;
  FrameSource clip_frames_, original_frames_;
};

bool ends_with(const std::string& path, std::string_view ending) {
  return path.size() > ending.size() &&
         std::equal(
             ending.begin(), ending.end(), path.end() - static_cast<ptrdiff_t>(ending.size()),
             [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

void write_pictures(const std::string& path, bool overwrite, Drawing& drawing,
                    const Progress& progress) {
  const NamePattern pattern = parse_name_pattern(path);
  if (!pattern.has_number && drawing.frame_count() > 1)
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: {} frames need a pattern with a number, such as frame_%04d.png",
                            path, drawing.frame_count()));
  for (uint32_t i = 0; i < drawing.frame_count(); ++i)
    check_output(pattern.name(i), overwrite);
  drawing.survey(progress);
  std::vector<AtomicFile> files;
  for (uint32_t i = 0; i < drawing.frame_count(); ++i) {
    if (progress)
      progress("drawing", static_cast<double>(i) / drawing.frame_count());
    AtomicFile& file = files.emplace_back(pattern.name(i), overwrite);
    file.write(png_bytes(drawing.draw(i)));
    file.close();
  }
  commit_all(files);
}

void write_animation(const std::string& path, bool overwrite, Drawing& drawing,
                     const Progress& progress) {
  AtomicFile file(path, overwrite);
  drawing.survey(progress);
  std::vector<Image> images;
  for (uint32_t i = 0; i < drawing.frame_count(); ++i) {
    if (progress)
      progress("drawing", static_cast<double>(i) / drawing.frame_count());
    images.push_back(drawing.draw(i));
  }
  const double seconds = drawing.seconds_per_frame();
  if (ends_with(path, ".gif"))
    file.write(gif_bytes(
        images, static_cast<uint16_t>(std::clamp(std::lround(100 * seconds), 2L, 65535L))));
  else
    file.write(mp4_bytes(images, 1 / seconds));
  file.commit();
}

/// A page that plays the clip, and the original beside it.
void write_page(const RenderCommand& command, const CommonOptions& common) {
  const std::pair<bool, const char*> others[] = {
      {!command.mesh.empty(), "--mesh"},     {!command.clip.empty(), "--clip"},
      {!command.frames.empty(), "--frames"}, {!command.views.empty(), "--view"},
      {!command.camera.empty(), "--camera"}, {!command.error_range.empty(), "--error-range"},
      {command.turntable, "--turntable"}};
  for (const auto& [given, name] : others) {
    if (given)
      throw Error(ErrorKind::kUsage, fmt::format("{}: is for pictures, not for .html", name));
  }
  check_output(command.output, common.overwrite);
  std::vector<std::string> names;
  if (!command.against.empty())
    names.push_back(command.against);
  names.push_back(command.input);
  std::vector<std::string> files;
  for (const std::string& name : names) {
    if (ComparedClip(name, {}, {}).bytes() == 0)
      throw Error(ErrorKind::kUsage, name + ": a page shows .anic files; encode it first");
    files.push_back(read_bytes(name));
  }
  std::vector<PageClip> clips;
  for (size_t i = 0; i < names.size(); ++i)
    clips.push_back({std::filesystem::path(names[i]).filename().string(), files[i]});
  const std::string page = viewer_page(load_viewer(), clips);
  AtomicFile file(command.output, common.overwrite);
  file.write(page);
  file.commit();
  if (common.json)
    return print_json(
        {{"file", command.output}, {"bytes", page.size()}, {"clip_bytes", files.back().size()}});
  if (!common.quiet)
    print_line("{}: {} bytes, {} of them the clip's", command.output, page.size(),
               files.back().size());
}

void run(const RenderCommand& command, const CommonOptions& common) {
  if (ends_with(command.output, ".html"))
    return write_page(command, common);
  ProgressLine line(common.quiet);
  const Progress progress = line.callback();
  const bool pictures = ends_with(command.output, ".png");
  if (!pictures && !ends_with(command.output, ".gif") && !ends_with(command.output, ".mp4"))
    throw Error(ErrorKind::kUsage,
                command.output + ": is of unknown kind; .png, .gif, .mp4 and .html can be written");
  Drawing drawing(command, progress);
  // A file of few bytes may announce frames that nobody waits for.
  constexpr uint32_t kMostPictures = 100'000;
  if (pictures ? drawing.frame_count() > kMostPictures : drawing.bytes() > half_of_machine())
    throw Error(ErrorKind::kInput,
                fmt::format("{}: {} frames are too many to draw at once; --frames takes some",
                            command.input, drawing.frame_count()));
  OutputFolder folder(command.output);
  (pictures ? write_pictures : write_animation)(command.output, common.overwrite, drawing,
                                                progress);
  folder.keep();
  line.clear();
  if (common.json)
    return print_json({{"file", command.output},
                       {"frames", drawing.frame_count()},
                       {"largest_error", drawing.largest_error()}});
  if (common.quiet)
    return;
  print_line("{}: {}", command.output, counted(drawing.frame_count(), "frame"));
  if (drawing.largest_error() > 0)
    fmt::print("black is an error of {:.4g}\n", drawing.largest_error());
}

}  // namespace

void add_render(Commands& commands, CommonOptions& common) {
  auto c = std::make_shared<RenderCommand>();
  Options& options =
      add_command(commands, common, kForce | kQuiet | kThreads | kJson,
                  {"render", "CLIP -o OUT [--against ORIGINAL] [options]",
                   "Draw a clip, beside its original and coloured by error", kRenderFooter},
                  [c, &common] { run(*c, common); });
  options.argument("CLIP", c->input, "The clip to draw").required();
  options
      .option("-o,--output", c->output, "OUT",
              "frame_%04d.png, x.png, clip.gif, clip.mp4 or clip.html")
      .required();
  options.option("--against", c->against, "ORIGINAL", "The original");
  options.option(
      "--clip", c->clip, "NAME",
      "Clip of an .anic file with several, or animation of a scene; of the original too");
  options.option("--mesh", c->mesh, "FILE",
                 "Mesh of a vertex cache (default: same stem beside it)");
  options.option("--frames", c->frames, "A:B[:STEP]",
                 "Frames A to B - 1, every STEP-th (default: all)");
  options.option("--view", c->views, "VIEW,...", "clip, original, error, separated by commas");
  options.option("--resolution", c->resolution, "WxH", "Pixels of each view (default 480x480)");
  options.option("--camera", c->camera, "AZ,EL",
                 "Degrees about the up axis and above (default 30,15)");
  options.flag("--turntable", c->turntable, "Turn the camera once while the clip plays");
  options.option("--error-range", c->error_range, "LEN",
                 "Error that is drawn black, in scene units (default: the largest)");
  options.choice("--up", c->up, {kUpAxes}, "Axis that points up (default: the clip's, else y)");
}

}  // namespace anicodec::tools
