// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_API_NORMALS_H_
#define ANICODEC_SDK_API_NORMALS_H_

#include "sdk/api/objects.h"
#include "sdk/play/normal_plan.h"

namespace anicodec {

/// Whether normals can be planned so. Errors: ANIC_E_ARGUMENT, ANIC_E_FRAME_RANGE, ANIC_E_ABSENT.
anic_status check_normal_options(const anic_asset* asset, uint32_t mesh,
                                 const anic_normal_plan_options& options);

/// Plans normals after check_normal_options(). Throws std::bad_alloc.
NormalPlan plan_normals(const Clip& clip, uint32_t mesh, const anic_normal_plan_options& options);

}  // namespace anicodec

#endif  // ANICODEC_SDK_API_NORMALS_H_
