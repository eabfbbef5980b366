// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once
#include "UObject/Object.h"

class FFeedbackContext;

class UFactory : public UObject {
 public:
  using UObject::UObject;
  UClass* SupportedClass = nullptr;
  bool bCreateNew = true, bEditorImport = false;
  TArray<FString> Formats;
  virtual UObject* FactoryCreateBinary(UClass*, UObject*, FName, EObjectFlags, UObject*,
                                       const TCHAR*, const uint8*&, const uint8*,
                                       FFeedbackContext*) = 0;
};
