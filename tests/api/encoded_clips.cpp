// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "build_paths.h"
#include "tests/api/opened.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include <unistd.h>

namespace anicodec {
namespace {

namespace fs = std::filesystem;

/// A folder for what this build of the tests encodes; those of older builds go.
fs::path folder() {
  const fs::path all = ANICODEC_ENCODED_CLIPS;
  const auto built = fs::last_write_time("/proc/self/exe").time_since_epoch().count();
  const fs::path own = all / std::to_string(built);
  std::error_code ignored;
  if (fs::exists(own, ignored))
    return own;
  fs::create_directories(all, ignored);
  for (const fs::directory_entry& old : fs::directory_iterator(all, ignored))
    fs::remove_all(old, ignored);
  fs::create_directories(own, ignored);
  return own;
}

Bytes encoded(const std::string& clip, BasisChoice basis, uint32_t frames) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  options.basis = basis;
  options.effort = Effort::kFast;
  return encode(frames > 0 ? corpus::make_scaled(clip, 300, frames) : corpus::make_clip(clip),
                options)
      .file;
}

}  // namespace

const Bytes& encoded_clip(const std::string& clip, BasisChoice basis, uint32_t frames) {
  static std::map<std::tuple<std::string, BasisChoice, uint32_t>, Bytes> files;
  Bytes& file = files[{clip, basis, frames}];
  if (!file.empty())
    return file;
  static const fs::path kept = folder();
  const std::string name =
      clip + "_" + std::to_string(static_cast<int>(basis)) + "_" + std::to_string(frames);
  if (std::ifstream in(kept / name, std::ios::binary); in)
    file.assign(std::istreambuf_iterator<char>(in), {});
  if (!file.empty())
    return file;
  file = encoded(clip, basis, frames);
  // Other tests run at the same time: they see all of it or nothing.
  const fs::path written = kept / (name + "." + std::to_string(getpid()));
  std::ofstream out(written, std::ios::binary);
  out.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
  out.close();
  std::error_code ignored;
  if (out)
    fs::rename(written, kept / name, ignored);
  else
    fs::remove(written, ignored);
  return file;
}

}  // namespace anicodec
