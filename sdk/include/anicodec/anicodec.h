/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * All of the decoder. A host that opens, seeks and writes frames needs play.h alone, which says what
 * holds for all; the others stand on it.
 */
#ifndef ANICODEC_ANICODEC_H_
#define ANICODEC_ANICODEC_H_

/* In the order of reading. */
/* clang-format off */
#include <anicodec/play.h>    /* open, seek, write */
#include <anicodec/surface.h> /* normals, rays, vertices for rendering, morphing */
#include <anicodec/gpu.h>     /* textures, and numbers for shaders */
#include <anicodec/stream.h>  /* files that arrive in pieces */
/* clang-format on */

#endif /* ANICODEC_ANICODEC_H_ */
