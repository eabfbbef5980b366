// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Finds, compiles and keeps the WebAssembly modules.

// The smallest module that has an instruction of 128 bits.
const SIMD = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15,
  253, 98, 11);
const simd = WebAssembly.validate(SIMD);

/** Kinds of modules: `small` plays files without geometry interpolation and exact positions, `full` all. */
const urls = {
  small: () => (simd ? new URL('./dist/anicodec.wasm', import.meta.url) : urls.full()),
  full: () => (simd ? new URL('./dist/anicodec-full.wasm', import.meta.url)
    : new URL('./dist/anicodec-scalar.wasm', import.meta.url)),
  scalar: () => new URL('./dist/anicodec-scalar.wasm', import.meta.url),
};
const modules = {};

export const isNode = typeof process !== 'undefined' && !!process.versions?.node;

/** Takes compiled modules from elsewhere: another thread, or a page that holds them. */
export function provideModule(kind, module) {
  modules[kind] = Promise.resolve(module);
}

async function compile(url) {
  if (isNode && url.protocol === 'file:') {
    const { readFile } = await import(/* @vite-ignore */ 'node:fs/promises');
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok)
    throw new Error(`${url}: ${response.status} ${response.statusText}`);
  if (WebAssembly.compileStreaming && response.headers.get('content-type') === 'application/wasm')
    return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** The compiled module of a kind, compiled once. */
export function loadModule(kind) {
  modules[kind] ??= compile(urls[kind]()).catch((error) => {
    delete modules[kind];  // the network may be back the next time
    throw error;
  });
  return modules[kind];
}
