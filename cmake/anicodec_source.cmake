# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_source(NAME PACKAGE VERSION SHA256 FOLDER): sets NAME_SOURCE to the source of a library that is no Debian package:
# FOLDER of a source package of PyPI, which pip brings once for all builds of a checkout; empty, with a warning, where that
# fails. A folder that -DANICODEC_NAME_SOURCE=FOLDER names is taken instead, on machines without a network, say.
function(anicodec_source name package version sha256 folder)
  set(ANICODEC_${name}_SOURCE "" CACHE PATH "Folder of the source of ${name}; empty: pip brings it")
  if(ANICODEC_${name}_SOURCE)
    set(${name}_SOURCE "${ANICODEC_${name}_SOURCE}" PARENT_SCOPE)
    return()
  endif()
  set(source "${PROJECT_SOURCE_DIR}/build/third_party/${package}-${version}")
  if(NOT EXISTS "${source}")
    message(STATUS "Bringing the source package ${package} ${version}")
    execute_process(COMMAND python3 "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/fetch_source.py" ${package} ${version} ${sha256}
      ${folder} "${source}" TIMEOUT 600 RESULT_VARIABLE result ERROR_VARIABLE text)
    if(NOT result EQUAL 0)
      message(WARNING "The build goes without ${name}; ANICODEC_${name}_SOURCE can name a folder of it:\n${text}")
      set(source "")
    endif()
  endif()
  set(${name}_SOURCE "${source}" PARENT_SCOPE)
endfunction()
