// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// An allocator inside a block of the host's: best fit over a list of free pieces in the order of
// their addresses, as Knuth describes (The Art of Computer Programming, volume 1, section 2.5).
#include <anicodec/anicodec.h>

#include <cstddef>
#include <cstdint>
#include <new>

namespace {

constexpr size_t kUnit = 16;  // of sizes and addresses

/// A piece that is free; the list is sorted by address, and no two pieces touch.
struct Piece {
  size_t size;
  Piece* next;
};

static_assert(sizeof(Piece) <= kUnit);

struct Block {
  Piece* first = nullptr;
};

size_t rounded(size_t size) {
  return (size + kUnit - 1) / kUnit * kUnit;
}

unsigned char* end_of(Piece* piece) {
  return reinterpret_cast<unsigned char*>(piece) + piece->size;
}

void* allocate(void* user, size_t size, size_t alignment) {
  auto* block = static_cast<Block*>(user);
  if (size > SIZE_MAX - kUnit || alignment > kUnit)
    return nullptr;
  size = rounded(size);
  Piece** best = nullptr;
  for (Piece** link = &block->first; *link; link = &(*link)->next) {
    if ((*link)->size >= size && (!best || (*link)->size < (*best)->size))
      best = link;
  }
  if (!best)
    return nullptr;
  Piece* piece = *best;
  if (piece->size == size) {
    *best = piece->next;
    return piece;
  }
  // The end of the piece, so that the list stays as it is.
  piece->size -= size;
  return end_of(piece);
}

void release(void* user, void* memory, size_t size) {
  auto* block = static_cast<Block*>(user);
  if (!memory)
    return;
  Piece** link = &block->first;
  Piece* before = nullptr;
  while (*link && static_cast<void*>(*link) < memory) {
    before = *link;
    link = &before->next;
  }
  auto* piece = new (memory) Piece{rounded(size), *link};
  *link = piece;
  if (piece->next && end_of(piece) == reinterpret_cast<unsigned char*>(piece->next)) {
    piece->size += piece->next->size;
    piece->next = piece->next->next;
  }
  if (before && end_of(before) == reinterpret_cast<unsigned char*>(piece)) {
    before->size += piece->size;
    before->next = piece->next;
  }
}

}  // namespace

anic_status anic_init_block_allocator(void* block, size_t size, anic_allocator* out) {
  if (!block || !out)
    return ANIC_E_ARGUMENT;
  if (size < 256)
    return ANIC_E_BUFFER_SIZE;
  auto address = reinterpret_cast<uintptr_t>(block);
  const size_t skip = (kUnit - address % kUnit) % kUnit;
  unsigned char* begin = static_cast<unsigned char*>(block) + skip;
  auto* head = new (begin) Block;
  const size_t room = (size - skip) / kUnit * kUnit - rounded(sizeof(Block));
  head->first = new (begin + rounded(sizeof(Block))) Piece{room, nullptr};
  out->user = head;
  out->allocate = allocate;
  out->release = release;
  return ANIC_OK;
}
