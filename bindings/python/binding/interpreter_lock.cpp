// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/python/binding/interpreter_lock.h"

#include <atomic>
#include <chrono>
#include <thread>

#if defined(__linux__)
#include <dlfcn.h>
#endif

namespace anicodec::python {
namespace {

using namespace std::chrono_literals;

std::atomic<int> outside{0};
std::atomic<bool> ending{false};
std::thread::id ender;  // written before `ending`

/// Whether threads that take the lock now are ended. Elsewhere than on Linux that unwinds no frames.
bool is_finalizing() {
#if defined(__linux__)
  // Its name has no underscore since 3.13, and it is outside the stable interface.
  static const auto asked = [] {
    void* const found = dlsym(RTLD_DEFAULT, "Py_IsFinalizing");
    return reinterpret_cast<int (*)()>(found ? found : dlsym(RTLD_DEFAULT, "_Py_IsFinalizing"));
  }();
  return asked && asked() != 0;
#else
  return false;
#endif
}

/// Runs after all threads that Python waits for, before it ends the others.
void end() {
  ender = std::this_thread::get_id();
  ending = true;
  if (outside == 0)
    return;
  // Threads that wait for the lock already get it a last time.
  const nb::gil_scoped_release release;
  std::this_thread::sleep_for(20ms);
}

}  // namespace

OutsideInterpreter::OutsideInterpreter() {
  ++outside;
}

OutsideInterpreter::~OutsideInterpreter() {
  if (ending && std::this_thread::get_id() != ender) {
    // Other functions that run at the end may wait for this thread, so it goes on unless the end comes soon.
    for (int tries = 0; tries < 50; ++tries) {
      while (is_finalizing())
        std::this_thread::sleep_for(1h);
      std::this_thread::sleep_for(1ms);
    }
  }
  --outside;
}

void watch_end_of_interpreter() {
  ending = false;  // a program may begin another interpreter
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&end));
}

}  // namespace anicodec::python
