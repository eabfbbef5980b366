// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Helpers shared by the files of the extension module.
#ifndef ANICODEC_SDK_PYTHON_BINDING_BINDING_H_
#define ANICODEC_SDK_PYTHON_BINDING_BINDING_H_

#include "bindings/python/binding/interpreter_lock.h"
#include "codec/sequence/mesh_sequence.h"

#include <anicodec/anicodec.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

namespace anicodec::python {

namespace nb = nanobind;

/// Arrays that Python gives: contiguous, of exactly this type. anicodec/ has copied any others.
template <class T, class... Shape>
using Array = nb::ndarray<const T, nb::c_contig, nb::device::cpu, Shape...>;
template <class T>
using Writable = nb::ndarray<T, nb::c_contig, nb::device::cpu>;
using Numpy32 = nb::ndarray<nb::numpy, float>;

/// A new array of numpy that owns its memory.
template <class T>
nb::ndarray<nb::numpy, T> new_array(std::initializer_list<size_t> shape) {
  size_t size = 1;
  for (size_t n : shape)
    size *= n;
  T* data = new T[size > 0 ? size : 1];
  const nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<T*>(p); });
  return nb::ndarray<nb::numpy, T>(data, shape, owner);
}

/// A copy of some numbers.
template <class T>
nb::ndarray<nb::numpy, T> copied(const T* from, size_t count) {
  auto result = new_array<T>({count});
  if (count > 0)
    std::memcpy(result.data(), from, count * sizeof(T));
  return result;
}

/// A text of a file. Bytes that are no UTF-8, as old programs write names, become U+FFFD.
inline nb::object text_of(const char* text) {
  return nb::steal(
      PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(std::strlen(text)), "replace"));
}

/// Raises the Python exception of a status: one of module.cpp, IndexError, ValueError ...
[[noreturn]] void raise(anic_status status, const std::string& text);

/// Raises, unless the status is ANIC_OK.
void check_status(anic_status status);

/// An element that Python names by its number.
inline uint32_t at_number(const std::vector<uint32_t>& values, uint32_t number) {
  if (number >= values.size())
    check_status(ANIC_E_ARGUMENT);
  return values[number];
}

/// Polygons by offsets and corners.
Polygons polygons_of(const Array<uint32_t>& offsets, const Array<uint32_t>& corners);

void bind_clip(nb::module_& module);
void bind_command(nb::module_& module);
void bind_encoder(nb::module_& module);
void bind_library(nb::module_& module);
void bind_live(nb::module_& module);

}  // namespace anicodec::python

#endif  // ANICODEC_SDK_PYTHON_BINDING_BINDING_H_
