# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors

# run(OUTPUT COMMAND...): a command that must succeed; OUTPUT receives what it printed.
function(run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nfailed: ${result}\n${text}${errors}")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# needed_libraries(FILE OUT): the libraries that a shared library wants, without their versions.
function(needed_libraries file out)
  run(text readelf -d "${file}")
  string(REGEX REPLACE "[][]" ":" text "${text}")  # brackets would glue a list together
  string(REGEX MATCHALL "NEEDED[^\n:]*:[^\n:]*:[^:.]*" lines "${text}")
  list(TRANSFORM lines REPLACE ".*:" "")
  list(SORT lines)
  set(${out} "${lines}" PARENT_SCOPE)
endfunction()
