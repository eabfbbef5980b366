// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The conformance files, and what they hold.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';

const folder = new URL('../conformance/', import.meta.url);

export const bytesOf = (name) => new Uint8Array(readFileSync(new URL(name, folder)));

/** Lines of the manifest: what, file, code, name of the code. */
export const files = readFileSync(new URL('MANIFEST', folder), 'utf8').trim().split('\n').map((line) => {
  const [what, file, , code, status] = line.split(' ');
  return { what, file, code: Number(code), status: `ANIC_E_${status}` };
});

export const factsOf = (file) => JSON.parse(readFileSync(new URL(`facts/${basename(file, '.anic')}.json`, folder), 'utf8'));

/** Runs uses(run, file) with the command and names of files in a folder that goes; undefined without the command (ANICODEC_COMMAND). */
function withCommand(uses) {
  const command = process.env.ANICODEC_COMMAND;
  if (!command)
    return undefined;
  const folder = mkdtempSync(join(tmpdir(), 'anicodec-'));
  try {
    return uses((...options) => execFileSync(command, options, { stdio: 'ignore' }), (name) => join(folder, name));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** A GLB of the parts that its buffer views are, and all else of its JSON. */
function glbOf(parts, rest) {
  const views = [];
  let binary = Buffer.alloc(0);
  for (const { buffer, byteOffset, byteLength } of parts) {
    views.push({ buffer: 0, byteOffset: binary.length, byteLength });
    binary = Buffer.concat([binary, Buffer.from(buffer, byteOffset, byteLength), Buffer.alloc(-byteLength & 3)]);
  }
  let text = Buffer.from(JSON.stringify({ asset: { version: '2.0' }, scene: 0, ...rest, buffers: [{ byteLength: binary.length }], bufferViews: views }));
  text = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  const words = (...values) => Buffer.from(Uint32Array.from(values).buffer);
  return Buffer.concat([Buffer.from('glTF'), words(2, 28 + text.length + binary.length, text.length), Buffer.from('JSON'), text, words(binary.length), Buffer.from('BIN\0'), binary]);
}

/**
 * A GLB whose one primitive moves by an .anic file, an open clip of which is given: with the surface of its first frame, and the
 * file inside or, with `uri`, beside it.
 */
export function movingGlb(bytes, clip, { uri } = {}) {
  const [mesh] = clip.meshes, { offsets, corners } = mesh.polygons, indices = [];
  for (let p = 0; p + 1 < offsets.length; ++p) {
    for (let c = offsets[p] + 2; c < offsets[p + 1]; ++c)
      indices.push(corners[offsets[p]], corners[c - 1], corners[c]);
  }
  const positions = mesh.sourcePositions(0), { min, max } = mesh.bounds, normals = new Float32Array(positions.length).fill(Math.sqrt(1 / 3));
  const NAME = 'ANIC_mesh_animation', accessor = (bufferView, componentType, type, count, more) => ({ bufferView, componentType, type, count, ...more });
  return glbOf([positions, normals, Uint32Array.from(indices), ...(uri ? [] : [bytes])], {
    scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, name: 'shown' }], extensionsUsed: [NAME],
    extensions: { [NAME]: { files: [uri ? { uri } : { bufferView: 3 }] } },
    meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0, extensions: { [NAME]: { file: 0 } } }] }],
    materials: [{ name: 'paint', doubleSided: true }],
    accessors: [accessor(0, 5126, 'VEC3', positions.length / 3, { min, max }), accessor(1, 5126, 'VEC3', positions.length / 3), accessor(2, 5125, 'SCALAR', indices.length)],
  });
}

/**
 * A scene that moves by a clip with its texture coordinates and colours: at 1 s all of them are (0.5, 0.25) and (-0.5, 0.25, 0) away from
 * those at 0 s. Undefined without the command.
 */
export function sceneWithMovingTexture() {
  const floats = (...values) => Float32Array.from(values), each = (...values) => floats(...values, ...values, ...values, ...values);
  const parts = [floats(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0), floats(0, 0, 0.5, 0, 0.5, 0.5, 0, 0.5), each(0.75, 0.5, 0.25), each(0, 0, 0.5), each(0.5, 0.25),
    each(-0.5, 0.25, 0), Uint16Array.of(0, 1, 2, 0, 2, 3), floats(0, 1), floats(0, 1)];
  const accessors = parts.map((part, bufferView) => ({
    bufferView, componentType: part instanceof Float32Array ? 5126 : 5123, ...([1, 4].includes(bufferView) ? { count: 4, type: 'VEC2' }
      : bufferView < 6 ? { count: 4, type: 'VEC3' } : { count: part.length, type: 'SCALAR' }),
  }));
  Object.assign(accessors[0], { min: [0, 0, 0], max: [1, 1, 0] });
  Object.assign(accessors[3], { min: [0, 0, 0.5], max: [0, 0, 0.5] });
  Object.assign(accessors[7], { min: [0], max: [1] });
  const glb = glbOf(parts, {
    scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, name: 'shown' }], accessors,
    meshes: [{ name: 'shown', primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1, COLOR_0: 2 }, indices: 6, targets: [{ POSITION: 3, TEXCOORD_0: 4, COLOR_0: 5 }] }], weights: [0] }],
    animations: [{ samplers: [{ input: 7, output: 8 }], channels: [{ sampler: 0, target: { node: 0, path: 'weights' } }] }],
  });
  return withCommand((run, file) => {
    writeFileSync(file('scene.glb'), glb);
    run('encode', file('scene.glb'), '-o', file('moving.glb'), '--effort', 'fast');
    return readFileSync(file('moving.glb'));
  });
}

/** A clip with two materials, of one of which the file has values; undefined without the command. */
export function clipWithLooks() {
  return withCommand((run, file) => {
    run('corpus', 'polygons', '-o', file('still.pc2'));
    const lines = readFileSync(file('still.obj'), 'utf8').split('\n'), faces = lines.filter((line) => line.startsWith('f '));
    writeFileSync(file('looks.mtl'), 'newmtl wood\nKd 0.5 0.25 0.125\nd 0.75\nKe 0 0.0625 0\nPr 0.875\nPm 0.25\nnorm wood_normal.png\n');
    writeFileSync(file('looks.obj'), ['mtllib looks.mtl', ...lines.filter((line) => line.startsWith('v ')), 'usemtl wood', ...faces.slice(9), 'usemtl metal', ...faces.slice(0, 9), ''].join('\n'));
    run('encode', file('looks.obj'), file('still.pc2'), '-o', file('looks.anic'), '--effort', 'fast');
    return new Uint8Array(readFileSync(file('looks.anic')));
  });
}
