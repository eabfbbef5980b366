# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_prebuilt: encoder, decoder and command of the finished build in ANICODEC_PREBUILT.
if(NOT EXISTS "${ANICODEC_PREBUILT}/tools/libanicodec_tools.a")
  message(FATAL_ERROR "ANICODEC_PREBUILT: there is no finished build in ${ANICODEC_PREBUILT}")
endif()
foreach(package TBB draco OpenMesh zstd Eigen3 fmt PNG GIF LibLZMA)
  find_package(${package} REQUIRED)
endforeach()
add_library(anicodec_prebuilt INTERFACE)
foreach(library tools/libanicodec_tools.a tools/io/libanicodec_io.a corpus/libanicodec_corpus.a
                codec/api/libanicodec_encoder.a codec/libanicodec_codec.a codec/sequence/libanicodec_sequence.a
                sdk/libanicodec_sdk.a format/libanicodec_format.a)
  target_link_libraries(anicodec_prebuilt INTERFACE "${ANICODEC_PREBUILT}/${library}")
endforeach()
target_link_libraries(anicodec_prebuilt INTERFACE Eigen3::Eigen OpenMeshTools TBB::tbb draco::draco zstd::libzstd_shared
  fmt::fmt PNG::PNG GIF::GIF LibLZMA::LibLZMA)
