# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# cmake -DSOURCE_DIR=... -DWORK_DIR=... -P compare_builds.cmake
# Builds the kernels of the spatial prediction with several compilers, optimisation levels, instruction sets and numbers
# of lanes, and runs each build: all must reconstruct the pinned hashes. Missing compilers are skipped by name.
cmake_policy(VERSION 3.25)
set(kernels "${SOURCE_DIR}/sdk/prediction/prediction_portable.cpp")
set(others format/memory.cpp sdk/prediction/mesh_graph.cpp sdk/prediction/vertex_order.cpp sdk/prediction/predictor.cpp
  tests/sdk/prediction_hash_main.cpp)
list(TRANSFORM others PREPEND "${SOURCE_DIR}/")

set(failures 0)
# check_builds(COMPILER OPTIONS...): one build for each of OPTIONS; what is not a kernel is compiled once.
function(check_builds compiler)
  find_program(path_${compiler} ${compiler})
  if(NOT path_${compiler})
    message("${compiler}: skipped, not installed")
    return()
  endif()
  set(folder "${WORK_DIR}/${compiler}")
  file(MAKE_DIRECTORY "${folder}")
  set(compile ${path_${compiler}} -std=c++17 -ffp-contract=off -Wno-psabi "-I${SOURCE_DIR}")
  execute_process(COMMAND ${compile} -O2 -c ${others} WORKING_DIRECTORY "${folder}" COMMAND_ERROR_IS_FATAL ANY)
  list(TRANSFORM others REPLACE "^.*/(.*)\\.cpp$" "\\1.o" OUTPUT_VARIABLE objects)
  foreach(options IN LISTS ARGN)
    separate_arguments(words UNIX_COMMAND "${options}")
    execute_process(COMMAND ${compile} ${words} "${kernels}" ${objects} -o prediction_hash
                    WORKING_DIRECTORY "${folder}" RESULT_VARIABLE result ERROR_VARIABLE text)
    if(result EQUAL 0)
      execute_process(COMMAND "${folder}/prediction_hash" RESULT_VARIABLE result OUTPUT_VARIABLE text)
    endif()
    if(result EQUAL 0)
      message("${compiler} ${options}: ok")
    else()
      message("${compiler} ${options}: FAILED\n${text}")
      math(EXPR failures "${failures} + 1")
    endif()
  endforeach()
  set(failures ${failures} PARENT_SCOPE)
endfunction()

# -O3 only once per instruction set: kernels take three times as long to compile as with -O2.
set(builds "-O0 -DANICODEC_LANES=8" "-O2 -DANICODEC_LANES=1" "-O2 -DANICODEC_LANES=4")
set(wide -O3)
execute_process(COMMAND uname -m OUTPUT_VARIABLE machine OUTPUT_STRIP_TRAILING_WHITESPACE)
if(machine STREQUAL "x86_64")
  file(STRINGS /proc/cpuinfo avx2 REGEX " avx2" LIMIT_COUNT 1)
  file(STRINGS /proc/cpuinfo avx512 REGEX "avx512f.*avx512vl" LIMIT_COUNT 1)
  if(avx2)
    set(wide "-O3 -mavx2")
  endif()
  if(avx512)
    list(APPEND builds "-O3 -mavx2 -mavx512f -mavx512vl -DANICODEC_LANES=16")
  endif()
endif()
list(APPEND builds "${wide} -DANICODEC_LANES=8")
check_builds(g++ ${builds})
check_builds(clang++ ${builds})
if(failures)
  message(FATAL_ERROR "${failures} builds differ")
endif()
