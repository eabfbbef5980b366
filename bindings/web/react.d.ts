// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import type { ReactElement, ReactNode, Ref } from 'react';
import type { ThreeElements } from '@react-three/fiber';
import type { Material } from 'three';
import type { OpenOptions, SampleOptions } from './index.js';
import type { AnchorPoint, AnicMesh } from './three.js';

/** Options that are plain values; a file is opened once for the same ones. */
export type AnicOptions = Omit<OpenOptions, 'signal' | 'onProgress' | 'onRefine'>;

/**
 * An AnicMesh of the component's own, for a `<primitive>`: call its update() in useFrame(). The file is opened once for all
 * components, which suspend until it is there. Errors go to an error boundary.
 */
export declare const useAnic: {
  (src: string, options?: AnicOptions): AnicMesh;
  /** Opens a file before a component asks for it. */
  preload(src: string, options?: AnicOptions): void;
  /** Forgets a file: its memory goes with the last component that shows it. */
  clear(src: string, options?: AnicOptions): void;
};

export interface AnicProps extends Omit<ThreeElements['group'], 'ref' | 'clip'> {
  ref?: Ref<AnicMesh>;
  src: string;
  options?: AnicOptions;
  /** The one that plays, by its name or number. Default: the first of the file. */
  clip?: string | number;
  /** Seconds: shows this moment, instead of playing. */
  time?: number;
  playing?: boolean;
  speed?: number;
  loop?: boolean;
  /** Seconds in which a new `clip` takes over from the last one. */
  fade?: number;
  sampling?: SampleOptions['sampling'];
  wrap?: SampleOptions['wrap'];
  /** Replaces the materials of the file. */
  material?: Material;
  /** A field to show as colours, with its range: see AnicMesh.showField(). */
  field?: string;
  low?: number;
  high?: number;
}

/** Plays a clip: a `<primitive>` of an AnicMesh. Children are in the space of the clip. Canvases with `frameloop="demand"` draw while it plays. */
export declare function Anic(props: AnicProps): ReactElement;

/** Children of an Anic that stay on a point of its surface, such as a pointer event: see AnicPlayer.anchor(). */
export declare function AnicAnchor(props: Omit<ThreeElements['group'], 'ref'> & { point: AnchorPoint; children?: ReactNode }): ReactElement;
