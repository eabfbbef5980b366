// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PYTHON_BINDING_INTERPRETER_LOCK_H_
#define ANICODEC_SDK_PYTHON_BINDING_INTERPRETER_LOCK_H_

#include <nanobind/nanobind.h>

namespace anicodec::python {

namespace nb = nanobind;

/// Counts the threads that are without the interpreter's lock. Its end returns for the thread that ends the
/// interpreter, and for every thread before that; a daemon thread sleeps from then on until the process ends. CPython before 3.14
/// would end it by pthread_exit() when it takes the lock, which aborts the process at the first frame of C++
/// that lets no exception pass.
class OutsideInterpreter {
 public:
  OutsideInterpreter();
  ~OutsideInterpreter();
  OutsideInterpreter(const OutsideInterpreter&) = delete;
  OutsideInterpreter& operator=(const OutsideInterpreter&) = delete;
};

/// Lets other threads of Python run while it lives.
class WithoutInterpreter {
 private:
  nb::gil_scoped_release release_;
  OutsideInterpreter outside_;  // its end comes first
};

/// Takes the lock of the interpreter in a callback.
class WithInterpreter {
 private:
  /// The end of a stay outside comes before the lock is taken.
  struct Entry {
    Entry() { const OutsideInterpreter outside; }
  };

  Entry entry_;
  nb::gil_scoped_acquire acquire_;
};

/// Registers what the interpreter does when it ends.
void watch_end_of_interpreter();

}  // namespace anicodec::python

#endif  // ANICODEC_SDK_PYTHON_BINDING_INTERPRETER_LOCK_H_
