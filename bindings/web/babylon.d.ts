// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import type { AnimationGroup } from '@babylonjs/core/Animations/animationGroup.js';
import type { Material } from '@babylonjs/core/Materials/material.js';
import type { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import type { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import type { Scene } from '@babylonjs/core/scene.js';
import type { Ray } from '@babylonjs/core/Culling/ray.js';
import type { PickingInfo } from '@babylonjs/core/Collisions/pickingInfo.js';
import type { Clip, ClipMesh, OpenOptions, SampleOptions, Source, SurfacePoint } from './index.js';

/** The result of a scene's pick, or a point of a mesh of the clip by its number, the first one if it has none. */
export type AnchorPoint = Pick<PickingInfo, 'pickedMesh' | 'faceId' | 'bu' | 'bv'> | (SurfacePoint & { mesh?: number });

/** A field that is shown, and the values that its colours run between. */
export interface ShownField {
  name: string;
  low: number;
  high: number;
}

/** Plays clips by animation groups; a class that extends it decides how the mesh moves. */
export declare class AnicPlayer extends TransformNode {
  readonly clip: Clip;
  /** Seconds from the first frame of the clip that is shown. */
  time: number;
  /** Name of the clip that is shown; set by name or number. */
  get current(): string;
  set current(clip: string | number);
  /** One for each clip of the file, in its order. Weights of groups that play together fade them into each other. */
  readonly animationGroups: AnimationGroup[];
  set sampling(sampling: SampleOptions['sampling']);
  set wrap(wrap: SampleOptions['wrap']);
  /** Plays a clip in place of what this played before. */
  play(clip?: string | number, options?: { speed?: number; loop?: boolean }): AnimationGroup;
  /** Shows the time at once; the scene calls it before it renders. */
  refresh(force?: boolean): void;
  /**
   * Keeps a node on a point of the surface, for what is held or worn: its y axis is the normal of the triangle, x the tangent along its
   * first edge. It is disabled while the mesh is not there, and free again without its parent. Costs three vertices a frame. Throws for
   * a point that is none.
   */
  anchor(point: AnchorPoint, node?: TransformNode): TransformNode;
}

/** Shows a clip: a node with a Mesh for each mesh of the clip that has faces, made on the CPU. dispose() closes the clip. */
export declare class AnicMesh extends AnicPlayer {
  constructor(clip: Clip, scene: Scene, material?: Material);
  readonly parts: Mesh[];
  /** Names of the fields of the clip: numbers beside positions, such as temperatures. */
  readonly fields: string[];
  /**
   * Shows a field as colours, from dark blue over green to yellow, in place of the materials; without a name these again. Vectors count
   * by their length, values of faces by the mean around a vertex; grey is for none. The range is that of 32 frames of the clip that is
   * shown, unless `low` and `high` say otherwise. Throws if there is no such field.
   */
  showField(name?: string, options?: { low?: number; high?: number; material?: Material }): ShownField | undefined;
}

/** Opens a clip and shows it in a scene. */
export declare function loadAnic(source: Source, scene: Scene, options?: OpenOptions): Promise<AnicMesh>;

/**
 * Many instances of a mesh at different times, drawn by one call for each material: the graphics card combines the resident
 * basis and makes smooth normals. Set `times` (seconds) and thinInstanceSetMatrixAt(). For WebGL 2 engines; the standard and
 * PBR materials and shadows work, without a material those of the file. The clip must be opened with bounds.
 */
export declare class AnicInstances extends Mesh {
  /** Throws where the engine draws into no float textures. A material is copied. */
  constructor(mesh: ClipMesh, count: number, scene: Scene, material?: Material, options?: SampleOptions);
  readonly times: Float64Array;
  /** Numbers of the clips that the times are of. */
  readonly clips: Uint16Array;
  options: SampleOptions;
  /** Instances that the last update() left to the CPU. */
  readonly madeByCpu: number;
  /** Makes what is drawn; the scene calls it before it renders. False while shaders are compiled. */
  update(): boolean;
  /** The first hit of a ray, with its `thinInstanceIndex`; null if there is none. Scene.pick() finds the same. */
  pick(ray: Ray): PickingInfo | null;
  /**
   * Keeps a node on a point of an instance's surface, as AnicMesh.anchor() does: what a scene's pick() or pick() found, or a point with
   * the number `thinInstanceIndex` of the instance, the first one if it has none.
   */
  anchor(point: Pick<PickingInfo, 'faceId' | 'bu' | 'bv' | 'thinInstanceIndex'> | (SurfacePoint & { thinInstanceIndex?: number }), node?: TransformNode): TransformNode;
  /** Names of the fields of the mesh. */
  readonly fields: string[];
  /** Shows a field as colours, as AnicMesh.showField() does, at the time of each instance; a material is copied. Without a name the materials come back. */
  showField(name?: string, options?: { low?: number; high?: number; material?: Material }): ShownField | undefined;
  /** Reads back what the card made: positions in the order of the source, or normals of the vertices. */
  read(instance: number, what?: 'positions' | 'normals'): Promise<Float32Array>;
}

/**
 * A plug-in of the glTF loader for the extension ANIC_mesh_animation:
 * registerGLTFExtension('ANIC_mesh_animation', true, (loader) => new AnicGLTFExtension(loader)).
 */
export declare class AnicGLTFExtension {
  constructor(loader: unknown, options?: OpenOptions);
  readonly name: string;
  enabled: boolean;
  dispose(): void;
}
