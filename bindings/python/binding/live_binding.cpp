// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/python/binding/live_binding.h"

#include "bindings/python/binding/struct_dicts.h"

namespace anicodec::python {
namespace {

/// Runs a call without the lock of the interpreter; raises what is neither ANIC_OK nor `expected`. True for ANIC_OK.
template <class Call>
bool called(const Call& call, anic_status expected) {
  anic_status status;
  {
    const WithoutInterpreter unlocked;
    status = call();
  }
  if (status != ANIC_OK && status != expected)
    raise(status, anic_get_live_text());
  return status == ANIC_OK;
}

}  // namespace

bool Live::push_frame(anic_live_frame frame, const std::vector<Array<float>>& values, double wait) {
  std::vector<const float*> addresses;
  for (const Array<float>& array : values)
    addresses.push_back(array.data());
  frame.values = addresses.data();
  frame.value_count = static_cast<uint32_t>(addresses.size());
  return called([&] { return anic_push_live_frame(live_.get(), &frame, wait); }, ANIC_E_LIMIT);
}

bool Live::push(const Array<float>& positions, const std::vector<Array<float>>& values,
                double wait) {
  anic_live_frame frame = ANIC_INIT(anic_live_frame);
  frame.positions = positions.data();
  return push_frame(frame, values, wait);
}

bool Live::push_doubles(const Array<double>& positions, const std::vector<Array<float>>& values,
                        double wait) {
  anic_live_frame frame = ANIC_INIT(anic_live_frame);
  frame.positions = positions.data();
  frame.scalar = ANIC_SCALAR_FLOAT64;
  return push_frame(frame, values, wait);
}

void Live::end() {
  called([&] { return anic_end_live(live_.get()); }, ANIC_OK);
}

nb::object Live::take(double wait) {
  anic_live_piece piece = ANIC_INIT(anic_live_piece);
  if (!called([&] { return anic_take_live_piece(live_.get(), wait, &piece); }, ANIC_E_ABSENT))
    return nb::none();
  return nb::make_tuple(nb::bytes(piece.file, piece.size), dict_of(piece));
}

nb::dict Live::info() const {
  anic_live_info info = ANIC_INIT(anic_live_info);
  check_status(anic_get_live_info(live_.get(), &info));
  return dict_of(info);
}

void bind_live(nb::module_& module) {
  nb::class_<Live>(module, "Live")
      .def("push", &Live::push)
      .def("push_doubles", &Live::push_doubles)
      .def("end", &Live::end)
      .def("take", &Live::take)
      .def("info", &Live::info);
}

}  // namespace anicodec::python
