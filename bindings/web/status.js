// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Statuses of anicodec.h by number.
export const STATUS = {
  1: 'ANIC_E_ARGUMENT', 2: 'ANIC_E_STATE', 3: 'ANIC_E_BUFFER_SIZE', 4: 'ANIC_E_FRAME_RANGE', 5: 'ANIC_E_ABSENT',
  10: 'ANIC_E_MAGIC', 11: 'ANIC_E_VERSION', 12: 'ANIC_E_FEATURE',
  20: 'ANIC_E_TRUNCATED', 21: 'ANIC_E_HEADER', 22: 'ANIC_E_HEADER_CHECKSUM', 23: 'ANIC_E_CHUNK_BOUNDS',
  24: 'ANIC_E_CHUNK_CHECKSUM', 25: 'ANIC_E_CHUNK_DUPLICATE', 26: 'ANIC_E_CHUNK_MISSING', 27: 'ANIC_E_CHUNK_UNKNOWN',
  29: 'ANIC_E_TRAILING_BYTES', 30: 'ANIC_E_FILE_SIZE',
  40: 'ANIC_E_RECORD', 41: 'ANIC_E_ENTROPY', 42: 'ANIC_E_ZSTD', 43: 'ANIC_E_TOPOLOGY', 44: 'ANIC_E_INDEX_RANGE',
  45: 'ANIC_E_QUANTIZER', 46: 'ANIC_E_NON_FINITE', 47: 'ANIC_E_DRACO', 48: 'ANIC_E_SEGMENT', 49: 'ANIC_E_HASH',
  50: 'ANIC_E_MESHES',
  51: 'ANIC_E_SEGMENT_MISSING',
  60: 'ANIC_E_LIMIT', 70: 'ANIC_E_MEMORY', 71: 'ANIC_E_READ', 72: 'ANIC_E_CANCELLED', 90: 'ANIC_E_INTERNAL',
};

/** An error, with the name of the status, and in a file the chunk and the byte offset. */
export class AnicError extends Error {
  constructor(status, text, { chunk = '', offset = 0 } = {}) {
    super(text);
    this.name = 'AnicError';
    this.status = status;
    this.chunk = chunk;
    this.offset = offset;
  }
}
