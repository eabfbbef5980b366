// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import type {
  AnimationAction, AnimationClip, Group, InstancedMesh, Intersection, Loader, LoadingManager, Material, Mesh, Object3D, Points, WebGLRenderer,
} from 'three';
import type { Clip, ClipMesh, OpenOptions, SampleOptions, SurfacePoint } from './index.js';

export interface PlayOptions {
  speed?: number;
  loop?: boolean;
  /** Seconds. */
  fade?: number;
}

/** Loads `.anic` files as AnicMesh objects, by the conventions of three's loaders. */
export declare class AnicLoader extends Loader<AnicMesh> {
  constructor(manager?: LoadingManager);
  /** Options of Anicodec.open(). */
  setOptions(options: OpenOptions): this;
  /** `progress` is a Progress, which the type of its base class has no room for. */
  load(url: string, onLoad?: (mesh: AnicMesh) => void, onProgress?: (progress: any) => void, onError?: (error: unknown) => void): void;
  /** The bytes of a file. */
  parseAsync(bytes: ArrayBuffer | ArrayBufferView): Promise<AnicMesh>;
}

/** A hit of a Raycaster (three.js r166 or later), or a point of a mesh of the clip by its number, the first one if it has none. */
export type AnchorPoint = Pick<Intersection, 'object' | 'face' | 'barycoord'> | (SurfacePoint & { mesh?: number });

/** The same of one of many instances, the first one if it has no number. */
export type InstanceAnchorPoint = Pick<Intersection, 'instanceId' | 'face' | 'barycoord'> | (SurfacePoint & { instanceId?: number });

/** A field that is shown, and the values that its colours run between. */
export interface ShownField {
  name: string;
  low: number;
  high: number;
}

/** Plays clips by actions of a mixer; a class that extends it decides how the mesh moves. */
export declare class AnicPlayer extends Group {
  readonly clip: Clip;
  /** Seconds from the first frame of the clip that is shown. */
  time: number;
  /** Name of the clip that is shown; set by name or number. */
  get current(): string;
  set current(clip: string | number);
  /** One for each clip of the file, in its order: for an AnimationMixer, which may fade and warp them. While actions play,
   * `time` and `current` are those of the largest weight. */
  animations: AnimationClip[];
  set sampling(sampling: SampleOptions['sampling']);
  set wrap(wrap: SampleOptions['wrap']);
  /** An object that the motion of the whole moves on from frame to frame, for clips opened with `inPlace`: this one, or one above it. */
  root: Object3D | undefined;
  /** Shows the time at once. */
  refresh(force?: boolean): void;
  /** Plays a clip by a mixer of its own, which update() moves on. The clip played before fades out within `fade` seconds. */
  play(clip?: string | number, options?: PlayOptions): AnimationAction;
  play(options: PlayOptions): AnimationAction;
  update(seconds: number): void;
  stop(): void;
  /**
   * Keeps a group on a point of the surface, for what is held or worn: its y axis is the normal of the triangle, x the tangent along
   * its first edge. It is hidden while the mesh is not there, and free again once it is removed from its parent. Costs three vertices a
   * frame. Throws for a point that is none.
   */
  anchor(point: AnchorPoint, group?: Group): Group;
  /** Closes the clip, once no player shows it any more. */
  dispose(): void;
}

/**
 * A plug-in of GLTFLoader for the extension ANIC_mesh_animation: loader.register((parser) => new AnicGLTFExtension(parser)).
 * Clips become animations of the result; `userData.anicPlayers` of the result has an AnicPlayer for each file.
 * Clones of the scene, as SkeletonUtils makes them, have players and surfaces of their own.
 */
export declare class AnicGLTFExtension {
  constructor(parser: unknown, options?: OpenOptions);
  readonly name: string;
}

/**
 * Shows a clip at `time`: a group of one Mesh (Points without polygons) for each mesh of the clip, with positions, normals,
 * and moving attributes made on the CPU when a frame is drawn or hit by a ray. A clip with z up is turned.
 */
export declare class AnicMesh extends AnicPlayer {
  constructor(clip: Clip, material?: Material);
  readonly parts: (Mesh | Points)[];
  /** Names of the fields of the clip: numbers beside positions, such as temperatures. */
  readonly fields: string[];
  /**
   * Shows a field as colours, from dark blue over green to yellow, in place of the materials; without a name these again. Vectors count
   * by their length, values of faces by the mean around a vertex; grey is for none. The range is that of 32 frames of the clip that is
   * shown, unless `low` and `high` say otherwise. `material` has to use vertexColors. Throws if there is no such field.
   */
  showField(name?: string, options?: { low?: number; high?: number; material?: Material }): ShownField | undefined;
  /** Another object that shows the same clip at a time of its own, with the same materials, without what was added to this one. */
  clone(): this;
  /** Gives memory back: on the graphics card, and in the decoder once no player shows the clip any more. */
  dispose(): void;
}

/**
 * Many instances of a mesh at different times, drawn by one call: the graphics card combines the resident basis and makes
 * smooth normals. Set `times` (seconds) and setMatrixAt(), and call update() before rendering. For WebGLRenderer; materials
 * of three.js, shadows and rays work. The clip must be opened with bounds.
 */
export declare class AnicInstances extends InstancedMesh {
  constructor(mesh: ClipMesh, count: number, material?: Material, options?: SampleOptions);
  readonly times: Float64Array;
  /** Numbers of the clips that the times are of. */
  readonly clips: Uint16Array;
  options: SampleOptions;
  /** Instances that the last update() left to the CPU. */
  readonly madeByCpu: number;
  /** Throws where the graphics card draws into no float textures (EXT_color_buffer_float). */
  update(renderer: WebGLRenderer): void;
  /** As AnicMesh.anchor(), on the surface of an instance; update() moves it. */
  anchor(point: InstanceAnchorPoint, group?: Group): Group;
  /** Names of the fields of the mesh. */
  readonly fields: string[];
  /**
   * As AnicMesh.showField(), from the next update() on. The CPU makes the colours of a field that moves, of each instance whose time
   * has changed. `material` is cloned.
   */
  showField(name?: string, options?: { low?: number; high?: number; material?: Material }): ShownField | undefined;
  /** Reads back what the card made: positions in the order of the source, or normals of the vertices. */
  read(renderer: WebGLRenderer, instance: number, what?: 'positions' | 'normals'): Float32Array;
  dispose(): this;
}
