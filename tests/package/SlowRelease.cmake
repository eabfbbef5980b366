# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# What the preset release builds and installs, without a warning; the command runs.
cmake_policy(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(launcher "")
if(LAUNCHER)
  set(launcher "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
endif()
set(ENV{CXXFLAGS} "")
execute_process(COMMAND "${CMAKE_COMMAND}" --preset release -B "${WORK_DIR}/build" ${launcher}
    "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" -DANICODEC_WERROR=ON
    -DANICODEC_BUILD_TESTS=OFF -DANICODEC_BUILD_EXAMPLES=OFF
  WORKING_DIRECTORY "${SOURCE_DIR}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
run(_ "${CMAKE_COMMAND}" --build "${WORK_DIR}/build" --target installed)
run(version "${WORK_DIR}/build/tools/anicodec" --version)
message("release: ${version}")
