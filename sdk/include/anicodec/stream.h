/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Files that arrive in pieces, and live streams.
 */
#ifndef ANICODEC_STREAM_H_
#define ANICODEC_STREAM_H_

#include <anicodec/play.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- streams --------------------------------------------------------------------------------- */

/**
 * A file that arrives from the front, piece by piece; of a live stream, one file after the other. Spec: 05, sections 7
 * and 8.
 */
typedef struct anic_stream anic_stream;

/**
 * Makes a stream.
 *
 * - Params: options: as for anic_open_asset(), kept for the assets that are made; may be NULL
 * - Errors: ANIC_E_MEMORY, ANIC_E_ARGUMENT
 */
ANIC_API anic_status anic_create_stream(const anic_options* options, anic_stream** out);

/** NULL is allowed. Assets made from the stream live on. */
ANIC_API void anic_destroy_stream(anic_stream* stream);

/** How much of a file has arrived, in a live stream of the one at hand. */
typedef struct anic_stream_info {
  size_t struct_size;
  uint64_t received_bytes;
  uint64_t file_bytes;        /**< 0 while the header is not there */
  uint32_t segment_count;     /**< 0 while the head is not there */
  uint32_t playable_segments; /**< segments that can be opened, coarsely at least */
  uint32_t layers;            /**< chunks with components of the bases of all segments */
  uint32_t arrived_layers;
  uint8_t playable; /**< anic_open_asset_from_stream() gives an asset that plays at least one
                       segment of positions, by its base while arrived_layers is 0 */
  uint8_t complete;
  uint32_t file_number;   /**< in a live stream, from 0 on */
  uint64_t waiting_bytes; /**< that follow the file: they are of the next ones of a live stream */
} anic_stream_info;

/**
 * Takes the next bytes of the file, and checks everything as soon as it is there: a stream that
 * cannot become a good file, or that breaks the limits, fails at once and stays failed. Bytes of the next
 * file of a live stream wait until anic_advance_stream().
 *
 * - Errors: those of anic_open_asset() that concern header, table, limits and checksums;
 *   ANIC_E_TRAILING_BYTES: what follows the file begins no other one
 * - Memory: file_bytes, once the head is there, and waiting_bytes; more once an asset was opened
 * - Cost: O(size), checksums included
 */
ANIC_API anic_status anic_push_bytes(anic_stream* stream, const void* bytes, size_t size);

/**
 * Turns to the next file of a live stream: what anicodec encode --live writes, a file for each second or so,
 * of which all but the first leave out their meshes. Its clip has the time at which it begins (anic_clip.start_time).
 * Open the file at hand before; the stream gives its bytes up, and keeps those of the meshes. Files
 * of a stream that learns continue the files before them: after a file that was lost, or not opened
 * when it was complete, the following ones are refused with ANIC_E_SEGMENT_MISSING up to the next
 * that begins anew.
 *
 * - Errors: ANIC_E_STATE: the file is not complete; those of anic_push_bytes(), of the bytes that waited
 * - Cost: O(waiting bytes)
 */
ANIC_API anic_status anic_advance_stream(anic_stream* stream);

/** - Errors: ANIC_E_ARGUMENT */
ANIC_API anic_status anic_get_stream_info(const anic_stream* stream, anic_stream_info* out);

/**
 * Tells what went wrong, as anic_open_asset() does; out->status is ANIC_OK if nothing did.
 *
 * - Errors: ANIC_E_ARGUMENT
 */
ANIC_API anic_status anic_get_stream_failure(const anic_stream* stream, anic_failure* out);

/**
 * Opens what has arrived: the segments whose base can be decoded, with all layers that follow
 * without a gap. info.partial tells whether anything is missing. The asset of a complete
 * stream is the same, bit for bit, as that of the whole file. Assets that were made before stay as
 * they are: replace them when their contexts can be replaced.
 *
 * A stream that is not complete, or live, keeps the faces, attributes, poses and orders of vertices of the meshes that
 * it opened, where max_bytes allows it, so that the next asset of them opens sooner; and what the last complete files
 * of a live stream have learnt.
 *
 * - Errors: ANIC_E_STATE: nothing is playable yet; others as anic_open_asset()
 * - Memory: that of the asset; until the stream goes, what the asset keeps of its meshes, 12 bytes more for each
 *   triangle, and 113 for each vertex; of a stream that learns, up to 1468 more for each vertex
 * - Cost: that of opening what is there, all layers from the first one on, the meshes once: do it when it is worth it,
 *   not at every push
 */
ANIC_API anic_status anic_open_asset_from_stream(anic_stream* stream, anic_asset** out,
                                                 anic_failure* failure);

#ifdef __cplusplus
}
#endif

#endif /* ANICODEC_STREAM_H_ */
