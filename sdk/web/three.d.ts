// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import type { AnimationAction, AnimationClip, Group, Loader, LoadingManager, Material, Mesh, Points } from 'three';
import type { Clip, OpenOptions, Progress, SampleOptions } from './index.js';

/** Loads `.anic` files as AnicMesh objects, by the conventions of three's loaders. */
export declare class AnicLoader extends Loader<AnicMesh> {
  constructor(manager?: LoadingManager);
  /** Options of Anicodec.open(). */
  setOptions(options: OpenOptions): this;
  load(url: string, onLoad?: (mesh: AnicMesh) => void, onProgress?: (progress: Progress) => void, onError?: (error: unknown) => void): void;
  /** The bytes of a file. */
  parseAsync(bytes: ArrayBuffer | ArrayBufferView): Promise<AnicMesh>;
}

/**
 * Shows a clip at `time`: a group of one Mesh (Points without polygons) for each mesh of the clip, with positions, normals,
 * and moving attributes made on the CPU when a frame is drawn or hit by a ray. A clip with z up is turned.
 */
export declare class AnicMesh extends Group {
  constructor(clip: Clip, material?: Material);
  readonly clip: Clip;
  readonly parts: (Mesh | Points)[];
  /** Seconds from the first frame. AnimationMixer can drive it: `animations` has a clip with this track. */
  time: number;
  animations: AnimationClip[];
  set sampling(sampling: SampleOptions['sampling']);
  set wrap(wrap: SampleOptions['wrap']);
  /** Fills the geometry for the time at once. */
  refresh(force?: boolean): void;
  /** Plays by a mixer of its own, which update() moves on. */
  play(options?: { speed?: number; loop?: boolean }): AnimationAction;
  update(seconds: number): void;
  dispose(): void;
}
