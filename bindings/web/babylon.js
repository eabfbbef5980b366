// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in Babylon.js: a node that shows a clip at a time, and a plug-in of its glTF loader.
import { Animation } from '@babylonjs/core/Animations/animation.js';
import { AnimationGroup } from '@babylonjs/core/Animations/animationGroup.js';
import { VertexBuffer } from '@babylonjs/core/Buffers/buffer.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import { boundingInfo, giveSurface, placeOnSurface, turnToScene } from './babylon_surface.js';
import { fieldNames, fieldOf, writeFieldColours } from './fields.js';
import { EXTENSION } from './glb.js';
import { GltfSurface } from './gltf_surface.js';
import { open } from './index.js';
import { momentsOf, sampleOf } from './moments.js';

export { AnicInstances } from './babylon_instances.js';

const FRAMES_PER_SECOND = 60;  // of the keys of animation groups

/** Plays the clips of a file by animation groups, or shows one at `time`. A class that extends it moves the mesh in show(). */
export class AnicPlayer extends TransformNode {
  #shown = '';
  #time = 0;
  #current;
  #options = {};
  #anchors = [];

  /** In a glTF scene, clips begin when they did in the source, as spec/gltf-extension.md says. */
  constructor(name, clip, scene, { inSource = false } = {}) {
    super(name, scene);
    this.clip = clip;
    this.#current = clip.find().index;
    // Groups mix numbers: of each clip its weight, and its time by the weight. Both are 0 while no group plays it.
    this.clipWeights = clip.clips.map(() => 0);
    this.clipTimes = clip.clips.map(() => 0);
    this.animationGroups = clip.clips.map((one, i) => this.#group(one, i, inSource ? Math.max(one.startTime, 0) : 0));
    const observer = scene.onBeforeRenderObservable.add(() => this.refresh());
    this.onDisposeObservable.addOnce(() => {
      scene.onBeforeRenderObservable.remove(observer);
      for (const group of this.animationGroups)
        group.dispose();
      clip.close();
    });
  }

  #group({ name, loop, duration, loopDuration }, i, begin) {
    const length = Math.max(loop ? loopDuration : duration, 1e-6), group = new AnimationGroup(name || 'anic', this.getScene());
    for (const [path, from, to] of [['clipWeights', 1, 1], ['clipTimes', 0, length]]) {
      const animation = new Animation(`${path}.${i}`, `${path}.${i}`, FRAMES_PER_SECOND, Animation.ANIMATIONTYPE_FLOAT, Animation.ANIMATIONLOOPMODE_CYCLE);
      // Keys begin at 0, as those that Babylon.js makes of a glTF: the first value holds until the clip begins.
      animation.setKeys([...(begin > 0 ? [{ frame: 0, value: from }] : []), { frame: begin * FRAMES_PER_SECOND, value: from },
        { frame: (begin + length) * FRAMES_PER_SECOND, value: to }]);
      group.addTargetedAnimation(animation, this);
    }
    group.onAnimationGroupEndObservable.add(() => { this.clipWeights[i] = this.clipTimes[i] = 0; });
    return group;
  }

  #moments() {
    return momentsOf(this.clipWeights, this.clipTimes, { clip: this.#current, time: this.#time });
  }

  /** Seconds from the first frame of the clip: of the one with the largest weight. */
  get time() { return this.#moments()[0].time; }

  set time(seconds) { this.#time = seconds; }

  /** Name of the clip that is shown: of the one with the largest weight. Set by name or number. */
  get current() { return this.clip.clips[this.#moments()[0].clip].name; }

  set current(clip) { this.#current = this.clip.find(clip).index; }

  /** 'step', 'linear' or 'cubic', and 'clamp', 'loop' or 'ping-pong'. */
  set sampling(sampling) { this.#options = { ...this.#options, sampling }; }

  set wrap(wrap) { this.#options = { ...this.#options, wrap }; }

  /** Plays a clip, by its name or number, in place of what this played before. Returns its animation group. */
  play(clip, { speed = 1, loop = true } = {}) {
    const group = this.animationGroups[this.clip.find(clip).index];
    for (const other of this.animationGroups)
      other.stop();
    return group.start(loop, speed);
  }

  /** Shows the time, unless it is shown already. The scene calls it before it renders. */
  refresh(force = false) {
    const { time, options, key } = sampleOf(this.#moments(), this.#options);
    if (this.#shown === key && !force)
      return;
    this.show(time, options);
    this.#shown = key;
    this.#anchors = this.#anchors.filter(({ node }) => node.parent && !node.isDisposed());
    for (const anchor of this.#anchors)
      this.#place(anchor, time, options);
  }

  /**
   * Keeps a node on a point of the surface, as what is held or worn: its y axis is the normal, x the tangent. The point is a PickingInfo, or
   * a hit of ClipMesh.intersectRay() with the number of the `mesh`. Without its parent, the node is free again.
   */
  anchor({ pickedMesh, faceId, bu, bv, mesh = 0, vertices, weights }, node = new TransformNode('anchor', this.getScene())) {
    if (pickedMesh) {
      vertices = pickedMesh.getIndices().slice(3 * faceId, 3 * faceId + 3);
      weights = [bu, bv, 1 - bu - bv];
    }
    this.refresh();
    const { parent, ...place } = this.pointOf({ object: pickedMesh, mesh, vertices }), anchor = { node, place: { ...place, weights } };
    const { time, options } = sampleOf(this.#moments(), this.#options);
    this.#place(anchor, time, options);  // throws for a point that is none
    this.#anchors = [...this.#anchors.filter((one) => one.node !== node), anchor];
    node.parent = parent;
    return node;
  }

  #place({ node, place: { mesh, ...point } }, time, options) {
    placeOnSurface(node, mesh, point, time, options);
  }
}

/** Shows a clip: a node with a mesh for each mesh of the clip. A clip with z up is turned. */
export class AnicMesh extends AnicPlayer {
  #field;

  constructor(clip, scene, material) {
    super(clip.info.name || 'anic', clip, scene);
    this.parts = clip.meshes.filter((mesh) => mesh.triangleCount > 0).map((mesh) => this.#part(mesh, material, scene));
    turnToScene(this, clip, scene);
    this.refresh();
  }

  #part(mesh, material, scene) {
    const object = new Mesh(mesh.name || this.name, scene), n = mesh.vertexCount;
    object.parent = this;
    const colour = giveSurface(object, mesh, scene, { material });
    return Object.assign(object, { anic: { mesh, colour, positions: new Float32Array(3 * n), normals: new Float32Array(3 * n) } });
  }

  pointOf({ object, mesh, vertices }) {
    const part = this.parts.find((one) => (object ? one === object : one.anic.mesh.index === mesh));
    if (!part)
      throw new Error(`the clip has no faces ${object ? object.name : mesh}`);
    return { parent: this, mesh: part.anic.mesh, vertices };
  }

  /** Names of the fields: numbers beside positions, such as temperatures. */
  get fields() { return fieldNames(this.clip); }

  /**
   * Shows a field as colours, in place of materials; without a name these again. The range is that of the clip that is shown, unless
   * `low` and `high` say otherwise. Returns { name, low, high }. Throws if there is no such field.
   */
  showField(name, { material, ...range } = {}) {
    const field = name === undefined ? undefined : fieldOf(this.clip, name, this.clip.find(this.current), range);
    for (const object of this.parts)
      this.#paint(object, field, material);
    this.#field = field;
    this.refresh(true);
    return field;
  }

  #paint(object, field, material) {
    const { anic } = object, kind = VertexBuffer.ColorKind;
    anic.own ??= { material: object.material, colours: object.getVerticesData(kind)?.slice(), width: object.getVertexBuffer(kind)?.getSize() };
    anic.made?.dispose();
    anic.made = field && !material ? Object.assign(new StandardMaterial('field', this.getScene()), { backFaceCulling: false, twoSidedLighting: true, specularColor: Color3.Black() }) : undefined;
    object.material = field ? material ?? anic.made : anic.own.material;
    if (field)
      object.setVerticesData(kind, anic.paint ??= new Float32Array(4 * anic.mesh.vertexCount).fill(1), true, 4);
    else if (anic.own.colours)
      object.setVerticesData(kind, anic.own.colours, anic.colour !== undefined, anic.own.width);
    else
      object.removeVerticesData(kind);
    if (!field)
      anic.own = undefined;
  }

  show(time, options) {
    for (const object of this.parts) {
      const { mesh, positions, normals, colour, paint } = object.anic;
      object.isVisible = mesh.isPresent(time, options);
      if (!object.isVisible)
        continue;
      mesh.surfaceAt(time, positions, normals, options);
      object.updateVerticesData(VertexBuffer.PositionKind, positions);
      object.updateVerticesData(VertexBuffer.NormalKind, normals);
      if (this.#field) {
        writeFieldColours(mesh, this.#field, time, options, paint, { width: 4, space: 'srgb' });
        object.updateVerticesData(VertexBuffer.ColorKind, paint);
      } else if (colour) {
        object.updateVerticesData(VertexBuffer.ColorKind, mesh.attribute(colour.index, time, undefined, options));
      }
    }
  }
}

/** Opens a clip, as Anicodec.open(), and shows it in a scene. */
export async function loadAnic(source, scene, options) {
  return new AnicMesh(await open(source, options), scene);
}

/** Babylon.js's name of an attribute of a glTF; undefined if it has none for it. */
function kindOf(attribute) {
  const [kind, number] = attribute.split('_');
  if (kind === 'COLOR')
    return number === '0' ? VertexBuffer.ColorKind : undefined;
  return number < 6 ? `${VertexBuffer.UVKind}${number > 0 ? Number(number) + 1 : ''}` : undefined;
}

/** Moves the meshes of a glTF scene that a clip is for. */
class ScenePlayer extends AnicPlayer {
  #surfaces = new Map();
  #parts = [];

  move(object, { mesh = 0, firstVertex = 0 }) {
    const moving = this.clip.meshes[mesh];
    if (!moving)
      throw new Error(`${EXTENSION}: the clip has no mesh ${mesh}`);
    if (!this.#surfaces.has(mesh))
      this.#surfaces.set(mesh, new GltfSurface(moving));
    const count = object.getTotalVertices(), positions = new Float32Array(3 * count);
    const normals = object.isVerticesDataPresent(VertexBuffer.NormalKind) ? new Float32Array(3 * count) : undefined;
    object.setVerticesData(VertexBuffer.PositionKind, positions, true);
    if (normals)
      object.setVerticesData(VertexBuffer.NormalKind, normals, true);
    const attributes = this.#surfaces.get(mesh).attributes.flatMap((one) => {
      const kind = kindOf(one.name), old = kind && object.getVertexBuffer(kind), width = old?.getSize();
      if (!old)
        return [];
      const values = Float32Array.from(object.getVerticesData(kind));
      object.setVerticesData(kind, values, true, width);
      return [{ one, kind, values, width }];
    });
    this.#parts.push({ object, mesh, firstVertex, count, positions, normals, attributes });
    this.refresh(true);
    if (moving.bounds)
      object.setBoundingInfo(boundingInfo(moving.bounds));
  }

  pointOf({ object, mesh, vertices }) {
    const part = this.#parts.find((one) => (object ? one.object === object : one.mesh === mesh));
    if (!part)
      throw new Error(`${EXTENSION}: ${object ? `the clip does not move ${object.name}` : `the clip moves no mesh ${mesh}`}`);
    const { renderVertices } = this.#surfaces.get(part.mesh);
    return { parent: part.object, mesh: this.clip.meshes[part.mesh], vertices: object ? Array.from(vertices, (v) => renderVertices[part.firstVertex + v]) : vertices };
  }

  show(time, options) {
    const present = new Map([...this.#surfaces].map(([mesh, surface]) => [mesh, surface.seek(time, options)]));
    for (const { object, mesh, firstVertex, count, positions, normals, attributes } of this.#parts) {
      object.isVisible = present.get(mesh);
      if (!object.isVisible)
        continue;
      this.#surfaces.get(mesh).take(firstVertex, count, positions, normals);
      object.updateVerticesData(VertexBuffer.PositionKind, positions);
      if (normals)
        object.updateVerticesData(VertexBuffer.NormalKind, normals);
      for (const { one, kind, values, width } of attributes) {
        this.#surfaces.get(mesh).takeAttribute(one, firstVertex, count, values, width);
        object.updateVerticesData(kind, values);
      }
    }
  }
}

/**
 * A plug-in of Babylon's glTF loader: registerGLTFExtension('ANIC_mesh_animation', true, (loader) => new AnicGLTFExtension(loader)).
 * Each clip becomes an animation group of what is loaded, the first of which the loader starts; a node ANIC_mesh_animation plays them.
 */
export class AnicGLTFExtension {
  #players = [];

  /** Options of open(). */
  constructor(loader, options = {}) {
    Object.assign(this, { name: EXTENSION, enabled: true, loader, options });
  }

  dispose() {
    this.loader = undefined;
  }

  async #open(index) {
    const { loader } = this, { babylonScene: scene, _assetContainer: container } = loader, path = `/extensions/${EXTENSION}/files/${index}`, file = loader.gltf.extensions[EXTENSION].files[index];
    const bytes = file.bufferView === undefined ? await loader.loadUriAsync(path, file, file.uri)
      : await loader.loadBufferViewAsync(path, loader.gltf.bufferViews[file.bufferView]);
    const clip = await open(bytes, this.options);
    // Entities of a container are not in the scene yet.
    scene._blockEntityCollection = !!container;
    const player = new ScenePlayer(EXTENSION, clip, scene, { inSource: true });
    scene._blockEntityCollection = false;
    player.parent = loader.rootBabylonMesh;
    // The loader gives results and containers the groups of what it has read.
    for (const group of player.animationGroups) {
      group._parentContainer = container;
      (loader.gltf.animations ??= []).push({ index: loader.gltf.animations.length, channels: [], samplers: [], _babylonAnimationGroup: group });
    }
    if (container) {
      player._parentContainer = container;
      container.transformNodes.push(player);
    }
    return player;
  }

  _loadMeshPrimitiveAsync(context, name, node, mesh, primitive, assign) {
    const moved = primitive.extensions?.[EXTENSION];
    if (!moved)
      return null;
    delete primitive.extensions[EXTENSION];  // or the loader would come here again
    const loaded = this.loader._loadMeshPrimitiveAsync(context, name, node, mesh, primitive, assign);
    primitive.extensions[EXTENSION] = moved;
    const file = moved.file ?? 0;
    this.#players[file] ??= this.#open(file);
    return Promise.all([loaded, this.#players[file]]).then(([object, player]) => {
      player.move(object, moved);
      return object;
    });
  }
}
