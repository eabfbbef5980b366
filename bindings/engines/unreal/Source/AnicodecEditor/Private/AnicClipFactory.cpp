// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "AnicClipFactory.h"

#include "AnicClip.h"
#include "Misc/FeedbackContext.h"

UAnicClipFactory::UAnicClipFactory(const FObjectInitializer& Initializer) : Super(Initializer) {
  SupportedClass = UAnicClip::StaticClass();
  bCreateNew = false;
  bEditorImport = true;
  Formats.Add(TEXT("anic;Compressed animated mesh"));
}

UObject* UAnicClipFactory::FactoryCreateBinary(UClass* Class, UObject* Parent, FName Name,
                                               EObjectFlags Flags, UObject* Context,
                                               const TCHAR* Type, const uint8*& Buffer,
                                               const uint8* BufferEnd, FFeedbackContext* Warn) {
  TArray<uint8> Bytes;
  Bytes.Append(Buffer, static_cast<int32>(BufferEnd - Buffer));
  FString Fault;
  if (!UAnicClip::Check(Bytes, Fault)) {
    Warn->Logf(ELogVerbosity::Error, TEXT("%s: %s"), *Name.ToString(), *Fault);
    return nullptr;
  }
  UAnicClip* const Clip = NewObject<UAnicClip>(Parent, Class, Name, Flags);
  Clip->Bytes = MoveTemp(Bytes);
  return Clip;
}
