# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_ufbx: ufbx 0.21.2, which reads FBX, from its source, which a Python package has. Without the source there is no
# such target, and FBX is refused.
include(anicodec_source)
anicodec_source(UFBX pyufbx 0.0.7 aabe7cb568f538719c5b7d3efc19f0f578678f99c1e5b3d52689bfc9a15e0e4b ufbx-c)
if(NOT UFBX_SOURCE)
  return()
endif()
add_library(anicodec_ufbx OBJECT "${UFBX_SOURCE}/ufbx.c")
set_target_properties(anicodec_ufbx PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden UNITY_BUILD OFF)
target_include_directories(anicodec_ufbx SYSTEM PUBLIC "${UFBX_SOURCE}")
target_compile_options(anicodec_ufbx PRIVATE -w -ffp-contract=off -ffunction-sections -fdata-sections)
target_compile_definitions(anicodec_ufbx PRIVATE UFBX_NO_SUBDIVISION UFBX_NO_TESSELLATION UFBX_NO_ANIMATION_BAKING
  UFBX_NO_FORMAT_OBJ UFBX_NO_TRIANGULATION)
