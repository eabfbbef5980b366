# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# The SDK without Draco, in scalar code: it neither needs nor contains them, plays what it can, and
# says what it cannot.
cmake_policy(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(build "${WORK_DIR}/build")
set(launcher "")
if(LAUNCHER)
  set(launcher "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
endif()
run(_ "${CMAKE_COMMAND}" -G Ninja -S "${SOURCE_DIR}" -B "${build}" ${launcher}
  "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" -DCMAKE_BUILD_TYPE=Debug
  -DANICODEC_WITH_DRACO=OFF -DANICODEC_LANES=1 -DCMAKE_UNITY_BUILD=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_draco=ON -DANICODEC_BUILD_ENCODER=OFF -DANICODEC_BUILD_TOOLS=OFF
  -DANICODEC_BUILD_TESTS=OFF)
run(_ "${CMAKE_COMMAND}" --build "${build}" --target anicodec_sdk_shared example_frame_to_obj_c)
file(GLOB_RECURSE library "${build}/sdk/*libanicodec.so")
needed_libraries("${library}" needed)
if("libdraco" IN_LIST needed)
  message(FATAL_ERROR "needs ${needed}")
endif()
run(symbols nm -C "${library}")
if(symbols MATCHES "draco::")
  message(FATAL_ERROR "contains ${CMAKE_MATCH_0}")
endif()

set(program "${build}/sdk/examples/example_frame_to_obj_c")
set(clips "${SOURCE_DIR}/tests/conformance")
# All but key-frames by Draco, among them one that default settings made.
foreach(clip soup polygons_all quad_box_corrected limb_effort9 uneven_times heated schedules limb_native
             limb_default)
  run(obj "${program}" "${clips}/${clip}.anic")
  if(NOT obj MATCHES "^v .*\nf [0-9 ]+\n$")
    message(FATAL_ERROR "no OBJ of ${clip}: ${obj}")
  endif()
endforeach()
execute_process(COMMAND "${program}" "${clips}/nonmanifold_keyframes.anic"
  RESULT_VARIABLE result ERROR_VARIABLE text)
if(result EQUAL 0 OR NOT text MATCHES "needs feature 1 .key-frames by[ \n]+Draco")
  message(FATAL_ERROR "${result}: ${text}")
endif()
message("without Draco: needs ${needed}")
