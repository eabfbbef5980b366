// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Many instances of a clip's mesh at different times, played by the graphics card of a WebGPURenderer.
//
// A compute pass combines the resident basis into positions, in the order of the source. The vertex shader of any node
// material reads them, and sums over the same corners as the CPU does into smooth normals. Frames that need more than a
// combination (corrections, times between two segments, geometry interpolation) are filled by the CPU.
import {
  Fn, If, Loop, Return, cross, dot, float, instanceIndex, int, materialColor, normalLocal, normalize, storage, uint, varying, vec3, vec4, vertexIndex,
} from 'three/tsl';
import {
  BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshStandardNodeMaterial, Sphere, StorageBufferAttribute, Vector3,
} from 'three/webgpu';
import { FieldSteps, stepColours } from './field_steps.js';
import { fieldNames, fieldOf } from './fields.js';
import { InstanceAnchors } from './three_instance_anchors.js';
import { raycastInstances } from './three_rays.js';

const MATRIX = 0, MOTION = 3, SEGMENT = 6, REGIONS = 7;  // of an instance, in vectors of four
const POSE_MAP = 0, WEIGHTS = 3;  // of one of its regions

/** Vectors of a region: a weight of three numbers to each, or four weights. */
const regionVectors = ({ components, weightChannels }) => WEIGHTS + (weightChannels === 3 ? components : Math.ceil(components / 4));

const reading = (array, size, type) => {
  const attribute = new StorageBufferAttribute(array, size);
  return Object.assign(storage(attribute, type, array.length / size).toReadOnly(), { attribute });
};

/** Numbers of 16 bits, two to a word. */
function packed(narrow) {
  const words = new Uint32Array(Math.max(Math.ceil((narrow?.length ?? 0) / 2), 1));
  for (let i = 0; narrow && i < narrow.length; ++i)
    words[i >> 1] |= (narrow[i] & 0xffff) << (16 * (i & 1));
  return words;
}

/** Instances of a mesh of a clip. `times` are seconds, of the clips that `clips` numbers. */
export class AnicInstances extends Mesh {
  #mesh;
  #segments = new Map();
  #state;
  #stride;
  #positions;
  #plan;
  #anchors;
  #painted;  // with a field: its bytes and their buffer, the material before

  constructor(mesh, count, material = new MeshStandardNodeMaterial(), options = {}) {
    const geometry = new BufferGeometry(), n = mesh.vertexCount;
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * n), 3));
    geometry.setAttribute('normal', new BufferAttribute(new Float32Array(3 * n), 3));
    geometry.setIndex(new BufferAttribute(mesh.indices, 1));
    const uv = mesh.attribute('uv');
    if (uv)
      geometry.setAttribute('uv', new BufferAttribute(uv, uv.length / n));
    if (!mesh.bounds)
      throw new Error('AnicInstances needs a clip that was opened with bounds');
    const { min, max } = mesh.bounds, low = new Vector3(...min), high = new Vector3(...max);
    geometry.boundingSphere = new Sphere(low.clone().add(high).multiplyScalar(0.5), low.distanceTo(high) / 2);
    super(geometry, material.clone());
    Object.assign(this, { count, options, times: new Float64Array(count), clips: new Uint16Array(count).fill(mesh.clip.find(options.clip).index), madeByCpu: 0 });
    this.frustumCulled = false;  // instances are elsewhere than their box
    this.#mesh = mesh;
    const { normalElements, normalCorners } = mesh.normalPlan;
    this.#plan = { elements: reading(normalElements, 4, 'uvec4'), corners: reading(normalCorners, 4, 'uvec4') };
    const segments = Array.from({ length: mesh.clip.info.segments }, (_, s) => mesh.clip.basis(s)).filter((basis) => basis.mesh === mesh.index && !basis.movesAttribute);
    this.#stride = REGIONS + Math.max(...segments.map((basis) => basis.regions * regionVectors(basis)), 1);
    this.#state = reading(new Float32Array(4 * this.#stride * count), 4, 'vec4');
    this.#positions = new StorageBufferAttribute(new Float32Array(4 * mesh.sourceVertexCount * count), 4);
    for (let i = 0; i < count; ++i)
      this.#state.attribute.array.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], this.#at(i, MATRIX));
    this.material.positionNode = this.#shown();
    this.#anchors = new InstanceAnchors(this, mesh, (i) => this.#optionsOf(i));
  }

  #at(instance, vector) {
    return 4 * (instance * this.#stride + vector);
  }

  setMatrixAt(instance, { elements: e }) {
    this.#state.attribute.array.set([e[0], e[4], e[8], e[12], e[1], e[5], e[9], e[13], e[2], e[6], e[10], e[14]], this.#at(instance, MATRIX));
  }

  getMatrixAt(instance, matrix) {
    return matrix.set(...this.#state.attribute.array.subarray(this.#at(instance, MATRIX), this.#at(instance, MATRIX) + 12), 0, 0, 0, 1);
  }

  /** A vertex of an instance: position, and a normal by the way. */
  #shown() {
    const { elements, corners } = this.#plan, state = this.#state, stride = this.#stride, vertices = this.#mesh.sourceVertexCount;
    const positions = storage(this.#positions, 'vec4', this.#positions.count).toReadOnly();
    return Fn(() => {
      const base = int(instanceIndex).mul(stride).toVar(), first = int(instanceIndex).mul(vertices).toVar();
      const point = (v) => positions.element(first.add(int(v))).xyz;
      const element = elements.element(vertexIndex).toVar(), p = vec4(point(element.x), 1).toVar(), centre = point(element.y).toVar(), sum = vec3(0).toVar();
      Loop({ start: int(0), end: int(element.w), type: 'int', condition: '<' }, ({ i }) => {
        const corner = corners.element(int(element.z).add(i)).toVar();
        sum.addAssign(cross(point(corner.x).sub(centre), point(corner.y).sub(centre)));
      });
      const row = (r) => state.element(base.add(MATRIX + r));
      // Up to a scale of the rows, which is that of normals too where instances are not sheared.
      const most = sum.x.abs().max(sum.y.abs()).max(sum.z.abs()).toVar(), n = most.greaterThan(0).select(sum.div(most), vec3(0, 0, 1)).toVar();
      normalLocal.assign(normalize(vec3(dot(row(0).xyz, n), dot(row(1).xyz, n), dot(row(2).xyz, n))));
      return vec3(dot(row(0), p), dot(row(1), p), dot(row(2), p));
    })();
  }

  /** The compute pass of a segment, made when an instance first shows it. */
  #segment(index) {
    if (!this.#segments.has(index)) {
      const basis = this.#mesh.clip.basis(index);
      this.#segments.set(index, { basis, pass: basis.msgi ? undefined : this.#pass(index, basis) });
    }
    return this.#segments.get(index);
  }

  #pass(index, basis) {
    const { components, wideComponents, channels, origin, pose, wide, narrow, vertexRegion } = basis;
    const state = this.#state, stride = this.#stride, vertices = this.#mesh.sourceVertexCount, total = vertices * this.count;
    const wides = reading(wide?.length ? wide : new Int32Array(1), 1, 'int'), narrows = reading(packed(narrow), 1, 'uint');
    const poses = reading(pose?.length ? pose : new Float32Array(1), 1, 'float'), out = storage(this.#positions, 'vec4', this.#positions.count);
    const regions = vertexRegion ? reading(Int32Array.from(vertexRegion), 1, 'int') : undefined;
    return Fn(() => {
      const instance = int(instanceIndex).div(vertices).toVar(), v = int(instanceIndex).mod(vertices).toVar();
      const base = instance.mul(stride).toVar(), of = (i) => state.element(base.add(i));
      If(of(SEGMENT).x.notEqual(float(index)), () => { Return(); });
      const block = v.div(16).toVar(), lane = v.mod(16).toVar(), x = vec3(0).toVar();
      const region = (regions ? base.add(regions.element(v).mul(regionVectors(basis))) : base).add(REGIONS).toVar();
      const ofRegion = (i) => state.element(region.add(i));
      const moved = (rows, first, p) => vec3(dot(rows(first), p), dot(rows(first + 1), p), dot(rows(first + 2), p));
      if (pose?.length > 0) {
        const place = (c) => poses.element(block.mul(48).add(16 * c).add(lane));
        x.assign(moved(ofRegion, POSE_MAP, vec4(place(0), place(1), place(2), 1)));
      }
      const number = (at, isWide) => {
        if (isWide)
          return float(wides.element(at));
        const word = narrows.element(at.div(2)), shift = uint(16).sub(uint(at.mod(2)).mul(uint(16)));
        return float(int(word.shiftLeft(shift)).shiftRight(int(16)));
      };
      const weight = (j) => {
        const four = ofRegion(j.div(4).add(WEIGHTS)).toVar(), k = j.mod(4);
        return k.equal(0).select(four.x, k.equal(1).select(four.y, k.equal(2).select(four.z, four.w)));
      };
      const add = (isWide, begin, count) => count > 0 && Loop({ start: int(0), end: int(count), type: 'int', condition: '<' }, ({ i }) => {
        const at = block.mul(count).add(i).mul(channels).mul(16).add(lane).toVar(), j = i.add(begin).toVar();
        if (channels === 1)
          x.addAssign(ofRegion(j.add(WEIGHTS)).xyz.mul(number(at, isWide)));
        else
          x.addAssign(vec3(number(at, isWide), number(at.add(16), isWide), number(at.add(32), isWide)).mul(weight(j)));
      });
      add(true, 0, wideComponents);
      add(false, wideComponents, components - wideComponents);
      out.element(instanceIndex).assign(vec4(moved(of, MOTION, vec4(x.add(vec3(...origin)), 1)), 1));
    })().compute(total);
  }

  #optionsOf(instance) {
    return { ...this.options, clip: this.clips[instance] };
  }

  /** Writes what an instance shows; false when the CPU has to do it. */
  #place(instance, { segment, share, correctionCount, poseMap, poseMapsAt, motion, weightsAt }) {
    const { basis } = this.#segment(segment), { msgi, components, weightChannels, regions } = basis, { array } = this.#state.attribute;
    if (msgi || share !== 1 || correctionCount > 0)
      return false;
    array.set(motion, this.#at(instance, MOTION));
    array[this.#at(instance, SEGMENT)] = segment;
    const { decoder } = this.#mesh.clip, count = components * weightChannels, weights = decoder.view(Float32Array, weightsAt, regions * count);
    const maps = regions > 1 ? decoder.view(Float32Array, poseMapsAt, 12 * regions) : poseMap;
    for (let r = 0, at = this.#at(instance, REGIONS); r < regions; ++r, at += 4 * regionVectors(basis)) {
      const own = weights.subarray(count * r, count * (r + 1)), to = at + 4 * WEIGHTS;
      array.set(maps.slice(12 * r, 12 * r + 12), at + 4 * POSE_MAP);
      if (weightChannels === 3) {
        for (let j = 0; j < components; ++j)
          array.set(own.subarray(3 * j, 3 * j + 3), to + 4 * j);
      } else {
        array.set(own, to);
      }
    }
    return true;
  }

  /** Makes the positions of all instances for their times. Call it before rendering, after renderer.init(). */
  update(renderer) {
    if (!renderer.backend.isWebGPUBackend)
      throw new Error('this renderer draws by WebGL: AnicInstances of anicodec/three are for WebGLRenderer');
    const mesh = this.#mesh, n = mesh.sourceVertexCount, segments = new Set(), { array } = this.#positions;
    this.madeByCpu = 0;
    this.#positions.clearUpdateRanges();
    for (let i = 0; i < this.count; ++i) {
      const options = this.#optionsOf(i), present = mesh.isPresent(this.times[i], options), parts = present ? mesh.parts(this.times[i], options) : [];
      if (parts.length === 1 && this.#place(i, parts[0])) {
        segments.add(parts[0].segment);
        continue;
      }
      ++this.madeByCpu;
      this.#state.attribute.array[this.#at(i, SEGMENT)] = -1;
      const p = present ? mesh.sourcePositions(this.times[i], undefined, options) : undefined;
      for (let v = 0; v < n; ++v)  // one that is not there shrinks to a point
        array.set(p ? p.subarray(3 * v, 3 * v + 3) : [0, 0, 0], 4 * (i * n + v));
      this.#positions.addUpdateRange(4 * i * n, 4 * n);
    }
    this.#state.attribute.needsUpdate = true;
    if (this.madeByCpu > 0)
      this.#positions.needsUpdate = true;
    for (const segment of segments)
      renderer.compute(this.#segment(segment).pass);
    this.#anchors.update();
    if (this.#painted?.steps.update(this.times, (i) => this.#optionsOf(i)))
      this.#painted.words.attribute.needsUpdate = true;
  }

  /** Keeps a group on a point of an instance's surface: a hit of a Raycaster, or a point of ClipMesh.intersectRay() with `instanceId`. */
  anchor(point, group) { return this.#anchors.add(point, group); }

  /** Names of the fields of the mesh. */
  get fields() { return fieldNames({ meshes: [this.#mesh] }); }

  /** Shows a field as colours, as AnicMesh.showField() does, from the next update() on. Each instance has those of its time. */
  showField(name, { material, ...range } = {}) {
    const mesh = this.#mesh, field = name === undefined ? undefined : fieldOf(mesh.clip, name, mesh.clip.find(this.clips[0]), range);
    const own = this.#painted?.own ?? this.material;
    if (this.#painted)
      this.material.dispose();
    this.material = own;
    this.#painted = undefined;
    if (!field)
      return undefined;
    const each = Math.ceil(mesh.vertexCount / 4), steps = new FieldSteps(mesh, field, this.count, 4 * each);
    const words = reading(new Uint32Array(steps.data.buffer), 1, 'uint'), colours = reading(stepColours(), 4, 'vec4');
    this.material = material?.clone() ?? new MeshStandardNodeMaterial({ side: DoubleSide });
    this.material.positionNode = own.positionNode;
    this.material.colorNode = materialColor.mul(varying(Fn(() => {
      const v = int(vertexIndex), word = words.element((steps.moves ? int(instanceIndex).mul(each) : int(0)).add(v.div(4)));
      return colours.element(int(word.shiftRight(uint(v.mod(4)).mul(uint(8))).bitAnd(uint(255)))).xyz;
    })()));
    this.#painted = { own, steps, words };
    return field;
  }

  /** The positions that the card made, or that it is given when it draws: in the order of the source. For tests. */
  async read(renderer, instance) {
    const n = this.#mesh.sourceVertexCount, out = new Float32Array(3 * n);
    const all = this.madeByCpu === this.count ? this.#positions.array : new Float32Array(await renderer.getArrayBufferAsync(this.#positions));
    for (let v = 0; v < n; ++v)
      out.set(all.subarray(4 * (instance * n + v), 4 * (instance * n + v) + 3), 3 * v);
    return out;
  }

  /** Rays hit the instances as they are at their times. */
  raycast(raycaster, intersects) {
    raycastInstances(this, this.#mesh, (i) => this.#optionsOf(i), raycaster, intersects);
  }

  dispose() {
    this.showField();
    for (const { pass } of this.#segments.values())
      pass?.dispose();
    this.geometry.dispose();
    this.material.dispose();
  }
}
