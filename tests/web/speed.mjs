// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node speed.mjs CLIP.anic [RUNS]: opening and playing in Node: processor time of the first opening, which compiles, the best of
// the others, and the best time for a frame at its positions. To be compared with `anicodec_bench decode` of the same minute.
import { readFileSync } from 'node:fs';
import { Anicodec } from '../../bindings/web/index.js';

const [file, runs = 30] = process.argv.slice(2), bytes = new Uint8Array(readFileSync(file)), times = { open: [], play: [] };
const processor = () => { const { user, system } = process.cpuUsage(); return (user + system) / 1000; };
let clip;
for (let run = 0; run < Number(runs); ++run) {
  const before = processor();
  clip = await Anicodec.open(bytes, { bounds: false });
  times.open.push(processor() - before);
}
const [mesh] = clip.meshes, out = new Float32Array(3 * mesh.sourceVertexCount);
for (let run = 0; run < 20; ++run) {
  const before = performance.now();
  for (let f = 0; f < clip.frames; ++f)
    mesh.sourcePositions(clip.frameTime(f), out, { sampling: 'step' });
  times.play.push((performance.now() - before) / clip.frames);
}
const best = (list) => Math.min(...list);
console.log(`${file}: opened in ${times.open[0].toFixed(0)} ms of processor time, then in ${best(times.open).toFixed(0)} ms; ${(1000 * best(times.play)).toFixed(0)} us a frame`);
