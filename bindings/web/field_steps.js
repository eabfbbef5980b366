// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Fields of many instances as bytes, whose colours a graphics card looks up.
import { fieldColour, sharesOf } from './fields.js';

const NONE = 255;

/** Colours of the bytes, four numbers of linear light or of sRGB each. */
export function stepColours(space = 'linear') {
  const share = (step) => (step < NONE ? step / (NONE - 1) : NaN), power = space === 'srgb' ? 1 / 2.2 : 1;
  return Float32Array.from({ length: 4 * (NONE + 1) }, (_, i) => [...fieldColour(share(i >> 2)), 1][i & 3] ** power);
}

/** Writes a byte for each vertex of a mesh: the share of a field's range in steps, or that it has none. */
function writeFieldSteps(mesh, field, time, options, out) {
  const [shares] = sharesOf({ meshes: [mesh] }, field, time, options);
  for (let vertex = 0; vertex < mesh.vertexCount; ++vertex)
    out[vertex] = shares?.[vertex] >= 0 ? Math.round(shares[vertex] * (NONE - 1)) : NONE;
}

/** The bytes of a field of many instances of a mesh: `size` of them for each, or for all where the field does not move. */
export class FieldSteps {
  #mesh;
  #field;
  #size;
  #shown;

  constructor(mesh, field, count, size) {
    this.#mesh = mesh;
    this.#field = field;
    this.#size = size;
    this.moves = mesh.attributes.some((attribute) => attribute.kind === 'custom' && attribute.name === field.name && attribute.moves);
    this.#shown = new Array(this.moves ? count : 1);
    this.data = new Uint8Array(size * this.#shown.length);
  }

  /** Brings them to the times of instances, with options of ClipMesh.attribute() by instance. Whether any changed. */
  update(times, optionsOf) {
    let changed = false;
    for (let i = 0; i < this.#shown.length; ++i) {
      const options = optionsOf(i), key = `${options.clip} ${times[i]}`;
      if (this.#shown[i] === key || (!this.moves && this.#shown[i] !== undefined))
        continue;
      writeFieldSteps(this.#mesh, this.#field, times[i], options, this.data.subarray(i * this.#size, (i + 1) * this.#size));
      this.#shown[i] = key;
      changed = true;
    }
    return changed;
  }
}
