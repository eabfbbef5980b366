// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The glTF extension ANIC_mesh_animation (spec/gltf-extension.md), whatever draws it.

import { EXTENSION } from './glb.js';

const MOVING = /^(TEXCOORD|COLOR)_\d+$/;

/** The surface of a mesh of a clip at a time, from which primitives take their vertices. */
export class GltfSurface {
  constructor(mesh) {
    const { vertexCount, sourceVertices, sourceVertexCount } = mesh;
    Object.assign(this, { mesh, positions: new Float32Array(3 * vertexCount), normals: new Float32Array(3 * vertexCount) });
    // A vertex of a glTF has one normal, so that any of the render vertices it became will do.
    this.renderVertices = new Uint32Array(sourceVertexCount).fill(0xffffffff);
    sourceVertices.forEach((v, r) => { this.renderVertices[v] = r; });
    /** Texture coordinates and colours that move, by the names that glTF has for them. */
    this.attributes = mesh.attributes.filter(({ name, domain, moves }) => moves && domain === 'vertices' && MOVING.test(name))
      .map(({ name, index, components }) => ({ name, index, components, values: new Float32Array(components * vertexCount) }));
  }

  /** False when the mesh is not there. */
  seek(time, options) {
    if (!this.mesh.isPresent(time, options))
      return false;
    this.mesh.surfaceAt(time, this.positions, this.normals, options);
    for (const { index, values } of this.attributes)
      this.mesh.attribute(index, time, values, options);
    return true;
  }

  /** The vertices of a primitive, which are `count` from the clip's vertex `first` on, as three numbers each. */
  take(first, count, positions, normals) {
    if (first + count > this.renderVertices.length)
      throw new Error(`${EXTENSION}: the clip has ${this.renderVertices.length} vertices, no ${first + count}`);
    for (let i = 0, to = 0; i < count; ++i, to += 3) {
      const from = 3 * this.renderVertices[first + i];
      if (from >= this.positions.length)
        continue;  // no triangle uses it
      for (let c = 0; c < 3; ++c) {
        positions[to + c] = this.positions[from + c];
        if (normals)
          normals[to + c] = this.normals[from + c];
      }
    }
  }

  /** The values of a moving attribute of those vertices, to an array of `width` numbers for each. v of textures is down in a glTF. */
  takeAttribute({ name, components, values }, first, count, out, width) {
    const down = name.startsWith('TEXCOORD'), both = Math.min(components, width);
    for (let i = 0; i < count; ++i) {
      const from = components * this.renderVertices[first + i];
      for (let c = 0; c < both && from < values.length; ++c)
        out[width * i + c] = down && c === 1 ? 1 - values[from + c] : values[from + c];
    }
  }
}
