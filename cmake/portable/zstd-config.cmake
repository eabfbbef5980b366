# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
include("${CMAKE_CURRENT_LIST_DIR}/static_libraries.cmake")
