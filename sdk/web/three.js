// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in three.js: a loader, and an object that shows a clip at a time.
import {
  AnimationClip, AnimationMixer, Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, Loader, LoopOnce, LoopRepeat, Mesh,
  MeshStandardMaterial, NumberKeyframeTrack, Points, PointsMaterial, Sphere, Vector3,
} from 'three';
import { open } from './index.js';

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
  const uvs = mesh.attributes.filter((a) => a.kind === 'uv' && a.components >= 2 && a.domain !== 'polygon').slice(0, 4);
  const colour = mesh.attributes.find((a) => a.kind === 'colour' && a.components >= 3 && a.domain !== 'polygon');
  return [...uvs.map((a, i) => [i === 0 ? 'uv' : `uv${i}`, a]), ...(colour ? [['color', colour]] : [])];
}

/** Shows a clip at `time`: a group of one object for each mesh of the clip. */
export class AnicMesh extends Group {
  #shown = '';
  #time = 0;
  #current;
  #options = {};
  #mixer;
  #action;
  #parts;

  constructor(clip, material) {
    super();
    this.type = 'AnicMesh';
    this.clip = clip;
    this.name = clip.info.name;
    this.#parts = clip.meshes.map((mesh) => this.#part(mesh, material));
    // A mixer mixes numbers: of each clip its weight, and its time by the weight. Both are 0 while no action plays it.
    this.clipWeights = clip.clips.map(() => 0);
    this.clipTimes = clip.clips.map(() => 0);
    this.animations = clip.clips.map(({ name, loop, duration, loopDuration }, i) => {
      const end = Math.max(loop ? loopDuration : duration, 1e-6), track = (path, ...values) => new NumberKeyframeTrack(path, [0, end], values);
      return new AnimationClip(name || 'anic', end, [track(`.clipWeights[${i}]`, 1, 1), track(`.clipTimes[${i}]`, 0, end)]);
    });
    this.#current = clip.find().index;
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
      const one = material ?? new MeshStandardMaterial({ vertexColors: coloured });
      const many = mesh.groups.map(({ material: name }) => (material ? one : Object.assign(one.clone(), { name: name ?? '' })));
      object = new Mesh(geometry, mesh.groups.length > 1 ? many : many[0] ?? one);
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

  /** The objects that show the meshes of the clip. */
  get parts() {
    return this.#parts.map(({ object }) => object);
  }

  /** What is shown: of each clip that a mixer plays its number, time and weight; or else the clip and time that were set. */
  #moments() {
    const moments = this.clipWeights.map((weight, clip) => ({ clip, weight, time: this.clipTimes[clip] / weight })).filter(({ weight }) => weight > 0);
    return moments.length > 0 ? moments.sort((a, b) => b.weight - a.weight) : [{ clip: this.#current, weight: 1, time: this.#time }];
  }

  /** Seconds from the first frame of the clip: of the one with the largest weight. */
  get time() { return this.#moments()[0].time; }

  set time(seconds) { this.#time = seconds; }

  /** Name of the clip that is shown: of the one with the largest weight. Set by name or number. */
  get current() { return this.clip.clips[this.#moments()[0].clip].name; }

  set current(clip) { this.#current = this.clip.find(clip).index; }

  /** 'step', 'linear' or 'cubic', and 'clamp', 'loop' or 'pingpong'. */
  set sampling(sampling) { this.#options = { ...this.#options, sampling }; }

  set wrap(wrap) { this.#options = { ...this.#options, wrap }; }

  /** Fills the geometry for the time, unless it shows it already. */
  refresh(force = false) {
    const [{ clip, time, weight }, ...others] = this.#moments(), { sampling, wrap } = this.#options;
    let all = weight;
    const blend = others.map((moment) => ({ ...moment, weight: moment.weight / (all += moment.weight) }));
    const shown = JSON.stringify([clip, time, blend, sampling, wrap]), options = { sampling, wrap, clip, blend };
    if (this.#shown === shown && !force)
      return;
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
      for (const [name, a] of moving) {
        mesh.attribute(a.index, time, object.geometry.attributes[name].array, options);
        object.geometry.attributes[name].needsUpdate = true;
      }
    }
    this.#shown = shown;
  }

  updateMatrixWorld(force) {
    this.refresh();
    super.updateMatrixWorld(force);
  }

  /**
   * Plays a clip, by its name or number, by a mixer of its own; call update() with the seconds since the last frame. The clip
   * that played before fades out within `fade` seconds. Returns the action.
   */
  play(clip, options = {}) {
    if (typeof clip === 'object')
      return this.play(undefined, clip);
    const { speed = 1, loop = true, fade = 0 } = options;
    this.#mixer ??= new AnimationMixer(this);
    const action = this.#mixer.clipAction(this.animations[this.clip.find(clip).index]), before = this.#action;
    action.reset().setLoop(loop ? LoopRepeat : LoopOnce, Infinity).setEffectiveWeight(1);
    action.timeScale = speed;
    action.clampWhenFinished = true;
    if (before && before !== action) {
      if (fade > 0)
        action.crossFadeFrom(before, fade, false);
      else
        before.stop();
    }
    this.#action = action;
    return action.play();
  }

  update(seconds) {
    this.#mixer?.update(seconds);
  }

  /** Gives memory back, on the graphics card and in the decoder. */
  dispose() {
    this.#mixer?.stopAllAction();
    for (const { object } of this.#parts) {
      object.geometry.dispose();
      for (const material of [object.material].flat())
        material.dispose();
    }
    this.clip.close();
  }
}
