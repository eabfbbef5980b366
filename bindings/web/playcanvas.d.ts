// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import type { AppBase, Asset, Entity, MeshInstance } from 'playcanvas';
import { Script } from 'playcanvas';
import type { Clip, OpenOptions, SampleOptions, SurfacePoint } from './index.js';

/** A script that plays the clips of a file. */
export declare abstract class Player extends Script {
  playing: boolean;
  speed: number;
  loop: boolean;
  sampling: SampleOptions['sampling'];
  /** Undefined until it is open. */
  readonly clip: Clip | undefined;
  /** Plays a clip, by its name or number, from `time` on; the one before fades out within `fade` seconds. */
  play(clip?: string | number, options?: { fade?: number; time?: number }): void;
  /** Name of the clip that plays. */
  readonly current: string;
  /** Seconds since its first frame; may be set, and shows a moment where `playing` is false. */
  time: number;
  /** Shows the time at once; update() does so by itself. */
  refresh(all?: boolean): void;
  /**
   * Keeps an entity on a point of the surface, for what is held or worn: its y axis is the normal of the triangle, x the tangent along its
   * first edge. The point is that of a mesh by its number, the first one if it has none, such as a hit of ClipMesh.intersectRay() in the
   * space of what shows it. It is disabled while the mesh is not there, and free again below another parent. Throws for a point that is none.
   */
  anchor(point: SurfacePoint & { mesh?: number }, entity?: Entity): Entity;
}

/**
 * A script that shows an .anic file below its entity: entity.script.create(AnicPlayer, { properties: { src: 'dancer.anic' } }), or in
 * the Editor. Positions and normals are made on the CPU; a clip with z up is turned. It fires 'load' with the Clip, and 'error' with what
 * failed, which otherwise the console says. Destroyed, it closes the clip.
 */
export declare class AnicPlayer extends Player {
  static scriptName: string;
  /** Address of the file. */
  src: string;
  /** The file as a binary asset, in place of an address. */
  asset: Asset | null;
  /** Name of the clip that plays first; empty: the first of the file. */
  clipName: string;
  /** Before the script is initialized. */
  options: OpenOptions;
  /** Settles when the file is open. */
  readonly ready: Promise<this>;
  /** Holds what is drawn, turned to the scene's axes. */
  readonly holder: Entity | undefined;
  /** One for each material of each mesh: their materials may be replaced. */
  readonly meshInstances: MeshInstance[];
  /** Names of the fields of the clip: numbers beside positions, such as temperatures. */
  readonly fields: string[];
  /**
   * Shows a field as colours of the vertices, times those of the materials, from dark blue over green to yellow; without a name those
   * of the file again. The range is that of 32 frames of the clip that plays, unless `low` and `high` say otherwise. Throws if there
   * is no such field.
   */
  showField(name?: string, range?: { low?: number; high?: number }): { name: string; low: number; high: number } | undefined;
}

/** The script of a clip in a scene of glTF, which loadAnicScene() makes. */
export declare class AnicScene extends Player {
  static scriptName: string;
}

/**
 * Loads a glTF scene with the extension ANIC_mesh_animation, by a container asset: an entity that is yours to add and to destroy, with
 * lights, cameras and materials. Below it, the entity ANIC_mesh_animation has the script `anicScene`, which moves its meshes and plays
 * the first clip; a second file in the scene has ANIC_mesh_animation_1, and so on. Each call opens them anew.
 */
export declare function loadAnicScene(url: string, app: AppBase, options?: OpenOptions): Promise<Entity>;
