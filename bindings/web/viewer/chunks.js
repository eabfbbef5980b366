// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The chunk table of a file, which tells where its bytes are (spec/05-file-layout.md).
const HEADER_BYTES = 40;

export const MEANINGS = {
  LIMI: 'counts', CLIP: 'clock, names', MESH: 'faces', VMAP: 'order of vertices', FMAP: 'order of faces', POSE: 'shape',
  SEGM: 'weights over time', BASI: 'basis of the motion', CORR: 'corrections', ATTR: 'texture coordinates, colours, materials',
  header: 'header and table',
};

/** Chunks of a file that opens: type, bytes, share. Bytes by type, largest first. */
export function chunkSizes(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), count = view.getUint32(12, true);
  const sizes = new Map([['header', HEADER_BYTES + view.getUint32(36, true)]]);
  let at = HEADER_BYTES;
  const varint = () => {
    let value = 0, unit = 1;
    for (;; unit *= 128) {
      const byte = bytes[at++];
      value += (byte & 127) * unit;
      if (byte < 128) return value;
    }
  };
  for (let i = 0; i < count; ++i) {
    const type = String.fromCharCode(...bytes.subarray(at, at + 4)), flags = bytes[at + 8];
    at += 9;  // type, checksum, flags
    if (flags & 2) varint();  // mesh
    if (flags & 4) varint();  // segment
    sizes.set(type, (sizes.get(type) ?? 0) + varint());
  }
  return [...sizes].map(([type, size]) => ({ type, size, share: size / bytes.length })).sort((a, b) => b.size - a.size);
}
