// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Built with -mavx2 -mfma on x86.
#define Eigen EigenOf256
#include "tests/bench/play_peers_lanes.h"

namespace anicodec::bench {

const PlayPeers kPlayPeers256 = {read_all, multiply_adds, eigen_product};

}  // namespace anicodec::bench
