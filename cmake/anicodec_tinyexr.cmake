# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_tinyexr: tinyexr 1, which reads and writes OpenEXR, compiled from its header (Debian: libtinyexr-dev), so that
# binaries bring no library along. Without the header there is no such target, and EXR is refused.
find_path(TINYEXR_INCLUDE tinyexr.h)
find_package(ZLIB)
if(NOT TINYEXR_INCLUDE OR NOT ZLIB_FOUND)
  message(WARNING "There is no tinyexr.h (Debian: libtinyexr-dev): export-vat writes PNG alone")
  return()
endif()
set(source "${CMAKE_CURRENT_BINARY_DIR}/tinyexr.cpp")
file(CONFIGURE OUTPUT "${source}" CONTENT "#define TINYEXR_IMPLEMENTATION\n#include <tinyexr.h>\n")
add_library(anicodec_tinyexr OBJECT "${source}")
set_target_properties(anicodec_tinyexr PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden UNITY_BUILD OFF)
target_include_directories(anicodec_tinyexr SYSTEM PUBLIC "${TINYEXR_INCLUDE}")
target_compile_options(anicodec_tinyexr PRIVATE -w -ffunction-sections -fdata-sections)
target_link_libraries(anicodec_tinyexr PUBLIC ZLIB::ZLIB)
