// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Tables of the words that stand for the values of an enumeration.
#ifndef ANICODEC_TOOLS_WORDS_WORD_TABLE_H_
#define ANICODEC_TOOLS_WORDS_WORD_TABLE_H_

#include <cstddef>
#include <span>

namespace anicodec::tools {

template <typename T>
struct Word {
  T value;
  const char* text;
};

/// A table that lives as long as the program.
template <typename T>
using WordTable = std::span<const Word<T>>;

/// The word of a value, or "unknown": a file may hold any number.
template <typename T, size_t kCount>
constexpr const char* word_of(const Word<T> (&table)[kCount], T value) {
  for (const Word<T>& word : table) {
    if (word.value == value)
      return word.text;
  }
  return "unknown";
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_WORD_TABLE_H_
