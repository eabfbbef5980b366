// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in PlayCanvas: a script of entities that opens a file, shows and plays it.
import {
  BLEND_NORMAL, BoundingBox, CULLFACE_BACK, CULLFACE_NONE, Entity, Mesh, MeshInstance, PRIMITIVE_POINTS, PRIMITIVE_TRIANGLES, StandardMaterial,
} from 'playcanvas';
import { fieldNames, fieldOf, writeFieldColours } from './fields.js';
import { open } from './index.js';
import { Player, boxOf } from './playcanvas_player.js';

export { AnicScene, loadAnicScene } from './playcanvas_gltf.js';

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
export class AnicPlayer extends Player {
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

  #parts = [];
  #field;
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
    this.refresh(true);
    this.fire('load', clip);
    return this;
  }

  /** The instances that are drawn: their materials may be replaced. */
  get meshInstances() { return this.#parts.flatMap(({ instances }) => instances); }

  /** Names of the fields: numbers beside positions, such as temperatures. */
  get fields() { return fieldNames(this.clip); }

  /** Shows a field as colours; without a name those of the file again. Returns { name, low, high }. Throws if there is no such field. */
  showField(name, range) {
    this.#field = name === undefined ? undefined : fieldOf(this.clip, name, this.clip.find(this.current), range);
    this.refresh(true);
    return this.#field;
  }

  show(time, options, all) {
    for (const part of this.#parts)
      part.show(time, options, this.#field, all);
  }

  pointOf(mesh) {
    if (!this.#parts[mesh])
      throw new Error(`the clip has no mesh ${mesh}`);
    return { parent: this.holder, mesh: this.#parts[mesh].mesh };
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
