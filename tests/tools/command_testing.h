// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_TOOLS_COMMAND_TESTING_H_
#define ANICODEC_TESTS_TOOLS_COMMAND_TESTING_H_

#include "build_paths.h"
#include "tests/tools/io_testing.h"

#include <chrono>
#include <csignal>
#include <functional>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace anicodec::tools {

/// The outcome of a program.
struct Outcome {
  int status = -1;  ///< exit status; 128 + signal when one ended it
  std::string out;
  std::string err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

inline std::ostream& operator<<(std::ostream& stream, const Outcome& outcome) {
  return stream << "status " << outcome.status << "\n" << outcome.out << outcome.err;
}

/// Runs a program to its end. A signal other than 0 is sent to it as soon as `ready` is true.
inline Outcome run_program(std::vector<std::string> arguments, int signal = 0,
                           const std::function<bool()>& ready = {}) {
  TemporaryFolder folder;
  std::vector<char*> argv;
  for (std::string& argument : arguments)
    argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::string out = folder / "out", err = folder / "err";
  pid_t child = ::fork();
  if (child == 0) {
    int flags = O_WRONLY | O_CREAT | O_TRUNC;
    ::dup2(::open("/dev/null", O_RDONLY), 0);
    ::dup2(::open(out.c_str(), flags, 0600), 1);
    ::dup2(::open(err.c_str(), flags, 0600), 2);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  pid_t ended = 0;
  if (signal != 0) {
    while (!ready() && (ended = ::waitpid(child, &status, WNOHANG)) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (ended == 0)
      ::kill(child, signal);
  }
  if (ended == 0)
    ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), folder.read("out"),
          folder.read("err")};
}

/// Runs the anicodec command.
inline Outcome anicodec(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), ANICODEC_COMMAND);
  return run_program(std::move(arguments));
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_TOOLS_COMMAND_TESTING_H_
