// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The glTF extension ANIC_mesh_animation (spec/gltf-extension.md), whatever draws it.

import { EXTENSION } from './glb.js';

/** The surface of a mesh of a clip at a time, from which primitives take their vertices. */
export class GltfSurface {
  constructor(mesh) {
    const { vertexCount, sourceVertices, sourceVertexCount } = mesh;
    Object.assign(this, { mesh, positions: new Float32Array(3 * vertexCount), normals: new Float32Array(3 * vertexCount) });
    // A vertex of a glTF has one normal, so that any of the render vertices it became will do.
    this.renderVertices = new Uint32Array(sourceVertexCount).fill(0xffffffff);
    sourceVertices.forEach((v, r) => { this.renderVertices[v] = r; });
  }

  /** False when the mesh is not there. */
  seek(time, options) {
    if (!this.mesh.isPresent(time, options))
      return false;
    this.mesh.surfaceAt(time, this.positions, this.normals, options);
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
}
