// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once

// Unreal's tool wants its generated header last.
// clang-format off
#include "CoreMinimal.h"
#include "Factories/Factory.h"
#include "AnicClipFactory.generated.h"
// clang-format on

/** Imports .anic files. */
UCLASS()

class UAnicClipFactory : public UFactory {
  GENERATED_BODY()

 public:
  explicit UAnicClipFactory(const FObjectInitializer& Initializer);

  virtual UObject* FactoryCreateBinary(UClass* Class, UObject* Parent, FName Name,
                                       EObjectFlags Flags, UObject* Context, const TCHAR* Type,
                                       const uint8*& Buffer, const uint8* BufferEnd,
                                       FFeedbackContext* Warn) override;
};
