// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The page that is kept in the source, for machines without Emscripten, against the one that is built.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { gunzipSync } from 'node:zlib';

const web = new URL('../../bindings/web/', import.meta.url);

/** The page without the module, and the module; zlib's versions compress it in different ways. */
function parts(name) {
  const page = readFileSync(new URL(name, web), 'utf8'), [, packed] = page.match(/<script id="decoder"[^>]*>([^<]*)</);
  return { page: page.replace(packed, ''), module: gunzipSync(Buffer.from(packed, 'base64')) };
}

test('the prebuilt viewer is what the sources make', () => {
  const kept = parts('viewer/prebuilt.html'), built = parts('dist/viewer.html');
  const digest = (bytes) => createHash('sha256').update(bytes).digest('hex');
  const how = 'build the preset wasm, and copy bindings/web/dist/viewer.html to bindings/web/viewer/prebuilt.html';
  assert.equal(digest(kept.module), digest(built.module), how);
  assert.equal(digest(kept.page), digest(built.page), how);
  assert.equal(digest(kept.module), digest(readFileSync(new URL('dist/anicodec-full.wasm', web))));
});
