// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "AnicComponent.h"

UAnicComponent::UAnicComponent(const FObjectInitializer& Initializer) : Super(Initializer) {
  PrimaryComponentTick.bCanEverTick = true;
  bUseAsyncCooking = true;
}

void UAnicComponent::Complain(const FString& What) {
  if (What == Fault)  // not in every frame
    return;
  Fault = What;
  UE_LOG(LogAnicodec, Error, TEXT("%s: %s"), *GetName(), *What);
}

void UAnicComponent::SetClip(UAnicClip* NewClip, int32 NewMesh) {
  anic_destroy_context(Context);
  Context = nullptr;
  ClearMeshSection(0);
  bHasSection = bFades = false;
  Clip = NewClip;
  Mesh = NewMesh;
  Show();
}

void UAnicComponent::CrossFade(const FString& To, double Seconds) {
  FadeTo = To;
  FadeTime = FadeDone = 0;
  FadeLength = Seconds;
  bFades = true;
}

bool UAnicComponent::Prepare() {
  if (Context != nullptr)
    return true;
  if (Clip == nullptr || Clip->GetAsset() == nullptr)
    return false;
  const anic_render_plan* const Plan = Clip->GetPlan(Mesh);
  if (Plan == nullptr) {
    Complain(FString::Printf(TEXT("the file has no mesh %d"), Mesh));
    return false;
  }
  const anic_status Status = anic_create_context(Clip->GetAsset(), nullptr, &Context);
  if (Status != ANIC_OK)
    Complain(UTF8_TO_TCHAR(anic_get_status_text(Status)));
  return Status == ANIC_OK;
}

anic_status UAnicComponent::Seek() {
  const anic_wrap Wrap = bLoop ? ANIC_WRAP_LOOP : ANIC_WRAP_CLAMP;
  const int32 Number = Clip->FindClip(ClipName), Other = bFades ? Clip->FindClip(FadeTo) : 0;
  if (Number < 0 || Other < 0)
    return ANIC_E_ABSENT;
  anic_status Status = anic_set_quality(Context, Quality);
  if (Status == ANIC_OK)
    Status = anic_set_clip(Context, static_cast<uint32>(Number));
  if (Status == ANIC_OK)
    Status = anic_seek_time(Context, Time, ANIC_SAMPLE_LINEAR, Wrap);
  if (Status == ANIC_OK && bFades) {
    const double Weight = FadeLength > 0 ? FMath::Clamp(FadeDone / FadeLength, 0.0, 1.0) : 1.0;
    Status =
        anic_blend(Context, static_cast<uint32>(Other), FadeTime, ANIC_SAMPLE_LINEAR, Wrap, Weight);
  }
  return Status;
}

void UAnicComponent::Show() {
  if (!Prepare())
    return;
  const anic_status Sought = Seek();
  if (Sought != ANIC_OK) {
    Complain(UTF8_TO_TCHAR(anic_get_status_text(Sought)));
    return;
  }
  const anic_render_plan* const Plan = Clip->GetPlan(Mesh);
  anic_render_info Info = ANIC_INIT(anic_render_info);
  anic_get_render_info(Plan, &Info);
  const int32 Count = static_cast<int32>(Info.vertex_count);
  Points.SetNum(3 * Count);
  Directions.SetNum(3 * Count);
  anic_output Out = ANIC_INIT(anic_output);
  Out.data = Points.GetData();
  Out.size = 12 * static_cast<size_t>(Count);
  anic_status Status =
      anic_write_render_positions(Plan, Context, ANIC_WHEN_CURRENT, 0, Info.vertex_count, &Out);
  if (Status == ANIC_E_ABSENT) {  // the mesh is not there at this time
    SetMeshSectionVisible(0, false);
    return;
  }
  Out.data = Directions.GetData();
  if (Status == ANIC_OK)
    Status = anic_write_render_normals(Plan, Points.GetData(), 0, 0, Info.vertex_count, &Out);
  if (Status != ANIC_OK) {
    Complain(UTF8_TO_TCHAR(anic_get_status_text(Status)));
    return;
  }
  Positions.SetNum(Count);
  Normals.SetNum(Count);
  for (int32 V = 0; V < Count; ++V) {
    Positions[V] = Clip->ToUnreal(&Points[3 * V]);
    Normals[V] = Clip->TurnToUnreal(&Directions[3 * V]);
  }
  if (!bHasSection)
    CreateSection(Plan);
  else
    UpdateMeshSection_LinearColor(0, Positions, Normals, {}, {}, {});
  SetMeshSectionVisible(0, true);
}

void UAnicComponent::CreateSection(const anic_render_plan* Plan) {
  anic_render_info Info = ANIC_INIT(anic_render_info);
  anic_get_render_info(Plan, &Info);
  // Unreal's fronts are clockwise in a left-handed system: the mirror has turned them round.
  TArray<int32> Triangles;
  for (uint32 I = 0; I < 3 * Info.triangle_count; ++I)
    Triangles.Add(static_cast<int32>(Info.indices[I]));
  TArray<FVector2D> Uvs;
  anic_mesh Faces = ANIC_INIT(anic_mesh);
  anic_get_mesh(Clip->GetAsset(), static_cast<uint32>(Mesh), &Faces);
  for (uint32 A = 0; A < Faces.attribute_count && Uvs.Num() == 0; ++A) {
    anic_attribute Attribute = ANIC_INIT(anic_attribute);
    anic_get_attribute(Clip->GetAsset(), static_cast<uint32>(Mesh), A, &Attribute);
    if (Attribute.kind != ANIC_ATTRIBUTE_UV || Attribute.domain == ANIC_DOMAIN_POLYGONS ||
        Attribute.components == 0)
      continue;
    TArray<float> Values;
    Values.SetNum(2 * static_cast<int32>(Info.vertex_count));
    anic_value_output Out = ANIC_INIT(anic_value_output);
    Out.data = Values.GetData();
    Out.size = 8 * static_cast<size_t>(Info.vertex_count);
    Out.components = 2;
    if (anic_write_render_attribute(Plan, Context, A, ANIC_WHEN_CURRENT, 0, Info.vertex_count,
                                    &Out) != ANIC_OK)
      continue;
    for (int32 V = 0; V < Values.Num(); V += 2)
      Uvs.Add(FVector2D(Values[V], 1 - Values[V + 1]));
  }
  CreateMeshSection_LinearColor(0, Positions, Triangles, Normals, Uvs, {}, {}, false);
  bHasSection = true;
}

void UAnicComponent::BeginPlay() {
  Super::BeginPlay();
  Show();
}

void UAnicComponent::TickComponent(float DeltaTime, ELevelTick TickType,
                                   FActorComponentTickFunction* Function) {
  Super::TickComponent(DeltaTime, TickType, Function);
  if (!bPlaying)
    return;
  Time += Speed * DeltaTime;
  FadeTime += Speed * DeltaTime;
  FadeDone += DeltaTime;
  if (bFades && FadeDone >= FadeLength) {
    ClipName = FadeTo;
    Time = FadeTime;
    bFades = false;
  }
  Show();
}

void UAnicComponent::BeginDestroy() {
  anic_destroy_context(Context);
  Context = nullptr;
  Super::BeginDestroy();
}
