# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Writes the manual and the completions of a built command under PREFIX.
#   cmake -DCOMMAND=anicodec -DPREFIX=/usr/local -P install_pages.cmake
function(write_page file)
  execute_process(COMMAND "${COMMAND}" ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE "${PREFIX}/share/${file}" "${text}")
  message(STATUS "Installing: ${PREFIX}/share/${file}")
  set(text "${text}" PARENT_SCOPE)
endfunction()

write_page(man/man1/anicodec.1 manual)
# Each command has a line there: ".BR anicodec\-massage\-fit (1)".
string(REGEX MATCHALL "anicodec\\\\-[a-z\\-]+ \\(1\\)" names "${text}")
foreach(name IN LISTS names)
  string(REGEX REPLACE " .*" "" name "${name}")
  string(REPLACE "\\-" "-" name "${name}")
  string(REGEX REPLACE "^anicodec-" "" command "${name}")
  # massage-fit is a mode of massage, export-vat a command.
  execute_process(COMMAND "${COMMAND}" help "${command}" RESULT_VARIABLE is_mode OUTPUT_QUIET ERROR_QUIET)
  if(is_mode)
    string(REPLACE "-" ";" command "${command}")
  endif()
  write_page(man/man1/${name}.1 manual ${command})
endforeach()
write_page(bash-completion/completions/anicodec completion bash)
write_page(zsh/site-functions/_anicodec completion zsh)
write_page(fish/vendor_completions.d/anicodec.fish completion fish)
