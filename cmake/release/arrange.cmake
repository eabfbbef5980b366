# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Run by CPack on the installed components, before it packs them.
cmake_policy(VERSION 3.25)
set(root "${CPACK_TEMPORARY_DIRECTORY}")

# move(FROM TO PATTERN...): files below usr/.
function(move from to)
  foreach(pattern IN LISTS ARGN)
    file(GLOB_RECURSE files RELATIVE "${root}/${from}" "${root}/${from}/usr/${pattern}")
    foreach(file IN LISTS files)
      cmake_path(GET file PARENT_PATH folder)
      file(MAKE_DIRECTORY "${root}/${to}/${folder}")
      file(RENAME "${root}/${from}/${file}" "${root}/${to}/${file}")
    endforeach()
  endforeach()
endfunction()
move(dev sdk_library libanicodec.so.*)
move(dev codec_library libanicodec_encoder.so.*)

if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  string(TIMESTAMP now "%s")
  set(ENV{SOURCE_DATE_EPOCH} "${now}")
endif()
execute_process(COMMAND date -R "--date=@$ENV{SOURCE_DATE_EPOCH}" OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN ITEMS command sdk_library codec_library dev)
  string(TOUPPER "${component}" key)
  set(doc "${root}/${component}/usr/share/doc/${CPACK_DEBIAN_${key}_PACKAGE_NAME}")
  file(MAKE_DIRECTORY "${doc}")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/copyright" "${doc}/copyright" COPYONLY)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/../../CHANGELOG.md" "${doc}/changelog" COPYONLY)
  file(WRITE "${doc}/changelog.Debian" "anicodec (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) bookworm; \
urgency=medium\n\n  * Version ${CPACK_PACKAGE_VERSION}: see changelog.gz.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
endforeach()
file(GLOB pages "${root}/command/usr/share/man/man1/*.1" "${root}/*/usr/share/doc/*/changelog*")
execute_process(COMMAND gzip -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND find "${root}" -exec touch --no-dereference "--date=@$ENV{SOURCE_DATE_EPOCH}" {} +
  COMMAND_ERROR_IS_FATAL ANY)
