// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once

// Unreal's tool wants its generated header last.
// clang-format off
#include "CoreMinimal.h"
#include "UObject/Object.h"
#include <anicodec/anicodec.h>
#include "AnicClip.generated.h"
// clang-format on

DECLARE_LOG_CATEGORY_EXTERN(LogAnicodec, Log, All);

/** An imported .anic file, opened when a component first needs it, and shared by all, on the game's thread. */
UCLASS(BlueprintType)

class ANICODEC_API UAnicClip : public UObject {
  GENERATED_BODY()

 public:
  /** The bytes of the file. */
  UPROPERTY()
  TArray<uint8> Bytes;

  /** Leaves the motion of the whole out of the positions, for actors that are moved by anic_get_root_step(). */
  UPROPERTY(EditAnywhere, Category = Anicodec)
  bool bInPlace = false;

  /** Tells what is wrong with a file; true where nothing is. */
  static bool Check(const TArray<uint8>& File, FString& OutFault);

  /** The opened file; null after a fault, which the log tells once. */
  const anic_asset* GetAsset();

  /** The vertices of a mesh that a graphics card needs, with the source's hard edges; null where there are none. */
  const anic_render_plan* GetPlan(int32 Mesh);

  /** Number of a clip of the file; that of the first one for an empty name, -1 where there is none of the name. */
  int32 FindClip(const FString& Name);

  /** Seconds of a turn of a clip; 0 where there is none of the name. */
  UFUNCTION(BlueprintCallable, Category = Anicodec)
  double GetDuration(const FString& Name);

  /** A position of the file in Unreal's axes, left-handed with z up, and centimetres; a file without a unit has metres. */
  FVector ToUnreal(const float* Position) const;

  /** The same of a direction of length 1. */
  FVector TurnToUnreal(const float* Direction) const;

  virtual void BeginDestroy() override;

 private:
  anic_asset* Asset = nullptr;
  TArray<anic_render_plan*> Plans;
  double Centimetres = 100;
  bool bZUp = false, bRefused = false;

  bool Open();
  void Close();
};
