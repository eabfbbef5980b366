# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# cmake -DSOURCE_DIR=... -DWORK_DIR=... -P compare_builds.cmake
# Builds the spatial prediction with several compilers, optimisation levels, instruction sets and numbers of
# lanes, and runs each build: all must reconstruct the pinned hashes. Missing compilers are skipped by name.
set(sources format/memory.cpp sdk/prediction/mesh_graph.cpp sdk/prediction/vertex_order.cpp sdk/prediction/predictor.cpp sdk/prediction/prediction_portable.cpp tests/sdk/prediction_hash_main.cpp)
list(TRANSFORM sources PREPEND "${SOURCE_DIR}/")
file(MAKE_DIRECTORY "${WORK_DIR}")

set(failures 0)
function(check_build compiler)
  find_program(path_${compiler} ${compiler})
  if(NOT path_${compiler})
    message("${compiler} ${ARGN}: skipped, compiler not installed")
    return()
  endif()
  set(program "${WORK_DIR}/prediction_hash")
  execute_process(COMMAND ${path_${compiler}} -std=c++17 -ffp-contract=off -Wno-psabi "-I${SOURCE_DIR}"
                          ${ARGN} ${sources} -o ${program}
                  RESULT_VARIABLE result ERROR_VARIABLE text)
  if(result EQUAL 0)
    execute_process(COMMAND ${program} RESULT_VARIABLE result OUTPUT_VARIABLE text)
  endif()
  if(result EQUAL 0)
    message("${compiler} ${ARGN}: ok")
  else()
    message("${compiler} ${ARGN}: FAILED\n${text}")
    math(EXPR failures "${failures} + 1")
    set(failures ${failures} PARENT_SCOPE)
  endif()
endfunction()

execute_process(COMMAND uname -m OUTPUT_VARIABLE machine OUTPUT_STRIP_TRAILING_WHITESPACE)
set(avx2 "")
if(machine STREQUAL "x86_64")
  set(avx2 -mavx2)
  file(STRINGS /proc/cpuinfo avx512 REGEX "avx512f.*avx512vl" LIMIT_COUNT 1)
endif()
foreach(compiler g++ clang++)
  check_build(${compiler} -O0 -DANICODEC_LANES=8)
  check_build(${compiler} -O2 -DANICODEC_LANES=1)
  check_build(${compiler} -O3 -DANICODEC_LANES=4)
  check_build(${compiler} -O3 ${avx2} -DANICODEC_LANES=8)
  if(avx512)
    check_build(${compiler} -O3 -mavx2 -mavx512f -mavx512vl -DANICODEC_LANES=16)
  endif()
endforeach()
if(failures)
  message(FATAL_ERROR "${failures} builds differ")
endif()
