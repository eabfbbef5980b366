// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The state of playing in three.js: which clips of a file, at which times, with which weights.
import { AnimationClip, AnimationMixer, Group, LoopOnce, LoopRepeat, Matrix4, NumberKeyframeTrack, Vector3 } from 'three';
import { momentsOf, rootStepOf, sampleOf } from './moments.js';

const users = new WeakMap();  // of clips: how many players show each

/** Plays the clips of a file by actions of a mixer, or shows one at `time`. A class that extends it draws in show(). */
export class AnicPlayer extends Group {
  #shown = '';
  #time = 0;
  #current;
  #options = {};
  #mixer;
  #action;
  #root;
  #before;
  #step = new Matrix4();
  #anchors = [];
  #disposed = false;

  /** `below` another root of a mixer, tracks name this object so, and start when the clip did in the source. */
  constructor(clip, { below = '' } = {}) {
    super();
    this.clip = clip;
    this.name = below;
    users.set(clip, (users.get(clip) ?? 0) + 1);
    // A mixer mixes numbers: of each clip its weight, and its time by the weight. Both are 0 while no action plays it.
    this.clipWeights = clip.clips.map(() => 0);
    this.clipTimes = clip.clips.map(() => 0);
    this.animations = clip.clips.map(({ name, loop, duration, loopDuration, startTime }, i) => {
      const length = Math.max(loop ? loopDuration : duration, 1e-6), begin = below ? Math.max(startTime, 0) : 0;
      const track = (path, ...values) => new NumberKeyframeTrack(`${below}.${path}[${i}]`, [begin, begin + length], values);
      return new AnimationClip(name || 'anic', begin + length, [track('clipWeights', 1, 1), track('clipTimes', 0, length)]);
    });
    this.#current = clip.find().index;
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

  /**
   * An object that the motion of the whole moves on from frame to frame, for clips that were opened with `inPlace`: this object
   * itself, or one above it. Undefined: none.
   */
  get root() { return this.#root; }

  set root(object) {
    this.#root = object;
    this.#before = undefined;
  }

  #moveRoot(moments) {
    const step = rootStepOf(this.clip, this.#before ?? moments, moments, this.#options);
    this.#before = moments;
    const [x, y, z] = step.move, c = Math.cos(step.turn), s = Math.sin(step.turn), matrix = this.#step;
    // The axes of the clip, which a clip with z up is turned from.
    if (this.clip.info.up !== 'z')
      matrix.set(c, 0, s, x, 0, 1, 0, y, -s, 0, c, z, 0, 0, 0, 1);
    else if (this.#root === this)
      matrix.set(c, -s, 0, x, s, c, 0, y, 0, 0, 1, z, 0, 0, 0, 1);
    else
      matrix.set(c, 0, s, x, 0, 1, 0, z, -s, 0, c, -y, 0, 0, 0, 1);
    this.#root.updateMatrix();
    this.#root.matrix.multiply(matrix).decompose(this.#root.position, this.#root.quaternion, this.#root.scale);
  }

  /** Shows the time, unless it is shown already. */
  refresh(force = false) {
    const moments = this.#moments(), { time, options, key } = sampleOf(moments, this.#options);
    if (this.#shown === key && !force)
      return;
    if (this.#root)
      this.#moveRoot(moments);
    this.show(time, options);
    this.#shown = key;
    this.#anchors = this.#anchors.filter(({ group }) => group.parent);
    for (const anchor of this.#anchors)
      this.#place(anchor, time, options);
  }

  updateMatrixWorld(force) {
    this.refresh();
    super.updateMatrixWorld(force);
  }

  /** The moment that is shown, too. */
  copy(source, recursive) {
    super.copy(source, recursive);
    [this.#time, this.#current, this.#options] = [source.#time, source.#current, source.#options];
    return this;
  }

  /**
   * Keeps a group on a point of the surface, as what is held or worn: its y axis is the normal, x the tangent. The point is a hit of a
   * Raycaster, or of ClipMesh.intersectRay() with the number of the `mesh`. Removed from its parent, the group is free again.
   */
  anchor(point, group = new Group()) {
    this.refresh();
    const { parent, ...place } = this.pointOf(point), { time, options } = sampleOf(this.#moments(), this.#options), anchor = { group, place };
    this.#place(anchor, time, options);  // throws for a point that is none
    this.#anchors = [...this.#anchors.filter((one) => one.group !== group), anchor];
    if (group.parent !== parent)
      parent.add(group);
    return group;
  }

  #place({ group, place: { mesh, ...point } }, time, options) {
    group.visible = mesh.isPresent(time, options);
    if (!group.visible)
      return;
    const { position, normal, tangent } = mesh.surfaceFrame(point, time, options), x = new Vector3(...tangent), y = new Vector3(...normal);
    new Matrix4().makeBasis(x, y, x.clone().cross(y)).setPosition(...position).decompose(group.position, group.quaternion, group.scale);
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

  /** Stops what play() began. */
  stop() {
    this.#mixer?.stopAllAction();
  }

  /** Closes the clip, if no other player shows it. */
  dispose() {
    this.stop();
    if (this.#disposed)
      return;
    this.#disposed = true;
    users.set(this.clip, users.get(this.clip) - 1);
    if (users.get(this.clip) === 0)
      this.clip.close();
  }
}
