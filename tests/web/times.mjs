// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node times.mjs CLIP.anic [ROUNDS]: the times that tests/rust/times.c prints, in JavaScript.
import { readFileSync } from 'node:fs';
import { Anicodec } from '../../bindings/web/index.js';

const [file, rounds = 5] = process.argv.slice(2), bytes = new Uint8Array(readFileSync(file));
const used = () => { const { user, system } = process.cpuUsage(); return (user + system) / 1000; };
let open = Infinity, frame = Infinity;
for (let round = 0; round < Number(rounds); ++round) {
  let start = used();
  const clip = await Anicodec.open(bytes, { bounds: false });
  open = Math.min(open, used() - start);
  const [mesh] = clip.meshes, out = new Float32Array(3 * mesh.sourceVertexCount);
  start = used();
  for (let f = 0; f < clip.frames; ++f)
    mesh.sourcePositions(clip.frameTime(f), out);
  frame = Math.min(frame, (used() - start) / clip.frames);
  clip.close();
}
console.log(`${open.toFixed(3)} ${frame.toFixed(5)}`);
