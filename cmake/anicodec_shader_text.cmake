# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_shader_text(TARGET): lets the sources of a target include "anicodec_play.inc", the text of the shader
# sdk/shaders/anicodec_play.glsl as string literals of C, a line each, without its comments.
function(anicodec_shader_text target)
  set(file "${PROJECT_SOURCE_DIR}/sdk/shaders/anicodec_play.glsl")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(READ "${file}" text)
  string(REGEX REPLACE "[ \t]*//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n+" "\n" text "${text}")
  string(REGEX REPLACE "^\n" "" text "${text}")
  string(REGEX REPLACE "([^\n]*)\n" "\"\\1\\\\n\"\n" text "${text}")
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/sdk/shaders/anicodec_play.inc" CONTENT "${text}" @ONLY)
  target_include_directories(${target} PRIVATE "${PROJECT_BINARY_DIR}/sdk/shaders")
endfunction()
