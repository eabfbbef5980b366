// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Playing of clips in PlayCanvas, whatever shows them.
import { BoundingBox, Entity, Mat4, Quat, Script, Vec3 } from 'playcanvas';
import { sampleOf } from './moments.js';

export function boxOf({ min, max }) {
  const box = new BoundingBox();
  box.setMinMax(new Vec3(...min), new Vec3(...max));
  return box;
}

/**
 * A script that plays the clips of a file. A class that extends it shows them in show(time, options, all), and finds the entity and the
 * mesh of a point in pointOf().
 */
export class Player extends Script {
  playing = true;

  speed = 1;

  loop = true;

  sampling = undefined;

  clip = undefined;

  #moments = [];  // that are shown, the newest last
  #fade = 0;
  #shown = '';
  #anchors = [];

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

  update(seconds) {
    if (!this.clip)
      return;
    if (this.playing) {
      for (const moment of this.#moments)
        moment.time += seconds * this.speed;
      this.#mix(seconds);
    }
    this.refresh();
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

  /** Shows the time, unless it is shown already. */
  refresh(all = false) {
    const { time, options, key } = this.#sample();
    if (key === this.#shown && !all)
      return;
    this.show(time, options, all);
    this.#shown = key;
    this.#anchors = this.#anchors.filter(({ entity, parent }) => entity.parent === parent);
    for (const anchor of this.#anchors)
      this.#place(anchor, time, options);
  }

  /**
   * Keeps an entity on a point of the surface, as what is held or worn: its y axis is the normal, x the tangent. The point is a hit of
   * ClipMesh.intersectRay() with the number of the `mesh`. Below another parent, the entity is free again.
   */
  anchor({ mesh = 0, vertices, weights }, entity = new Entity('anchor')) {
    const { time, options } = this.#sample(), anchor = { entity, ...this.pointOf(mesh), point: { vertices, weights } };
    this.#place(anchor, time, options);  // throws for a point that is none
    this.#anchors = [...this.#anchors.filter((one) => one.entity !== entity), anchor];
    if (entity.parent !== anchor.parent)
      entity.reparent(anchor.parent);
    return entity;
  }

  #place({ entity, mesh, point }, time, options) {
    const present = mesh.isPresent(time, options);
    entity.enabled = present;
    if (!present)
      return;
    const { position, normal, tangent } = mesh.surfaceFrame(point, time, options), z = new Vec3().cross(new Vec3(...tangent), new Vec3(...normal));
    entity.setLocalPosition(...position);
    entity.setLocalRotation(new Quat().setFromMat4(new Mat4().set([...tangent, 0, ...normal, 0, z.x, z.y, z.z, 0, 0, 0, 0, 1])));
  }
}
