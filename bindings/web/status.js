// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors

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
