// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Instances of a clip's mesh that a graphics card plays by WebGL 2: what needs no engine of it. Textures are rows of WIDTH
// vertices; the shaders of the two passes fill one of positions, in the order of the source, and one of normals.
export const WIDTH = 1024;
const LINEAR_TEXELS = 7;  // of a region of an instance, before its weights: two maps of three rows, and the number of the segment

/** Vertices of the triangle that covers the target of a pass. */
export const FULL = `
precision highp float;
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }`;

export const POSITIONS = `
precision highp float;
precision highp int;
precision highp isampler2DArray;
uniform isampler2DArray wide, narrow;
uniform sampler2D pose, state;
uniform int segment, rows, wideCount, narrowCount, scalar, hasPose, regionTexels;
uniform vec3 origin;
out vec4 result;
vec4 of(int instance, int i) { return texelFetch(state, ivec2(i, instance), 0); }
vec3 moved(int instance, int first, vec3 p) {
  vec4 q = vec4(p, 1.0);
  return vec3(dot(of(instance, first), q), dot(of(instance, first + 1), q), dot(of(instance, first + 2), q));
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int instance = at.y / rows;
  ivec2 v = ivec2(at.x, at.y % rows);
  if (int(of(instance, 6).x) != segment) discard;
  vec4 still = texelFetch(pose, v, 0);
  int region = int(still.w) * regionTexels;
  vec3 x = hasPose == 1 ? moved(instance, region, still.xyz) : vec3(0.0);
  int w = region + ${LINEAR_TEXELS};
  if (scalar == 1) {
    // Four components of one number to a texel; their weights have three.
    for (int j = 0; j < wideCount; j += 4, w += 4) {
      vec4 q = vec4(texelFetch(wide, ivec3(v, j / 4), 0));
      x += q.x * of(instance, w).xyz + q.y * of(instance, w + 1).xyz + q.z * of(instance, w + 2).xyz + q.w * of(instance, w + 3).xyz;
    }
    for (int j = 0; j < narrowCount; j += 4, w += 4) {
      vec4 q = vec4(texelFetch(narrow, ivec3(v, j / 4), 0));
      x += q.x * of(instance, w).xyz + q.y * of(instance, w + 1).xyz + q.z * of(instance, w + 2).xyz + q.w * of(instance, w + 3).xyz;
    }
  } else {
    // A component of three numbers to a texel; four weights to a texel.
    for (int j = 0; j < wideCount; ++j)
      x += vec3(texelFetch(wide, ivec3(v, j), 0).xyz) * of(instance, w + j / 4)[j % 4];
    w += (wideCount + 3) / 4;
    for (int j = 0; j < narrowCount; ++j)
      x += vec3(texelFetch(narrow, ivec3(v, j), 0).xyz) * of(instance, w + j / 4)[j % 4];
  }
  result = vec4(moved(instance, region + 3, x + origin), 1.0);
}`;

export const NORMALS = `
precision highp float;
precision highp int;
precision highp usampler2D;
uniform sampler2D positions;
uniform usampler2D elements, corners;
uniform int rows, sourceRows;
out vec4 result;
vec3 point(uint v, int instance) {
  return texelFetch(positions, ivec2(int(v) % ${WIDTH}, int(v) / ${WIDTH} + instance * sourceRows), 0).xyz;
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int instance = at.y / rows;
  uvec4 e = texelFetch(elements, ivec2(at.x, at.y % rows), 0);  // source vertex, centre, first corner, number of corners
  vec3 centre = point(e.y, instance), sum = vec3(0.0);
  for (uint c = e.z; c < e.z + e.w; ++c) {
    uvec4 k = texelFetch(corners, ivec2(int(c) % ${WIDTH}, int(c) / ${WIDTH}), 0);
    sum += cross(point(k.x, instance) - centre, point(k.y, instance) - centre);
  }
  float most = max(max(abs(sum.x), abs(sum.y)), abs(sum.z));
  result = vec4(most > 0.0 ? normalize(sum / most) : vec3(0.0, 0.0, 1.0), float(e.x));
}`;

/** For vertex shaders: position and normal of a vertex of an instance, by anicPositions, anicNormals, anicRows and anicSourceRows. */
export const FETCH = `
vec4 anicNormal() {
  return texelFetch(anicNormals, ivec2(gl_VertexID % ${WIDTH}, gl_VertexID / ${WIDTH} + gl_InstanceID * anicRows), 0);
}
vec3 anicPosition() {
  int v = int(anicNormal().w);
  return texelFetch(anicPositions, ivec2(v % ${WIDTH}, v / ${WIDTH} + gl_InstanceID * anicSourceRows), 0).xyz;
}
`;

/** For vertex shaders: the colour of a field at a vertex of an instance, by anicField, a byte each, anicColours and anicFieldRows, 0 if all show the same. */
export const FIELD = `
vec3 anicFieldColour() {
  float share = texelFetch(anicField, ivec2(gl_VertexID % ${WIDTH}, gl_VertexID / ${WIDTH} + gl_InstanceID * anicFieldRows), 0).r;
  return texelFetch(anicColours, ivec2(int(255.0 * share + 0.5), 0), 0).rgb;
}
`;

export const rowsOf = (count) => Math.max(Math.ceil(count / WIDTH), 1);

/** The data of a segment's textures, in texels of four: a row of WIDTH vertices, rows, and a layer for each component or four of them. */
function basisTexels(basis) {
  const { vertexCount, components, wideComponents, channels } = basis, rows = rowsOf(vertexCount), scalar = channels === 1;
  const layered = (from, count, Type) => {
    const layers = Math.max(scalar ? Math.ceil(count / 4) : count, 1), data = new Type(4 * WIDTH * rows * layers);
    for (let v = 0; v < vertexCount; ++v) {
      const block = v >> 4, i = v & 15;
      for (let j = 0; j < count; ++j) {
        if (scalar) {
          data[4 * ((j >> 2) * WIDTH * rows + v) + (j & 3)] = from[(block * count + j) * 16 + i];
        } else {
          for (let c = 0; c < 3; ++c)
            data[4 * (j * WIDTH * rows + v) + c] = from[((block * count + j) * 3 + c) * 16 + i];
        }
      }
    }
    return { data, rows, layers };
  };
  const pose = new Float32Array(4 * WIDTH * rows);
  for (let v = 0; basis.pose && v < vertexCount; ++v) {
    for (let c = 0; c < 3; ++c)
      pose[4 * v + c] = basis.pose[((v >> 4) * 3 + c) * 16 + (v & 15)];
    pose[4 * v + 3] = basis.vertexRegion?.[v] ?? 0;
  }
  return {
    wide: layered(basis.wide, wideComponents, Int32Array), narrow: layered(basis.narrow, components - wideComponents, Int16Array),
    pose: { data: pose, rows, layers: 1 },
  };
}

const four = (n) => Math.ceil(n / 4);

/** Texels of a region of an instance: a weight of three numbers to each, or four weights. */
function regionTexels({ components, wideComponents, weightChannels }) {
  return LINEAR_TEXELS + (weightChannels === 3 ? 4 : 1) * (four(wideComponents) + four(components - wideComponents));
}

/** Writes the weights of a region from a place on, wide and narrow ones in whole groups of four. */
function placeWeights({ components, wideComponents, weightChannels }, weights, data, to) {
  const narrow = components - wideComponents;
  if (weightChannels !== 3) {
    data.set(weights.subarray(0, wideComponents), to);
    data.set(weights.subarray(wideComponents), to + 4 * four(wideComponents));
    return;
  }
  for (let j = 0, k = 0; j < components; ++j, ++k) {
    if (j === wideComponents)
      k = 4 * four(wideComponents);
    for (let c = 0; c < 3; ++c)
      data[to + 4 * k + c] = weights[3 * j + c];
  }
  for (let k = wideComponents; k < 4 * four(wideComponents); ++k)
    data.fill(0, to + 4 * k, to + 4 * k + 4);
  for (let k = narrow; k < 4 * four(narrow); ++k)
    data.fill(0, to + 4 * (4 * four(wideComponents) + k), to + 4 * (4 * four(wideComponents) + k) + 4);
}

/** The states of the instances of a mesh at their times, as texels that the first pass reads: a row for each instance. */
export class InstanceStates {
  #mesh;
  #count;
  #segments = new Map();

  constructor(mesh, count) {
    Object.assign(this, { width: 0, data: new Float32Array(0) });
    this.#mesh = mesh;
    this.#count = count;
    this.#widen(LINEAR_TEXELS);
  }

  #widen(texels) {
    if (texels <= this.width)
      return false;
    this.width = texels;
    this.data = new Float32Array(4 * texels * this.#count);
    return true;
  }

  /** A segment: its basis, the texels of its textures, and the uniforms of the first pass. `made` is the caller's to fill. */
  segment(index) {
    if (!this.#segments.has(index)) {
      const basis = this.#mesh.clip.basis(index), texels = basis.msgi ? undefined : basisTexels(basis);
      const { wideComponents, components, channels, pose, origin } = basis;
      const uniforms = {
        segment: index, rows: rowsOf(this.#mesh.sourceVertexCount), wideCount: wideComponents, narrowCount: components - wideComponents,
        scalar: channels === 1 ? 1 : 0, hasPose: pose?.length > 0 ? 1 : 0, regionTexels: regionTexels(basis),
      };
      this.#segments.set(index, { basis, texels, uniforms, origin, made: undefined });
    }
    return this.#segments.get(index);
  }

  get segments() { return this.#segments.values(); }

  /** Writes what an instance shows; false when the CPU has to do it, undefined if there was too little room. */
  #place(instance, part) {
    const { basis } = this.segment(part.segment), { components, weightChannels, regions } = basis, { decoder } = this.#mesh.clip;
    if (basis.msgi || part.share !== 1 || part.correctionCount > 0)
      return false;
    const texels = regionTexels(basis), count = components * weightChannels;
    if (this.#widen(regions * texels))
      return undefined;
    const weights = decoder.view(Float32Array, part.weightsAt, regions * count);
    const maps = regions > 1 ? decoder.view(Float32Array, part.poseMapsAt, 12 * regions) : part.poseMap;
    for (let r = 0, at = 4 * this.width * instance; r < regions; ++r, at += 4 * texels) {
      this.data.set(maps.slice(12 * r, 12 * r + 12), at);
      this.data.set(part.motion, at + 12);
      this.data[at + 24] = part.segment;
      placeWeights(basis, weights.subarray(count * r, count * (r + 1)), this.data, at + 4 * LINEAR_TEXELS);
    }
    return true;
  }

  /** The parts of an instance; none when the mesh is not there. */
  #parts(time, options) {
    try {
      return this.#mesh.parts(time, options);
    } catch (error) {
      if (error.status === 'ANIC_E_ABSENT')
        return [];
      throw error;
    }
  }

  /**
   * Fills `data` for times and their options. Returns the segments that are shown, and the instances that the CPU has to
   * make: [instance, whether the mesh is there].
   */
  fill(times, optionsOf) {
    const segments = new Set(), byCpu = [];
    for (let i = 0; i < this.#count; ++i) {
      const parts = this.#parts(times[i], optionsOf(i)), placed = parts.length === 1 && this.#place(i, parts[0]);
      if (placed) {
        segments.add(parts[0].segment);
      } else if (placed === undefined) {  // a segment of more components than any before: begin anew
        segments.clear();
        byCpu.length = 0;
        i = -1;
      } else {
        this.data[4 * this.width * i + 24] = -1;
        byCpu.push([i, parts.length > 0]);
      }
    }
    return { segments, byCpu };
  }

  /** Texels of the positions of an instance that the CPU makes; one that is not there shrinks to a point. */
  positions(present, time, options) {
    const data = new Float32Array(4 * WIDTH * rowsOf(this.#mesh.sourceVertexCount));
    if (present) {
      const p = this.#mesh.sourcePositions(time, undefined, options);
      for (let v = 0; 3 * v < p.length; ++v)
        data.set(p.subarray(3 * v, 3 * v + 3), 4 * v);
    }
    return data;
  }
}

/** The plan for normals as texels of four unsigned numbers, in rows of WIDTH. */
export function normalTexels(mesh) {
  const { normalElements, normalCorners } = mesh.normalPlan;
  const texels = (data) => {
    const rows = rowsOf(data.length / 4), all = new Uint32Array(4 * WIDTH * rows);
    all.set(data);
    return { data: all, rows };
  };
  return { elements: texels(normalElements), corners: texels(normalCorners) };
}

/** Three numbers of each vertex of what a pass made. */
export function pointsOf(texels, count) {
  const out = new Float32Array(3 * count);
  for (let v = 0; v < count; ++v)
    out.set(texels.subarray(4 * v, 4 * v + 3), 3 * v);
  return out;
}
