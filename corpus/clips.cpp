// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"

#include "codec/sequence/error.h"
#include "corpus/generators.h"

#include <algorithm>

namespace anicodec::corpus {
namespace {

MeshSequence waves(ClipSize size) {
  return make_wave_grid(size.vertices, size.frames, 30);
}

struct Clip {
  const char* name;
  MeshSequence (*make)(ClipSize);
  ClipSize size;  ///< the default; one that is not scalable may use the frames only
  bool scalable;
  UpAxis up;
  const char* description;
};

constexpr UpAxis kNone = UpAxis::kUnknown, kY = UpAxis::kY, kZ = UpAxis::kZ;

const Clip kClips[] = {
    {"limb",
     limb,
     {800, 72},
     true,
     kZ,
     "skinned limb that bends and twists: linear blend skinning by three bones"},
    {"cloth",
     cloth,
     {1024, 72},
     true,
     kY,
     "cloth in the wind, travelling waves; the pinned edge is exactly static"},
    {"face",
     face,
     {1296, 90},
     true,
     kY,
     "face-like mask with an open boundary: ten local blend shapes, static elsewhere"},
    {"rigid",
     rigid,
     {690, 60},
     true,
     kY,
     "seven boxes that tumble and bounce, one connected component each"},
    {"waves", waves, {1500, 64}, true, kZ, "sheet that spans exactly 30 shapes"},
    {"helix",
     helix,
     {1000, 49},
     true,
     kZ,
     "straight rod that winds up into a helix: rotations of several turns"},
    {"noisy",
     noisy,
     {900, 40},
     true,
     kY,
     "cloth with independent noise in every vertex and frame, as if captured"},
    {"soup",
     limb_soup,
     {2400, 48},
     true,
     kZ,
     "skinned limb as triangle soup: every corner a vertex, trajectories repeat"},
    {"cuts", cuts, {400, 60}, true, kZ, "three takes joined by hard cuts"},
    {"repeats",
     repeats,
     {400, 60},
     true,
     kY,
     "animated on twos with a hold: frames repeat exactly"},
    {"static", motionless, {400, 10}, true, kZ, "nothing moves"},
    {"one_frame", one_frame, {400, 1}, false, kZ, "a single frame"},
    {"uneven", uneven, {256, 30}, true, kY, "cloth sampled at uneven times"},
    {"far",
     far_tumble,
     {386, 60},
     true,
     kY,
     "box that tumbles thousands of units from the origin, at the resolution of float32"},
    {"large", large, {300, 24}, true, kZ, "skinned limb with coordinates of about 10^12"},
    {"tiny", tiny, {300, 24}, true, kZ, "skinned limb with coordinates of about 10^-12"},
    {"one_triangle", one_triangle, {3, 5}, false, kNone, "one triangle"},
    {"one_vertex", one_vertex, {1, 4}, false, kNone, "one vertex, no face"},
    {"points", points, {500, 30}, true, kNone, "point cloud in a vortex, no face"},
    {"nonmanifold",
     nonmanifold,
     {151, 24},
     false,
     kNone,
     "three sheets on one spine (8 edges of three faces) and a bow-tie vertex"},
    {"moebius", moebius, {200, 24}, false, kNone, "Moebius strip: cannot be oriented"},
    {"open_pair", open_pair, {245, 24}, false, kNone, "two separate open sheets"},
    {"polygons", polygons, {166, 24}, false, kNone, "triangles, quads and pentagons mixed"},
    {"quad_box", box_of_quads, {152, 24}, false, kNone, "closed box of quads"},
    {"leftovers",
     leftovers,
     {148, 24},
     false,
     kNone,
     "unused vertices, degenerate faces and duplicate faces in a sheet"},
    {"sliding",
     sliding,
     {1600, 48},
     true,
     kZ,
     "skinned limb whose vertices slide over it, otherwise in every frame, as if captured"},
    {"painted_box",
     painted_box,
     {98, 24},
     false,
     kNone,
     "box of quads with texture coordinates, colours, hard edges, materials and objects"},
    {"heated",
     heated,
     {240, 24},
     false,
     kZ,
     "sheet with a seam whose colours, temperature and texture coordinates move"},
};

const Clip& find(std::string_view name) {
  const Clip* clip = std::find_if(std::begin(kClips), std::end(kClips),
                                  [&](const Clip& c) { return name == c.name; });
  if (clip != std::end(kClips))
    return *clip;
  std::string text = "there is no clip \"" + std::string(name) + "\"; there are:";
  for (const Clip& c : kClips)
    text += std::string(" ") + c.name;
  throw Error(ErrorKind::kUsage, text);
}

MeshSequence make(const Clip& clip, ClipSize size) {
  MeshSequence sequence = clip.make(size);
  sequence.name = clip.name;
  sequence.up = clip.up;
  return sequence;
}

}  // namespace

const std::vector<ClipInfo>& clips() {
  static const std::vector<ClipInfo> list = [] {
    std::vector<ClipInfo> result;
    for (const Clip& c : kClips)
      result.push_back({c.name, c.description, c.scalable});
    return result;
  }();
  return list;
}

std::vector<std::string> clip_names() {
  std::vector<std::string> names;
  for (const Clip& c : kClips)
    names.emplace_back(c.name);
  return names;
}

MeshSequence make_clip(std::string_view name) {
  const Clip& clip = find(name);
  return make(clip, clip.size);
}

MeshSequence make_scaled(std::string_view name, uint32_t vertices, uint32_t frames) {
  const Clip& clip = find(name);
  ClipSize size{vertices == 0 ? clip.size.vertices : vertices,
                frames == 0 ? clip.size.frames : frames};
  if (!clip.scalable)
    throw Error(ErrorKind::kUsage, "the clip \"" + std::string(name) + "\" has a fixed size");
  if (size.vertices < 100 || size.vertices >= (1U << 30) || size.frames >= (1U << 24))
    throw Error(ErrorKind::kUsage,
                "a clip has at least 100 and less than 2^30 vertices and less than 2^24 frames");
  return make(clip, size);
}

}  // namespace anicodec::corpus
