// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import type { Group, Intersection, Material, Matrix4, Mesh, Raycaster } from 'three';
import type { WebGPURenderer } from 'three/webgpu';
import type { ClipMesh, SampleOptions } from './index.js';
import type { InstanceAnchorPoint, ShownField } from './three.js';

/**
 * Many instances of a mesh at different times, drawn by one call of WebGPURenderer: a compute pass combines the resident basis,
 * the vertex shader of a node material makes smooth normals. Set `times` (seconds) and setMatrixAt(), and call update() before
 * rendering and after renderer.init(). Shadows and rays work. The clip must be opened with bounds. Needs WebGPU: the renderer's
 * backend for WebGL 2 has no storage buffers.
 */
export declare class AnicInstances extends Mesh {
  constructor(mesh: ClipMesh, count: number, material?: Material, options?: SampleOptions);
  readonly count: number;
  readonly times: Float64Array;
  /** Numbers of the clips that the times are of. */
  readonly clips: Uint16Array;
  options: SampleOptions;
  /** Instances that the last update() left to the CPU. */
  readonly madeByCpu: number;
  setMatrixAt(instance: number, matrix: Matrix4): void;
  getMatrixAt(instance: number, matrix: Matrix4): Matrix4;
  update(renderer: WebGPURenderer): void;
  /** Keeps a group on a point of an instance's surface, as AnicMesh.anchor() does; update() moves it. */
  anchor(point: InstanceAnchorPoint, group?: Group): Group;
  /** Names of the fields of the mesh. */
  readonly fields: string[];
  /** Shows a field as colours, as AnicMesh.showField() does, at the time of each instance from the next update() on; a material is copied. Without a name the materials come back. */
  showField(name?: string, options?: { low?: number; high?: number; material?: Material }): ShownField | undefined;
  /** Reads back what the card made: positions in the order of the source. */
  read(renderer: WebGPURenderer, instance: number): Promise<Float32Array>;
  raycast(raycaster: Raycaster, intersects: Intersection[]): void;
  dispose(): void;
}
