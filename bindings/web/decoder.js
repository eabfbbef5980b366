// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// One clip in one instance of the WebAssembly module: what binding/web.c exports, with errors as exceptions. Dropping the
// instance gives all of its memory back, and a decoder that ran out of memory takes only its own clip with it.
import { FAILURE, OPEN_BOUNDS, OPEN_INEXACT, OPEN_IN_PLACE, STATUS, STREAM_INFO } from './interface.js';
import { AnicError } from './status.js';

function flagsOf({ bounds, inPlace, inexact }) {
  return (bounds ? OPEN_BOUNDS : 0) | (inPlace ? OPEN_IN_PLACE : 0) | (inexact ? OPEN_INEXACT : 0);
}
const text = new TextDecoder();

/** Bytes of a number, and how it is read. */
const NUMBERS = {
  bool: [1, (view, at) => view.getUint8(at) !== 0],
  i16: [2, (view, at) => view.getInt16(at, true)],
  i32: [4, (view, at) => view.getInt32(at, true)],
  u32: [4, (view, at) => view.getUint32(at, true)],
  u64: [8, (view, at) => Number(view.getBigUint64(at, true))],
  f32: [4, (view, at) => view.getFloat32(at, true)],
  f64: [8, (view, at) => view.getFloat64(at, true)],
  ratio: [8, (view, at) => view.getUint32(at, true) / (view.getUint32(at + 4, true) || 1)],
};

export class Decoder {
  /** An empty decoder. progress(share) may return true to stop an opening. */
  static async create(module, progress) {
    const decoder = new Decoder();
    const imports = {
      env: {
        emscripten_notify_memory_growth() {},
        web_progress: (done) => (progress?.(done) ? 1 : 0),
      },
      wasi_snapshot_preview1: {
        proc_exit() { throw new WebAssembly.RuntimeError('the decoder stopped'); },
      },
    };
    const instance = await WebAssembly.instantiate(module, imports);
    decoder.module = module;
    decoder.wasm = Object.fromEntries(Object.entries(instance.exports).map(([name, one]) => [name.replace(/^web_/, ''), one]));
    decoder.memory = instance.exports.memory;
    decoder.wasm._initialize();
    decoder.resultAt = decoder.wasm.result();
    return decoder;
  }

  /** A decoder with the memory of another one of the same module, in this thread or another one. */
  static async from({ module, memory }) {
    const decoder = await Decoder.create(module);
    const more = memory.byteLength - decoder.memory.buffer.byteLength;
    if (more > 0)
      decoder.memory.grow(more / 65536);
    new Uint8Array(decoder.memory.buffer).set(new Uint8Array(memory));
    return decoder;
  }

  /** Everything that from() needs; the memory is a copy, to be transferred. */
  snapshot() {
    return { module: this.module, memory: this.memory.buffer.slice(0) };
  }

  /** Calls an export. One that stops the module for good says so in the error. */
  run(name, ...values) {
    if (!this.wasm)
      throw new AnicError('ANIC_E_STATE', 'the clip is closed');
    try {
      return this.wasm[name](...values);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError) && !(error instanceof RangeError))
        throw error;
      const memory = this.wasm.is_without_memory();
      this.close();
      throw memory ? new AnicError('ANIC_E_MEMORY', 'the browser gives no more memory')
        : new AnicError('ANIC_E_INTERNAL', `the decoder stopped: ${error.message}`);
    }
  }

  /** Calls an export that returns a status. */
  call(name, ...values) {
    const status = this.run(name, ...values);
    if (status !== 0)
      throw this.error(status);
  }

  error(status) {
    return new AnicError(STATUS[status] ?? `status ${status}`, this.string(this.wasm.status_text(status)));
  }

  /** The failure of an opening: with the place in the file. */
  failure(status) {
    const { detail, offset, chunk } = this.read(FAILURE, this.wasm.failure());
    const what = detail || this.string(this.wasm.status_text(status));
    const error = new AnicError(STATUS[status] ?? `status ${status}`, chunk ? `${what} (chunk ${chunk}, byte ${offset})` : what,
      { chunk, offset });
    // The full module has geometry interpolation and exact positions, and no other feature.
    error.needsFullModule = error.status === 'ANIC_E_FEATURE' && (detail.includes('feature 2 ') || !detail.includes('needs feature'));
    return error;
  }

  /** A struct of interface.js, by default the one that the last call left. */
  read({ fields }, at = this.resultAt) {
    const view = new DataView(this.memory.buffer);
    const one = (kind, place) => {
      if (kind === 'text')
        return this.string(view.getUint32(place, true));
      if (kind === 'chars')
        return this.string(place);
      if (kind.fields)
        return this.read(kind, place);
      if (Array.isArray(kind)) {
        const number = view.getInt32(place, true);
        return number in kind ? kind[number] : number;
      }
      return NUMBERS[kind][1](view, place);
    };
    return Object.fromEntries(fields.map(([name, kind, offset, count]) => {
      const size = kind.size ?? NUMBERS[kind]?.[0];
      return [name, count ? Array.from({ length: count }, (_, i) => one(kind, at + offset + i * size)) : one(kind, at + offset)];
    }));
  }

  /** The numbers that the last call left, where it left no struct. */
  numbers(count) {
    return new Uint32Array(this.memory.buffer, this.resultAt, count);
  }

  /** A typed array over the module's memory; good until memory grows. */
  view(Type, address, length) {
    return length > 0 ? new Type(this.memory.buffer, address, length) : new Type(0);
  }

  string(address) {
    if (!address)
      return '';
    const bytes = new Uint8Array(this.memory.buffer);
    return text.decode(bytes.slice(address, bytes.indexOf(0, address)));
  }

  allocate(size) {
    const address = this.run('allocate', size);
    if (!address)
      throw new AnicError('ANIC_E_MEMORY', 'the browser gives no more memory');
    return address;
  }

  /** Runs body(address of a copy of the bytes). */
  withBytes(bytes, body) {
    const address = this.allocate(bytes.byteLength);
    try {
      new Uint8Array(this.memory.buffer).set(bytes, address);
      return body(address);
    } finally {
      this.wasm?.release(address);
    }
  }

  /** Names the clips that will be opened; none: all. */
  #choose(clips) {
    if (!clips)
      return;
    const names = new TextEncoder().encode(clips.map((name) => `${name}\0`).join('')), at = this.allocate(names.length);
    new Uint8Array(this.memory.buffer).set(names, at);
    this.call('choose_clips', at, names.length);
  }

  /** Opens a whole file. */
  open(bytes, { quality = 1, bounds = true, maxBytes = 0, clips = undefined, inPlace = false, inexact = false } = {}) {
    this.#choose(clips);
    const status = this.withBytes(bytes, (at) => this.run('open', at, bytes.byteLength, quality, flagsOf({ bounds, inPlace, inexact }), maxBytes));
    if (status !== 0)
      throw this.failure(status);
  }

  beginStream({ quality = 1, bounds = true, maxBytes = 0, clips = undefined, inPlace = false, inexact = false } = {}) {
    this.#choose(clips);
    this.call('stream_begin', quality, flagsOf({ bounds, inPlace, inexact }), maxBytes);
  }

  /** Takes the next bytes, and tells how far the file is. */
  push(bytes) {
    return this.#arrived(this.withBytes(bytes, (at) => this.run('stream_push', at, bytes.byteLength)));
  }

  /** Turns to the next file of a live stream, and tells how far that is. */
  advance() {
    return this.#arrived(this.run('stream_advance'));
  }

  #arrived(status) {
    if (status !== 0)
      throw this.failure(status);
    this.call('stream_info');
    const { receivedBytes, fileBytes, playable, layers, arrivedLayers, complete } = this.read(STREAM_INFO);
    // A page opens once before the end: with a layer, where there are any.
    return { received: receivedBytes, size: fileBytes, playable: playable && (arrivedLayers > 0 || layers === 0), complete };
  }

  /** Opens what has arrived. */
  openStream() {
    const status = this.run('stream_open');
    if (status !== 0)
      throw this.failure(status);
  }

  endStream() {
    this.run('stream_end');
  }

  close() {
    this.wasm = this.memory = this.module = undefined;
  }
}
