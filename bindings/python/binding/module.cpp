// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The extension module, and its exceptions.
#include "bindings/python/binding/binding.h"
#include "bindings/python/binding/instance.h"
#include "codec/sequence/error.h"

#include <anicodec/encode.h>

#include <exception>
#include <iterator>

namespace anicodec::python {
namespace {

/// An exception of anicodec/errors.py.
nb::object exception(const char* name) {
  return nb::module_::import_("anicodec.errors").attr(name);
}

const char* exception_name(anic_status status) {
  switch (status) {
    case ANIC_E_ARGUMENT:
    case ANIC_E_STATE:
    case ANIC_E_BUFFER_SIZE:
    case ANIC_E_INDEX_RANGE:
    case ANIC_E_NON_FINITE:
      return "InputError";
    case ANIC_E_FRAME_RANGE:
      return "FrameError";
    case ANIC_E_ABSENT:
      return "AbsentError";
    case ANIC_E_VERSION:
    case ANIC_E_FEATURE:
      return "UnsupportedError";
    case ANIC_E_LIMIT:
    case ANIC_E_MEMORY:
      return "LimitError";
    case ANIC_E_CANCELLED:
      return "Cancelled";
    case ANIC_E_INTERNAL:
      return "InternalError";
    default:
      return "CorruptError";
  }
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& e) {
    const nb::object type =
        exception(e.kind() == ErrorKind::kInternal ? "InternalError" : "InputError");
    PyErr_SetString(type.ptr(), e.what());
  }
}

}  // namespace

void raise(anic_status status, const std::string& text) {
  const WithInterpreter locked;
  const nb::object type = exception(exception_name(status));
  PyErr_SetString(type.ptr(), text.empty() ? anic_get_status_text(status) : text.c_str());
  throw nb::python_error();
}

void check_status(anic_status status) {
  if (status != ANIC_OK)
    raise(status, "");
}

Polygons polygons_of(const Array<uint32_t>& offsets, const Array<uint32_t>& corners) {
  Polygons result;
  result.offsets.assign(offsets.data(), offsets.data() + offsets.size());
  result.corners.assign(corners.data(), corners.data() + corners.size());
  return result;
}

}  // namespace anicodec::python

NB_MODULE(_anicodec, module) {
  using namespace anicodec::python;
  module.doc() = "The extension module inside the package anicodec; use the package.";
  module.attr("version") = std::to_string(ANIC_VERSION_MAJOR) + "." +
                           std::to_string(ANIC_VERSION_MINOR) + "." +
                           std::to_string(ANIC_VERSION_PATCH);
  // Programs such as Panda3D hold nodes until the process ends: nothing that a user could mend.
  nb::set_leak_warnings(false);
  nb::register_exception_translator(translate);
  watch_end_of_interpreter();
  bind_instance(module);
  bind_clip(module);
  bind_encoder(module);
  bind_command(module);
  bind_library(module);
  bind_live(module);
}
