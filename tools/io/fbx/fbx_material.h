// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FBX_FBX_MATERIAL_H_
#define ANICODEC_TOOLS_IO_FBX_FBX_MATERIAL_H_

#include "format/material_look.h"

#include <ufbx.h>

namespace anicodec::tools {

/// The look of a material in the terms of glTF; without what no renderer can use.
MaterialLook look_of(const ufbx_material& material);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FBX_FBX_MATERIAL_H_
