// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/solution.h"

#include <algorithm>

namespace anicodec {

std::vector<const EncodedSegment*> Solution::encoded() const {
  std::vector<const EncodedSegment*> list;
  for (const CodedSegment& segment : segments)
    list.push_back(&segment.encoded);
  return list;
}

double Solution::price() const {
  double sum = static_cast<double>(bytes);
  for (const CodedSegment& segment : segments)
    sum += segment.opening;
  return sum;
}

double Solution::squared_error() const {
  double sum = 0;
  for (const CodedSegment& segment : segments)
    sum += segment.error.squared;
  return sum;
}

double Solution::max_error() const {
  double largest = 0;
  for (const CodedSegment& segment : segments)
    largest = std::max(largest, segment.error.max);
  return largest;
}

}  // namespace anicodec
