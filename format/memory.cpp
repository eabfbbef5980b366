// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/memory.h"

#include <algorithm>

namespace anicodec {

void throw_bad_alloc() {
  throw std::bad_alloc();
}

void* Memory::take(size_t size, size_t alignment) {
  void* memory = allocate(user, size, alignment);
  if (!memory)
    throw_bad_alloc();
  held += size;
  peak = std::max(peak, held);
  return memory;
}

void Memory::give_back(void* memory, size_t size) {
  held -= size;
  release(user, memory, size);
}

}  // namespace anicodec
