// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The library that OpenUSD loads: the decoder, and the choice of the plug-in for the release that loads it. A release has its
// version in the name of every symbol, and its library a name that differs from one build to the next (libusd_ms-6b533cf6.so), so
// that neither can be linked beforehand. Here the library that is loaded already is found, and given the one name that
// the plug-ins were linked with: a link in a private folder, which is the run path of the plug-in that is opened from there.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

namespace {

/// Releases that there are plug-ins for, as 26_8.
constexpr const char* kReleases[] = {ANICODEC_USD_RELEASES};

bool has_release(const std::string& path, const char* release) {
  void* library = dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (library == nullptr)
    return false;
  const std::string space = std::string("pxrInternal_v0_") + release + "__pxrReserved__";
  const std::string symbol = "_ZTIN" + std::to_string(space.size()) + space + "13SdfFileFormatE";
  const bool has = dlsym(library, symbol.c_str()) != nullptr;
  dlclose(library);
  return has;
}

int add_library(dl_phdr_info* info, size_t /*size*/, void* paths) {
  const char* slash = std::strrchr(info->dlpi_name, '/');
  if (slash != nullptr && std::strncmp(slash, "/libusd_ms", 10) == 0)
    static_cast<std::vector<std::string>*>(paths)->emplace_back(info->dlpi_name);
  return 0;
}

/// Folder of this library.
std::string own_folder() {
  Dl_info own;
  if (dladdr(reinterpret_cast<const void*>(&add_library), &own) == 0 || own.dli_fname == nullptr)
    return ".";
  const std::string path = own.dli_fname;
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

void say(const std::string& text) {
  std::fprintf(stderr, "anicodec: %s\n", text.c_str());
}

bool open_from(const std::string& folder, const std::string& library, const std::string& plugin) {
  const std::string link = folder + "/libusd_ms.so";
  const std::string here = folder + "/plugin.so";
  bool opened = false;
  if (symlink(library.c_str(), link.c_str()) == 0 && symlink(plugin.c_str(), here.c_str()) == 0)
    opened = dlopen(here.c_str(), RTLD_NOW | RTLD_LOCAL) != nullptr;
  const char* reason = opened ? nullptr : dlerror();
  if (!opened)
    say(reason != nullptr ? reason : folder + ": no links can be made there");
  unlink(here.c_str());
  unlink(link.c_str());
  return opened;
}

__attribute__((constructor)) void load_plugin() {
  std::vector<std::string> libraries;
  dl_iterate_phdr(add_library, &libraries);
  const char* release = nullptr;
  std::string library;
  for (const std::string& path : libraries) {
    for (const char* known : kReleases) {
      if (release == nullptr && has_release(path, known)) {
        release = known;
        library = path;
      }
    }
  }
  if (release == nullptr) {
    std::string releases;
    for (const char* known : kReleases)
      releases += (releases.empty() ? "" : ", ") + std::string(known);
    for (char& c : releases)
      c = c == '_' ? '.' : c;
    say("this plug-in is for the OpenUSD releases " + releases + " of usd-core, not for " +
        (libraries.empty() ? "the one that loads it" : libraries[0]));
    return;
  }
  const char* temporary = std::getenv("TMPDIR");
  std::string folder = std::string(temporary == nullptr || temporary[0] == 0 ? "/tmp" : temporary) +
                       "/anicodec-usd-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) {
    say(folder + ": cannot be made");
    return;
  }
  open_from(folder, library, own_folder() + "/anicodec_usd_" + release + ".so");
  rmdir(folder.c_str());
}

}  // namespace
