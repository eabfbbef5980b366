// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in PlayCanvas: a script of entities that opens a file, shows and plays it.
import {
  BLEND_NORMAL, BoundingBox, CULLFACE_BACK, CULLFACE_NONE, Entity, Mat4, Mesh, MeshInstance, PRIMITIVE_POINTS, PRIMITIVE_TRIANGLES, Quat, Script, StandardMaterial,
  Vec3,
} from 'playcanvas';
import { fieldNames, fieldOf, writeFieldColours } from './fields.js';
import { open } from './index.js';
import { sampleOf } from './moments.js';

/** The material of a group of triangles, with the values that the file has; `userData` names its images. */
function materialOf({ material: name = 'anic', look }) {
  const made = Object.assign(new StandardMaterial(), { name, useMetalness: true, metalness: 0, gloss: 0.2, cull: CULLFACE_NONE, twoSidedLighting: true });
  if (look) {
    const { baseColour: [r, g, b, opacity], metallic, roughness, emissive, alpha, alphaCutoff, doubleSided } = look;
    made.diffuse.set(r, g, b).gamma();
    made.emissive.set(...emissive).gamma();
    Object.assign(made, {
      metalness: metallic, gloss: 1 - roughness, opacity: alpha === 'opaque' ? 1 : opacity, alphaTest: alpha === 'mask' ? alphaCutoff : 0,
      cull: doubleSided ? CULLFACE_NONE : CULLFACE_BACK, twoSidedLighting: doubleSided, userData: { anic: look },
    });
    if (alpha === 'blend')
      Object.assign(made, { blendType: BLEND_NORMAL, depthWrite: false });
  }
  return made;
}

function boxOf({ min, max }) {
  const box = new BoundingBox();
  box.setMinMax(new Vec3(...min), new Vec3(...max));
  return box;
}

/** A mesh of a clip on the graphics card, drawn once for each of its materials. */
class Part {
  constructor(mesh, device) {
    const n = mesh.vertexCount, faces = mesh.triangleCount > 0, type = faces ? PRIMITIVE_TRIANGLES : PRIMITIVE_POINTS;
    Object.assign(this, { mesh, type, positions: new Float32Array(3 * n), normals: faces ? new Float32Array(3 * n) : undefined });
    this.colour = mesh.attributes.find((a) => a.kind === 'colour' && a.components >= 3 && a.domain !== 'polygons');
    this.uvs = mesh.attributes.filter((a) => a.kind === 'uv' && a.components === 2 && a.domain !== 'polygons').slice(0, 2);
    const made = new Mesh(device);
    made.clear(true, false);
    made.setPositions(this.positions);
    if (faces) {
      made.setNormals(this.normals);
      made.setIndices(mesh.indices);
    }
    this.uvs.forEach((a, i) => made.setUvs(i, this.#uvsAt(a)));
    this.colours = new Float32Array(4 * n).fill(1);  // white, until a field is shown
    made.setColors(this.colours);
    made.update(type, false);
    const others = mesh.groups.slice(1).map(() => Object.assign(new Mesh(device), { vertexBuffer: made.vertexBuffer, indexBuffer: made.indexBuffer }));
    this.meshes = [made, ...others];
    this.instances = this.meshes.map((one, g) => {
      const { start, count } = mesh.groups[g] ?? { start: 0, count: faces ? mesh.indices.length : n };
      one.primitive[0] = { type, base: start, baseVertex: 0, count, indexed: faces };
      const material = Object.assign(materialOf(mesh.groups[g] ?? {}), { diffuseVertexColor: true });
      material.update();
      return new MeshInstance(one, material);
    });
    for (const one of this.meshes)
      one.aabb = mesh.bounds ? boxOf(mesh.bounds) : new BoundingBox();
    for (const one of this.instances)
      one.cull = !!mesh.bounds;
    this.own = this.instances.map(({ material }) => material);
  }

  /** Texture coordinates; PlayCanvas counts v of images downwards. */
  #uvsAt({ index }, time, options) {
    return this.mesh.attribute(index, time, undefined, options).map((x, i) => (i % 2 === 1 ? 1 - x : x));
  }

  /** Colours of the vertices: of a field, or their own. */
  #paint(time, options, field) {
    const { mesh, colour, colours } = this;
    if (field) {
      writeFieldColours(mesh, field, time, options, colours, { width: 4 });
    } else if (colour) {
      const values = mesh.attribute(colour.index, time, undefined, options), { components } = colour;
      for (let v = 0; v < mesh.vertexCount; ++v) {
        for (let c = 0; c < Math.min(components, 4); ++c)
          colours[4 * v + c] = values[components * v + c];
      }
    } else {
      colours.fill(1);
    }
    this.meshes[0].setColors(colours);
  }

  show(time, options, field, colours) {
    const { mesh, positions, normals, meshes: [made] } = this, present = mesh.isPresent(time, options);
    for (const instance of this.instances)
      instance.visible = present;
    if (!present)
      return;
    if (normals)
      mesh.surfaceAt(time, positions, normals, options);
    else
      mesh.positions(time, positions, options);
    made.setPositions(positions);
    if (normals)
      made.setNormals(normals);
    if (colours || field || this.colour?.moves)
      this.#paint(time, options, field);
    this.uvs.forEach((a, i) => {
      if (a.moves)
        made.setUvs(i, this.#uvsAt(a, time, options));
    });
    const { primitive: [kept] } = made, { base, count } = kept;
    made.update(this.type, false);
    Object.assign(kept, { base, count });  // update() draws all
  }

  release() {
    for (const material of this.own)
      material.destroy();
    for (const other of this.meshes.slice(1))
      Object.assign(other, { vertexBuffer: null, indexBuffer: [null] });
    for (const one of this.meshes)
      one.destroy();
  }
}

/** Shows an .anic file below its entity. */
export class AnicPlayer extends Script {
  static scriptName = 'anicPlayer';

  /**
   * Address of the file.
   * @attribute
   */
  src = '';

  /**
   * The file as a binary asset, in place of an address.
   * @attribute
   * @type {Asset}
   * @resource binary
   */
  asset = null;

  /**
   * Name of the clip that plays first; the first one if empty.
   * @attribute
   */
  clipName = '';

  /**
   * @attribute
   */
  playing = true;

  /**
   * @attribute
   */
  speed = 1;

  /**
   * @attribute
   */
  loop = true;

  /** Options of open(), before the script is initialized. */
  options = {};

  sampling = undefined;

  clip = undefined;

  #moments = [];  // that are shown, the newest last
  #fade = 0;
  #parts = [];
  #shown = '';
  #field;
  #anchors = [];
  #gone = false;

  initialize() {
    this.once('destroy', () => this.#release());
    this.ready = this.#load();
    this.ready.catch((error) => {
      if (this.hasEvent('error'))
        this.fire('error', error);
      else
        console.error(error);
    });
  }

  async #load() {
    const address = this.src || this.asset?.getFileUrl();
    if (!address)
      throw new Error('anicPlayer has neither src nor asset');
    const clip = await open(address, this.options);
    if (this.#gone) {
      clip.close();
      return this;
    }
    this.clip = clip;
    this.#parts = clip.meshes.map((mesh) => new Part(mesh, this.app.graphicsDevice));
    this.holder = new Entity('anic');
    if (clip.info.up === 'z')
      this.holder.setLocalEulerAngles(-90, 0, 0);
    this.holder.addComponent('render', { type: 'asset' });
    this.holder.render.meshInstances = this.#parts.flatMap(({ instances }) => instances);
    this.entity.addChild(this.holder);
    this.play(this.clipName || undefined);
    this.#show(true);
    this.fire('load', clip);
    return this;
  }

  /** The instances that are drawn: their materials may be replaced. */
  get meshInstances() { return this.#parts.flatMap(({ instances }) => instances); }

  /** Plays a clip, by its name or number; the one before fades out within `fade` seconds. */
  play(clip, { fade = 0, time = 0 } = {}) {
    const { index } = this.clip.find(clip);
    this.#fade = fade;
    this.#moments = fade > 0 ? this.#moments.map((one) => ({ ...one, share: one.weight })) : [];
    this.#moments.push({ clip: index, time, weight: this.#moments.length > 0 ? 0 : 1, share: 1 });
  }

  /** Name of the clip that plays. */
  get current() { return this.clip.clips[this.#moments.at(-1).clip].name; }

  /** Seconds from its first frame. */
  get time() { return this.#moments.at(-1).time; }

  set time(seconds) { this.#moments.at(-1).time = seconds; }

  /** Names of the fields: numbers beside positions, such as temperatures. */
  get fields() { return fieldNames(this.clip); }

  /** Shows a field as colours; without a name those of the file again. Returns { name, low, high }. Throws if there is no such field. */
  showField(name, range) {
    this.#field = name === undefined ? undefined : fieldOf(this.clip, name, this.clip.find(this.current), range);
    this.#show(true);
    return this.#field;
  }

  update(seconds) {
    if (!this.clip)
      return;
    if (this.playing) {
      for (const moment of this.#moments)
        moment.time += seconds * this.speed;
      this.#mix(seconds);
    }
    this.#show(false);
  }

  #mix(seconds) {
    const newest = this.#moments.at(-1), others = this.#moments.slice(0, -1);
    if (others.length === 0)
      return;
    newest.weight = Math.min(newest.weight + seconds / this.#fade, 1);
    if (newest.weight === 1)
      this.#moments = [newest];
    for (const one of others)
      one.weight = one.share * (1 - newest.weight);
  }

  /** The moment that is shown now, as sampleOf() gives it. */
  #sample() {
    const largest = this.#moments.filter(({ weight }) => weight > 0).sort((a, b) => b.weight - a.weight);
    return sampleOf(largest, { sampling: this.sampling, wrap: this.loop ? 'loop' : 'clamp' });
  }

  #show(all) {
    const { time, options, key } = this.#sample();
    if (key === this.#shown && !all)
      return;
    for (const part of this.#parts)
      part.show(time, options, this.#field, all);
    this.#shown = key;
    this.#anchors = this.#anchors.filter(({ entity }) => entity.parent === this.holder);
    for (const anchor of this.#anchors)
      this.#place(anchor, time, options);
  }

  /**
   * Keeps an entity on a point of the surface, as what is held or worn: its y axis is the normal, x the tangent. The point is a hit of
   * ClipMesh.intersectRay() with the number of the `mesh`. Below another parent, the entity is free again.
   */
  anchor({ mesh = 0, vertices, weights }, entity = new Entity('anchor')) {
    if (!this.#parts[mesh])
      throw new Error(`the clip has no mesh ${mesh}`);
    const anchor = { entity, mesh: this.#parts[mesh].mesh, point: { vertices, weights } }, { time, options } = this.#sample();
    this.#place(anchor, time, options);  // throws for a point that is none
    this.#anchors = [...this.#anchors.filter((one) => one.entity !== entity), anchor];
    if (entity.parent !== this.holder)
      entity.reparent(this.holder);
    return entity;
  }

  #place({ entity, mesh, point }, time, options) {
    entity.enabled = mesh.isPresent(time, options);
    if (!entity.enabled)
      return;
    const { position, normal, tangent } = mesh.surfaceFrame(point, time, options), z = new Vec3().cross(new Vec3(...tangent), new Vec3(...normal));
    entity.setLocalPosition(...position);
    entity.setLocalRotation(new Quat().setFromMat4(new Mat4().set([...tangent, 0, ...normal, 0, z.x, z.y, z.z, 0, 0, 0, 0, 1])));
  }

  #release() {
    this.#gone = true;
    this.holder?.destroy();
    for (const part of this.#parts)
      part.release();
    this.#parts = [];
    this.clip?.close();
    this.clip = undefined;
  }
}
