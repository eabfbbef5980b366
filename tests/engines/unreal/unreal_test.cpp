// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The plug-in for Unreal on stubs of Unreal: importing, playing, fading, axes, faults.
//
// usage: unreal_test CHECKOUT
#include "AnicClip.h"
#include "AnicClipFactory.h"
#include "AnicComponent.h"
#include "Misc/FeedbackContext.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#define CHECK(condition)                                                   \
  do {                                                                     \
    if (!(condition)) {                                                    \
      std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
      for (const std::string& line : logged)                               \
        std::fprintf(stderr, "logged: %s\n", line.c_str());                \
      std::exit(1);                                                        \
    }                                                                      \
  } while (false)

static std::vector<uint8> read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  CHECK(file.good());
  return {std::istreambuf_iterator<char>(file), {}};
}

static UAnicClip* import(const std::vector<uint8>& file) {
  UAnicClipFactory factory{FObjectInitializer()};
  FFeedbackContext told;
  const uint8* begin = file.data();
  CHECK(factory.bEditorImport && factory.Formats.Num() == 1);
  return static_cast<UAnicClip*>(factory.FactoryCreateBinary(factory.SupportedClass, nullptr,
                                                             "dancer", RF_NoFlags, nullptr, "anic",
                                                             begin, begin + file.size(), &told));
}

/// The largest distance from the positions that the decoder gives: of clip `a`, or blended with clip `b`.
static double distance(const UAnicComponent& shown, UAnicClip* clip, int32 a, double time, int32 b,
                       double other, double weight) {
  anic_context* context = nullptr;
  CHECK(anic_create_context(clip->GetAsset(), nullptr, &context) == ANIC_OK);
  anic_set_clip(context, static_cast<uint32>(a));
  CHECK(anic_seek_time(context, time, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP) == ANIC_OK);
  if (weight > 0)
    CHECK(anic_blend(context, static_cast<uint32>(b), other, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP,
                     weight) == ANIC_OK);
  const int32 count = shown.vertices.Num();
  std::vector<float> points(3 * static_cast<std::size_t>(count));
  anic_output out = ANIC_INIT(anic_output);
  out.data = points.data();
  out.size = 12 * static_cast<std::size_t>(count);
  const anic_status status = anic_write_render_positions(
      clip->GetPlan(0), context, ANIC_WHEN_CURRENT, 0, static_cast<uint32>(count), &out);
  CHECK(status == ANIC_OK && count > 0);
  anic_destroy_context(context);
  double most = 0;
  for (int32 v = 0; v < count; ++v) {
    const FVector wanted = clip->ToUnreal(&points[3 * static_cast<std::size_t>(v)]),
                  is = shown.vertices[v];
    most = std::max(
        {most, std::abs(wanted.X - is.X), std::abs(wanted.Y - is.Y), std::abs(wanted.Z - is.Z)});
  }
  return most;
}

/// Share of triangles whose normals by Unreal's winding look away from those of their vertices.
static double turned(const UAnicComponent& shown) {
  int32 against = 0;
  for (int32 t = 0; t < shown.triangles.Num(); t += 3) {
    const FVector p = shown.vertices[shown.triangles[t]],
                  q = shown.vertices[shown.triangles[t + 1]],
                  r = shown.vertices[shown.triangles[t + 2]], n = shown.normals[shown.triangles[t]];
    const FVector a{q.X - p.X, q.Y - p.Y, q.Z - p.Z}, b{r.X - p.X, r.Y - p.Y, r.Z - p.Z};
    // The other way round than in a right-handed system.
    const double along = (b.Y * a.Z - b.Z * a.Y) * n.X + (b.Z * a.X - b.X * a.Z) * n.Y +
                         (b.X * a.Y - b.Y * a.X) * n.Z;
    against += along < 0;
  }
  return 3.0 * against / shown.triangles.Num();
}

int main(int argc, char** argv) {
  CHECK(argc == 2);
  const std::string checkout = argv[1], examples = checkout + "/bindings/rust/anicodec/examples/";
  const std::vector<uint8> file = read(examples + "walk.anic");
  UAnicClip* const clip = import(file);
  CHECK(clip != nullptr && clip->Bytes.Num() == static_cast<int32>(file.size()));
  const int32 walk = clip->FindClip("walk"), stand = clip->FindClip("stand");
  CHECK(walk >= 0 && stand >= 0 && clip->FindClip("") == 0 && clip->FindClip("fly") < 0);
  CHECK(clip->GetDuration("walk") > 0 && clip->GetPlan(7) == nullptr);

  UAnicComponent shown{FObjectInitializer()};
  shown.BeginPlay();  // without a clip nothing happens
  CHECK(shown.created == 0 && logged.empty());
  shown.ClipName = "walk";
  shown.SetClip(clip, 0);
  CHECK(shown.created == 1 && shown.visible && distance(shown, clip, walk, 0, 0, 0, 0) == 0);
  shown.Speed = -2;
  shown.TickComponent(0.25F, LEVELTICK_All, nullptr);
  CHECK(shown.updated == 1 && shown.Time == -0.5 &&
        distance(shown, clip, walk, -0.5, 0, 0, 0) == 0);
  shown.CrossFade("stand", 1);
  shown.TickComponent(0.25F, LEVELTICK_All, nullptr);
  CHECK(distance(shown, clip, walk, -1, stand, -0.5, 0.25) == 0);
  shown.TickComponent(0.75F, LEVELTICK_All, nullptr);
  CHECK(shown.ClipName == FString("stand") && shown.Time == -2 &&
        distance(shown, clip, stand, -2, 0, 0, 0) == 0);
  shown.bPlaying = false;
  shown.TickComponent(1, LEVELTICK_All, nullptr);
  CHECK(shown.Time == -2 && logged.empty());
  for (int i = 0; i < 2; ++i) {
    shown.ClipName = "fly";
    shown.Show();
  }
  CHECK(logged.size() == 1);
  shown.BeginDestroy();

  UAnicClip* const limb = import(read(checkout + "/tests/golden/default.anic"));
  UAnicComponent closed{FObjectInitializer()};
  closed.SetClip(limb, 0);
  CHECK(closed.triangles.Num() > 0 && turned(closed) < 0.02);
  for (const FVector& n : closed.normals)
    CHECK(std::abs(n.X * n.X + n.Y * n.Y + n.Z * n.Z - 1) < 1e-4);
  closed.SetClip(limb, 1);
  CHECK(logged.size() == 2 && closed.vertices.Num() == 0);
  closed.BeginDestroy();

  std::vector<uint8> damaged = file;
  damaged[300] ^= 1;
  CHECK(import(damaged) == nullptr && logged.back().find("chunk \"CLIP\"") != std::string::npos);
  UAnicClip refused;
  refused.Bytes.Append(damaged.data(), static_cast<int32>(damaged.size()));
  CHECK(refused.GetAsset() == nullptr && refused.GetAsset() == nullptr && logged.size() == 4);
  for (const std::unique_ptr<UObject>& object : objects)
    object->BeginDestroy();
  std::puts("the plug-in imports, plays, fades and refuses as it says");
}
