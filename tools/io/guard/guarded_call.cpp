// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/guard/guarded_call.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// How the child's message begins: the result follows, or the kind and the text of an error.
constexpr char kResult = 'R', kError = 'E', kNoMemory = 'M';

[[noreturn]] void fail(std::string_view name, const std::string& reason) {
  throw Error(ErrorKind::kInput, std::string(name) + ": " + reason);
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;  // its shadow takes terabytes of addresses
#else
constexpr bool kSanitized = false;
#endif

/// Addresses that this process has, in bytes.
uint64_t own_addresses() {
  unsigned long long pages = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file && std::fscanf(file, "%llu", &pages) != 1)
    pages = 0;
  if (file)
    std::fclose(file);
  return pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Lowers a limit, never beyond what the process may have.
template <typename Resource>
void limit(Resource resource, uint64_t most) {
  rlimit now;
  if (::getrlimit(resource, &now) != 0)
    return;
  now.rlim_cur = std::min<rlim_t>(most, now.rlim_max);
  ::setrlimit(resource, &now);
}

void set_limits(const GuardLimits& limits) {
  constexpr uint64_t kStack = uint64_t{64} << 20;
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  limit(RLIMIT_STACK, kStack);
  if (!kSanitized)
    limit(RLIMIT_AS, own_addresses() + limits.memory);
}

/// Takes from the child what belongs to its parent: handlers, open files, the terminal.
void detach(pid_t parent, int pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent)
    ::_exit(1);
  for (int signal = 1; signal < NSIG; ++signal)
    std::signal(signal, SIG_DFL);
  ::close_range(3, static_cast<unsigned>(pipe) - 1, 0);
  ::close_range(static_cast<unsigned>(pipe) + 1, UINT_MAX, 0);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  if (!kSanitized)
    ::dup2(nothing, STDERR_FILENO);
}

void write_all(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(pipe, bytes.data(), bytes.size());
    if (n < 0 && errno != EINTR)
      ::_exit(1);
    bytes.remove_prefix(n > 0 ? static_cast<size_t>(n) : 0);
  }
}

void do_work(int pipe, const std::function<std::string()>& work) {
  try {
    const std::string result = work();
    write_all(pipe, {&kResult, 1});
    write_all(pipe, result);
  } catch (const Error& e) {
    const char head[] = {kError, static_cast<char>(e.kind())};
    write_all(pipe, {head, sizeof head});
    write_all(pipe, e.what());
  } catch (const std::bad_alloc&) {
    write_all(pipe, {&kNoMemory, 1});
  } catch (const std::exception& e) {
    const char head[] = {kError, static_cast<char>(ErrorKind::kInput)};
    write_all(pipe, {head, sizeof head});
    write_all(pipe, e.what());
  }
}

[[noreturn]] void run_child(pid_t parent, int pipe, const GuardLimits& limits,
                            const std::function<std::string()>& work) noexcept {
  detach(parent, pipe);
  set_limits(limits);
  do_work(pipe, work);
  ::_exit(0);
}

/// The child, its end of the pipe, and what it says.
class Child {
 public:
  Child(std::string_view name, const GuardLimits& limits, const std::function<std::string()>& work)
      : name_(name), limits_(limits) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      fail(name, std::string("no pipe: ") + std::strerror(errno));
    const pid_t parent = ::getpid();
    id_ = ::fork();
    if (id_ == 0)
      run_child(parent, ends[1], limits, work);
    ::close(ends[1]);
    pipe_ = ends[0];
    if (id_ < 0)
      fail_to_start();
  }

  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  ~Child() {
    ::close(pipe_);
    if (id_ > 0) {
      ::kill(id_, SIGKILL);
      wait();
    }
  }

  /// Its message; empty when it ended without.
  std::string read() {
    // A child that waits for something takes no processor time.
    const auto end = Clock::now() + std::chrono::seconds(uint64_t{10} * limits_.seconds);
    std::string message;
    for (char piece[1 << 16];;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
      pollfd ready{pipe_, POLLIN, 0};
      const int found =
          ::poll(&ready, 1, static_cast<int>(std::clamp<int64_t>(left.count(), 0, INT_MAX)));
      if (found == 0)
        fail_slow();
      const ssize_t n = found < 0 ? -1 : ::read(pipe_, piece, sizeof piece);
      if (n < 0 && errno != EINTR)
        fail(name_, std::string("the process that reads it: ") + std::strerror(errno));
      if (n == 0)
        return message;
      message.append(piece, n > 0 ? static_cast<size_t>(n) : 0);
      if (message.size() > limits_.memory)
        fail_memory();
    }
  }

  /// Throws unless it ended well.
  void finish() {
    const int status = wait();
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
      fail_slow();
    if (WIFSIGNALED(status))
      fail(name_, std::string("the library that reads it crashes (") +
                      ::strsignal(WTERMSIG(status)) + ")");
    if (status != 0)
      fail(name_, "the library that reads it ends the process");
  }

  [[noreturn]] void fail_memory() const {
    fail(name_, "takes more than " + std::to_string(limits_.memory) + " bytes of memory to read");
  }

 private:
  [[noreturn]] void fail_to_start() {
    const int fault = errno;
    ::close(pipe_);
    fail(name_, std::string("no process to read it: ") + std::strerror(fault));
  }

  [[noreturn]] void fail_slow() const {
    fail(name_, "takes longer than " + std::to_string(limits_.seconds) + " s to read");
  }

  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

  std::string_view name_;
  GuardLimits limits_;
  pid_t id_ = -1;
  int pipe_ = -1;
};

}  // namespace

GuardLimits GuardLimits::for_input(uint64_t bytes, uint64_t memory) {
  constexpr uint64_t kLeast = 30, kMost = 86400;
  return {memory, static_cast<uint32_t>(std::min(kMost, kLeast + (bytes >> 20)))};
}

std::string run_guarded(std::string_view name, const GuardLimits& limits,
                        const std::function<std::string()>& work) {
  Child child(name, limits, work);
  std::string message = child.read();
  child.finish();
  if (message.empty() || message[0] == kNoMemory)
    child.fail_memory();
  if (message[0] == kError && message.size() >= 2)
    throw Error(static_cast<ErrorKind>(message[1]), message.substr(2));
  message.erase(0, 1);
  return message;
}

}  // namespace anicodec::tools
