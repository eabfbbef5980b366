// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Runs a fuzz target where there is no libFuzzer: once on each file in the folders named on the
// command line, then for some seconds on damaged copies of them, the same ones in every run; every
// second copy by the target's own mutator where it has one. Says which one it was when the target
// stops the program.
//
// usage: NAME_fuzz SECONDS FOLDER...
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);
extern "C" __attribute__((weak)) size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size,
                                                                size_t max_size, unsigned seed);

namespace {

using Input = std::vector<uint8_t>;

char current[512];  // what is run now

extern "C" void tell(int signal) {
  size_t length = 0;
  while (length < sizeof current && current[length] != '\0')
    ++length;
  if (write(STDERR_FILENO, current, length) >= 0)
    std::signal(signal, SIG_DFL);
  raise(signal);
}

std::mt19937 random_bits(1);

/// One to four changes: bytes altered, left out, doubled, or taken from another input.
Input damaged(Input bytes, const Input& other) {
  std::mt19937& random = random_bits;
  auto below = [&](size_t limit) { return limit == 0 ? 0 : random() % limit; };
  for (uint32_t changes = 1 + random() % 4; changes > 0; --changes) {
    const size_t at = below(bytes.size() + 1);
    const size_t count = std::min<size_t>(below(32), bytes.size() - at);
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto to = from + static_cast<std::ptrdiff_t>(count);
    const Input part(from, to);
    constexpr uint8_t kTelling[] = {0, 1, 0x7F, 0x80, 0xFF, '-', '9', ' '};
    switch (random() % 6) {
      case 0:
        if (at < bytes.size())
          bytes[at] ^= static_cast<uint8_t>(1U << random() % 8);
        break;
      case 1:
        if (at < bytes.size())
          bytes[at] = kTelling[random() % std::size(kTelling)];
        break;
      case 2:
        bytes.erase(from, to);
        break;
      case 3:
        bytes.insert(to, part.begin(), part.end());
        break;
      case 4:
        bytes.resize(at);
        break;
      default:
        for (size_t i = 0; i < count && at + i < other.size(); ++i)
          bytes[at + i] = other[at + i];
    }
  }
  return bytes;
}

Input damaged_by_target(Input bytes) {
  constexpr size_t kMore = 4096;
  const size_t size = bytes.size();
  bytes.resize(size + kMore);
  bytes.resize(LLVMFuzzerCustomMutator(bytes.data(), size, bytes.size(),
                                       static_cast<unsigned>(random_bits())));
  return bytes;
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size) {
  const Input bytes(data, data + size);
  const Input changed = damaged(bytes, bytes);
  const size_t length = std::min(changed.size(), max_size);
  std::copy_n(changed.begin(), length, data);
  return length;
}

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  if (argc < 3)
    return 2;
  std::vector<std::filesystem::path> paths;
  for (int i = 2; i < argc; ++i) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
      if (entry.is_regular_file())
        paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  for (int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL})
    std::signal(signal, tell);
  std::vector<Input> inputs;
  for (const auto& path : paths) {
    std::snprintf(current, sizeof current, "in %s\n", path.c_str());
    std::ifstream in(path, std::ios::binary);
    const Input& bytes =
        inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  const Clock::time_point end = Clock::now() + std::chrono::seconds(std::atoi(argv[1]));
  uint32_t runs = 0;
  for (; !inputs.empty() && Clock::now() < end; ++runs) {
    const size_t which = random_bits() % inputs.size();
    const Input bytes = LLVMFuzzerCustomMutator && runs % 2 == 0
                            ? damaged_by_target(inputs[which])
                            : damaged(inputs[which], inputs[random_bits() % inputs.size()]);
    std::snprintf(current, sizeof current, "in damaged copy %u, of %s\n", runs,
                  paths[which].c_str());
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%zu inputs, %u damaged copies\n", inputs.size(), runs);
  return inputs.empty() ? 1 : 0;
}
