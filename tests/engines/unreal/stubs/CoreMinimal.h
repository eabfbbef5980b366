// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The part of Unreal's interface that bindings/engines/unreal uses, by its documentation, with just enough behind it that tests see
// what the plug-in does. Not Unreal: nothing of an engine or its tools is tested with it.
#pragma once
#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using uint8 = std::uint8_t;
using uint32 = std::uint32_t;
using int32 = std::int32_t;
using TCHAR = char;

#define TEXT(text) text
#define UTF8_TO_TCHAR(text) (text)
#define TCHAR_TO_UTF8(text) (text)
#define ANICODEC_API
#define UCLASS(...)
#define UPROPERTY(...)
#define UFUNCTION(...)

template <typename T>
std::remove_reference_t<T>&& MoveTemp(T&& value) {
  return std::move(value);
}

template <typename T>
class TArray {
 public:
  TArray() = default;

  TArray(std::initializer_list<T> of) : items_(of) {}

  T* GetData() { return items_.data(); }

  const T* GetData() const { return items_.data(); }

  int32 Num() const { return static_cast<int32>(items_.size()); }

  bool IsValidIndex(int32 i) const { return i >= 0 && i < Num(); }

  T& operator[](int32 i) { return items_.at(static_cast<std::size_t>(i)); }

  const T& operator[](int32 i) const { return items_.at(static_cast<std::size_t>(i)); }

  void SetNum(int32 count) { items_.resize(static_cast<std::size_t>(count)); }

  void SetNumZeroed(int32 count) { SetNum(count); }

  void Add(const T& item) { items_.push_back(item); }

  void Append(const T* from, int32 count) { items_.insert(items_.end(), from, from + count); }

  void Empty() { items_.clear(); }

  auto begin() { return items_.begin(); }

  auto end() { return items_.end(); }

 private:
  std::vector<T> items_;
};

class FString {
 public:
  FString() = default;

  FString(const TCHAR* text) : text_(text) {}

  const TCHAR* operator*() const { return text_.c_str(); }

  bool IsEmpty() const { return text_.empty(); }

  bool operator==(const FString& other) const { return text_ == other.text_; }

  static FString Printf(const TCHAR* format, ...) __attribute__((format(printf, 1, 2))) {
    char text[1000];
    va_list values;
    va_start(values, format);
    std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    return text;
  }

 private:
  std::string text_;
};

class FName {
 public:
  FName(const TCHAR* text = "") : text_(text) {}

  FString ToString() const { return text_; }

 private:
  FString text_;
};

struct FVector {
  double X = 0, Y = 0, Z = 0;
  FVector() = default;

  FVector(double x, double y, double z) : X(x), Y(y), Z(z) {}

  FVector operator*(double by) const { return {X * by, Y * by, Z * by}; }
};

struct FVector2D {
  double X = 0, Y = 0;
  FVector2D() = default;

  FVector2D(double x, double y) : X(x), Y(y) {}
};

struct FLinearColor {};

struct FMath {
  static double Clamp(double x, double least, double most) { return std::clamp(x, least, most); }
};

/// The lines that were logged.
inline std::vector<std::string> logged;

struct ELogVerbosity {
  enum Type { Error };
};

#define DECLARE_LOG_CATEGORY_EXTERN(name, ...) extern int name
#define DEFINE_LOG_CATEGORY(name) int name = 0
#define UE_LOG(category, verbosity, ...) \
  logged.push_back((static_cast<void>(category), *FString::Printf(__VA_ARGS__)))
