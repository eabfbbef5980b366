// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node speed.mjs CLIP.anic [RUNS] [INSTANCES]: processor time of opening and of a frame at its positions, in Node, in Chromium and in native
// code, in turns: that of `native_speed`, which `cmake --build build/test --target native_speed` makes, if ANICODEC_NATIVE_SPEED names it. Also
// the first opening in Node, which compiles. Then, with Chromium, the engines: bytes of the package that a page loads (minified, brotli),
// milliseconds from nothing to a clip that is shown, microseconds of script for a frame with its normals; medians. Then a crowd of three.js on
// the graphics card.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync } from 'node:zlib';
import { Anicodec } from '../../bindings/web/index.js';
import { babylonImports, babylonScripts, pageOf, playcanvasImports, threeImports } from './engines.mjs';
import { CHROMIUM, launch, serve, withPage } from './serve.mjs';

const [file, runs = 30, instances = 1000] = process.argv.slice(2), bytes = new Uint8Array(readFileSync(file));
const best = (list) => Math.min(...list), median = (list) => list.sort((a, b) => a - b)[list.length >> 1];
const TRIES = 3;  // of each in a turn, the best of which counts
const processor = () => { const { user, system } = process.cpuUsage(); return (user + system) / 1000; };

/** Opens the clip here or in a page, in this thread. */
async function openOnce() {
  globalThis.speed ??= { ...await import('anicodec'), bytes: new Uint8Array(await (await fetch('/clip')).arrayBuffer()) };
  globalThis.speed.clip = await globalThis.speed.Anicodec.open(globalThis.speed.bytes, { bounds: false, worker: false });
  return globalThis.speed.clip.frames;
}

/** Makes all frames of the clip that is open. */
function playOnce() {
  const { clip } = globalThis.speed, [mesh] = clip.meshes, out = globalThis.speed.out ??= new Float32Array(3 * mesh.sourceVertexCount);
  for (let f = 0; f < clip.frames; ++f)
    mesh.sourcePositions(clip.frameTime(f), out, { sampling: 'step' });
}

/** A turn of what `run` runs and `clock` times, both ms: of an opening, ms, and of a frame, us. */
async function turn(run, clock) {
  const timed = async (work) => {
    const times = [];
    let result;
    for (let i = 0; i < TRIES; ++i) {
      const before = await clock();
      result = await run(work);
      times.push(await clock() - before);
    }
    return [best(times), result];
  };
  const [open, frames] = await timed(openOnce), [play] = await timed(playOnce);
  return { open, frame: 1000 * play / frames };
}

/** The processor time that the page's thread has taken. */
async function clockOf(page) {
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  return async () => 1000 * (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value;
}

/** Prints times of native code, Node and a page of Chromium, and medians of their ratios in `turns`. */
async function compare(page, turns) {
  globalThis.speed = { Anicodec, bytes };
  const native = process.env.ANICODEC_NATIVE_SPEED, clock = page && await clockOf(page), before = processor();
  await openOnce();
  const first = processor() - before;
  const ways = {
    ...(native && { native: () => JSON.parse(execFileSync(native, [file, `${TRIES}`])) }),
    Node: () => turn((work) => work(), processor),
    ...(page && { Chromium: () => turn((work) => page.evaluate(work), clock) }),
  };
  const times = Object.fromEntries(Object.keys(ways).map((name) => [name, []]));
  for (let i = 0; i < 2 * turns; ++i) {
    for (const [name, way] of Object.entries(ways))
      times[name].push(await way());
  }
  // The first half compiles the functions that take time once more.
  const half = (name) => times[name].slice(turns), cell = (name, key, digits) => median(half(name).map((one) => one[key])).toFixed(digits);
  const ratio = (name, key) => (native ? median(half(name).map((one, i) => one[key] / half('native')[i][key])).toFixed(2) : '-');
  console.log(`${file}, the first opening in Node: ${first.toFixed(0)} ms\n\n| | opening, ms | x native | frame, us | x native |\n|---|---|---|---|---|`);
  for (const name of Object.keys(ways))
    console.log(`| ${name} | ${cell(name, 'open', 1)} | ${ratio(name, 'open')} | ${cell(name, 'frame', 1)} | ${ratio(name, 'frame')} |`);
}

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
const turns = Math.max(3, Math.ceil(Number(runs) / TRIES / 2));
if (!CHROMIUM) {
  await compare(undefined, turns);
  console.log('There is no Chromium');
  process.exit();
}
const wasm = brotliCompressSync(readFileSync(new URL('../../bindings/web/dist/anicodec.wasm', import.meta.url))).length;
const server = await serve({ '/clip': bytes, ...Object.fromEntries(ENGINES.filter(([, , , imports]) => imports).map(([name, , , imports, scripts]) => [`/${name}`, pageOf(imports, scripts)])) });
const browser = await launch();
await withPage(async (page) => { await page.goto(`${server.url}/three`); await compare(page, turns); }, { browser });
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
