# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Debian packages by CPack: what the components command, sdk and codec install; arrange.cmake takes libraries into packages of
# their own, as programs that were linked with different versions need.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME anicodec)
set(CPACK_PACKAGE_CONTACT "The anicodec authors <anicodec@localhost>")
set(CPACK_PACKAGE_FILE_NAME anicodec)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY >=)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${ANICODEC_HOMEPAGE}")
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/arrange.cmake")

# anicodec_package(COMPONENT-OR-GROUP NAME SECTION TITLE TEXT)
function(anicodec_package component name section title text)
  string(TOUPPER "${component}" key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${title}\n${text}" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()
set(CPACK_COMPONENTS_ALL "")
set(about "An animated mesh has fixed connectivity and moving vertices: a baked\ncharacter, cloth, a capture. anicodec \
stores it in a small .anic file\nwith an error bound at every vertex; any frame decodes at the same cost.")
anicodec_package(command anicodec graphics "compressed animated meshes: encoder, decoder, viewer"
  "${about}\n.\nThe command encodes, decodes, compares and renders, and makes pages that\nplay a clip in a browser.")
anicodec_package(sdk_library libanicodec1 libs "compressed animated meshes: decoder" "${about}\n.\nThe library that plays clips.")
anicodec_package(codec_library libanicodec-encoder1.0 libs "compressed animated meshes: encoder"
  "${about}\n.\nThe library that makes clips.")
anicodec_package(dev libanicodec-dev libdevel "compressed animated meshes: headers of the libraries"
  "${about}\n.\nHeaders, static library, and files of CMake and pkg-config.")
set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libanicodec1 (= ${version}), libanicodec-encoder1.0 (= ${version})")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libzstd-dev, libdraco-dev")
# One package of two components, as both are headers.
list(REMOVE_ITEM CPACK_COMPONENTS_ALL dev)
list(APPEND CPACK_COMPONENTS_ALL sdk codec)
set(CPACK_COMPONENT_SDK_GROUP dev)
set(CPACK_COMPONENT_CODEC_GROUP dev)
set(CPACK_COMPONENT_GROUP_DEV_DESCRIPTION "${CPACK_COMPONENT_DEV_DESCRIPTION}")

file(WRITE "${PROJECT_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
# Components that arrange.cmake fills.
foreach(component sdk_library codec_library)
  install(CODE "" COMPONENT ${component} EXCLUDE_FROM_ALL)
  string(TOUPPER "${component}" key)
  set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/triggers")
endforeach()
include(CPack)
