# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# The public headers compile alone, in every language that they promise. INCLUDE, ENCODER_INCLUDE: their folders;
# C_COMPILER, CXX_COMPILER, WORK_DIR.
include("${CMAKE_CURRENT_LIST_DIR}/../package/run.cmake")

# compile(COMPILER LANGUAGE STANDARD HEADER): a source that includes HEADER, twice, and nothing else.
function(compile compiler language standard header)
  set(source "${WORK_DIR}/${header}_${standard}.${language}")
  file(WRITE "${source}" "#include <anicodec/${header}>\n#include <anicodec/${header}>\n")
  run(unused "${compiler}" -std=${standard} -I "${INCLUDE}" -I "${ENCODER_INCLUDE}" -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
      -fsyntax-only "${source}")
endfunction()

foreach(header IN ITEMS anicodec.h play.h surface.h gpu.h stream.h encode.h)
  foreach(standard c99 c11)
    compile("${C_COMPILER}" c ${standard} ${header})
  endforeach()
  foreach(standard c++11 c++17 c++20)
    compile("${CXX_COMPILER}" cpp ${standard} ${header})
  endforeach()
endforeach()
foreach(standard c++17 c++20)
  compile("${CXX_COMPILER}" cpp ${standard} anicodec.hpp)
endforeach()
