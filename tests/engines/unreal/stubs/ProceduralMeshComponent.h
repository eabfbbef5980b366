// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once
#include "CoreMinimal.h"
#include "UObject/Object.h"

struct FActorComponentTickFunction {
  bool bCanEverTick = false;
};

enum ELevelTick { LEVELTICK_All };

struct FProcMeshTangent {};

class UActorComponent : public UObject {
 public:
  using UObject::UObject;
  FActorComponentTickFunction PrimaryComponentTick;

  virtual void BeginPlay() {}

  virtual void TickComponent(float, ELevelTick, FActorComponentTickFunction*) {}
};

/// Keeps section 0.
class UProceduralMeshComponent : public UActorComponent {
 public:
  using UActorComponent::UActorComponent;
  bool bUseAsyncCooking = false;
  TArray<FVector> vertices, normals;
  TArray<int32> triangles;
  TArray<FVector2D> uvs;
  int created = 0, updated = 0;
  bool visible = false;

  void CreateMeshSection_LinearColor(int32, const TArray<FVector>& v, const TArray<int32>& t,
                                     const TArray<FVector>& n, const TArray<FVector2D>& uv,
                                     const TArray<FLinearColor>&, const TArray<FProcMeshTangent>&,
                                     bool) {
    vertices = v, triangles = t, normals = n, uvs = uv;
    ++created;
  }

  void UpdateMeshSection_LinearColor(int32, const TArray<FVector>& v, const TArray<FVector>& n,
                                     const TArray<FVector2D>&, const TArray<FLinearColor>&,
                                     const TArray<FProcMeshTangent>&) {
    vertices = v, normals = n;
    ++updated;
  }

  void ClearMeshSection(int32) { vertices.Empty(); }

  void SetMeshSectionVisible(int32, bool is) { visible = is; }
};
