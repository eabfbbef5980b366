// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Code length of a probability, for the encoder's decisions. Not normative.
#ifndef ANICODEC_FORMAT_CODING_BIT_COST_H_
#define ANICODEC_FORMAT_CODING_BIT_COST_H_

#include <cstdint>

namespace anicodec {

/// One bit, in the unit of bit_cost().
constexpr uint32_t kBitCostOne = 65536;

/// -log2(p / 65536) in 1/65536 bit, within 0.05 % of the probability. 0 < p <= 65536.
uint32_t bit_cost(uint32_t p);

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_BIT_COST_H_
