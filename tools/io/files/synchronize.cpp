// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/synchronize.h"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

namespace anicodec::tools {

bool synchronize(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
}

void synchronize_folder(const std::string& path) {
  const int descriptor =
      ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    return;
  synchronize(descriptor);
  ::close(descriptor);
}

}  // namespace anicodec::tools
