// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node speed.mjs CLIP.anic [RUNS] [INSTANCES]: opening and playing in Node: processor time of the first opening, which compiles, the best
// of the others, and the best time for a frame at its positions. To be compared with `anicodec_bench decode` of the same minute.
// Then, with Chromium, the engines: bytes of the package that a page loads (minified, brotli), milliseconds from nothing to a clip that
// is shown, microseconds of script for a frame with its normals; medians. Then a crowd of three.js on the graphics card.
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync } from 'node:zlib';
import { Anicodec } from '../../bindings/web/index.js';
import { babylonImports, babylonScripts, pageOf, playcanvasImports, threeImports } from './engines.mjs';
import { CHROMIUM, launch, serve, withPage } from './serve.mjs';

const [file, runs = 30, instances = 1000] = process.argv.slice(2), bytes = new Uint8Array(readFileSync(file)), times = { open: [], play: [] };
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
const best = (list) => Math.min(...list), median = (list) => list.sort((a, b) => a - b)[list.length >> 1];
console.log(`${file}: opened in ${times.open[0].toFixed(0)} ms of processor time, then in ${best(times.open).toFixed(0)} ms; ${(1000 * best(times.play)).toFixed(0)} us a frame`);

/** Bytes of a module of the package with all that it imports of it, and of the worker. */
async function shipped(module) {
  const { build } = await import('../../bindings/web/node_modules/esbuild/lib/main.js'), web = fileURLToPath(new URL('../../bindings/web/', import.meta.url));
  const sizes = await Promise.all([module, 'worker.js'].map(async (entry) => {
    const { outputFiles: [script] } = await build({ entryPoints: [web + entry], bundle: true, minify: true, format: 'esm', target: 'es2022', write: false,
      external: ['three', 'three/*', '@babylonjs/*', 'react', '@react-three/fiber', 'playcanvas', 'node:*'] });
    return brotliCompressSync(script.contents).length;
  }));
  return sizes.reduce((a, b) => a + b);
}

/** In a page: opens the clip and plays all of its frames. */
async function play(engine) {
  const canvas = document.getElementById('canvas'), modules = {};
  if (engine === 'three')
    modules.three = await import('anicodec/three');
  else if (engine === 'babylon')
    modules.babylon = await import('anicodec/babylon');
  else
    modules.playcanvas = { ...await import('anicodec/playcanvas'), pc: await import('playcanvas') };
  const B = globalThis.BABYLON, scene = engine === 'babylon' ? new B.Scene(new B.Engine(canvas, false)) : undefined;
  const app = engine === 'playcanvas' ? new modules.playcanvas.pc.Application(canvas) : undefined, begin = performance.now();
  let shown, show;
  if (engine === 'three') {
    shown = await new modules.three.AnicLoader().loadAsync('/clip');
    show = (time) => { shown.time = time; shown.refresh(); };
  } else if (engine === 'babylon') {
    shown = await modules.babylon.loadAnic('/clip', scene);
    show = (time) => { shown.time = time; shown.refresh(); };
  } else {
    const entity = new modules.playcanvas.pc.Entity();
    entity.addComponent('script');
    app.root.addChild(entity);
    app.start();
    shown = await entity.script.create(modules.playcanvas.AnicPlayer, { properties: { src: '/clip', playing: false } }).ready;
    show = (time) => { shown.time = time; shown.update(0); };
  }
  const opened = performance.now() - begin, { frames, duration } = shown.clip;
  const pass = () => {
    const before = performance.now();
    for (let f = 0; f < frames; ++f)
      show(duration * (f + 0.5) / frames);
    return 1000 * (performance.now() - before) / frames;
  };
  pass();
  return { opened, frame: Math.min(...Array.from({ length: 5 }, pass)) };
}

/** In a page: draws a crowd of three.js for a while. */
async function crowd(count) {
  const THREE = await import('three'), { AnicInstances } = await import('anicodec/three'), { Anicodec: { open } } = await import('anicodec');
  const renderer = new THREE.WebGLRenderer({ canvas: document.getElementById('canvas') }), scene = new THREE.Scene(), clip = await open('/clip');
  const { min, max } = clip.bounds, size = Math.hypot(...max.map((x, c) => x - min[c])), side = Math.ceil(Math.sqrt(count)), many = new AnicInstances(clip.meshes[0], count);
  const camera = new THREE.PerspectiveCamera(50, 4 / 3, size / 10, 4 * side * size);
  scene.add(new THREE.HemisphereLight(), many);
  many.frustumCulled = false;
  for (let i = 0; i < count; ++i)
    many.setMatrixAt(i, new THREE.Matrix4().makeTranslation((i % side - side / 2) * size * 0.6, 0, -Math.floor(i / side) * size * 0.6));
  camera.position.set(0, side * size * 0.3, size * side * 0.3);
  camera.lookAt(0, 0, -side * size * 0.3);
  const gl = renderer.getContext(), script = [], begin = performance.now();
  let frames = 0;
  for (; frames < 3 || (frames < 100 && performance.now() - begin < 10000); ++frames) {
    const before = performance.now();
    for (let i = 0; i < count; ++i)
      many.times[i] = (0.37 * i + frames / 60) % clip.duration;
    many.update(renderer);
    script.push(performance.now() - before);
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for the card
  }
  const { UNMASKED_RENDERER_WEBGL } = gl.getExtension('WEBGL_debug_renderer_info') ?? {};
  return { script: script.sort((a, b) => a - b)[script.length >> 1], rate: 1000 * frames / (performance.now() - begin), calls: renderer.info.render.calls,
    card: UNMASKED_RENDERER_WEBGL ? gl.getParameter(UNMASKED_RENDERER_WEBGL) : 'unknown' };
}

const ENGINES = [
  ['three', 'three.js', 'three.js', threeImports, '', 'node_modules/three'], ['babylon', 'Babylon.js', 'babylon.js', babylonImports(), babylonScripts, 'babylon/node_modules/babylonjs'],
  ['playcanvas', 'PlayCanvas', 'playcanvas.js', playcanvasImports, '', 'pages/node_modules/playcanvas'], ['react', 'React', 'react.js'],
];
if (!CHROMIUM) {
  console.log('There is no Chromium for the engines');
  process.exit();
}
const wasm = brotliCompressSync(readFileSync(new URL('../../bindings/web/dist/anicodec.wasm', import.meta.url))).length;
const server = await serve({ '/clip': bytes, ...Object.fromEntries(ENGINES.filter(([, , , imports]) => imports).map(([name, , , imports, scripts]) => [`/${name}`, pageOf(imports, scripts)])) });
const browser = await launch();
console.log(`\n| engine | scripts, bytes | decoder, bytes | clip, bytes | shown after, ms | script a frame, us |\n|---|---|---|---|---|---|`);
for (const [name, title, module, imports, , needs] of ENGINES) {
  const results = [], installed = imports && existsSync(new URL(needs, import.meta.url));
  for (let run = 0; installed && run < Math.min(Number(runs), 5); ++run)
    results.push(await withPage(async (page) => { await page.goto(`${server.url}/${name}`); return page.evaluate(play, name); }, { browser }));
  const cell = (key) => (results.length > 0 ? median(results.map((one) => one[key])).toFixed(0) : imports ? 'not installed' : 'as three.js');
  console.log(`| ${title} | ${await shipped(module)} | ${wasm} | ${brotliCompressSync(bytes).length} | ${cell('opened')} | ${cell('frame')} |`);
}
const { script, rate, calls, card } = await withPage(async (page) => { await page.goto(`${server.url}/three`); return page.evaluate(crowd, Number(instances)); }, { browser });
console.log(`\n${instances} instances in three.js: ${calls} draw calls, ${script.toFixed(1)} ms of script and ${(1000 / rate).toFixed(0)} ms in all a frame, ${rate.toFixed(1)} frames a second, by ${card}`);
await browser.close();
server.close();
