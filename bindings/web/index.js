// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import { Clip } from './clip.js';
import { Decoder } from './decoder.js';
import { BOX } from './interface.js';
import { Opening, unpackError } from './opening.js';
import { isNode, loadModule, provideModule } from './module.js';
import { AnicError } from './status.js';

export { AnicError, Clip, provideModule };

function aborted(signal) {
  return signal.reason ?? new DOMException('The opening was aborted', 'AbortError');
}

/** An error that names the address of its source: servers answer wrong ones by pages of their own, too. */
function named(error, source) {
  const address = String(source?.url ?? source);
  const isAddress = typeof source === 'string' || source instanceof URL || (typeof Request !== 'undefined' && source instanceof Request);
  if (isAddress && error?.name !== 'AbortError' && !address.startsWith('data:') && !error?.message?.includes(address))
    error.message = `${address}: ${error.message}`;
  return error;
}

/** The pieces of a source as Uint8Arrays. */
async function* pieces(source, signal, onBytes) {
  if (source instanceof ArrayBuffer || (typeof SharedArrayBuffer !== 'undefined' && source instanceof SharedArrayBuffer)) {
    yield new Uint8Array(source).slice();
    return;
  }
  if (ArrayBuffer.isView(source)) {
    yield new Uint8Array(source.buffer, source.byteOffset, source.byteLength).slice();
    return;
  }
  let stream = source, size = 0;
  if (typeof Blob !== 'undefined' && source instanceof Blob) {
    stream = source.stream();
    size = source.size;
  } else if (typeof source === 'string' || source instanceof URL || (typeof Request !== 'undefined' && source instanceof Request)) {
    const address = source instanceof URL ? source.href : source;
    if (isNode && typeof address === 'string' && (address.startsWith('file:') || !/^[a-z][a-z0-9+.-]+:/i.test(address))) {
      const { readFile } = await import(/* @vite-ignore */ 'node:fs/promises');
      yield new Uint8Array(await readFile(address.startsWith('file:') ? new URL(address) : address));
      return;
    }
    const response = await fetch(source, { signal });
    if (!response.ok)
      throw new Error(`${response.url || source}: ${response.status} ${response.statusText}`.trim());
    stream = response.body;
    // A compressed body has another length.
    size = response.headers.get('content-encoding') ? 0 : Number(response.headers.get('content-length') ?? 0);
  }
  if (typeof stream?.getReader !== 'function')
    throw new TypeError('Anicodec.open() takes a URL, bytes, a Blob, a Request or a ReadableStream');
  const reader = stream.getReader();
  try {
    for (let received = 0; ;) {
      const { done, value } = await reader.read();
      if (done)
        return;
      received += value.byteLength;
      onBytes?.(received, size);
      yield value;
    }
  } finally {
    reader.cancel().catch(() => {});
  }
}

/** Opens in a thread of its own; onDecoder gets decoders of this thread. */
async function inWorker(source, options, signal, onProgress, onBytes, onDecoder) {
  const modules = { small: await loadModule('small') };
  const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  let stop;
  try {
    const done = new Promise((resolve, reject) => {
      let last = Promise.resolve();
      stop = () => reject(aborted(signal));
      signal?.addEventListener('abort', stop);
      worker.onerror = (event) => reject(new Error(event.message || 'the worker of anicodec could not be started'));
      worker.onmessage = ({ data }) => {
        if (data.type === 'progress') {
          onProgress?.(data.done);
        } else if (data.type === 'error') {
          reject(unpackError(data.error));
        } else {
          provideModule(data.kind, data.snapshot.module);
          last = last.then(async () => onDecoder(await Decoder.from(data.snapshot), data.complete));
          if (data.complete)
            last.then(resolve, reject);
        }
      };
    });
    worker.postMessage({ type: 'begin', options, modules });
    const sent = (async () => {
      for await (const bytes of pieces(source, signal, onBytes))
        worker.postMessage({ type: 'push', bytes }, [bytes.buffer]);
      worker.postMessage({ type: 'end' });
    })();
    await Promise.race([done, sent.then(() => done)]);
  } finally {
    worker.terminate();
    signal?.removeEventListener('abort', stop);
  }
}

async function here(source, options, signal, onProgress, onBytes, onDecoder) {
  const opening = new Opening({
    ...options, onProgress, isCancelled: () => signal?.aborted,
    onDecoder: async (decoder, complete) => onDecoder(complete ? decoder : await Decoder.from(decoder.snapshot()), complete),
  });
  try {
    for await (const bytes of pieces(source, signal, onBytes))
      await opening.push(bytes);
    await opening.end();
  } catch (error) {
    throw signal?.aborted ? aborted(signal) : error;
  }
}

/** See index.d.ts. */
export function open(source, { quality, bounds, maxBytes, clips, inPlace, inexact, progressive = false, signal, onProgress, onRefine, worker } = {}) {
  if (signal?.aborted)
    return Promise.reject(aborted(signal));
  const run = worker ?? (typeof Worker !== 'undefined' && !isNode) ? inWorker : here;
  const options = { quality, bounds, maxBytes, clips, inPlace, inexact, progressive };
  const report = (stage) => onProgress && ((done, of = 1) => onProgress({ stage, done: of > 0 ? done / of : undefined }));
  return new Promise((resolve, reject) => {
    let clip;
    const finished = run(source, options, signal, report('decode'), report('load'), (decoder, complete) => {
      if (clip?.closed)
        return;
      if (clip) {
        clip.replaceDecoder(decoder);
        onRefine?.(clip);
      } else {
        clip = new Clip(decoder);
        clip.finished = new Promise((done, fail) => Object.assign(clip, { settle: { done, fail } }));
        clip.finished.catch(() => {});  // whoever waits for it is told
        resolve(clip);
      }
      if (complete)
        clip.settle.done(clip);
    });
    finished.catch((error) => (clip ? clip.settle.fail : reject)(named(error, source)));
  });
}

/** Opens the file at hand of a live stream; false where one that it continues was lost. */
function opensOrLacks(decoder) {
  try {
    decoder.openStream();
    return true;
  } catch (error) {
    if (error.status !== 'ANIC_E_SEGMENT_MISSING')
      throw error;
    return false;
  }
}

/** Tells a live stream's losses: files that could not be opened, and time that no file has. */
class Gaps {
  #onLoss;
  #end;       // of the last clip, seconds
  #files = 0; // refused since

  constructor(onLoss) {
    this.#onLoss = onLoss;
  }

  refuse() {
    ++this.#files;
  }

  pass({ startTime, frames, rate }) {
    if (this.#files > 0 || startTime > this.#end + 0.5 / rate)
      this.#onLoss?.({ from: this.#end, to: startTime, files: this.#files });
    this.#files = 0;
    this.#end = startTime + frames / rate;
  }

  end() {
    if (this.#files > 0)
      this.#onLoss?.({ from: this.#end, to: undefined, files: this.#files });
  }
}

/** See index.d.ts. */
export async function* live(source, { quality, bounds, maxBytes, inPlace, inexact, signal, onLoss } = {}) {
  const decoder = await Decoder.create(await loadModule('small'), () => signal?.aborted ?? false);
  decoder.beginStream({ quality, bounds, maxBytes, inPlace, inexact });
  const gaps = new Gaps(onLoss);
  try {
    let state = { received: 0 };
    for await (const bytes of pieces(source, signal)) {
      for (state = decoder.push(bytes); state.complete; state = decoder.advance()) {
        if (!opensOrLacks(decoder)) {
          gaps.refuse();
          continue;
        }
        const clip = new Clip(await Decoder.from(decoder.snapshot()));
        gaps.pass(clip.info);
        yield clip;
      }
    }
    gaps.end();
    if (state.received > 0)
      throw new AnicError('ANIC_E_TRUNCATED', 'the stream ends inside a file', { offset: state.received });
  } catch (error) {
    throw signal?.aborted ? aborted(signal) : error;
  } finally {
    decoder.close();
  }
}

/** Runs read(decoder, address) with the bytes of a file in a decoder of its own; undefined where the file lacks what is read. */
async function unopened(file, read) {
  const bytes = ArrayBuffer.isView(file) ? new Uint8Array(file.buffer, file.byteOffset, file.byteLength) : new Uint8Array(file);
  const decoder = await Decoder.create(await loadModule('small'));
  try {
    return decoder.withBytes(bytes, (at) => read(decoder, at, bytes.byteLength));
  } catch (error) {
    if (error.status === 'ANIC_E_ABSENT')
      return undefined;
    throw error;
  } finally {
    decoder.close();
  }
}

/** See index.d.ts. */
export function readMetadata(file) {
  return unopened(file, (decoder, at, size) => {
    decoder.call('read_metadata', at, size);
    const [text, bytes] = decoder.numbers(2);
    let metadata;
    try {
      metadata = JSON.parse(new TextDecoder().decode(decoder.view(Uint8Array, text, bytes).slice()));
    } catch {
      // No JSON: the same error as another value.
    }
    if (metadata === null || typeof metadata !== 'object' || Array.isArray(metadata))
      throw new AnicError('ANIC_E_RECORD', 'the metadata is not a JSON object', { chunk: 'META' });
    return metadata;
  });
}

/** See index.d.ts. */
export function readBounds(file, { mesh = 0, firstFrame = 0, frames = 0 } = {}) {
  return unopened(file, (decoder, at, size) => {
    decoder.call('read_bounds', at, size, mesh, firstFrame, frames);
    return decoder.read(BOX);
  });
}

export const Anicodec = { open, live, readMetadata, readBounds };
export default Anicodec;
