// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PREDICTION_VERTEX_ORDER_COST_H_
#define ANICODEC_SDK_PREDICTION_VERTEX_ORDER_COST_H_

#include "sdk/prediction/vertex_order.h"

namespace anicodec {

/// make_vertex_order(), and how many vertices and edges of its graphs it visits: a cost that does
/// not depend on the machine, for tests.
Status make_counted_vertex_order(const uint32_t* triangles, size_t triangle_count,
                                 const int32_t* positions, size_t vertex_count, int neighbours,
                                 int colours, VertexOrder* out, uint64_t* visits);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_VERTEX_ORDER_COST_H_
