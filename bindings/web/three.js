// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in three.js: a loader, and an object that shows a clip at a time.
import {
  Box3, BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, FrontSide, Loader, Mesh, MeshStandardMaterial, Object3D, Points, PointsMaterial, Sphere,
  Vector3,
} from 'three';
import { fieldNames, fieldOf, writeFieldColours } from './fields.js';
import { open } from './index.js';
import { AnicPlayer } from './three_player.js';

export { AnicGLTFExtension } from './three_gltf.js';
export { AnicInstances } from './three_instances.js';

/** Loads `.anic` files as AnicMesh objects. */
export class AnicLoader extends Loader {
  /** Options of Anicodec.open(), and `up`: 'y' turns clips with z up. */
  constructor(manager) {
    super(manager);
    this.options = {};
  }

  setOptions(options) {
    this.options = options;
    return this;
  }

  load(url, onLoad, onProgress, onError) {
    const full = this.manager.resolveURL((this.path ?? '') + url);
    const request = new Request(new URL(full, globalThis.location?.href), {
      headers: this.requestHeader, credentials: this.crossOrigin === 'use-credentials' || this.withCredentials ? 'include' : 'same-origin',
    });
    this.manager.itemStart(full);
    const progress = (event) => {
      this.options.onProgress?.(event);
      onProgress?.(event);
    };
    open(request, { ...this.options, onProgress: progress }).then((clip) => onLoad?.(new AnicMesh(clip))).catch((error) => {
      if (onError)
        onError(error);
      else
        console.error(error);
      this.manager.itemError(full);
    }).finally(() => this.manager.itemEnd(full));
  }

  /** The bytes of a file. */
  async parseAsync(bytes) {
    return new AnicMesh(await open(bytes, this.options));
  }
}

function boxOf(bounds) {
  return new Box3(new Vector3(...bounds.min), new Vector3(...bounds.max));
}

/** The unmoving part of a mesh's geometry; positions and normals are filled by AnicMesh. */
function geometryOf(mesh) {
  const geometry = new BufferGeometry(), n = mesh.vertexCount;
  for (const name of ['position', 'normal'])
    geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * n), 3).setUsage(DynamicDrawUsage));
  if (mesh.triangleCount > 0) {
    geometry.setIndex(new BufferAttribute(n > 65535 ? mesh.indices : Uint16Array.from(mesh.indices), 1));
    if (mesh.groups.length > 1)
      mesh.groups.forEach(({ start, count }, i) => geometry.addGroup(start, count, i));
  }
  if (mesh.bounds) {
    geometry.boundingBox = boxOf(mesh.bounds);
    geometry.boundingSphere = geometry.boundingBox.getBoundingSphere(new Sphere());
  }
  return geometry;
}

/** Attributes of a clip's mesh that three.js has names for: [name, attribute]. */
function namedAttributes(mesh) {
  const uvs = mesh.attributes.filter((a) => a.kind === 'uv' && a.components >= 2 && a.domain !== 'polygons').slice(0, 4);
  const colour = mesh.attributes.find((a) => a.kind === 'colour' && a.components >= 3 && a.domain !== 'polygons');
  return [...uvs.map((a, i) => [i === 0 ? 'uv' : `uv${i}`, a]), ...(colour ? [['color', colour]] : [])];
}

/** The material of a group of triangles, with the values that the file has; `userData.anic` names its images. */
function materialOf({ material: name = '', look }, vertexColors) {
  const made = new MeshStandardMaterial({ name, vertexColors });
  if (look) {
    const { baseColour, metallic, roughness, emissive, alpha, alphaCutoff, doubleSided } = look;
    made.color.fromArray(baseColour);
    made.emissive.fromArray(emissive);
    made.setValues({
      metalness: metallic, roughness, opacity: alpha === 'opaque' ? 1 : baseColour[3], transparent: alpha === 'blend',
      alphaTest: alpha === 'mask' ? alphaCutoff : 0, side: doubleSided ? DoubleSide : FrontSide,
    });
    made.userData.anic = look;
  }
  return made;
}

/** Shows a clip at `time`: a group of one object for each mesh of the clip. */
export class AnicMesh extends AnicPlayer {
  #parts;
  #field;

  constructor(clip, material) {
    super(clip);
    this.type = 'AnicMesh';
    this.name = clip.info.name;
    this.#parts = clip.meshes.map((mesh) => this.#part(mesh, material));
    if (clip.info.up === 'z')
      this.rotation.x = -Math.PI / 2;
    this.refresh();
  }

  #part(mesh, material) {
    const geometry = geometryOf(mesh), attributes = namedAttributes(mesh);
    for (const [name, a] of attributes)
      geometry.setAttribute(name, new BufferAttribute(mesh.attribute(a.index), a.components).setUsage(a.moves ? DynamicDrawUsage : geometry.attributes.position.usage));
    const coloured = attributes.some(([name]) => name === 'color');
    let object;
    if (mesh.triangleCount > 0) {
      const many = mesh.groups.map((group) => material ?? materialOf(group, coloured));
      object = new Mesh(geometry, mesh.groups.length > 1 ? many : many[0] ?? material ?? materialOf({}, coloured));
      object.raycast = (...args) => {
        this.refresh();
        Mesh.prototype.raycast.apply(object, args);
      };
    } else {
      object = new Points(geometry, material ?? new PointsMaterial({ vertexColors: coloured, size: this.clip.info.diagonal / 200 }));
    }
    object.name = mesh.name;
    object.frustumCulled = !!mesh.bounds;
    this.add(object);
    return { mesh, object, moving: attributes.filter(([, a]) => a.moves) };
  }

  /** An object of its own that shows the same clip, without what was added to this one; materials are shared. */
  clone() {
    const made = new AnicMesh(this.clip).copy(this, false);
    made.parts.forEach((part, i) => {
      Object3D.prototype.copy.call(part, this.parts[i], false);
      part.material = this.#parts[i].own?.material ?? this.parts[i].material;
    });
    made.refresh();
    return made;
  }

  pointOf({ object, face, barycoord, mesh = 0, vertices, weights }) {
    const part = object ? this.#parts.find((one) => one.object === object) : this.#parts[mesh];
    if (!part)
      throw new Error(`the clip has no mesh ${object ? object.name : mesh}`);
    return { parent: this, mesh: part.mesh, vertices: face ? [face.a, face.b, face.c] : vertices, weights: face ? barycoord.toArray() : weights };
  }

  /** Names of the fields: numbers beside positions, such as temperatures. */
  get fields() { return fieldNames(this.clip); }

  /**
   * Shows a field as colours, in place of materials; without a name these again. The range is that of the clip that is shown, unless
   * `low` and `high` say otherwise. Returns { name, low, high }. Throws if there is no such field.
   */
  showField(name, { material, ...range } = {}) {
    const field = name === undefined ? undefined : fieldOf(this.clip, name, this.clip.find(this.current), range);
    for (const part of this.#parts)
      this.#paint(part, field, material);
    this.#field = field;
    this.refresh(true);
    return field;
  }

  /** The objects that show the meshes of the clip. */
  get parts() {
    return this.#parts.map(({ object }) => object);
  }

  #paint(part, field, material) {
    const { object, mesh } = part, { geometry } = object;
    part.own ??= { material: object.material, colour: geometry.attributes.color };
    part.paint ??= new BufferAttribute(new Float32Array(3 * mesh.vertexCount), 3).setUsage(DynamicDrawUsage);
    part.made?.dispose();
    part.made = field && !material ? (object.isPoints ? new PointsMaterial({ vertexColors: true, size: part.own.material.size })
      : new MeshStandardMaterial({ vertexColors: true, side: DoubleSide })) : undefined;
    object.material = field ? material ?? part.made : part.own.material;
    const colour = field ? part.paint : part.own.colour;
    if (colour)
      geometry.setAttribute('color', colour);
    else
      geometry.deleteAttribute('color');
    if (!field)
      part.own = undefined;
  }

  show(time, options) {
    for (const { mesh, object, moving } of this.#parts) {
      object.visible = mesh.isPresent(time, options);
      if (!object.visible)
        continue;
      const { position, normal } = object.geometry.attributes;
      if (mesh.triangleCount > 0)
        mesh.surfaceAt(time, position.array, normal.array, options);
      else
        mesh.positions(time, position.array, options);
      position.needsUpdate = normal.needsUpdate = true;
      if (this.#field) {
        writeFieldColours(mesh, this.#field, time, options, object.geometry.attributes.color.array);
        object.geometry.attributes.color.needsUpdate = true;
      }
      for (const [name, a] of moving) {
        if (this.#field && name === 'color')
          continue;
        mesh.attribute(a.index, time, object.geometry.attributes[name].array, options);
        object.geometry.attributes[name].needsUpdate = true;
      }
    }
  }

  /** Gives memory back on the graphics card, and in the decoder if no other object shows the clip. */
  dispose() {
    for (const { object, own, made } of this.#parts) {
      object.geometry.dispose();
      for (const material of [own?.material ?? object.material, made ?? []].flat())
        material.dispose();
    }
    super.dispose();
  }
}
