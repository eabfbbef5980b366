// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// anicodec/loaders-gl in Node. `npm ci --prefix tests/web/pages` installs loaders.gl.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { test } from 'node:test';
import { Anicodec } from '../../bindings/web/index.js';
import { AnicLoader, anicMeshAt } from '../../bindings/web/loaders_gl.js';
import { bytesOf } from './files.mjs';

const CORE = new URL('pages/node_modules/@loaders.gl/core/dist/index.js', import.meta.url);
const skip = existsSync(CORE) ? false : 'there is no loaders.gl: npm ci --prefix tests/web/pages';

test('loaders.gl loads meshes of clips, which play on', { skip }, async () => {
  const { parse, selectLoader } = await import(CORE), bufferOf = (name) => bytesOf(name).buffer, heated = bufferOf('heated.anic');
  assert.equal((await selectLoader(heated, [AnicLoader])).id, 'anic');
  assert.equal((await selectLoader('https://example.com/dancer.anic', [AnicLoader])).id, 'anic');
  const mesh = await parse(heated, [AnicLoader]), [expected] = (await Anicodec.open(bytesOf('heated.anic'))).meshes;
  assert.deepEqual(Object.keys(mesh.attributes), ['POSITION', 'NORMAL', 'TEXCOORD_0', 'COLOR_0']);
  assert.deepEqual(mesh.schema.fields.map(({ name }) => name), Object.keys(mesh.attributes));
  for (const time of [0, 0.4]) {
    const { attributes: { POSITION, NORMAL, COLOR_0 }, indices } = time === 0 ? mesh : anicMeshAt(mesh, time), { positions, normals } = expected.surfaceAt(time);
    assert.deepEqual([POSITION.value, NORMAL.value, COLOR_0.value, indices.value], [positions, normals, expected.attribute('colour', time), expected.indices]);
  }
  // A mesh that is not there in the first frame.
  const second = await parse(bufferOf('scene.anic'), [AnicLoader], { anic: { mesh: 1 } }), { loaderData: { clip } } = second, later = anicMeshAt(second, clip.frameTime(1));
  assert.deepEqual([second.header.vertexCount, second.indices.value.length], [0, 0]);
  assert.deepEqual([later.header.vertexCount, later.indices.value.length], [clip.meshes[1].vertexCount, clip.meshes[1].indices.length]);
  await assert.rejects(parse(heated, [AnicLoader], { anic: { mesh: 3 } }), /1 meshes, and no mesh 3/);
  await assert.rejects(parse(heated.slice(0, 100), [AnicLoader]), /AnicError|truncated|ends/i);
});
