// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// anicodec/react in Chromium, and the examples of pages. `npm ci --prefix tests/web/pages` installs what they are for.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { Anicodec } from '../../bindings/web/index.js';
import { bytesOf, clipWithLooks, movingGlb, sceneWithMovingTexture } from './files.mjs';
import { CHROMIUM, launch, serve, withPage } from './serve.mjs';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const installed = existsSync(here('pages/node_modules/playcanvas'));
const skip = !CHROMIUM ? 'there is no Chromium' : installed ? false : 'there is no React or PlayCanvas: npm ci --prefix tests/web/pages';
const WEB = here('../../bindings/web'), EXAMPLES = `${WEB}/examples`;
const looks = clipWithLooks(), texture = sceneWithMovingTexture();
let server, browser;

/** One script of a module in JSX and all that it imports. */
async function bundle(options) {
  const { build } = await import('../../bindings/web/node_modules/esbuild/lib/main.js');
  const { outputFiles: [script] } = await build({
    bundle: true, format: 'esm', target: 'es2022', jsx: 'automatic', write: false, external: ['node:fs/promises'], define: { 'process.env.NODE_ENV': '"production"' },
    alias: { 'anicodec/react': `${WEB}/react.js`, 'anicodec/three': `${WEB}/three.js`, 'three/addons': here('node_modules/three/examples/jsm'), three: here('node_modules/three') }, nodePaths: [here('pages/node_modules')], ...options,
  });
  return script.text;
}

// A test changes it by show(props).
const APP = `
import { Component, StrictMode, Suspense, useMemo, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { Canvas, useFrame, useLoader } from '@react-three/fiber';
import { AnimationMixer } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { Anic, AnicAnchor, useAnic } from 'anicodec/react';
import { AnicGLTFExtension } from 'anicodec/three';
function Scene({ src }) {
  const { scene, animations } = useLoader(GLTFLoader, src, (loader) => loader.register((parser) => new AnicGLTFExtension(parser)));
  const mixer = useMemo(() => new AnimationMixer(scene), [scene]);
  useFrame((_, seconds) => {
    mixer.clipAction(animations[0]).play();
    mixer.update(seconds);
  });
  return <primitive ref={(shown) => { globalThis.scene = shown; }} object={scene} />;
}
class Problem extends Component {
  state = {};
  static getDerivedStateFromError({ message }) { globalThis.problem = message; return { message }; }
  render() { return this.state.message ? null : this.props.children; }
}
function App() {
  const [props, show] = useState({ src: '/tests/conformance/clips.anic' });
  globalThis.show = (more) => show((before) => ({ ...before, ...more }));
  const { shown = true, point, scene, ...rest } = props;
  return <Suspense fallback={null}>
    {shown && <Anic ref={(mesh) => { globalThis.mesh = mesh; }} {...rest}>
      {point && <AnicAnchor point={point} position={[0, 1, 0]}><mesh ref={(pin) => { globalThis.pin = pin; }}><boxGeometry /></mesh></AnicAnchor>}
    </Anic>}
    {scene && <Scene src={scene} />}
    <Anic ref={(mesh) => { globalThis.other = mesh; }} src="/tests/conformance/clips.anic" time={0.5} clip="clip of 29" />
  </Suspense>;
}
globalThis.clear = () => useAnic.clear('/tests/conformance/clips.anic');
createRoot(document.getElementById('root')).render(<StrictMode><Canvas frameloop="demand"><Problem><App /></Problem></Canvas></StrictMode>);
`;
const paged = (script) => `<!doctype html><link rel=icon href="data:,"><style>html,body,#root{height:100%;margin:0}</style><div id=root></div><script type=module src="${script}"></script>`;

before(async () => {
  if (skip)
    return;
  browser = await launch();
  const [app, example] = await Promise.all([
    bundle({ stdin: { contents: APP, loader: 'jsx', resolveDir: here('.') } }), bundle({ entryPoints: [`${EXAMPLES}/react/main.jsx`] }),
  ]);
  const limb = bytesOf('limb_small.anic'), model = movingGlb(limb, await Anicodec.open(limb)), clips = bytesOf('clips.anic');
  // Scripts lie where the package finds its worker and its modules.
  const folders = [
    ['/pages/node_modules/anicodec/', 'bindings/web/'], ['/pages/node_modules/three/', 'tests/web/node_modules/three/'], ['/pages/node_modules/', 'tests/web/pages/node_modules/'], ['/pages/', 'bindings/web/examples/pages/'],
  ];
  server = await serve({ '/pages/model.glb': model, '/pages/dancer.anic': limb, ...(looks ? { '/looks.anic': looks } : {}), ...(texture ? { '/texture.glb': texture } : {}),
    '/moving.glb': movingGlb(clips, await Anicodec.open(clips)),
    '/app': paged('/bindings/web/app.js'), '/bindings/web/app.js': app, '/bindings/web/main.js': example,
    '/react': readFileSync(`${EXAMPLES}/react/index.html`, 'utf8').replace('/main.jsx', '/bindings/web/main.js'), '/dancer.anic': limb }, folders);
});
after(() => {
  server?.close();
  return browser?.close();
});

/** Pixels of a page that are lit, and the red ones among them, as [x, y]. */
async function pixels(page) {
  const png = (await page.screenshot()).toString('base64');
  return page.evaluate(async (data) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob()), canvas = new OffscreenCanvas(bitmap.width, bitmap.height), context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const seen = { red: [], lit: [] };
    context.getImageData(0, 0, bitmap.width, bitmap.height).data.forEach((v, i, all) => {
      if (i % 4 === 0 && v > 60)
        seen[all[i + 1] < v / 2 ? 'red' : 'lit'].push([(i / 4) % bitmap.width, Math.floor(i / 4 / bitmap.width)]);
    });
    return seen;
  }, png);
}

// Fiber's own use of THREE.Clock.
const unexpected = (messages) => messages.filter((text) => !text.includes('THREE.Clock'));

test('a component of React plays a clip as its props say', { skip }, async () => {
  await withPage(async (page, messages) => {
    await page.goto(`${server.url}/app`);
    await page.waitForFunction(() => globalThis.mesh?.time > 0);
    const result = await page.evaluate(async () => {
      const next = () => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }), steps = {};
      const far = (p, q) => p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0), { mesh, other, show } = globalThis, { clip } = mesh;
      const shown = (object) => object.parts[0].geometry.attributes.position.array, wait = (ms) => new Promise((done) => { setTimeout(done, ms); });
      const outcome = { steps, apart: mesh !== other && mesh.clip === other.clip };
      steps.other = far(shown(other), clip.positions(0.5, undefined, { clip: 'clip of 29' }));
      show({ clip: 'clip of 29', fade: 0.1 });
      for (let tries = 0; tries < 500 && mesh.current !== 'clip of 29'; ++tries)
        await wait(20);
      outcome.clip = mesh.current;
      show({ playing: false });
      await next();
      const time = mesh.time;
      await wait(100);
      outcome.stands = mesh.time === time;
      show({ time: 0.25, clip: 'clip of 70', castShadow: true });
      await next();
      steps.time = far(shown(mesh), clip.positions(0.25, undefined, { clip: 'clip of 70' }));
      outcome.shadow = mesh.parts[0].castShadow;
      show({ point: { vertices: [0, 1, 2], weights: [0.5, 0.25, 0.25] } });
      await next();
      const frame = (at) => { const { position, normal } = mesh.clip.meshes[0].surfaceFrame({ vertices: [0, 1, 2], weights: [0.5, 0.25, 0.25] }, at, { clip: 'clip of 70' }); return position.map((x, c) => x + normal[c]); };
      const pinned = () => { mesh.updateMatrixWorld(); return mesh.worldToLocal(globalThis.pin.getWorldPosition(globalThis.pin.position.clone())).toArray(); };
      steps.pinned = far(pinned(), frame(0.25));
      show({ time: 0.5 });
      await next();
      steps.follows = far(pinned(), frame(0.5));
      show({ src: '/tests/conformance/heated.anic', point: undefined, clip: undefined, field: 'temperature', low: 0, high: 100 });
      for (let tries = 0; tries < 1000 && [mesh, null].includes(globalThis.mesh); ++tries)
        await wait(20);
      await next();
      const heated = globalThis.mesh, { color } = heated.parts[0].geometry.attributes;
      outcome.colours = [heated !== mesh, new Set(color.array).size > 10];
      show({ field: undefined });
      await next();
      outcome.own = heated.parts[0].geometry.attributes.color === color;
      show({ shown: false });
      await next();
      outcome.open = [heated.clip.closed, other.clip.closed];
      show({ scene: '/pages/model.glb' });
      const moment = () => globalThis.scene?.getObjectByName('ANIC_mesh_animation').time ?? 0;
      for (let tries = 0; tries < 1000 && moment() === 0; ++tries) {
        await wait(20);
        show({});
      }
      outcome.scene = moment() > 0;
      show({ shown: true, src: '/tests/conformance/absent.anic' });
      for (let tries = 0; tries < 1000 && !globalThis.problem; ++tries)
        await wait(20);
      outcome.problem = globalThis.problem;
      return outcome;
    });
    assert.ok(Object.values(result.steps).every((distance) => distance < 1e-3), JSON.stringify(result));
    const { apart, clip, stands, shadow, colours, own, open, scene } = result;
    assert.deepEqual({ apart, clip, stands, shadow, colours, own, open, scene },
      { apart: true, clip: 'clip of 29', stands: true, shadow: true, colours: [true, true], own: false, open: [false, false], scene: true });
    assert.match(result.problem, /absent\.anic/);
    assert.deepEqual(unexpected(messages).filter((text) => !/404|absent\.anic/.test(text)), []);
  }, { browser });
});

test('the example for React shows two dancers, and keeps a ball on one', { skip }, async () => {
  await withPage(async (page, messages) => {
    await page.goto(`${server.url}/react`);
    await page.waitForSelector('canvas');
    let seen;
    for (let tries = 0; tries < 50; ++tries) {
      seen = await pixels(page);
      if (seen.lit.length > 100)
        break;
    }
    assert.ok(seen.lit.length > 100 && seen.red.length === 0, `${seen.lit.length} ${seen.red.length}`);
    const [x, y] = seen.lit[seen.lit.length >> 1];
    await page.mouse.click(x, y);
    for (let tries = 0; tries < 50 && seen.red.length === 0; ++tries)
      seen = await pixels(page);
    assert.ok(seen.red.length > 4);
    assert.deepEqual(unexpected(messages), []);
  }, { browser });
});

for (const [name, file] of [['model-viewer', 'model-viewer.html'], ['A-Frame', 'a-frame.html'], ['PlayCanvas', 'playcanvas.html']]) {
  test(`the example for ${name} shows a clip that moves`, { skip }, async () => {
    await withPage(async (page, messages) => {
      await page.goto(`${server.url}/pages/${file}`);
      const pictures = new Set();
      for (let tries = 0; tries < 100 && pictures.size < 3; ++tries) {
        const { lit } = await pixels(page);
        if (lit.length > 200)
          pictures.add(lit.join());
        await page.waitForTimeout(100);
      }
      assert.equal(pictures.size, 3);
      assert.deepEqual(messages.filter((text) => !/A-Frame Version|THREE Version|GPU stall|Powered by PlayCanvas|rAF timed out/.test(text)), []);
    }, { browser });
  });
}

test('a script of PlayCanvas plays and fades clips, with their materials and fields', { skip }, async () => {
  await withPage(async (page, messages) => {
    await page.goto(`${server.url}/pages/playcanvas.html`);
    const result = await page.evaluate(async (textured) => {
      const pc = await import('playcanvas'), { AnicPlayer } = await import('anicodec/playcanvas'), app = pc.app, outcome = { steps: {} };
      const far = (p, q) => p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0), [a, b] = ['clip of 70', 'clip of 29'];
      const load = async (src) => {
        const entity = new pc.Entity();
        entity.addComponent('script');
        app.root.addChild(entity);
        const script = entity.script.create(AnicPlayer, { properties: { src, playing: false } });
        await script.ready;
        return script;
      };
      const read = (script, semantic = 'getPositions') => { const out = []; script.meshInstances[0].mesh[semantic](out); return out; };
      const player = await load('/tests/conformance/clips.anic'), { clip } = player;
      player.play(b);
      player.time = 0.5;
      player.update(0);
      outcome.steps.set = far(read(player), clip.positions(0.5, undefined, { clip: b }));
      player.playing = true;
      player.play(a);
      player.update(0.25);
      outcome.steps.playing = far(read(player), clip.positions(0.25, undefined, { clip: a }));
      player.play(b, { fade: 1 });
      player.update(0.25);
      outcome.steps.fading = far(read(player), clip.positions(0.5, undefined, { clip: a, blend: { clip: b, time: 0.25, weight: 0.25 } }));
      player.update(1);
      outcome.steps.after = far(read(player), clip.positions(1.25, undefined, { clip: b, wrap: 'loop' }));
      outcome.current = player.current;
      const point = { vertices: [0, 1, 2], weights: [0.5, 0.25, 0.25] }, entity = player.anchor(point);
      player.time = 0.3;
      player.update(0);
      const frame = clip.meshes[0].surfaceFrame(point, 0.3, { clip: b, wrap: 'loop' }), axis = (v) => entity.getLocalRotation().transformVector(new pc.Vec3(...v)), list = ({ x, y, z }) => [x, y, z];
      outcome.steps.anchor = Math.max(far(list(entity.getLocalPosition()), frame.position), far(list(axis([0, 1, 0])), frame.normal), far(list(axis([1, 0, 0])), frame.tangent));
      entity.reparent(app.root);
      const free = entity.getLocalPosition().clone();
      player.time = 0.6;
      player.update(0);
      outcome.free = free.equals(entity.getLocalPosition());
      player.entity.destroy();
      outcome.closed = clip.closed;
      const heated = await load('/tests/conformance/heated.anic'), own = read(heated, 'getColors');
      outcome.field = heated.showField('temperature').name;
      outcome.painted = far(read(heated, 'getColors'), own) > 0.1;
      heated.showField();
      outcome.back = far(read(heated, 'getColors'), own) < 1e-6;
      heated.time = 0.4;
      heated.update(0);
      const uvs = [];
      heated.meshInstances[0].mesh.getUvs(0, uvs);
      outcome.steps.uv = far(uvs, heated.clip.attribute('uv', 0.4).map((x, i) => (i % 2 === 1 ? 1 - x : x)));
      if (textured) {
        const [one, two] = (await load('/looks.anic')).meshInstances, wood = [one, two].find(({ material }) => material.name === 'wood').material;
        outcome.looks = [one.mesh.primitive[0].count + two.mesh.primitive[0].count, one.mesh.vertexBuffer === two.mesh.vertexBuffer, wood.gloss, wood.metalness, wood.opacity, wood.userData.anic.normalImage];
      }
      const lost = new pc.Entity();
      lost.addComponent('script');
      app.root.addChild(lost);
      const failing = lost.script.create(AnicPlayer, { properties: { src: '/absent.anic' } });
      failing.on('error', ({ message }) => { outcome.error = message; });
      await failing.ready.catch(() => {});
      return outcome;
    }, looks !== undefined);
    assert.ok(Object.values(result.steps).every((distance) => distance < 1e-3), JSON.stringify(result));
    const { current, closed, field, painted, back, free } = result;
    assert.deepEqual({ current, closed, field, painted, back, free }, { free: true, current: 'clip of 29', closed: true, field: 'temperature', painted: true, back: true });
    assert.match(result.error, /404/);
    if (looks)
      assert.deepEqual(result.looks.slice(1), [true, 0.125, 0.25, 0.75, 'wood_normal.png']);
    assert.deepEqual(messages.filter((text) => !/404|Powered by PlayCanvas/.test(text)), []);
  }, { browser });
});

test('PlayCanvas plays scenes of glTF that move by clips', { skip }, async () => {
  await withPage(async (page, messages) => {
    await page.goto(`${server.url}/pages/playcanvas.html`);
    const result = await page.evaluate(async (textured) => {
      const pc = await import('playcanvas'), { loadAnicScene } = await import('anicodec/playcanvas'), { Anicodec } = await import('/pages/node_modules/anicodec/index.js'), app = pc.app, outcome = { steps: {} };
      const far = (p, q) => p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0), [a, b] = ['clip of 70', 'clip of 29'];
      // The data on the card, of vertices with floats alone.
      const read = ({ vertexBuffer: { format, numVertices, storage } }, semantic) => {
        const { offset, stride, numComponents } = format.elements.find(({ name }) => name === semantic), view = new DataView(storage);
        return Float32Array.from({ length: numVertices * numComponents }, (_, i) => view.getFloat32(offset + Math.floor(i / numComponents) * stride + 4 * (i % numComponents), true));
      };
      const clip = await Anicodec.open('/tests/conformance/clips.anic'), [mesh] = clip.meshes, root = await loadAnicScene('/moving.glb', app), { anicScene: scene } = root.findByName('ANIC_mesh_animation').script;
      const [instance] = root.findComponents('render').flatMap(({ meshInstances }) => meshInstances), shown = () => read(instance.mesh, pc.SEMANTIC_POSITION);
      app.root.addChild(root);
      scene.playing = false;
      scene.play(b);
      scene.time = 0.5;
      scene.update(0);
      outcome.steps.set = far(shown(), mesh.sourcePositions(0.5, undefined, { clip: b }));
      scene.playing = true;
      scene.play(a);
      scene.update(0.25);
      scene.play(b, { fade: 1 });
      scene.update(0.25);
      outcome.steps.fading = far(shown(), mesh.sourcePositions(0.5, undefined, { clip: a, wrap: 'loop', blend: { clip: b, time: 0.25, weight: 0.25 } }));
      scene.update(1);
      scene.playing = false;
      const { renderVertices, normals } = { renderVertices: new Map([...mesh.sourceVertices].map((v, r) => [v, r])), normals: mesh.normals(scene.time, undefined, { clip: b, wrap: 'loop' }) };
      outcome.steps.normals = far(read(instance.mesh, pc.SEMANTIC_NORMAL), Float32Array.from({ length: 3 * mesh.sourceVertexCount }, (_, i) => normals[3 * renderVertices.get(Math.floor(i / 3)) + i % 3]));
      outcome.shown = [scene.current, instance.material.name, instance.visible, instance.mesh.primitive[0].count === mesh.indices.length];
      const point = { vertices: [0, 1, 2], weights: [0.5, 0.25, 0.25] }, entity = scene.anchor(point), { position } = mesh.surfaceFrame(point, scene.time, { clip: b, wrap: 'loop' }), { x, y, z } = entity.getLocalPosition();
      outcome.steps.anchor = far([x, y, z], position);
      outcome.parent = entity.parent === instance.node;
      const inside = scene.clip;
      root.destroy();
      outcome.closed = inside.closed;
      if (textured) {
        const sheet = await loadAnicScene('/texture.glb', app), { anicScene: moved } = sheet.findByName('ANIC_mesh_animation').script, { mesh: made } = sheet.findComponent('render').meshInstances[0];
        moved.playing = false;
        moved.time = 0.5;
        moved.refresh();
        outcome.textured = [...read(made, `${pc.SEMANTIC_TEXCOORD}0`).slice(0, 4), ...read(made, pc.SEMANTIC_COLOR).slice(0, 3)];
        sheet.destroy();
      }
      outcome.error = await loadAnicScene('/absent.glb', app).then(() => 'none', ({ message }) => message);
      return outcome;
    }, texture !== undefined);
    assert.ok(Object.values(result.steps).every((distance) => distance < 1e-3), JSON.stringify(result));
    assert.deepEqual([result.shown, result.parent, result.closed], [['clip of 29', 'paint', true, true], true, true], JSON.stringify(result));
    if (texture)
      [0.25, 0.125, 0.75, 0.125, 0.5, 0.625, 0.25].forEach((x, i) => assert.ok(Math.abs(x - result.textured[i]) < 0.01, JSON.stringify(result)));
    assert.match(result.error, /404|absent/);
    assert.deepEqual(messages.filter((text) => !/404|absent|Powered by PlayCanvas/.test(text)), []);
  }, { browser });
});
