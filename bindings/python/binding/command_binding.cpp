// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The command line, which shares encoder and decoder with the rest of the module.
#include "bindings/python/binding/binding.h"
#include "tools/commands/command_line.h"

namespace anicodec::python {
namespace {

/// Arguments are bytes: names of files need not be UTF-8.
int run_command(const std::vector<nb::bytes>& arguments) {
  std::vector<const char*> texts;
  for (const nb::bytes& argument : arguments)
    texts.push_back(argument.c_str());
  texts.push_back(nullptr);
  const WithoutInterpreter unlocked;
  return tools::run_command_line(static_cast<int>(arguments.size()), texts.data(), true);
}

}  // namespace

void bind_command(nb::module_& module) {
  module.def("run_command", &run_command);
}

}  // namespace anicodec::python
