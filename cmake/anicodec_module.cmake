# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_library(NAME STANDARD SOURCES...): a static library anicodec_NAME (alias anicodec::NAME).
# Headers are included as "module/file.h" from the top of the tree.
#
# anicodec_module(NAME STANDARD): one of every source in the current folder and below, except in folders
# that have a CMakeLists.txt.

set(ANICODEC_PIC ON)
if(EMSCRIPTEN)
  set(ANICODEC_PIC OFF)
endif()
# This prefix makes a flag of Clang one of clang-cl, which only warns of most that it does not know.
set(ANICODEC_FLAG "")
if(MSVC)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "Visual C++ lacks the vectors that the kernels are written in: choose its clang-cl (-T ClangCL)")
  endif()
  set(ANICODEC_FLAG "/clang:")
endif()

add_library(anicodec_flags INTERFACE)
target_compile_options(anicodec_flags INTERFACE
  # The integers a decoder predicts from must come out the same everywhere: no fused multiply-add
  # unless the source asks for it.
  ${ANICODEC_FLAG}-ffp-contract=off
  # A linker leaves out what is not used, of rooms that are compiled as one source too.
  ${ANICODEC_FLAG}-ffunction-sections ${ANICODEC_FLAG}-fdata-sections
  -Wshadow -Wundef
  # GCC 12 warns at -O3 of overlaps in std::string that there are not (bug 105651).
  $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Wold-style-cast>)
if(MSVC)  # whose -Wall is everything
  target_compile_options(anicodec_flags INTERFACE /W4 $<$<BOOL:${ANICODEC_WERROR}>:/WX>)
else()
  target_compile_options(anicodec_flags INTERFACE -Wall -Wextra -Wpedantic $<$<BOOL:${ANICODEC_WERROR}>:-Werror>)
endif()
target_include_directories(anicodec_flags INTERFACE "${PROJECT_SOURCE_DIR}")

function(anicodec_module name standard)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp *.h)
  file(GLOB folders CONFIGURE_DEPENDS */CMakeLists.txt)
  foreach(folder IN LISTS folders)
    cmake_path(GET folder PARENT_PATH folder)
    list(FILTER sources EXCLUDE REGEX "^${folder}/")
  endforeach()
  anicodec_library(${name} ${standard} ${sources})
  anicodec_group_rooms(${sources})
endfunction()

# With CMAKE_UNITY_BUILD the sources of a room are compiled as one, so that headers are parsed once; those of several
# rooms where `compiled_together` lists them, as "inputs+report". Names in their unnamed namespaces must differ.
function(anicodec_group_rooms)
  foreach(source IN LISTS ARGN)
    cmake_path(GET source PARENT_PATH room)
    cmake_path(RELATIVE_PATH room BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" OUTPUT_VARIABLE room)
    if(room STREQUAL ".")
      set(room top)
    endif()
    foreach(rooms IN LISTS compiled_together)
      if("+${rooms}+" MATCHES "[+]${room}[+]")
        set(room "${rooms}")
      endif()
    endforeach()
    string(REGEX REPLACE "[/+]" "_" room "${room}")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${room}")
  endforeach()
endfunction()

function(anicodec_library name standard)
  add_library(anicodec_${name} STATIC ${ARGN})
  add_library(anicodec::${name} ALIAS anicodec_${name})
  target_compile_features(anicodec_${name} PUBLIC cxx_std_${standard})
  set_target_properties(anicodec_${name} PROPERTIES
    CXX_STANDARD ${standard} CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ${ANICODEC_PIC}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON UNITY_BUILD_MODE GROUP)
  target_link_libraries(anicodec_${name} PUBLIC $<BUILD_INTERFACE:anicodec_flags>)
  # clang also warns of promotions that are spelled out, and of unsigned offsets of iterators.
  target_compile_options(anicodec_${name} PRIVATE
    -Wconversion $<$<CXX_COMPILER_ID:GNU>:-Wsign-conversion -Wdouble-promotion>
    $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-sign-conversion>)
endfunction()
