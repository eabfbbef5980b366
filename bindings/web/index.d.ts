// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors

import type { AssetInfo, AttributeInfo as AttributeFields, Basis as BasisFields, Box, Hit as HitFields, Look as LookFields,
  NamedClip as ClipFields, NamedTime, Part as PartFields, RootMotion, Sampling, Side, SurfaceFrame, Wrap } from './interface.js';

export type { Box, NamedTime, RootMotion, Sampling, Side, SurfaceFrame, Wrap };

/** An error of the decoder. `status` is a name of anicodec.h, such as ANIC_E_CHUNK_CHECKSUM. */
export declare class AnicError extends Error {
  readonly status: string;
  /** Type of the chunk of the file, or empty. */
  readonly chunk: string;
  /** Byte offset in the file, as exact as is known. */
  readonly offset: number;
}

export type Source = string | URL | Request | Blob | ArrayBuffer | ArrayBufferView | ReadableStream<Uint8Array>;

export interface Progress {
  stage: 'load' | 'decode';
  /** Share of the stage, 0 to 1; undefined while the size of a download is not known. */
  done: number | undefined;
}

export interface OpenOptions {
  /** Share of the components to open, in (0, 1]: fewer are coarser, smaller and faster. Default 1. */
  quality?: number;
  /** Computes the boxes of all frames while opening. Default true. */
  bounds?: boolean;
  /** Memory that the file may take; files that ask for more fail with ANIC_E_LIMIT. */
  maxBytes?: number;
  /** Gives a clip as soon as it plays coarsely; it becomes exact later: see Clip.finished. Default false. */
  progressive?: boolean;
  /** Leaves the motion of the whole out of the positions, where it is apart: Clip.rootMotion(). Default false. */
  inPlace?: boolean;
  /** Leaves the exact positions of a lossless file closed, which take as much memory as all frames. Default false. */
  inexact?: boolean;
  /** Names of the clips to open, of a file with several; others take no memory. Default: all. */
  clips?: string[];
  /** Decodes in a worker. Default: where there are workers, but in Node in the calling thread. */
  worker?: boolean;
  signal?: AbortSignal;
  onProgress?(progress: Progress): void;
  /** The clip has become exact: draw it again. For progressive clips. */
  onRefine?(clip: Clip): void;
}

/** How times become positions. The default of wrap is what the file says: 'loop' or 'clamp'. */
export interface SampleOptions {
  sampling?: Sampling;
  wrap?: Wrap;
  /** The clip that the time is of, by its name or number. Default: the first one that is open. */
  clip?: string | number;
  /** Moments that are faded in, one after the other: what is shown then counts 1 - weight. */
  blend?: Moment | Moment[];
}

/** A time of a clip, and its weight in a cross-fade, from 0 to 1. */
export interface Moment extends Omit<SampleOptions, 'blend'> {
  time: number;
  weight: number;
}

/** One of the clips of a file: what a file's character does. */
export interface NamedClip extends ClipFields {
  readonly index: number;
  /** Named times, seconds from its first frame on. */
  readonly events: readonly NamedTime[];
}

/** Name, clock and errors are those of the first clip of the file: Clip.clips has those of each. */
export interface ClipInfo extends Omit<AssetInfo, 'meshes' | 'metresPerUnit'> {
  readonly metresPerUnit: number | undefined;
}

/** Values beside the positions, as in frame 0. */
export interface AttributeInfo extends Omit<AttributeFields, `${string}At` | 'labelCount'> {
  readonly index: number;
  /** Names, of materials and parts. */
  readonly labels: string[];
  /** For materials: the look that each label names, where the file has it. */
  readonly looks: (Look | undefined)[];
}

/** Values of a material, as glTF means them; colours are linear. Images are names, which the host loads. */
export type Look = Omit<LookFields, 'name' | `${string}Image`> & { readonly [Image in keyof LookFields & `${string}Image`]: string | undefined };

/** Triangles of one material: indices start .. start + count - 1. */
export interface Group {
  start: number;
  count: number;
  material: string | undefined;
  look: Look | undefined;
}

/** Data that a shader needs at a time, beside a Basis: anic_part of anicodec.h. Addresses are in the decoder's memory. */
export interface Part extends PartFields {
  /** Place of the pose maps of all regions, twelve float32 each; 0: the basis has no pose. */
  readonly poseMapsAt: number;
}

/** The resident basis of a segment: anic_basis of anicodec.h. */
export interface Basis extends Omit<BasisFields, `${string}At` | 'reconstruction' | 'target' | 'poseCount' | 'wideCount' | 'narrowCount'> {
  msgi: boolean;
  movesAttribute: boolean;
  pose: Float32Array | null;
  wide: Int32Array | null;
  narrow: Int16Array | null;
  vertexShape: Uint32Array | null;
  /** Region of each vertex; null: all are of region 0. */
  vertexRegion: Uint8Array | null;
}

/** A point of the surface: vertices of a triangle of `indices`, and barycentric coordinates in it, whose sum is 1. */
export interface SurfacePoint {
  vertices: ArrayLike<number> & Iterable<number>;
  weights: ArrayLike<number> & Iterable<number>;
}

export interface Ray {
  origin: Iterable<number>;
  direction: Iterable<number>;
  /** The distance that still counts, in lengths of the direction; 0: any. */
  farthest?: number;
  /** Triangles that count, by the side that the ray meets. */
  side?: Side;
}

export interface Hit extends SurfacePoint, Omit<HitFields, 'point' | 'side'> {
  vertices: number[];
  weights: number[];
  side: 'front' | 'back';
}

/**
 * A mesh of a clip. Its vertices are render vertices: one for each vertex of the source and what its corners carry, such
 * as texture coordinates and the sides of hard edges. Times are seconds from the first frame of the clip. Without `out`, functions
 * make an array; with it they fill it and return it.
 */
export declare class ClipMesh {
  readonly clip: Clip;
  readonly index: number;
  readonly name: string;
  readonly vertexCount: number;
  readonly triangleCount: number;
  /** Three vertices for each triangle, ordered by material. */
  readonly indices: Uint32Array;
  readonly groups: Group[];
  /** Vertex of the source, a corner of it, and the polygon of each triangle. */
  readonly sourceVertices: Uint32Array;
  readonly sourceCorners: Uint32Array;
  readonly trianglePolygons: Uint32Array;
  readonly sourceVertexCount: number;
  readonly polygonCount: number;
  readonly cornerCount: number;
  readonly attributes: AttributeInfo[];
  /** The box around all frames. */
  readonly bounds: Box | undefined;
  /** For normals on a GPU: four numbers for each vertex (vertex of the source, centre, first corner, corners), and for each
   * corner (vertices after and before, 0, 0). */
  readonly normalPlan: { normalElements: Uint32Array; normalCorners: Uint32Array };
  readonly polygons: { offsets: Uint32Array; corners: Uint32Array };
  /** Edges that are hard: those of the source (default), or from an angle in degrees. Changes the vertices. */
  set shading(options: { crease?: number; sourceEdges?: boolean });
  isPresent(time: number, options?: SampleOptions): boolean;
  positions(time: number, out?: Float32Array, options?: SampleOptions): Float32Array;
  normals(time: number, out?: Float32Array, options?: SampleOptions): Float32Array;
  surfaceAt(time: number, positions?: Float32Array, normals?: Float32Array, options?: SampleOptions):
    { positions: Float32Array; normals: Float32Array };
  /** Values by number or kind of an attribute; undefined if there is none. */
  attribute(which: number | 'uv' | 'normal' | 'tangent' | 'colour' | 'custom', time?: number, out?: Float32Array,
    options?: SampleOptions): Float32Array | undefined;
  /** Axes of length 1 at a point of the surface, for what is attached to it: the triangle's normal, and the tangent from its first
   * vertex to the second one. */
  surfaceFrame(point: SurfacePoint, time: number, options?: SampleOptions): SurfaceFrame;
  /** The first point of the surface on a ray; undefined if it meets nothing. Costs what positions do, and O(triangles). */
  intersectRay(ray: Ray, time: number, options?: SampleOptions): Hit | undefined;
  /** Positions in the order of the source. */
  sourcePositions(time: number, out?: Float32Array, options?: SampleOptions): Float32Array;
  parts(time: number, options?: SampleOptions): Part[];
}

/** An opened file. Its memory goes with close(), or when nothing refers to it any more. */
export declare class Clip {
  readonly info: ClipInfo;
  /** The clips of the file: one, or several of the same meshes. */
  readonly clips: readonly NamedClip[];
  /** One of them, by its name or number. Throws if there is none, or it was not opened. */
  find(clip?: string | number): NamedClip;
  readonly meshes: ClipMesh[];
  readonly frames: number;
  /** Seconds, of the first clip that is open. */
  readonly duration: number;
  readonly closed: boolean;
  readonly memoryBytes: number;
  /** Resolves when the clip is exact: at once unless it is progressive. */
  readonly finished: Promise<Clip>;
  /** The box around all frames of all meshes. */
  readonly bounds: Box;
  /** Time of a frame of the file, in seconds from the first one of its clip. */
  frameTime(frame: number): number;
  /** The motion of the whole at a time, part of the positions or not (OpenOptions.inPlace); none where it is not apart. */
  rootMotion(time: number, options?: { clip?: string | number; sampling?: Sampling; wrap?: Wrap }): RootMotion;
  /** The step of a character from one time to another, through any number of turns of a loop: a turn, and a move in the axes
   * that it has at `from`; no pivot. */
  rootStep(from: number, to: number, options?: { clip?: string | number; sampling?: Sampling; wrap?: Wrap }): RootMotion;
  verify(): void;
  basis(segment: number): Basis;
  close(): void;
  // For the first mesh:
  readonly indices: Uint32Array;
  readonly groups: Group[];
  readonly vertexCount: number;
  positions: ClipMesh['positions'];
  normals: ClipMesh['normals'];
  attribute: ClipMesh['attribute'];
}

/** Opens a clip. Fails with an AnicError, an AbortError, or what the network says. */
export declare function open(source: Source, options?: OpenOptions): Promise<Clip>;

/** Time of a live stream that no clip shows, seconds. */
export interface Loss {
  /** End of the clip before it; undefined: there was none. */
  from: number | undefined;
  /** Start of the clip behind it; undefined: the stream ended first. */
  to: number | undefined;
  /** Files that came, and continue one that was lost. */
  files: number;
}

export interface LiveOptions extends Pick<OpenOptions, 'quality' | 'bounds' | 'maxBytes' | 'inPlace' | 'inexact' | 'signal'> {
  /** Told of a loss before the clip behind it comes. */
  onLoss?: (loss: Loss) => void;
}

/**
 * Clips of a live stream, which `anicodec encode --live` writes: one for each of its files, as soon as that is there, with the
 * time that it begins at (`clip.info.startTime`). They are opened in this thread, some milliseconds each; close() those that have been played.
 * Files that continue one that was lost are left out, up to the next that begins anew: onLoss says so. Whoever joins late gives the
 * last file with meshes, then all from one that begins anew on.
 * Fails as open() does, with ANIC_E_TRUNCATED where the stream ends inside a file, and with ANIC_E_MESHES where a file with meshes was lost.
 */
export declare function live(source: Source, options?: LiveOptions): AsyncGenerator<Clip, void>;

/** The metadata of a file: a JSON object; undefined if the file has none. */
export declare function readMetadata(file: ArrayBuffer | ArrayBufferView): Promise<Record<string, unknown> | undefined>;

/**
 * A box around frames of a mesh that the file keeps for culling, without decoding; undefined if it has none. The first bytes
 * of the file suffice. frames 0: all from firstFrame on.
 */
export declare function readBounds(file: ArrayBuffer | ArrayBufferView, options?: { mesh?: number; firstFrame?: number; frames?: number }): Promise<Box | undefined>;

/** Gives a compiled module, where the files of dist/ cannot be fetched. */
export declare function provideModule(kind: 'small' | 'full', module: WebAssembly.Module): void;

export declare const Anicodec: { open: typeof open; live: typeof live; readMetadata: typeof readMetadata; readBounds: typeof readBounds };
export default Anicodec;
