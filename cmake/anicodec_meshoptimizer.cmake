# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_meshoptimizer: the codecs of meshoptimizer 1.3, from its source, which a Python package has. Debian 12 has 0.18,
# which cannot read version 1 of the vertex codec (KHR_meshopt_compression).
include(anicodec_source)
anicodec_source(MESHOPTIMIZER meshopt 0.1.0 41359e33ae103df20dd261e860b4d5b3232c0538aa35dcced8efe4830a8026dd
  vendor/meshoptimizer)
if(NOT MESHOPTIMIZER_SOURCE)
  return()
endif()
set(sources allocator indexcodec vcacheoptimizer vertexcodec vertexfilter vfetchoptimizer)
list(TRANSFORM sources REPLACE "(.+)" "${MESHOPTIMIZER_SOURCE}/\\1.cpp")
add_library(anicodec_meshoptimizer OBJECT ${sources})
set_target_properties(anicodec_meshoptimizer PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
  UNITY_BUILD OFF)
target_include_directories(anicodec_meshoptimizer SYSTEM PUBLIC "${MESHOPTIMIZER_SOURCE}")
target_compile_options(anicodec_meshoptimizer PRIVATE -ffunction-sections -fdata-sections)
