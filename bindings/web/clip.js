// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import {
  ASSET_INFO, ATTRIBUTE, BASIS, BOX, CLIP, EVENT, HIT, MATERIAL, MESH, PARTS, POLYGONS, RENDER_INFO, ROOT_MOTION, SAMPLING, SIDE, SURFACE_FRAME, WRAP,
} from './interface.js';
import { AnicError } from './status.js';

const ABSENT = 'ANIC_E_ABSENT';
const FLOAT32X3 = 0;

function number(table, name, what) {
  if (!(name in table))
    throw new TypeError(`${what} is one of ${Object.keys(table).join(', ')}, not ${name}`);
  return table[name];
}

/** An opened clip. Its memory goes with close(), or when nothing refers to it any more. */
export class Clip {
  #decoder;
  #context;
  #seeked;
  #first;
  #scratch = { at: 0, size: 0 };

  constructor(decoder) {
    this.#take(decoder);
  }

  #take(decoder) {
    this.#decoder = decoder;
    this.#context = decoder.run('create_context');
    if (!this.#context)
      throw new AnicError('ANIC_E_MEMORY', 'the browser gives no more memory');
    this.#scratch = { at: 0, size: 0 };
    this.#seeked = undefined;
    decoder.call('info');
    const { meshes, ...info } = decoder.read(ASSET_INFO);
    this.info = Object.freeze({ ...info, metresPerUnit: info.metresPerUnit || undefined, origin: Object.freeze(info.origin) });
    this.clips = Object.freeze(Array.from({ length: decoder.run('clip_count') }, (_, i) => this.#clipInfo(i)));
    this.#first = this.clips.find(({ isOpen }) => isOpen);
    // Meshes that the host holds stay the same objects.
    this.meshes ??= Array.from({ length: meshes }, (_, i) => new ClipMesh(this, i));
    for (const mesh of this.meshes)
      mesh.replaced();
  }

  #clipInfo(index) {
    const decoder = this.#decoder;
    decoder.call('clip', index);
    return Object.freeze({ index, ...decoder.read(CLIP), events: this.#events(index) });
  }

  #events(clip) {
    const decoder = this.#decoder;
    return Object.freeze(Array.from({ length: decoder.run('event_count', clip) }, (_, event) => {
      decoder.call('event', clip, event);
      return Object.freeze(decoder.read(EVENT));
    }));
  }

  /** One of the clips of the file, by its name or number; without either the first one that is open. */
  find(clip) {
    const found = clip === undefined ? this.#first : typeof clip === 'number' ? this.clips[clip] : this.clips.find(({ name }) => name === clip);
    if (!found?.isOpen)
      throw new AnicError(ABSENT, found ? `the clip ${found.name} was not opened` : `there is no clip ${clip}, but ${this.clips.map(({ name }) => name).join(', ')}`);
    return found;
  }

  /** Takes a finer version of the same file. */
  replaceDecoder(decoder) {
    this.#take(decoder);
  }

  get decoder() {
    if (!this.#decoder)
      throw new AnicError('ANIC_E_STATE', 'the clip is closed');
    return this.#decoder;
  }

  get closed() {
    return !this.#decoder;
  }

  get frames() {
    return this.info.frames;
  }

  /** The duration of the first clip that is open. */
  get duration() {
    return this.find().duration;
  }

  /** Bytes that the clip's decoder holds. */
  get memoryBytes() {
    return this.decoder.memory.buffer.byteLength;
  }

  /** Compares the hashes in the file with what was decoded; throws if they differ, or at less than full quality. */
  verify() {
    this.decoder.call('verify');
  }

  /** Time of a frame of the file, in seconds from the first one of its clip. */
  frameTime(frame) {
    return this.decoder.run('frame_time', frame);
  }

  /** The motion of the whole at a time, part of the positions or not: OpenOptions.inPlace. */
  rootMotion(time, options) {
    return this.#motion('root_motion', [time], options);
  }

  /** The step of a character from one time to another, through any number of turns of a loop. */
  rootStep(from, to, options) {
    return this.#motion('root_step', [from, to], options);
  }

  #motion(name, times, { clip, sampling = 'linear', wrap } = {}) {
    const found = this.find(clip);
    this.decoder.call(name, found.index, ...times.map(Number), number(SAMPLING, sampling, 'sampling'),
      number(WRAP, wrap ?? (found.loop ? 'loop' : 'clamp'), 'wrap'));
    return this.decoder.read(ROOT_MOTION);
  }

  /** Chooses what the following calls show. */
  seek(time, { clip, sampling = 'linear', wrap, blend } = {}) {
    const decoder = this.decoder, numbersOf = (one) => {
      const found = this.find(one.clip);
      return [found.index, Number(one.time), number(SAMPLING, one.sampling ?? sampling, 'sampling'),
        number(WRAP, one.wrap ?? wrap ?? (found.loop ? 'loop' : 'clamp'), 'wrap'), Number(one.weight ?? 1)];
    };
    const moments = [numbersOf({ clip, time }), ...(blend ? [blend].flat().map(numbersOf) : [])], [[index, at, how, around], ...others] = moments;
    if (this.#seeked?.length === moments.length && moments.every((moment, i) => moment.every((one, k) => one === this.#seeked[i][k])))
      return this.#context;
    this.#seeked = undefined;
    decoder.call('set_clip', this.#context, index);
    decoder.call('seek_time', this.#context, at, how, around);
    for (const moment of others)
      decoder.call('blend', this.#context, ...moment);
    this.#seeked = moments;
    return this.#context;
  }

  /** Memory of the module for a moment: its address. */
  scratch(bytes) {
    const decoder = this.decoder;
    if (bytes > this.#scratch.size) {
      if (this.#scratch.at)
        decoder.run('release', this.#scratch.at);
      this.#scratch = { at: 0, size: 0 };
      this.#scratch = { at: decoder.allocate(bytes), size: bytes };
    }
    return this.#scratch.at;
  }

  // The first mesh, which is the only one in most clips.
  positions(time, out, options) { return this.meshes[0].positions(time, out, options); }
  normals(time, out, options) { return this.meshes[0].normals(time, out, options); }
  attribute(which, time, out, options) { return this.meshes[0].attribute(which, time, out, options); }
  get indices() { return this.meshes[0].indices; }
  get groups() { return this.meshes[0].groups; }
  get vertexCount() { return this.meshes[0].vertexCount; }

  /** The box around all frames of all meshes. */
  get bounds() {
    const box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
    for (const { bounds } of this.meshes) {
      for (let c = 0; c < 3 && bounds; ++c) {
        box.min[c] = Math.min(box.min[c], bounds.min[c]);
        box.max[c] = Math.max(box.max[c], bounds.max[c]);
      }
    }
    return box;
  }

  /** The resident basis of a segment, for a GPU: arrays are copies. See anic_basis of anicodec.h. */
  basis(segment) {
    const decoder = this.decoder;
    decoder.call('basis', segment);
    const { reconstruction, target, poseAt, wideAt, narrowAt, poseCount, wideCount, narrowCount, vertexShapeAt, vertexRegionAt, ...basis } = decoder.read(BASIS);
    const copy = (Type, at, count) => (at ? decoder.view(Type, at, count).slice() : null);
    return {
      ...basis, msgi: reconstruction === 'msgi', movesAttribute: target === 'attribute',
      pose: copy(Float32Array, poseAt, poseCount), wide: copy(Int32Array, wideAt, wideCount), narrow: copy(Int16Array, narrowAt, narrowCount),
      vertexShape: copy(Uint32Array, vertexShapeAt, basis.vertexCount), vertexRegion: copy(Uint8Array, vertexRegionAt, basis.vertexCount),
    };
  }

  close() {
    this.#decoder?.close();
    this.#decoder = undefined;
  }

  [Symbol.dispose ?? Symbol('dispose')]() {
    this.close();
  }
}

/** A mesh of a clip. Vertices are render vertices: one for each vertex and what its corners carry. */
export class ClipMesh {
  #clip;
  #index;
  #plan;
  #render;
  #options = { crease: 0, sourceEdges: true };

  constructor(clip, index) {
    this.#clip = clip;
    this.#index = index;
  }

  /** The clip has another decoder now. */
  replaced() {
    const decoder = this.#clip.decoder;
    decoder.call('mesh', this.#index);
    const { name, vertexCount, polygonCount, cornerCount, attributeCount } = decoder.read(MESH);
    Object.assign(this, { name, sourceVertexCount: vertexCount, polygonCount, cornerCount });
    this.attributes = Array.from({ length: attributeCount }, (_, a) => this.#attributeInfo(a));
    this.#plan = undefined;
    if (this.#render)
      this.#makePlan();
  }

  #attributeInfo(index) {
    const decoder = this.#clip.decoder;
    decoder.call('attribute', this.#index, index);
    const { valuesAt, labelsAt, labelCount, ...attribute } = decoder.read(ATTRIBUTE);
    const labels = Array.from({ length: labelCount }, (_, l) => decoder.string(decoder.run('label_name', this.#index, index, l)));
    return { index, ...attribute, labels, looks: attribute.kind === 'material' ? labels.map((_, l) => this.#look(index, l)) : [] };
  }

  /** The look of a material that a label names; undefined where the file has its name alone. */
  #look(attribute, label) {
    const decoder = this.#clip.decoder;
    if (decoder.run('material', this.#index, attribute, label) !== 0)
      return undefined;
    const { name, ...look } = decoder.read(MATERIAL);
    return Object.fromEntries(Object.entries(look).map(([key, value]) => [key, value === '' ? undefined : value]));
  }

  get clip() { return this.#clip; }

  get index() { return this.#index; }

  /** How normals are made, before the first use: crease angle in degrees, and the edges that were hard in the source. */
  set shading({ crease = 0, sourceEdges = true }) {
    this.#options = { crease, sourceEdges };
    if (this.#plan)
      this.#clip.decoder.run('destroy_plan', this.#plan);
    this.#plan = this.#render = undefined;
  }

  #makePlan() {
    const decoder = this.#clip.decoder;
    this.#plan = decoder.run('create_plan', this.#index, this.#options.crease, this.#options.sourceEdges ? 1 : 0);
    if (!this.#plan) {
      const [status] = decoder.numbers(1);
      throw decoder.error(status);
    }
  }

  get #planned() {
    if (!this.#plan)
      this.#makePlan();
    return this.#plan;
  }

  /** Indices, groups, and where vertices come from: copies, made once. */
  get #surface() {
    if (!this.#render) {
      const decoder = this.#clip.decoder;
      decoder.call('plan_info', this.#planned);
      const plan = decoder.read(RENDER_INFO), { vertexCount, triangleCount, groupCount } = plan;
      const copy = (at, count) => decoder.view(Uint32Array, at, at ? count : 0).slice();
      const begin = copy(plan.groupBeginAt, groupCount + 1), labels = copy(plan.groupMaterialsAt, groupCount);
      const { labels: names = [], looks = [] } = this.attributes.find((a) => a.kind === 'material') ?? {};
      this.#render = {
        vertexCount, triangleCount, indices: copy(plan.indicesAt, 3 * triangleCount), sourceVertices: copy(plan.verticesAt, vertexCount),
        sourceCorners: copy(plan.cornersAt, vertexCount), trianglePolygons: copy(plan.trianglePolygonsAt, triangleCount),
        groups: Array.from(labels, (label, g) => ({
          start: 3 * begin[g], count: 3 * (begin[g + 1] - begin[g]), material: label > 0 ? names[label - 1] : undefined, look: label > 0 ? looks[label - 1] : undefined,
        })),
      };
    }
    return this.#render;
  }

  get vertexCount() { return this.#surface.vertexCount; }

  get triangleCount() { return this.#surface.triangleCount; }

  get indices() { return this.#surface.indices; }

  get groups() { return this.#surface.groups; }

  get sourceVertices() { return this.#surface.sourceVertices; }

  get sourceCorners() { return this.#surface.sourceCorners; }

  get trianglePolygons() { return this.#surface.trianglePolygons; }

  /**
   * For normals on a GPU. normalElements: four numbers for each vertex: its vertex of the source, that of the centre of its
   * group of corners, the first corner of the group, and how many there are. normalCorners: four for each corner: the
   * source's vertices after and before it, and two zeros. See anic_render_info of anicodec.h.
   */
  get normalPlan() {
    const decoder = this.#clip.decoder, source = this.sourceVertices, vertices = this.vertexCount;
    decoder.call('plan_info', this.#planned);
    const plan = decoder.read(RENDER_INFO), groups = plan.normalGroupCount;
    const view = (at, count) => decoder.view(Uint32Array, at, count);
    const group = view(plan.normalGroupsAt, vertices), centre = view(plan.normalCentresAt, groups), begin = view(plan.normalBeginAt, groups + 1);
    const corners = view(plan.normalCornersAt, 2 * begin[groups]);
    const normalElements = new Uint32Array(4 * vertices), normalCorners = new Uint32Array(2 * corners.length);
    for (let r = 0; r < vertices; ++r) {
      const g = group[r];
      normalElements.set([source[r], source[centre[g]], begin[g], begin[g + 1] - begin[g]], 4 * r);
    }
    for (let c = 0; 2 * c < corners.length; ++c)
      normalCorners.set([source[corners[2 * c]], source[corners[2 * c + 1]]], 4 * c);
    return { normalElements, normalCorners };
  }

  /** The box around all frames; undefined if the clip was opened without, or the mesh is in no frame. */
  get bounds() {
    const decoder = this.#clip.decoder;
    if (decoder.run('clip_bounds', this.#index) !== 0)
      return undefined;
    return decoder.read(BOX);
  }

  /** Runs write(address, bytes) and copies what it wrote to `out`. */
  #write(Type, length, out, write) {
    if (out && !(out instanceof Type))
      throw new TypeError(`out is no ${Type.name}`);
    if (out && out.length < length)
      throw new AnicError('ANIC_E_BUFFER_SIZE', `out has ${out.length} elements, and ${length} are written`);
    const bytes = length * Type.BYTES_PER_ELEMENT, at = this.#clip.scratch(Math.max(bytes, 1));
    write(at, bytes);
    const made = this.#clip.decoder.view(Type, at, length);
    if (!out)
      return made.slice();
    out.set(made);
    return out;
  }

  /** Whether the mesh is there at a time. */
  isPresent(time, options) {
    try {
      this.parts(time, options);
      return true;
    } catch (error) {
      if (error.status === ABSENT)
        return false;
      throw error;
    }
  }

  /** Positions at a time: vertexCount x 3. */
  positions(time, out, options) {
    const context = this.#clip.seek(time, options), plan = this.#planned, count = this.vertexCount;
    return this.#write(Float32Array, 3 * count, out, (at, bytes) => this.#clip.decoder.call('plan_positions', plan, context, count, at, bytes));
  }

  /** Normals at a time, recomputed from the positions: vertexCount x 3. */
  normals(time, out, options) {
    return this.surfaceAt(time, undefined, out, options).normals;
  }

  /** Positions and normals at a time, at the cost of one. */
  surfaceAt(time, positions, normals, options) {
    const context = this.#clip.seek(time, options), plan = this.#planned, count = this.vertexCount, decoder = this.#clip.decoder;
    const bytes = 12 * count, at = this.#clip.scratch(Math.max(2 * bytes, 1));
    decoder.call('plan_positions', plan, context, count, at, bytes);
    decoder.call('plan_normals', plan, at, count, at + bytes, bytes, FLOAT32X3);
    const give = (from, to) => {
      const made = decoder.view(Float32Array, from, 3 * count);
      if (!to)
        return made.slice();
      to.set(made);
      return to;
    };
    return { positions: give(at, positions), normals: give(at + bytes, normals) };
  }

  /**
   * Values of an attribute, by its number or kind ('uv', 'colour'), at a time: of the vertices, vertexCount x components; of one
   * of polygons, of these.
   */
  attribute(which, time = 0, out = undefined, options = undefined) {
    const found = this.attributes.find((a) => (typeof which === 'number' ? a.index === which : a.kind === which && a.components > 0));
    if (!found || found.components === 0)
      return undefined;
    const context = this.#clip.seek(time, options);
    if (found.domain === 'polygons')
      return this.#write(Float32Array, found.components * found.count, out, (at, bytes) =>
        this.#clip.decoder.call('write_attribute', context, this.#index, found.index, found.count, at, bytes));
    const plan = this.#planned, count = this.vertexCount;
    return this.#write(Float32Array, found.components * count, out, (at, bytes) =>
      this.#clip.decoder.call('plan_attribute', plan, context, found.index, count, at, bytes, 0));
  }

  /**
   * Axes at a point of the surface at a time, for what is attached to it: its position, the triangle's normal, and the tangent
   * from the triangle's first vertex to the second one, of length 1.
   */
  surfaceFrame({ vertices, weights }, time, options) {
    const decoder = this.#clip.decoder, source = this.sourceVertices;
    if (Array.from(vertices).some((vertex) => !(vertex in source)))
      throw new AnicError('ANIC_E_ARGUMENT', `there are no vertices ${vertices}`);
    decoder.call('surface_frame', this.#clip.seek(time, options), this.#index, ...Array.from(vertices, (vertex) => source[vertex]), ...weights);
    return decoder.read(SURFACE_FRAME);
  }

  /**
   * The first point of the surface on a ray { origin, direction, farthest, side } at a time: { distance, triangle, vertices, weights,
   * side }; undefined if it meets nothing. Distances are in lengths of the direction; triangles are those of `indices`.
   */
  intersectRay({ origin, direction, farthest = 0, side = 'any' }, time, options) {
    const decoder = this.#clip.decoder, context = this.#clip.seek(time, options), indices = this.indices, source = this.sourceVertices;
    const triangles = this.triangleCount, work = 12 * this.sourceVertexCount;
    const at = this.#clip.scratch(28 + 12 * triangles + work);
    decoder.view(Float32Array, at, 7).set([...origin, ...direction, farthest]);
    decoder.view(Uint32Array, at + 28, 3 * triangles).set(indices.map((vertex) => source[vertex]));
    decoder.call('intersect_ray', context, this.#index, at, SIDE[side] ?? -1, at + 28, triangles, at + 28 + 12 * triangles, work);
    const { point, distance, triangle, side: met } = decoder.read(HIT);
    if (distance === Infinity)
      return undefined;
    return { distance, triangle, vertices: [...indices.subarray(3 * triangle, 3 * triangle + 3)], weights: point.weights, side: met };
  }

  /** Positions of the vertices of the source, in its order: sourceVertexCount x 3. */
  sourcePositions(time, out, options) {
    const context = this.#clip.seek(time, options), count = this.sourceVertexCount;
    return this.#write(Float32Array, 3 * count, out, (at, bytes) => this.#clip.decoder.call('write_positions', context, this.#index, count, at, bytes));
  }

  /** The source's polygons: polygon p has the vertices corners[offsets[p]] .. corners[offsets[p + 1] - 1]. */
  get polygons() {
    const decoder = this.#clip.decoder;
    decoder.call('polygons', this.#index);
    const { offsetsAt, cornersAt, polygonCount } = decoder.read(POLYGONS), copy = (at, count) => decoder.view(Uint32Array, at, count).slice();
    return { offsets: copy(offsetsAt, polygonCount + 1), corners: copy(cornersAt, this.cornerCount) };
  }

  /** Data that a shader needs at a time, beside basis(): see anic_part of anicodec.h. Arrays are good until the next call. */
  parts(time, options) {
    const context = this.#clip.seek(time, options), decoder = this.#clip.decoder;
    decoder.call('parts', context, this.#index);
    const { count, parts, poseMapsAt } = decoder.read(PARTS);
    return parts.slice(0, count).map((part, p) => ({ ...part, poseMapsAt: poseMapsAt[p] }));
  }
}
