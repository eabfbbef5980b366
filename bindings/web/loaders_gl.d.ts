// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import type { LoaderWithParser, StrictLoaderOptions } from '@loaders.gl/loader-utils';
import type { Clip, OpenOptions, SampleOptions } from './index.js';

/** A mesh of loaders.gl's category "mesh". */
export interface AnicMeshData {
  loader: 'anic';
  /** The open clip, which plays on, and the number of its mesh. close() gives its memory back. */
  loaderData: { clip: Clip; mesh: number };
  schema: { fields: object[]; metadata: Record<string, string> };
  header: { vertexCount: number; boundingBox?: [[number, number, number], [number, number, number]] };
  topology: 'triangle-list' | 'point-list';
  mode: number;
  /** POSITION, NORMAL, TEXCOORD_0 and so on, COLOR_0. */
  attributes: Record<string, { value: Float32Array; size: number }>;
  indices?: { value: Uint32Array; size: 1 };
}

export type AnicLoaderOptions = StrictLoaderOptions & {
  /** Options of open(), and the number of the mesh; 0 is the default. */
  anic?: OpenOptions & { mesh?: number };
};

/** A loader for loaders.gl 4, such as of deck.gl: load('dancer.anic', AnicLoader) gives a mesh of the file at its first frame. */
export declare const AnicLoader: LoaderWithParser<AnicMeshData, never, AnicLoaderOptions>;

/** The mesh at another time, in seconds from the first frame: for the next picture. */
export declare function anicMeshAt(mesh: AnicMeshData, time: number, options?: SampleOptions): AnicMeshData;
