# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Installs the SDK of a finished build and uses it from there: what it needs and exports, a C99 and a C++17
# project by find_package, shared and static, and a compiler with the flags of pkg-config.
cmake_policy(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
file(REMOVE_RECURSE "${WORK_DIR}")
set(prefix "${WORK_DIR}/prefix")
run(_ "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}" --component sdk)
file(GLOB library "${prefix}/lib*/libanicodec.so" "${prefix}/lib/*/libanicodec.so")
cmake_path(GET library PARENT_PATH library_dir)
if(NOT EXISTS "${library_dir}/libanicodec.a")
  message(FATAL_ERROR "no libraries in ${prefix}")
endif()

# Nothing but the compiler's libraries, zstd and Draco.
needed_libraries("${library}" needed)
set(allowed libc libdraco libgcc_s libm libstdc++ libzstd ld-linux-x86-64 ld-linux-aarch64)
if(NOT FLAGS MATCHES "sanitize")
  foreach(name IN LISTS needed)
    if(NOT name IN_LIST allowed)
      message(FATAL_ERROR "libanicodec.so needs ${name}")
    endif()
  endforeach()
endif()

# Exactly the functions of the header.
file(READ "${prefix}/include/anicodec/anicodec.h" header)
string(REGEX MATCHALL "ANIC_API [^;(]*[ *]anic_[a-z_]+\\(" declared "${header}")
list(TRANSFORM declared REPLACE ".*[ *](anic_[a-z_]+)\\($" "\\1")
list(SORT declared)
run(symbols nm -D --defined-only "${library}")
string(REGEX MATCHALL "[^ \n]+\n" exported "${symbols}")
list(TRANSFORM exported STRIP)
list(TRANSFORM exported REPLACE "@.*" "")
list(SORT exported)
list(LENGTH declared count)
if(count LESS 30 OR NOT declared STREQUAL exported)
  message(FATAL_ERROR "declared: ${declared}\nexported: ${exported}")
endif()
message("${count} functions exported; needs ${needed}")

set(clip "${SOURCE_DIR}/tests/conformance/limb_effort9.anic")
set(examples "${SOURCE_DIR}/sdk/examples")
foreach(static OFF ON)
  set(consumer "${WORK_DIR}/consumer_${static}")
  run(_ "${CMAKE_COMMAND}" -G Ninja -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${consumer}"
    "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
    "-DCMAKE_C_FLAGS=${FLAGS}" "-DCMAKE_CXX_FLAGS=${FLAGS}" "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DEXAMPLES=${examples}" -DANICODEC_STATIC=${static})
  run(_ "${CMAKE_COMMAND}" --build "${consumer}")
  foreach(program in_c in_cpp)
    run(text "${consumer}/${program}" "${clip}")
    message("${program}, static ${static}: plays")
  endforeach()
endforeach()

find_program(pkg_config pkg-config)
if(NOT pkg_config)
  message("pkg-config is not installed: not tried")
  return()
endif()
set(ENV{PKG_CONFIG_PATH} "${library_dir}/pkgconfig")
separate_arguments(build_flags UNIX_COMMAND "${FLAGS}")
foreach(kind "" --static)
  run(flags pkg-config ${kind} --cflags --libs anicodec)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  if(kind)  # the archive, beside which the shared library lies
    list(TRANSFORM flags REPLACE "^-lanicodec$" "-l:libanicodec.a")
  endif()
  set(program "${WORK_DIR}/by_pkg_config${kind}")
  run(_ ${C_COMPILER} -std=c99 ${build_flags} "${examples}/frame_to_obj.c" -o "${program}" ${flags})
  run(obj ${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${library_dir}" "${program}" "${clip}")
  if(NOT obj MATCHES "^v .*\nf [0-9 ]+\n$")
    message(FATAL_ERROR "no OBJ: ${obj}")
  endif()
  message("pkg-config ${kind}: plays")
endforeach()
