// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#pragma once
#include "CoreMinimal.h"

class FObjectInitializer {};

enum EObjectFlags { RF_NoFlags };

class UObject {
 public:
  UObject() = default;

  explicit UObject(const FObjectInitializer&) {}

  virtual ~UObject() = default;

  virtual void BeginDestroy() {}

  FString GetName() const { return "an object"; }
};

class UClass : public UObject {
 public:
  std::unique_ptr<UObject> (*make)() = nullptr;
};

template <typename T>
class TObjectPtr {
 public:
  TObjectPtr(T* to = nullptr) : to_(to) {}

  T* operator->() const { return to_; }

  bool operator==(std::nullptr_t) const { return to_ == nullptr; }

 private:
  T* to_;
};

/// Objects that NewObject() made, as Unreal's garbage collector owns them.
inline std::vector<std::unique_ptr<UObject>> objects;

template <typename T>
T* NewObject(UObject*, UClass* of, FName, EObjectFlags) {
  objects.push_back(of->make());
  return static_cast<T*>(objects.back().get());
}
