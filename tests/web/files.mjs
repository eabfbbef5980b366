// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The conformance files, and what they hold.
import { readFileSync } from 'node:fs';

const folder = new URL('../conformance/', import.meta.url);

export const bytesOf = (name) => new Uint8Array(readFileSync(new URL(name, folder)));

/** Lines of the manifest: what, file, code, name of the code. */
export const files = readFileSync(new URL('MANIFEST', folder), 'utf8').trim().split('\n').map((line) => {
  const [what, file, , code, status] = line.split(' ');
  return { what, file, code: Number(code), status: `ANIC_E_${status}` };
});

export const factsOf = (file) => JSON.parse(readFileSync(new URL(`facts/${file.replace('.anic', '.json')}`, folder), 'utf8'));
