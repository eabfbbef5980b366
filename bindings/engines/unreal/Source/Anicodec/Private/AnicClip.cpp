// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "AnicClip.h"

DEFINE_LOG_CATEGORY(LogAnicodec);

namespace {

/** The first frame that shows a mesh. */
uint32 FindFirstFrame(const anic_asset* Asset, uint32 Mesh) {
  anic_asset_info Info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(Asset, &Info);
  anic_box Box;
  uint32 Frame = 0;
  while (Frame + 1 < Info.frame_count && anic_get_frame_bounds(Asset, Mesh, Frame, &Box) != ANIC_OK)
    ++Frame;
  return Frame;
}

anic_asset* OpenFile(const TArray<uint8>& File, bool bInPlace, FString& OutFault) {
  anic_options Options = ANIC_INIT(anic_options);
  Options.flags = ANIC_OPEN_BOUNDS | (bInPlace ? ANIC_OPEN_IN_PLACE : 0);
  anic_failure Failure = ANIC_INIT(anic_failure);
  anic_asset* Asset = nullptr;
  anic_open_asset(File.GetData(), File.Num(), &Options, &Asset, &Failure);
  if (Asset == nullptr)
    OutFault = FString::Printf(
        TEXT("byte %llu, chunk \"%s\": %s (%s)"), static_cast<unsigned long long>(Failure.offset),
        UTF8_TO_TCHAR(Failure.chunk), UTF8_TO_TCHAR(anic_get_status_text(Failure.status)),
        UTF8_TO_TCHAR(Failure.detail));
  return Asset;
}

}  // namespace

bool UAnicClip::Check(const TArray<uint8>& File, FString& OutFault) {
  anic_asset* const Opened = OpenFile(File, false, OutFault);
  anic_close_asset(Opened);
  return Opened != nullptr;
}

bool UAnicClip::Open() {
  if (Asset != nullptr || bRefused)
    return Asset != nullptr;
  FString Fault;
  Asset = OpenFile(Bytes, bInPlace, Fault);
  if (Asset == nullptr) {
    bRefused = true;
    UE_LOG(LogAnicodec, Error, TEXT("%s: %s"), *GetName(), *Fault);
    return false;
  }
  anic_asset_info Info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(Asset, &Info);
  bZUp = Info.up == ANIC_UP_Z;
  Centimetres = 100 * (Info.metres_per_unit > 0 ? Info.metres_per_unit : 1);
  Plans.SetNumZeroed(static_cast<int32>(Info.mesh_count));
  return true;
}

const anic_asset* UAnicClip::GetAsset() {
  return Open() ? Asset : nullptr;
}

const anic_render_plan* UAnicClip::GetPlan(int32 Mesh) {
  if (!Open() || !Plans.IsValidIndex(Mesh))
    return nullptr;
  if (Plans[Mesh] == nullptr) {
    anic_render_plan_options Options = ANIC_INIT(anic_render_plan_options);
    Options.source_edges = 1;
    Options.crease_angle = 60;
    Options.reference_frame = FindFirstFrame(Asset, static_cast<uint32>(Mesh));
    anic_create_render_plan(Asset, static_cast<uint32>(Mesh), &Options, nullptr, &Plans[Mesh]);
  }
  return Plans[Mesh];
}

int32 UAnicClip::FindClip(const FString& Name) {
  uint32 Number = 0;
  if (!Open() ||
      (!Name.IsEmpty() && anic_find_clip(Asset, TCHAR_TO_UTF8(*Name), &Number) != ANIC_OK))
    return -1;
  return static_cast<int32>(Number);
}

double UAnicClip::GetDuration(const FString& Name) {
  const int32 Number = FindClip(Name);
  anic_clip Clip = ANIC_INIT(anic_clip);
  if (Number < 0 || anic_get_clip(Asset, static_cast<uint32>(Number), &Clip) != ANIC_OK)
    return 0;
  return Clip.loop_duration;
}

FVector UAnicClip::TurnToUnreal(const float* Direction) const {
  // One axis turned round, or two exchanged: a mirror, which makes a right-handed system left-handed.
  return bZUp ? FVector(Direction[0], -Direction[1], Direction[2])
              : FVector(Direction[0], Direction[2], Direction[1]);
}

FVector UAnicClip::ToUnreal(const float* Position) const {
  return TurnToUnreal(Position) * Centimetres;
}

void UAnicClip::Close() {
  for (anic_render_plan* Plan : Plans)
    anic_destroy_render_plan(Plan);
  Plans.Empty();
  anic_close_asset(Asset);
  Asset = nullptr;
}

void UAnicClip::BeginDestroy() {
  Close();
  Super::BeginDestroy();
}
