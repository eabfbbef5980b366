// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/solution.h"

#include <algorithm>

namespace anicodec {

std::vector<const EncodedSegment*> Solution::segments() const {
  std::vector<const EncodedSegment*> list;
  for (const CodedPart& part : parts)
    list.push_back(&part.encoded);
  return list;
}

double Solution::price() const {
  double sum = static_cast<double>(bytes);
  for (const CodedPart& part : parts)
    sum += part.opening;
  return sum;
}

double Solution::squared_error() const {
  double sum = 0;
  for (const CodedPart& part : parts)
    sum += part.error.squared;
  return sum;
}

double Solution::max_error() const {
  double largest = 0;
  for (const CodedPart& part : parts)
    largest = std::max(largest, part.error.max);
  return largest;
}

}  // namespace anicodec
