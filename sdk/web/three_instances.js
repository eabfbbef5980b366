// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Many instances of a clip's mesh at different times, played by the graphics card of a WebGLRenderer.
//
// Two passes fill textures for all instances: positions, as combinations of the resident basis, and normals, as sums over
// the corners that the CPU sums too. Materials of three.js then fetch both by the number of the vertex, whatever they do
// with them: light, shadows, fog. What the first pass does not do, such as corrections of single vertices, frames between
// two segments, and geometry interpolation, the CPU does for the instances concerned.
import {
  BufferAttribute, BufferGeometry, DataArrayTexture, DataTexture, FloatType, GLSL3,
  InstancedMesh, IntType, Matrix4, Mesh, MeshDepthMaterial, MeshDistanceMaterial, MeshStandardMaterial, NearestFilter,
  OrthographicCamera, RGBADepthPacking, RGBAFormat, RGBAIntegerFormat, RawShaderMaterial, ShortType, Sphere, UnsignedIntType,
  Vector2, Vector3, WebGLRenderTarget,
} from 'three';
import { raycastInstances } from './three_rays.js';

const LINEAR_TEXELS = 7;  // of a region of an instance, before its weights: two maps of three rows, and the number of the segment
const WIDTH = 1024;  // texels of a row of vertices

const FULL = `
precision highp float;
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }`;

const POSITIONS = `
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

const NORMALS = `
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

const FETCH = `
uniform highp sampler2D anicPositions, anicNormals;
uniform int anicRows, anicSourceRows;
vec4 anicNormal() {
  return texelFetch(anicNormals, ivec2(gl_VertexID % ${WIDTH}, gl_VertexID / ${WIDTH} + gl_InstanceID * anicRows), 0);
}
vec3 anicPosition() {
  int v = int(anicNormal().w);
  return texelFetch(anicPositions, ivec2(v % ${WIDTH}, v / ${WIDTH} + gl_InstanceID * anicSourceRows), 0).xyz;
}
`;

const rowsOf = (count) => Math.max(Math.ceil(count / WIDTH), 1);

function texture(Type, Class, data, width, height, depth, type, format, internalFormat) {
  const made = Class === DataTexture ? new DataTexture(data, width, height, format, type) : new DataArrayTexture(data, width, height, depth);
  Object.assign(made, { format, type, internalFormat, minFilter: NearestFilter, magFilter: NearestFilter, generateMipmaps: false, unpackAlignment: 1, needsUpdate: true });
  return made;
}

/** The basis of a segment as textures: a row of WIDTH vertices, rows, and a layer for each component or four of them. */
function basisTextures(basis) {
  const { vertexCount, components, wideComponents, channels } = basis, rows = rowsOf(vertexCount), scalar = channels === 1;
  const layered = (from, count, Type, type, internal) => {
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
    return texture(Type, DataArrayTexture, data, WIDTH, rows, layers, type, RGBAIntegerFormat, internal);
  };
  const pose = new Float32Array(4 * WIDTH * rows);
  for (let v = 0; basis.pose && v < vertexCount; ++v) {
    for (let c = 0; c < 3; ++c)
      pose[4 * v + c] = basis.pose[((v >> 4) * 3 + c) * 16 + (v & 15)];
    pose[4 * v + 3] = basis.vertexRegion?.[v] ?? 0;
  }
  return {
    wide: layered(basis.wide, wideComponents, Int32Array, IntType, 'RGBA32I'),
    narrow: layered(basis.narrow, components - wideComponents, Int16Array, ShortType, 'RGBA16I'),
    pose: texture(Float32Array, DataTexture, pose, WIDTH, rows, 1, FloatType, RGBAFormat, 'RGBA32F'),
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

/** Instances of a mesh of a clip. `times` are seconds, of the clips that `clips` numbers; setMatrixAt() and all else is as for InstancedMesh. */
export class AnicInstances extends InstancedMesh {
  #mesh;
  #clip;
  #rows;
  #sourceRows;
  #targets;
  #state;
  #width;
  #segments = new Map();
  #screen;
  #camera = new OrthographicCamera();
  #passes;

  constructor(mesh, count, material = new MeshStandardMaterial(), options = {}) {
    const geometry = new BufferGeometry();
    // Both come from textures; three.js counts vertices by the first, and shades them flat without the second.
    const unused = new BufferAttribute(new Float32Array(3 * mesh.vertexCount), 3);
    geometry.setAttribute('position', unused);
    geometry.setAttribute('normal', unused);
    geometry.setIndex(new BufferAttribute(mesh.indices, 1));
    const uv = mesh.attribute('uv');
    if (uv)
      geometry.setAttribute('uv', new BufferAttribute(uv, uv.length / mesh.vertexCount));
    if (!mesh.bounds)
      throw new Error('AnicInstances needs a clip that was opened with bounds');
    const { min, max } = mesh.bounds, low = new Vector3(...min), high = new Vector3(...max);
    geometry.boundingSphere = new Sphere(low.clone().add(high).multiplyScalar(0.5), low.distanceTo(high) / 2);
    super(geometry, material, count);
    this.#mesh = mesh;
    this.#clip = mesh.clip;
    this.options = options;
    this.times = new Float64Array(count);
    this.clips = new Uint16Array(count).fill(mesh.clip.find(options.clip).index);
    this.madeByCpu = 0;  // instances, by the last update()
    this.#rows = rowsOf(mesh.vertexCount);
    this.#sourceRows = rowsOf(mesh.sourceVertexCount);
    const target = (rows) => new WebGLRenderTarget(WIDTH, rows * count, {
      type: FloatType, format: RGBAFormat, internalFormat: 'RGBA32F', minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: false, generateMipmaps: false,
    });
    this.#targets = { positions: target(this.#sourceRows), normals: target(this.#rows) };
    const uniforms = {
      anicPositions: { value: this.#targets.positions.texture }, anicNormals: { value: this.#targets.normals.texture },
      anicRows: { value: this.#rows }, anicSourceRows: { value: this.#sourceRows },
    };
    const patched = (one) => {
      one.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, uniforms);
        shader.vertexShader = FETCH + shader.vertexShader
          .replace('#include <begin_vertex>', 'vec3 transformed = anicPosition();')
          .replace('#include <beginnormal_vertex>', 'vec3 objectNormal = anicNormal().xyz;');
      };
      one.customProgramCacheKey = () => 'anicodec';
      return one;
    };
    this.material = patched(material.clone());
    this.customDepthMaterial = patched(new MeshDepthMaterial({ depthPacking: RGBADepthPacking }));
    this.customDistanceMaterial = patched(new MeshDistanceMaterial());
    for (let i = 0; i < count; ++i)
      this.setMatrixAt(i, new Matrix4());
    this.#makePasses();
  }

  /** A texture of the plan for normals: what each vertex and each corner refer to. */
  #makePasses() {
    const { normalElements, normalCorners } = this.#mesh.normalPlan;
    const uints = (data, count) => {
      const rows = rowsOf(count), all = new Uint32Array(4 * WIDTH * rows);
      all.set(data);
      return texture(Uint32Array, DataTexture, all, WIDTH, rows, 1, UnsignedIntType, RGBAIntegerFormat, 'RGBA32UI');
    };
    const pass = (fragmentShader, uniforms) => new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: FULL, fragmentShader, uniforms, depthTest: false, depthWrite: false });
    const uniform = (names) => Object.fromEntries(names.map((name) => [name, { value: null }]));
    this.#passes = {
      positions: pass(POSITIONS, uniform(['wide', 'narrow', 'pose', 'state', 'segment', 'rows', 'wideCount', 'narrowCount', 'scalar', 'hasPose', 'regionTexels', 'origin'])),
      normals: pass(NORMALS, {
        positions: { value: this.#targets.positions.texture }, elements: { value: uints(normalElements, this.#mesh.vertexCount) },
        corners: { value: uints(normalCorners, normalCorners.length / 4) }, rows: { value: this.#rows }, sourceRows: { value: this.#sourceRows },
      }),
    };
    const triangle = new BufferGeometry();
    triangle.setAttribute('position', new BufferAttribute(Float32Array.of(-1, -1, 0, 3, -1, 0, -1, 3, 0), 3));
    this.#screen = new Mesh(triangle, this.#passes.positions);
    this.#screen.frustumCulled = false;
  }

  /** Textures and numbers of a segment, made when an instance first shows it. */
  #segment(index) {
    if (!this.#segments.has(index)) {
      const basis = this.#clip.basis(index);
      this.#segments.set(index, { basis, ...(basis.msgi ? {} : basisTextures(basis)) });
    }
    return this.#segments.get(index);
  }

  /** Room for the weights of every instance. */
  #stateOf(texels) {
    if (!this.#state || this.#width < texels) {
      this.#state?.dispose();
      this.#width = texels;
      this.#state = texture(Float32Array, DataTexture, new Float32Array(4 * texels * this.count), texels, this.count, 1, FloatType, RGBAFormat, 'RGBA32F');
    }
    return this.#state;
  }

  /** Writes what an instance shows; false when the CPU has to do it. */
  #place(instance, part) {
    const { basis } = this.#segment(part.segment), { components, weightChannels, regions } = basis, { decoder } = this.#clip;
    if (basis.msgi || part.share !== 1 || part.correctionCount > 0)
      return false;
    const texels = regionTexels(basis), data = this.#stateOf(regions * texels).image.data;
    const count = components * weightChannels, weights = decoder.view(Float32Array, part.weightsAt, regions * count);
    const maps = regions > 1 ? decoder.view(Float32Array, part.poseMapsAt, 12 * regions) : part.poseMap;
    for (let r = 0, at = 4 * this.#width * instance; r < regions; ++r, at += 4 * texels) {
      data.set(maps.slice(12 * r, 12 * r + 12), at);
      data.set(part.motion, at + 12);
      data[at + 24] = part.segment;
      placeWeights(basis, weights.subarray(count * r, count * (r + 1)), data, at + 4 * LINEAR_TEXELS);
    }
    return true;
  }

  #optionsOf(instance) {
    return { ...this.options, clip: this.clips[instance] };
  }

  /** What an instance shows; no parts when the mesh is not there. */
  #partsOf(instance) {
    try {
      return this.#mesh.parts(this.times[instance], this.#optionsOf(instance));
    } catch (error) {
      if (error.status === 'ANIC_E_ABSENT')
        return [];
      throw error;
    }
  }

  /** Makes positions and normals of all instances for their times. Call it before rendering. */
  update(renderer) {
    if (!renderer.extensions.has('EXT_color_buffer_float'))
      throw new Error('this graphics card draws into no float textures; AnicMesh plays on the CPU');
    const segments = new Set(), byCpu = [];
    this.#stateOf(LINEAR_TEXELS);
    for (let i = 0; i < this.count; ++i) {
      const parts = this.#partsOf(i), width = this.#width;
      if (parts.length === 1 && this.#place(i, parts[0])) {
        segments.add(parts[0].segment);
      } else {
        this.#state.image.data[4 * this.#width * i + 24] = -1;
        byCpu.push([i, parts.length > 0]);
      }
      if (this.#width !== width) {  // a segment of more components than any before: begin anew
        segments.clear();
        byCpu.length = 0;
        i = -1;
      }
    }
    this.#state.needsUpdate = true;

    const target = renderer.getRenderTarget(), clears = renderer.autoClear;
    renderer.autoClear = false;
    renderer.setRenderTarget(this.#targets.positions);
    for (const index of segments) {
      const { basis, wide, narrow, pose } = this.#segment(index), { uniforms } = this.#passes.positions;
      const values = {
        wide, narrow, pose, state: this.#state, segment: index, rows: this.#sourceRows, wideCount: basis.wideComponents,
        narrowCount: basis.components - basis.wideComponents, scalar: basis.channels === 1 ? 1 : 0, hasPose: basis.pose?.length > 0 ? 1 : 0, regionTexels: regionTexels(basis),
        origin: new Vector3(...basis.origin),
      };
      for (const [name, value] of Object.entries(values))
        uniforms[name].value = value;
      this.#passes.positions.uniformsNeedUpdate = true;
      this.#screen.material = this.#passes.positions;
      renderer.render(this.#screen, this.#camera);
    }
    this.madeByCpu = byCpu.length;
    for (const [i, present] of byCpu)
      this.#upload(renderer, i, present);
    renderer.setRenderTarget(this.#targets.normals);
    this.#screen.material = this.#passes.normals;
    renderer.render(this.#screen, this.#camera);
    renderer.setRenderTarget(target);
    renderer.autoClear = clears;
  }

  /** Positions of one instance by the CPU; one that is not there shrinks to a point. */
  #upload(renderer, instance, present) {
    const data = new Float32Array(4 * WIDTH * this.#sourceRows);
    if (present) {
      const p = this.#mesh.sourcePositions(this.times[instance], undefined, this.#optionsOf(instance));
      for (let v = 0; 3 * v < p.length; ++v)
        data.set(p.subarray(3 * v, 3 * v + 3), 4 * v);
    }
    const rows = texture(Float32Array, DataTexture, data, WIDTH, this.#sourceRows, 1, FloatType, RGBAFormat, 'RGBA32F');
    renderer.copyTextureToTexture(rows, this.#targets.positions.texture, null, new Vector2(0, instance * this.#sourceRows));
    rows.dispose();
  }

  /** Reads back what the card made: positions in the order of the source, or normals. For tests. */
  read(renderer, instance, what = 'positions') {
    const rows = what === 'positions' ? this.#sourceRows : this.#rows, data = new Float32Array(4 * WIDTH * rows);
    const count = what === 'positions' ? this.#mesh.sourceVertexCount : this.#mesh.vertexCount, out = new Float32Array(3 * count);
    renderer.readRenderTargetPixels(this.#targets[what], 0, instance * rows, WIDTH, rows, data);
    for (let v = 0; v < count; ++v)
      out.set(data.subarray(4 * v, 4 * v + 3), 3 * v);
    return out;
  }

  /** Rays hit the instances as they are at their times. */
  raycast(raycaster, intersects) {
    raycastInstances(this, this.#mesh, (i) => this.#optionsOf(i), raycaster, intersects);
  }

  dispose() {
    super.dispose();
    for (const target of Object.values(this.#targets))
      target.dispose();
    for (const { wide, narrow, pose } of this.#segments.values())
      for (const one of [wide, narrow, pose])
        one?.dispose();
    this.#state?.dispose();
    this.#passes.normals.uniforms.elements.value.dispose();
    this.#passes.normals.uniforms.corners.value.dispose();
    for (const pass of Object.values(this.#passes))
      pass.dispose();
    this.geometry.dispose();
    this.material.dispose();
  }
}
