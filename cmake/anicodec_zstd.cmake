# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# anicodec_zstd: zstd's decompressor from its source, for machines without a library of it. xxHash is a header in there.
if(NOT EXISTS "${ANICODEC_ZSTD_SOURCE}/zstd.h")
  message(FATAL_ERROR "ANICODEC_ZSTD_SOURCE: there is no zstd.h in ${ANICODEC_ZSTD_SOURCE}; preset wasm wants `npm ci` in bindings/web")
endif()
set(sources common/debug common/entropy_common common/error_private common/fse_decompress common/xxhash common/zstd_common
  decompress/huf_decompress decompress/zstd_ddict decompress/zstd_decompress decompress/zstd_decompress_block)
list(TRANSFORM sources REPLACE "(.+)" "${ANICODEC_ZSTD_SOURCE}/\\1.c")
add_library(anicodec_zstd STATIC ${sources})
set_target_properties(anicodec_zstd PROPERTIES C_VISIBILITY_PRESET hidden POSITION_INDEPENDENT_CODE ${ANICODEC_PIC})
target_include_directories(anicodec_zstd SYSTEM PUBLIC "${ANICODEC_ZSTD_SOURCE}" "${ANICODEC_ZSTD_SOURCE}/common")
# Blocks are small and opened once: the shorter of its decoders.
target_compile_definitions(anicodec_zstd PRIVATE ZSTD_DISABLE_ASM ZSTD_NO_TRACE ZSTD_STRIP_ERROR_STRINGS ZSTD_NO_INLINE
  HUF_FORCE_DECOMPRESS_X1 ZSTD_FORCE_DECOMPRESS_SEQUENCES_SHORT
  # Its functions are nobody else's: not every linker can hide what is visible.
  ZSTDLIB_VISIBLE= ZSTDERRORLIB_VISIBLE=)
