// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The state of playing in three.js: which clips of a file, at which times, with which weights.
import { AnimationClip, AnimationMixer, Group, LoopOnce, LoopRepeat, NumberKeyframeTrack } from 'three';
import { momentsOf, sampleOf } from './moments.js';

/** Plays the clips of a file by actions of a mixer, or shows one at `time`. What it looks like is up to show(). */
export class AnicPlayer extends Group {
  #shown = '';
  #time = 0;
  #current;
  #options = {};
  #mixer;
  #action;

  /** Below another root of a mixer, its tracks name this object, and start when the clip did in the source. */
  constructor(clip, { below = false } = {}) {
    super();
    this.clip = clip;
    const target = below ? this.uuid : '';
    // A mixer mixes numbers: of each clip its weight, and its time by the weight. Both are 0 while no action plays it.
    this.clipWeights = clip.clips.map(() => 0);
    this.clipTimes = clip.clips.map(() => 0);
    this.animations = clip.clips.map(({ name, loop, duration, loopDuration, startTime }, i) => {
      const length = Math.max(loop ? loopDuration : duration, 1e-6), begin = below ? Math.max(startTime, 0) : 0;
      const track = (path, ...values) => new NumberKeyframeTrack(`${target}.${path}[${i}]`, [begin, begin + length], values);
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

  /** 'step', 'linear' or 'cubic', and 'clamp', 'loop' or 'pingpong'. */
  set sampling(sampling) { this.#options = { ...this.#options, sampling }; }

  set wrap(wrap) { this.#options = { ...this.#options, wrap }; }

  /** Shows the time, unless it is shown already. */
  refresh(force = false) {
    const { time, options, key } = sampleOf(this.#moments(), this.#options);
    if (this.#shown === key && !force)
      return;
    this.show(time, options);
    this.#shown = key;
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

  /** Stops what play() began. */
  stop() {
    this.#mixer?.stopAllAction();
  }
}
