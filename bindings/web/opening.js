// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Opens a file in the thread that runs this: bytes come in, decoders come out, coarse ones first.
import { Decoder } from './decoder.js';
import { AnicError } from './status.js';
import { loadModule } from './module.js';

/**
 * The file as it arrives: push() bytes, then end(). onDecoder(decoder, complete) gets what plays; a decoder that is not
 * complete goes on, so whoever plays by it takes a copy before the promise it returns resolves.
 */
export class Opening {
  constructor({ quality, bounds, maxBytes, clips, inPlace, inexact, progressive = false, kind = 'small', onProgress, isCancelled, onDecoder }) {
    this.options = { quality, bounds, maxBytes, clips, inPlace, inexact };
    Object.assign(this, { progressive, kind, onProgress, isCancelled, onDecoder });
    this.pieces = [];
    this.played = false;
    this.complete = false;
  }

  async decoder() {
    return Decoder.create(await loadModule(this.kind), (done) => {
      this.onProgress?.(done);
      return this.isCancelled?.() ?? false;
    });
  }

  async push(bytes) {
    this.pieces.push(bytes);
    if (!this.progressive)
      return;
    this.stream ??= await this.startStream();
    const { playable, complete } = await this.pushToStream(bytes);
    this.complete = complete;
    if (playable && !complete && !this.played) {
      this.played = true;
      await this.withFullModule(async () => {
        this.stream.openStream();
        await this.onDecoder(this.stream, false);
      });
    }
  }

  async startStream() {
    const decoder = await this.decoder();
    decoder.beginStream(this.options);
    return decoder;
  }

  async pushToStream(bytes) {
    try {
      return this.stream.push(bytes);
    } catch (error) {
      if (!error.needsFullModule || this.kind !== 'small')
        throw error;
      this.kind = 'full';
      return this.restartStream();
    }
  }

  /** A new stream that has got everything so far. */
  async restartStream() {
    this.stream = await this.startStream();
    let state;
    for (const piece of this.pieces)
      state = this.stream.push(piece);
    return state;
  }

  /** Runs body, and once more with the module that reads everything if the file asks for it. */
  async withFullModule(body) {
    try {
      return await body();
    } catch (error) {
      if (!error.needsFullModule || this.kind !== 'small')
        throw error;
      this.kind = 'full';
      if (this.stream)
        await this.restartStream();
      return body();
    }
  }

  async end() {
    if (this.played && this.complete)
      return this.refine();
    this.stream = undefined;
    const size = this.pieces.reduce((sum, piece) => sum + piece.byteLength, 0);
    let bytes = this.pieces[0] ?? new Uint8Array(0);
    if (this.pieces.length > 1) {
      bytes = new Uint8Array(size);
      let at = 0;
      for (const piece of this.pieces) {
        bytes.set(piece, at);
        at += piece.byteLength;
      }
    }
    this.pieces = [bytes];
    await this.withFullModule(async () => {
      const decoder = await this.decoder();
      decoder.open(bytes, this.options);
      await this.onDecoder(decoder, true);
    });
  }

  /** Opens the rest of what was opened coarsely: the stream has kept its meshes. */
  async refine() {
    await this.withFullModule(async () => {
      this.stream.openStream();
      this.stream.endStream();
      await this.onDecoder(this.stream, true);
    });
  }
}

/** An error as a message to another thread, and back. */
export const packError = (error) => ({ name: error.name, message: error.message, status: error.status, chunk: error.chunk, offset: error.offset });
export const unpackError = ({ name, message, status, chunk, offset }) =>
  (name === 'AnicError' ? new AnicError(status, message, { chunk, offset }) : new Error(message));
