// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once

// Unreal's tool wants its generated header last.
// clang-format off
#include "CoreMinimal.h"
#include "AnicClip.h"
#include "ProceduralMeshComponent.h"
#include "AnicComponent.generated.h"
// clang-format on

/** Plays a mesh of a clip in section 0 of a procedural mesh, which the CPU fills. */
UCLASS(ClassGroup = Rendering, meta = (BlueprintSpawnableComponent))

class ANICODEC_API UAnicComponent : public UProceduralMeshComponent {
  GENERATED_BODY()

 public:
  explicit UAnicComponent(const FObjectInitializer& Initializer);

  /** The file. */
  UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = Anicodec)
  TObjectPtr<UAnicClip> Clip;

  /** Mesh of the file. */
  UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = Anicodec)
  int32 Mesh = 0;

  /** Clip of the file by its name; empty: the first one. */
  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Anicodec)
  FString ClipName;

  /** Seconds; 0 is the first frame of the clip. */
  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Anicodec)
  double Time = 0;

  /** Seconds of the clip in a second of the game; negative: backwards. */
  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Anicodec)
  double Speed = 1;

  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Anicodec)
  bool bLoop = true;

  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Anicodec)
  bool bPlaying = true;

  /** Share of the components to play: less for what is far away. */
  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Anicodec,
            meta = (ClampMin = "0.01", ClampMax = "1"))
  double Quality = 1;

  /** Shows another file or mesh from now on. */
  UFUNCTION(BlueprintCallable, Category = Anicodec)
  void SetClip(UAnicClip* NewClip, int32 NewMesh);

  /** Fades to another clip of the file within some seconds. */
  UFUNCTION(BlueprintCallable, Category = Anicodec)
  void CrossFade(const FString& To, double Seconds);

  /** Shows the time that the properties say. */
  UFUNCTION(BlueprintCallable, Category = Anicodec)
  void Show();

  virtual void BeginPlay() override;
  virtual void TickComponent(float DeltaTime, ELevelTick TickType,
                             FActorComponentTickFunction* Function) override;
  virtual void BeginDestroy() override;

 private:
  anic_context* Context = nullptr;
  FString FadeTo, Fault;
  double FadeTime = 0, FadeDone = 0, FadeLength = 0;
  bool bFades = false, bHasSection = false;
  TArray<float> Points, Directions;
  TArray<FVector> Positions, Normals;

  bool Prepare();
  anic_status Seek();
  void CreateSection(const anic_render_plan* Plan);
  void Complain(const FString& What);
};
