// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Fields of many instances as bytes, whose colours a graphics card looks up.
import { fieldColour, sharesOf } from './fields.js';

const NONE = 255;

/** Colours of the bytes, four numbers of linear light each. */
export function stepColours() {
  const share = (step) => (step < NONE ? step / (NONE - 1) : NaN);
  return Float32Array.from({ length: 4 * (NONE + 1) }, (_, i) => [...fieldColour(share(i >> 2)), 1][i & 3]);
}

/** Writes a byte for each vertex of a mesh: the share of a field's range in steps, or that it has none. */
export function writeFieldSteps(mesh, field, time, options, out) {
  const [shares] = sharesOf({ meshes: [mesh] }, field, time, options);
  for (let vertex = 0; vertex < mesh.vertexCount; ++vertex)
    out[vertex] = shares?.[vertex] >= 0 ? Math.round(shares[vertex] * (NONE - 1)) : NONE;
}

/** Whether a field of a mesh has other values in other frames, which are not there in some, too. */
export const fieldMoves = (mesh, { name }) => mesh.attributes.some((attribute) => attribute.kind === 'custom' && attribute.name === name && attribute.moves);
