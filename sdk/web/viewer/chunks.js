// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Where the bytes of a file are: its chunk table, as spec/05-file-layout.md has it.
const HEADER_BYTES = 40, ENTRY_BYTES = 32;

export const MEANINGS = {
  LIMI: 'counts', CLIP: 'clock, names', MESH: 'faces', VMAP: 'order of vertices', FMAP: 'order of faces', POSE: 'shape',
  SEGM: 'weights over time', BASI: 'basis of the motion', CORR: 'corrections', ATTR: 'texture coordinates, colours, materials',
  header: 'header and table',
};

/** Chunks of a file that opens: type, bytes, share. Bytes by type, largest first. */
export function chunkSizes(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), count = view.getUint32(12, true);
  const sizes = new Map([['header', HEADER_BYTES + ENTRY_BYTES * count]]);
  for (let i = 0; i < count; ++i) {
    const at = HEADER_BYTES + ENTRY_BYTES * i, type = String.fromCharCode(...bytes.subarray(at, at + 4));
    sizes.set(type, (sizes.get(type) ?? 0) + Number(view.getBigUint64(at + 24, true)));
  }
  return [...sizes].map(([type, size]) => ({ type, size, share: size / bytes.length })).sort((a, b) => b.size - a.size);
}
