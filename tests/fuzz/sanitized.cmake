# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# The fuzz tests once more, under the address and undefined-behaviour sanitizers: by clang where it has them,
# as it takes half of the time that GCC takes to compile such code.
cmake_policy(VERSION 3.25)
include("${SOURCE_DIR}/tests/package/run.cmake")
find_program(clang NAMES clang++ clang++-14)
if(clang)
  file(WRITE "${WORK_DIR}/empty.cpp" "int main() {}\n")
  execute_process(COMMAND "${clang}" -fsanitize=address,undefined "${WORK_DIR}/empty.cpp" -o "${WORK_DIR}/empty"
                  RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
  if(result EQUAL 0)
    set(CXX_COMPILER "${clang}")
    string(REPLACE "clang++" "clang" C_COMPILER "${clang}")
  endif()
endif()
message("compiled by ${CXX_COMPILER}")
set(launcher "")
if(LAUNCHER)
  set(launcher "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
endif()
# A third of the time to link.
set(linker "")
find_program(gold ld.gold)
if(gold)
  set(linker -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=gold)
endif()
run(_ "${CMAKE_COMMAND}" --preset asan -S "${SOURCE_DIR}" -B "${WORK_DIR}" ${launcher}
  "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" ${linker}
  -DANICODEC_LANES=8  # one source of kernels instead of four: they differ in lanes alone
  "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -DNDEBUG" -DCMAKE_UNITY_BUILD=ON -DANICODEC_BUILD_EXAMPLES=OFF -DANICODEC_INSTALL=OFF)
run(_ "${CMAKE_COMMAND}" --build "${WORK_DIR}" --target fuzz_tests)
run(_ "${CMAKE_CTEST_COMMAND}" --test-dir "${WORK_DIR}" -L "^fuzz$" -LE slow --no-tests=error --output-on-failure)
