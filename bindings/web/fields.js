// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Numbers beside the positions of a clip, such as temperatures, as colours: one of vertex, corner or face.
import { AnicError } from './status.js';

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
  if (found.domain !== 'polygons')
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

/** Values of a field at the vertices of a mesh, as shares of its range; undefined: it has none then. */
function sharesAt(mesh, { name, low, high }, time, options) {
  return valuesOf(mesh, name, time, options)?.map((value) => Math.min(Math.max((value - low) / (high - low || 1), 0), 1));
}

/** The same of each mesh of a clip. */
export const sharesOf = (clip, field, time, options) => clip.meshes.map((mesh) => sharesAt(mesh, field, time, options));

const STEPS = 1024;  // of a table, finer than screens; one more is of no value
const POWERS = { linear: 1, srgb: 1 / 2.2 }, tables = {};

function tableOf(space) {
  tables[space] ??= Float32Array.from({ length: 3 * (STEPS + 2) }, (_, i) => fieldColour(i < 3 * (STEPS + 1) ? Math.floor(i / 3) / STEPS : NaN)[i % 3] ** POWERS[space]);
  return tables[space];
}

/** A field of a clip with its range: of all frames of one of the file's clips, or a given one. Throws if there is none. */
export function fieldOf(clip, name, current, range = {}) {
  const names = fieldNames(clip);
  if (!names.includes(name))
    throw new AnicError('ANIC_E_ABSENT', `there is no field ${name}, but ${names.join(', ') || 'none'}`);
  return { name, low: 0, high: 1, ...(range.low === undefined || range.high === undefined ? rangeOf(clip, name, current) : {}), ...range };
}

/** Writes the colours of a field at the vertices of a mesh, the first three of `width` numbers for each; grey where it has none. */
export function writeFieldColours(mesh, field, time, options, out, { width = 3, space = 'linear' } = {}) {
  const shares = sharesAt(mesh, field, time, options), table = tableOf(space);
  for (let vertex = 0; vertex < mesh.vertexCount; ++vertex) {
    const share = shares?.[vertex] ?? NaN, from = 3 * (share >= 0 ? Math.round(share * STEPS) : STEPS + 1), to = width * vertex;
    out[to] = table[from];
    out[to + 1] = table[from + 1];
    out[to + 2] = table[from + 2];
  }
}
