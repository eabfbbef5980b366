// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
import { Extension, ExtensionProperty } from '@gltf-transform/core';

/** An .anic file of an asset: its bytes, or its address relative to the asset, where it stays. */
export declare class AnicFile extends ExtensionProperty {
  extensionName: string;
  propertyType: string;
  parentTypes: string[];
  init(): void;
  getBytes(): Uint8Array | null;
  setBytes(bytes: Uint8Array | null): this;
  getURI(): string;
  setURI(uri: string): this;
}

/** Extension of a primitive: what it moves by. */
export declare class MeshAnimation extends ExtensionProperty {
  extensionName: string;
  propertyType: string;
  parentTypes: string[];
  init(): void;
  getFile(): AnicFile | null;
  setFile(file: AnicFile | null): this;
  /** Number of a mesh of the file. */
  getMesh(): number;
  setMesh(mesh: number): this;
  /** Vertex of that mesh which is the primitive's first. */
  getFirstVertex(): number;
  setFirstVertex(vertex: number): this;
}

/**
 * Lets glTF-Transform 4 read, keep and write scenes with the extension ANIC_mesh_animation, which it would drop:
 * io.registerExtensions([ANICMeshAnimation]). Functions may put vertices of such a primitive in another order, split, merge and drop
 * them; writing restores them, as a clip knows vertices by number. Writing fails where a scene would be shown wrong: positions that were
 * quantized or transformed, primitives that joinPrimitives() made of moving ones, Draco. Files of the same bytes are written once.
 */
export declare class ANICMeshAnimation extends Extension {
  static readonly EXTENSION_NAME: 'ANIC_mesh_animation';
  readonly extensionName: 'ANIC_mesh_animation';
  createFile(): AnicFile;
  createMeshAnimation(): MeshAnimation;
  read(context: Parameters<Extension['read']>[0]): this;
  write(context: Parameters<Extension['write']>[0]): this;
}
