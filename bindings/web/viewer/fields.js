// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Numbers beside the positions of a clip, such as temperatures, as colours: one of vertex, corner or face.

/** From dark blue over green to yellow, brighter as the value grows; red, green, blue of sRGB. */
const STOPS = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
/** Frames, spread over the clip, that the range is of. */
const LOOKED_AT = 32;

export const gradient = `linear-gradient(to right, ${STOPS.map((stop) => `rgb(${stop})`).join(', ')})`;

/** Linear light of a share of the range; grey where there is none. */
export function fieldColour(share) {
  if (!(share >= 0 && share <= 1))
    return [0.3, 0.3, 0.3];
  const at = share * (STOPS.length - 1), i = Math.min(Math.floor(at), STOPS.length - 2), t = at - i;
  return STOPS[i].map((a, c) => ((a + (STOPS[i + 1][c] - a) * t) / 255) ** 2.2);
}

const isField = ({ kind, name, components }) => kind === 'custom' && name && components > 0;

/** Names of the fields of a clip. */
export const fieldNames = (clip) => [...new Set(clip.meshes.flatMap((mesh) => mesh.attributes.filter(isField).map(({ name }) => name)))];

/** Values of a field at the vertices of a mesh, lengths of vectors; of faces the mean around each. Undefined: it has none then. */
function valuesOf(mesh, name, time, options) {
  const found = mesh.attributes.find((attribute) => isField(attribute) && attribute.name === name);
  if (!found || !mesh.isPresent(time, options))
    return undefined;
  const all = mesh.attribute(found.index, time, undefined, options), n = found.components;
  const values = n === 1 ? all : Float32Array.from({ length: all.length / n }, (_, i) => Math.hypot(...all.subarray(n * i, n * i + n)));
  if (found.domain !== 'polygon')
    return values;
  const { indices, trianglePolygons } = mesh, sums = new Float32Array(mesh.vertexCount), counts = new Uint32Array(mesh.vertexCount);
  for (let corner = 0; corner < indices.length; ++corner) {
    sums[indices[corner]] += values[trianglePolygons[Math.floor(corner / 3)]];
    ++counts[indices[corner]];
  }
  return sums.map((sum, vertex) => sum / counts[vertex]);
}

/** Least and largest value of a field in a clip of a file, of some frames; undefined if no mesh shows it. */
export function rangeOf(clip, name, { index, frames, duration }) {
  let low = Infinity, high = -Infinity;
  for (let i = 0; i < Math.min(frames, LOOKED_AT); ++i) {
    const time = duration * i / Math.max(Math.min(frames, LOOKED_AT) - 1, 1);
    for (const mesh of clip.meshes) {
      for (const value of valuesOf(mesh, name, time, { clip: index }) ?? []) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
  }
  return low <= high ? { low, high } : undefined;
}

/** Of each mesh, its values as shares of a range. */
export function sharesOf(clip, name, { low, high }, time, options) {
  return clip.meshes.map((mesh) => valuesOf(mesh, name, time, options)?.map((value) => Math.min(Math.max((value - low) / (high - low || 1), 0), 1)));
}
