# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Packages of CMake that stand in for Debian's, which know shared libraries alone: the same headers and names, but static
# libraries.
function(anicodec_static target library)
  if(TARGET ${target})
    return()
  endif()
  add_library(${target} STATIC IMPORTED)
  set_target_properties(${target} PROPERTIES IMPORTED_LOCATION "${ANICODEC_STATIC_LIBRARIES}/lib${library}.a"
    INTERFACE_INCLUDE_DIRECTORIES /usr/include ${ARGN})
endfunction()

string(TOLOWER "${CMAKE_FIND_PACKAGE_NAME}" package)
if(package STREQUAL "draco")
  anicodec_static(draco::draco draco)
elseif(package STREQUAL "fmt")
  anicodec_static(fmt::fmt fmt INTERFACE_COMPILE_DEFINITIONS FMT_SHARED INTERFACE_COMPILE_FEATURES cxx_variadic_templates)
elseif(package STREQUAL "openmesh")
  anicodec_static(OpenMeshCore OpenMeshCore)
  anicodec_static(OpenMeshTools OpenMeshTools INTERFACE_LINK_LIBRARIES OpenMeshCore)
elseif(package STREQUAL "tbb")
  anicodec_static(TBB::tbb tbb)
elseif(package STREQUAL "zstd")
  anicodec_static(zstd::libzstd_shared zstd)
endif()
set(${CMAKE_FIND_PACKAGE_NAME}_FOUND TRUE)
