// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Built with -mavx2 -mfma -mavx512f -mavx512dq -mavx512vl on x86.
#define Eigen EigenOf512
#include "tests/bench/play_peers_lanes.h"

namespace anicodec::bench {

const PlayPeers kPlayPeers512 = {read_all, multiply_adds, eigen_product};

}  // namespace anicodec::bench
