// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Takes the .anic file out of a GLB with the extension ANIC_mesh_animation (spec/gltf-extension.md).
import { AnicError } from './status.js';

export const EXTENSION = 'ANIC_mesh_animation';
const GLB = 0x46546c67;

/** The bytes of the first file in a GLB; bytes of any other kind as they are. */
export function clipInGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.byteLength < 20 || view.getUint32(0, true) !== GLB)
    return bytes;
  const length = view.getUint32(12, true), json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  const at = json.bufferViews?.[json.extensions?.[EXTENSION]?.files?.[0]?.bufferView];
  if (!at)
    throw new AnicError('ANIC_E_MAGIC', `a GLB without a clip (${EXTENSION})`);
  const begin = 28 + length + (at.byteOffset ?? 0);
  return bytes.slice(begin, begin + at.byteLength);
}
