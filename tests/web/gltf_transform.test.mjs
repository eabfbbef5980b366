// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// anicodec/gltf-transform in Node. `npm ci --prefix tests/web/pages` installs glTF-Transform.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { Anicodec } from '../../bindings/web/index.js';
import { bytesOf, movingGlb } from './files.mjs';

const here = (path) => fileURLToPath(new URL(path, import.meta.url)), INSTALLED = here('pages/node_modules');
const skip = existsSync(`${INSTALLED}/@gltf-transform/core`) ? false : 'there is no glTF-Transform: npm ci --prefix tests/web/pages';
const NAME = 'ANIC_mesh_animation', folder = mkdtempSync(join(tmpdir(), 'anicodec-'));
let core, functions, io, anic, clips, source;
before(async () => {
  if (skip)
    return;
  // The package beside what it imports, as it is installed.
  mkdirSync(join(folder, 'node_modules'));
  symlinkSync(`${INSTALLED}/@gltf-transform`, join(folder, 'node_modules/@gltf-transform'));
  for (const file of ['package.json', 'gltf_transform.js', 'glb.js', 'status.js'])
    writeFileSync(join(folder, file), readFileSync(here(`../../bindings/web/${file}`)));
  const load = (path) => import(pathToFileURL(path));
  core = await load(`${INSTALLED}/@gltf-transform/core/dist/index.js`);
  functions = await load(`${INSTALLED}/@gltf-transform/functions/dist/index.js`);
  anic = await load(join(folder, 'gltf_transform.js'));
  io = new core.NodeIO().registerExtensions([anic.ANICMeshAnimation]).setLogger(new core.Logger(core.Logger.Verbosity.SILENT));
  clips = bytesOf('clips.anic');
  source = movingGlb(clips, await Anicodec.open(clips));
});
after(() => rmSync(folder, { recursive: true }));

/** JSON and binary part of a GLB, and the bytes of its clips. */
function opened(glb) {
  const view = new DataView(glb.buffer, glb.byteOffset), size = view.getUint32(12, true), json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + size)));
  const binary = glb.subarray(28 + size), part = (index) => binary.subarray(json.bufferViews[index].byteOffset ?? 0, (json.bufferViews[index].byteOffset ?? 0) + json.bufferViews[index].byteLength);
  return { json, files: json.extensions[NAME].files.map(({ bufferView }) => part(bufferView)) };
}

/** Positions of a primitive's vertices and of its corners, face by face. */
async function surface(glb) {
  const [primitive] = (await io.readBinary(glb)).getRoot().listMeshes()[0].listPrimitives(), positions = [...primitive.getAttribute('POSITION').getArray()];
  return { positions, corners: Array.from(primitive.getIndices().getArray(), (v) => positions.slice(3 * v, 3 * v + 3)) };
}

test('glTF-Transform keeps the clips of a scene through what it does to vertices', { skip }, async () => {
  const expected = await surface(source), { dedup, prune, weld, unweld, flatten, join: joined, reorder, sparse, resample, cloneDocument } = functions;
  const shuffle = (document) => {
    const [primitive] = document.getRoot().listMeshes()[0].listPrimitives(), n = primitive.getAttribute('POSITION').getCount(), order = Array.from({ length: n }, (_, i) => (7 * i + 3) % n);
    assert.equal(new Set(order).size, n);
    for (const accessor of primitive.listAttributes()) {
      const size = accessor.getElementSize(), old = accessor.getArray();
      accessor.setArray(old.map((_, i) => old[size * order[Math.floor(i / size)] + i % size]));
    }
    primitive.getIndices().setArray(primitive.getIndices().getArray().map((v) => order.indexOf(v)));
  };
  for (const steps of [[], [dedup(), prune(), resample(), sparse()], [flatten(), joined()], [unweld()], [unweld(), weld()], [shuffle], [shuffle, weld(), prune()]]) {
    const document = await io.readBinary(source);
    await document.transform(...steps);
    for (const one of [document, cloneDocument(document)]) {
      const glb = await io.writeBinary(one), { json, files } = opened(glb);
      assert.deepEqual(files.map((bytes) => Buffer.compare(bytes, clips)), [0]);
      assert.deepEqual(json.extensionsUsed, [NAME]);
      assert.deepEqual(json.meshes[0].primitives[0].extensions[NAME], { file: 0, mesh: 0, firstVertex: 0 });
      assert.deepEqual(Object.keys(json.meshes[0].primitives[0].attributes).sort(), ['NORMAL', 'POSITION']);
      assert.equal(json.accessors.length, 3);
      assert.deepEqual(await surface(glb), expected);
    }
  }
});

test('merged scenes have the clips of both, each once', { skip }, async () => {
  const other = bytesOf('walk_y_up.anic'), second = movingGlb(other, await Anicodec.open(other)), target = await io.readBinary(source);
  for (const glb of [second, source])
    functions.mergeDocuments(target, await io.readBinary(glb));
  await target.transform(functions.unpartition(), functions.dedup(), functions.prune());
  const { json, files } = opened(await io.writeBinary(target));
  assert.deepEqual(files.map((bytes) => bytes.length), [clips.length, other.length]);
  assert.deepEqual(json.meshes.map(({ primitives: [{ extensions }] }) => extensions[NAME].file), [0, 1, 0]);
  // Without what moves by it, a clip goes.
  target.getRoot().listMeshes()[1].dispose();
  assert.equal(opened(await io.writeBinary(target)).files.length, 1);
});

test('a clip beside the scene, and scenes made by a program, are written', { skip }, async () => {
  const beside = movingGlb(clips, await Anicodec.open(clips), { uri: 'dancer.anic' });
  const read = await io.readBinary(new Uint8Array(beside)), glb = await io.writeBinary(read), size = new DataView(glb.buffer).getUint32(12, true);
  assert.deepEqual(JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + size))).extensions[NAME], { files: [{ uri: 'dancer.anic' }] });
  const document = new core.Document(), extension = document.createExtension(anic.ANICMeshAnimation), position = document.createAccessor().setType('VEC3').setArray(new Float32Array(9)).setBuffer(document.createBuffer());
  const animation = extension.createMeshAnimation().setFile(extension.createFile().setBytes(clips)).setMesh(2).setFirstVertex(5);
  document.createScene().addChild(document.createNode().setMesh(document.createMesh().addPrimitive(document.createPrimitive().setAttribute('POSITION', position).setExtension(NAME, animation))));
  const { json, files } = opened(await io.writeBinary(document));
  assert.deepEqual([json.meshes[0].primitives[0].extensions[NAME], files[0].length], [{ file: 0, mesh: 2, firstVertex: 5 }, clips.length]);
});

test('scenes that a clip would move wrong are refused', { skip }, async () => {
  const refused = async (pattern, ...steps) => {
    const document = await io.readBinary(source);
    await document.transform(...steps);
    await assert.rejects(io.writeBinary(document), pattern);
  };
  await refused(/primitive 0 of mesh "" has other positions/, functions.quantize());
  const kept = await io.readBinary(source);
  await kept.transform(functions.quantize({ pattern: /^(?!POSITION)/ }));
  assert.equal(opened(await io.writeBinary(kept)).files.length, 1);
  await refused(/other positions/, (document) => { functions.transformMesh(document.getRoot().listMeshes()[0], [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]); });
  await refused(/two values of NORMAL/, functions.unweld(), (document) => {
    const normal = document.getRoot().listMeshes()[0].listPrimitives()[0].getAttribute('NORMAL');
    normal.setArray(normal.getArray().map((_, i) => (i % 9 === 0 ? 1 : 0)));
  });
  await refused(/was joined/, (document) => {
    const [mesh] = document.getRoot().listMeshes(), [primitive] = mesh.listPrimitives(), made = functions.joinPrimitives([primitive, primitive.clone()]);
    mesh.removePrimitive(primitive).addPrimitive(made);
  });
  const json = { asset: { version: '2.0' }, extensionsUsed: [NAME], meshes: [{ primitives: [{ attributes: {}, extensions: { [NAME]: { file: 1 } } }] }] };
  await assert.rejects(io.readJSON({ json, resources: {} }), /mesh 0 names file 1, and there are 0/);
});
