# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Links binaries that run on other distributions: every library is static, and glibc is that of 2018 (glibc_stubs.py).
# prepare.sh makes what this links with.
get_filename_component(ANICODEC_PORTABLE "${CMAKE_CURRENT_LIST_DIR}/../../build/portable" ABSOLUTE)
get_filename_component(ANICODEC_STATIC_LIBRARIES "${ANICODEC_PORTABLE}/lib" ABSOLUTE)
if(NOT EXISTS "${ANICODEC_PORTABLE}/glibc/libc.so")
  message(FATAL_ERROR "cmake/portable/prepare.sh makes the libraries that a portable build links with")
endif()
foreach(package draco fmt OpenMesh TBB zstd)
  set(${package}_DIR "${CMAKE_CURRENT_LIST_DIR}")
endforeach()
set(PNG_LIBRARY_RELEASE "${ANICODEC_STATIC_LIBRARIES}/libpng16.a")
set(ZLIB_LIBRARY_RELEASE "${ANICODEC_STATIC_LIBRARIES}/libz.a")
set(GIF_LIBRARY "${ANICODEC_STATIC_LIBRARIES}/libgif.a")
set(LIBLZMA_LIBRARY_RELEASE "${ANICODEC_STATIC_LIBRARIES}/liblzma.a")
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-L${ANICODEC_PORTABLE}/glibc -static-libstdc++")
endforeach()
# libgcc_s of this machine wants more of glibc than the one that is there in the end.
string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,--allow-shlib-undefined")
