// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/commands/command_line.h"

int main(int argc, char** argv) {
  return anicodec::tools::run_command_line(argc, argv);
}
