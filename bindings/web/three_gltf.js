// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Scenes of GLTFLoader whose meshes move by clips.
import { Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, LoaderUtils, Mesh, Sphere, Vector3 } from 'three';
import { EXTENSION } from './glb.js';
import { GltfSurface } from './gltf_surface.js';
import { open } from './index.js';
import { AnicPlayer } from './three_player.js';

/** GLTFLoader's name of an attribute. */
function nameOf(attribute) {
  const [kind, number] = attribute.split('_');
  if (kind === 'COLOR' && number === '0')
    return 'color';
  return kind === 'TEXCOORD' && number < 4 ? `uv${number > 0 ? number : ''}` : attribute.toLowerCase();
}

/** A geometry with the same attributes, until they are replaced. */
function sharing(geometry) {
  const made = new BufferGeometry().setIndex(geometry.index);
  for (const [name, attribute] of Object.entries(geometry.attributes))
    made.setAttribute(name, attribute);
  for (const { start, count, materialIndex } of geometry.groups)
    made.addGroup(start, count, materialIndex);
  return made;
}

/** Moves the meshes of a scene that a clip is for. It is in the scene, and shows nothing itself. */
class ScenePlayer extends AnicPlayer {
  #surfaces = new Map();
  #parts = [];
  #file;
  #cloned = false;

  constructor(clip, file) {
    super(clip, { below: file > 0 ? `${EXTENSION}_${file}` : EXTENSION });
    this.type = 'AnicScenePlayer';
    this.#file = file;
  }

  /** Moves the meshes of a scene that is cloned with it: they are marked. */
  clone() {
    const made = new ScenePlayer(this.clip, this.#file).copy(this, false);
    made.#cloned = true;
    return made;
  }

  refresh(force) {
    if (this.#cloned && this.parent) {
      this.#cloned = false;
      this.parent.traverse((object) => {
        const moved = object.userData[EXTENSION];
        if (!object.isMesh || moved?.file !== this.#file)
          return;
        object.geometry = sharing(object.geometry);
        this.move(object, moved);
      });
    }
    super.refresh(force);
  }

  /** Lets a mesh of the scene follow. */
  move(object, { mesh = 0, firstVertex = 0 }) {
    const moving = this.clip.meshes[mesh], { geometry } = object, { position, normal } = geometry.attributes;
    if (!moving)
      throw new Error(`${EXTENSION}: the clip has no mesh ${mesh}`);
    if (!this.#surfaces.has(mesh))
      this.#surfaces.set(mesh, new GltfSurface(moving));
    const free = (attribute) => attribute && new BufferAttribute(new Float32Array(3 * attribute.count), 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute('position', free(position));
    if (normal)
      geometry.setAttribute('normal', free(normal));
    const attributes = this.#surfaces.get(mesh).attributes.flatMap((one) => {
      const old = geometry.attributes[nameOf(one.name)];
      if (!old)
        return [];
      const values = Float32Array.from({ length: old.count * old.itemSize }, (_, i) => old.getComponent(Math.floor(i / old.itemSize), i % old.itemSize));
      const made = new BufferAttribute(values, old.itemSize).setUsage(DynamicDrawUsage);
      geometry.setAttribute(nameOf(one.name), made);
      return [{ one, made }];
    });
    const { bounds } = moving;
    if (bounds) {
      geometry.boundingBox = new Box3(new Vector3(...bounds.min), new Vector3(...bounds.max));
      geometry.boundingSphere = geometry.boundingBox.getBoundingSphere(new Sphere());
    }
    object.raycast = (...args) => {
      this.refresh();
      Mesh.prototype.raycast.apply(object, args);
    };
    object.userData[EXTENSION] = { file: this.#file, mesh, firstVertex };
    this.#parts.push({ object, mesh, firstVertex, attributes });
  }

  pointOf({ object, face, barycoord, mesh = 0, vertices, weights }) {
    const part = this.#parts.find((one) => (object ? one.object === object : one.mesh === mesh));
    if (!part)
      throw new Error(`${EXTENSION}: ${object ? `the clip does not move ${object.name || 'the object'}` : `the clip moves no mesh ${mesh}`}`);
    const { renderVertices } = this.#surfaces.get(part.mesh), found = { parent: part.object, mesh: this.clip.meshes[part.mesh] };
    return face ? { ...found, vertices: [face.a, face.b, face.c].map((v) => renderVertices[part.firstVertex + v]), weights: barycoord.toArray() } : { ...found, vertices, weights };
  }

  show(time, options) {
    const present = new Map([...this.#surfaces].map(([mesh, surface]) => [mesh, surface.seek(time, options)]));
    for (const { object, mesh, firstVertex, attributes } of this.#parts) {
      object.visible = present.get(mesh);
      if (!object.visible)
        continue;
      const { position, normal } = object.geometry.attributes;
      this.#surfaces.get(mesh).take(firstVertex, position.count, position.array, normal?.array);
      position.needsUpdate = true;
      if (normal)
        normal.needsUpdate = true;
      for (const { one, made } of attributes) {
        this.#surfaces.get(mesh).takeAttribute(one, firstVertex, made.count, made.array, made.itemSize);
        made.needsUpdate = true;
      }
    }
  }
}

/**
 * A plug-in of GLTFLoader: loader.register((parser) => new AnicGLTFExtension(parser)). Each clip becomes an animation of the
 * result, or joins the one of its name.
 */
export class AnicGLTFExtension {
  /** Options of open(). */
  constructor(parser, options = {}) {
    Object.assign(this, { name: EXTENSION, parser, options });
  }

  async #open({ bufferView, uri }) {
    const { parser } = this;
    const source = bufferView === undefined ? LoaderUtils.resolveURL(uri, parser.options.path) : await parser.getDependency('bufferView', bufferView);
    return open(source, this.options);
  }

  async afterRoot(result) {
    const { json, associations } = this.parser, files = json.extensions?.[EXTENSION]?.files;
    if (!files)
      return;
    const players = (await Promise.all(files.map((file) => this.#open(file)))).map((clip, i) => new ScenePlayer(clip, i));
    for (const scene of result.scenes) {
      scene.traverse((object) => {
        const { meshes, primitives } = associations.get(object) ?? {};
        const moved = json.meshes?.[meshes]?.primitives[primitives ?? 0].extensions?.[EXTENSION];
        if (moved && object.isMesh)
          players[moved.file ?? 0].move(object, moved);
      });
    }
    for (const player of players) {
      result.scene.add(player);
      player.refresh();
      for (const animation of player.animations) {
        const same = result.animations.find(({ name }) => name === animation.name);
        if (same)
          Object.assign(same, { tracks: [...same.tracks, ...animation.tracks] }).resetDuration();
        else
          result.animations.push(animation);
      }
    }
    result.userData.anicPlayers = players;
  }
}
