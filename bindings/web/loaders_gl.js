// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in loaders.gl: a loader of its category "mesh", and meshes at other times for those who draw them.
import { open } from './index.js';

const MAGIC = Uint8Array.of(0x89, 0x41, 0x4e, 0x49);

/** Attributes of a mesh of a clip that glTF has names for: [name, attribute]. */
function named(mesh) {
  const uvs = mesh.attributes.filter((a) => a.kind === 'uv' && a.components === 2 && a.domain !== 'polygons');
  const colour = mesh.attributes.find((a) => a.kind === 'colour' && a.components >= 3 && a.domain !== 'polygons');
  return [...uvs.map((a, i) => [`TEXCOORD_${i}`, a]), ...(colour ? [['COLOR_0', colour]] : [])];
}

/** Attributes of a mesh of a clip at a time: [name, values, size]. */
function valuesAt(mesh, time, options) {
  if (mesh.triangleCount === 0)
    return [['POSITION', mesh.positions(time, undefined, options), 3]];
  const { positions, normals } = mesh.surfaceAt(time, undefined, undefined, options);
  const others = named(mesh).map(([name, { index, components }]) => [name, mesh.attribute(index, time, undefined, options), components]);
  return [['POSITION', positions, 3], ['NORMAL', normals, 3], ...others];
}

/** The mesh that a mesh of this loader is at another time; without faces and vertices where the clip has none then. */
export function anicMeshAt({ loaderData: { clip, mesh: index } }, time, options) {
  const mesh = clip.meshes[index], faces = mesh.triangleCount > 0, present = mesh.isPresent(time, options);
  const values = present ? valuesAt(mesh, time, options) : [['POSITION', new Float32Array(0), 3]];
  const fields = values.map(([name, , size]) => ({
    name, nullable: false, type: { type: 'fixed-size-list', listSize: size, children: [{ name: 'value', type: 'float32', nullable: false }] }, metadata: {},
  }));
  return {
    loader: 'anic', loaderData: { clip, mesh: index }, schema: { fields, metadata: {} },
    header: { vertexCount: present ? mesh.vertexCount : 0, boundingBox: mesh.bounds && [mesh.bounds.min, mesh.bounds.max] },
    topology: faces ? 'triangle-list' : 'point-list', mode: faces ? 4 : 0, attributes: Object.fromEntries(values.map(([name, value, size]) => [name, { value, size }])),
    ...(faces ? { indices: { value: present ? mesh.indices : new Uint32Array(0), size: 1 } } : {}),
  };
}

/** Loads a mesh of an .anic file at its first frame. `options.anic` are those of open(), and the number of the `mesh`. */
export const AnicLoader = {
  dataType: null, batchType: null, name: 'anicodec', id: 'anic', module: 'anicodec', version: 'latest', worker: false, category: 'mesh', binary: true,
  extensions: ['anic'], mimeTypes: ['model/vnd.anicodec'], tests: [MAGIC.buffer], options: { anic: {} },
  parse: async (bytes, { anic: { mesh = 0, ...options } = {} } = {}) => {
    const clip = await open(bytes, options);
    if (!clip.meshes[mesh])
      throw new Error(`anicodec: the clip has ${clip.meshes.length} meshes, and no mesh ${mesh}`);
    return anicMeshAt({ loaderData: { clip, mesh } }, 0);
  },
};
