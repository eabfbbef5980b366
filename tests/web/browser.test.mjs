// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The package in Chromium: workers, errors, three.js.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { Anicodec } from '../../bindings/web/index.js';
import { threeImports } from './engines.mjs';
import { bytesOf, clipWithLooks, files, movingGlb, sceneWithMovingTexture } from './files.mjs';
import { CHROMIUM, launch, serve, withPage } from './serve.mjs';

const PAGE = `<!doctype html><link rel=icon href="data:,"><script type=importmap>${JSON.stringify({ imports: threeImports })}</script><body style="margin:0"></body>`;
const looks = clipWithLooks(), texture = sceneWithMovingTexture();
const skip = CHROMIUM ? false : 'there is no Chromium';
const VIEWER = new URL('../../bindings/web/dist/viewer.html', import.meta.url);
let server, browser;
before(async () => {
  browser = skip ? undefined : await launch();
  const bytes = bytesOf('clips.anic'), clip = await Anicodec.open(bytes);
  server = await serve({ ...(looks ? { '/looks.anic': looks, '/texture.glb': texture } : {}), '/page': PAGE, '/moving.glb': movingGlb(bytes, clip), '/beside.glb': movingGlb(bytes, clip, { uri: 'tests/conformance/clips.anic' }) });
});
after(() => {
  server.close();
  return browser?.close();
});

/** Runs a function in a page that can import the package; nothing may be said on the console. */
async function inPage(body, argument) {
  return withPage(async (page, messages) => {
    await page.goto(`${server.url}/page`);
    const result = await page.evaluate(body, argument);
    assert.deepEqual(messages, []);
    return result;
  }, { browser });
}

test('opens in a worker what opens in the page, bit for bit, and reports damage', { skip }, async () => {
  const names = files.filter(({ what }) => what === 'valid').map(({ file }) => file);
  const damaged = Array.from({ length: 60 }, (_, i) => i * 7919);
  const result = await inPage(async ({ names: all, damaged: flips }) => {
    const { Anicodec } = await import('anicodec');
    const outcome = { same: 0, draco: 0, refused: {} };
    let last;
    for (const name of all) {
      const url = `/tests/conformance/${name}`;
      try {
        const a = await Anicodec.open(url), b = await Anicodec.open(url, { worker: false });
        a.verify();
        for (const time of [0, 0.06, 1]) {
          a.meshes.forEach((mesh, m) => {
            if (!mesh.isPresent(time))
              return;
            const x = mesh.positions(time), y = b.meshes[m].positions(time);
            if (x.length !== y.length || x.some((v, i) => v !== y[i]))
              throw new Error(`${name}: positions differ`);
          });
        }
        ++outcome.same;
        last = url;
        a.close();
      } catch (error) {
        if (!error.message.includes('feature 1 '))
          throw error;
        ++outcome.draco;
      }
    }
    const bytes = new Uint8Array(await (await fetch(last)).arrayBuffer());
    for (const at of flips) {
      const bad = bytes.slice();
      bad[at % bad.length] ^= 1 << (at % 8);
      try {
        (await Anicodec.open(bad, { worker: at % 2 === 0 })).close();
      } catch (error) {
        if (error.name !== 'AnicError' || !error.status.startsWith('ANIC_E_'))
          throw error;
        outcome.refused[error.status] = (outcome.refused[error.status] ?? 0) + 1;
      }
    }
    const controller = new AbortController();
    const stopped = Anicodec.open(last, { signal: controller.signal }).catch((error) => error.name);
    controller.abort();
    outcome.aborted = await stopped;
    outcome.page = await Anicodec.open('/page').catch((error) => error.message);
    outcome.missing = await Anicodec.open('data:,x').catch((error) => error.status);
    return outcome;
  }, { names, damaged });
  assert.ok(result.same > 5, JSON.stringify(result));
  assert.equal(result.same + result.draco, names.length);
  assert.ok(Object.values(result.refused).reduce((a, b) => a + b) > 40, JSON.stringify(result));
  assert.equal(result.aborted, 'AbortError');
  assert.equal(result.missing, 'ANIC_E_MAGIC');
  assert.match(result.page, /^\/page: /);
});

test('three.js shows, plays and hits a clip', { skip }, async () => {
  const result = await inPage(async () => {
    const THREE = await import('three');
    const { AnicLoader } = await import('anicodec/three');
    const seen = [], mesh = await new Promise((resolve, reject) =>
      new AnicLoader().load('/tests/conformance/heated.anic', resolve, (event) => seen.push(event), reject));
    const renderer = new THREE.WebGLRenderer();
    renderer.setSize(320, 240);
    document.body.append(renderer.domElement);
    const scene = new THREE.Scene(), light = new THREE.DirectionalLight(0xffffff, 3);
    light.position.set(1, 2, 3);
    scene.add(light, mesh);
    const { min, max } = mesh.clip.bounds, box = new THREE.Box3(new THREE.Vector3(...min), new THREE.Vector3(...max));
    const sphere = box.getBoundingSphere(new THREE.Sphere()), centre = sphere.center;
    const camera = new THREE.PerspectiveCamera(40, 4 / 3, sphere.radius / 10, sphere.radius * 10);
    camera.position.copy(centre).add(new THREE.Vector3(0, 0, 3.5 * sphere.radius));
    camera.lookAt(centre);
    const shot = () => {
      renderer.render(scene, camera);
      const gl = renderer.getContext(), pixels = new Uint8Array(4 * 320 * 240);
      gl.readPixels(0, 0, 320, 240, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      return pixels;
    };
    const lit = (pixels) => pixels.filter((v, i) => i % 4 === 0 && v > 8).length;
    const first = shot();
    const action = mesh.play({ speed: 1 });
    mesh.update(mesh.clip.duration / 2);
    const later = shot();
    scene.updateMatrixWorld();
    const ray = new THREE.Raycaster(camera.position, centre.clone().sub(camera.position).normalize());
    const hits = ray.intersectObject(mesh, true).length;
    const outcome = { lit: lit(first), changed: first.filter((v, i) => v !== later[i]).length, time: mesh.time, running: action.isRunning(),
      half: mesh.clip.duration / 2, hits, progress: seen.length, attributes: Object.keys(mesh.parts[0].geometry.attributes) };
    mesh.dispose();
    return outcome;
  });
  assert.ok(result.lit > 1000, JSON.stringify(result));
  assert.ok(result.changed > 100, JSON.stringify(result));
  assert.ok(Math.abs(result.time - result.half) < 1e-6 && result.running);
  assert.ok(result.hits > 0 && result.progress > 0);
  assert.ok(result.attributes.includes('uv') && result.attributes.includes('color'));
});

test('a mixer of three.js plays the clips of a file, and fades them into each other', { skip }, async () => {
  const result = await inPage(async () => {
    const { AnimationMixer } = await import('three');
    const { AnicLoader } = await import('anicodec/three');
    const mesh = await new AnicLoader().loadAsync('/tests/conformance/clips.anic'), { clip } = mesh, [a, b] = ['clip of 70', 'clip of 29'];
    const shown = () => { mesh.refresh(); return mesh.parts[0].geometry.attributes.position.array.slice(); };
    const expected = (time, options) => clip.positions(time, undefined, options);
    const far = (p, q) => p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0) / clip.info.diagonal;
    const steps = {};
    mesh.current = b;
    mesh.time = 0.5;
    steps.set = far(shown(), expected(0.5, { clip: b }));
    mesh.play(a);
    mesh.update(0.25);
    steps.playing = far(shown(), expected(0.25, { clip: a }));
    const names = [mesh.current];
    mesh.play(b, { fade: 1 });
    mesh.update(0.25);
    steps.fading = far(shown(), expected(0.5, { clip: a, blend: { clip: b, time: 0.25, weight: 0.25 } }));
    mesh.update(1);
    names.push(mesh.current);
    steps.after = far(shown(), expected(1.25, { clip: b }));
    mesh.dispose();
    // Another mixer, with actions of its own.
    const other = await new AnicLoader().loadAsync('/tests/conformance/clips.anic'), mixer = new AnimationMixer(other);
    const actions = [a, b].map((name) => mixer.clipAction(other.animations.find((one) => one.name === name)).play());
    actions[0].setEffectiveWeight(0.75);
    actions[1].setEffectiveWeight(0.25);
    mixer.update(0.1);
    other.refresh();
    steps.weights = far(other.parts[0].geometry.attributes.position.array, other.clip.positions(0.1, undefined, { clip: a, blend: { clip: b, time: 0.1, weight: 0.25 } }));
    mixer.stopAllAction();
    const still = other.clipWeights.every((w) => w === 0) && other.time === 0;
    other.dispose();
    return { steps, names, still };
  });
  assert.ok(Object.values(result.steps).every((far) => far < 1e-6), JSON.stringify(result));
  assert.deepEqual(result.names, ['clip of 70', 'clip of 29']);
  assert.ok(result.still);
});

test('three.js has the materials of a clip', { skip: skip || (looks ? false : 'ANICODEC_COMMAND names no command') }, async () => {
  const result = await inPage(async () => {
    const { AnicLoader } = await import('anicodec/three'), mesh = await new AnicLoader().loadAsync('/looks.anic');
    const wood = mesh.parts[0].material.find(({ name }) => name === 'wood'), { baseColour } = wood.userData.anic;
    return { colour: wood.color.toArray().map((x, c) => Math.abs(x - baseColour[c])), material: [wood.roughness, wood.metalness, wood.transparent, wood.opacity, wood.userData.anic.normalImage] };
  });
  assert.deepEqual(result.material, [0.875, 0.25, true, 0.75, 'wood_normal.png']);
  assert.ok(Math.max(...result.colour) < 1e-6, JSON.stringify(result));
});

test('the motion of the whole moves an object of three.js on', { skip }, async () => {
  const result = await inPage(async () => {
    const THREE = await import('three'), { AnicLoader } = await import('anicodec/three');
    const load = () => new AnicLoader().setOptions({ inPlace: true }).loadAsync('/tests/conformance/walk.anic');
    const far = [];
    for (const self of [false, true]) {
      const mesh = await load(), above = new THREE.Group().add(mesh), { clip } = mesh, { loopDuration, duration } = clip.find('turn');
      mesh.root = self ? mesh : above;
      mesh.wrap = 'loop';
      mesh.current = 'turn';
      mesh.refresh(true);
      const begin = mesh.matrixWorld.clone(), steps = [0.2, 0.5, 0.8, 1.1, 1.4, 1.7, 2.2].map((share) => share * loopDuration);
      above.updateMatrixWorld(true);
      begin.copy(mesh.matrixWorld);
      for (const time of steps) {
        mesh.time = time % loopDuration;
        mesh.refresh();
      }
      above.updateMatrixWorld(true);
      const m = clip.rootStep(0, steps.at(-1), { clip: 'turn', wrap: 'loop' }).matrix;
      const expected = begin.multiply(new THREE.Matrix4().set(...m, 0, 0, 0, 1));
      far.push(Math.max(...expected.elements.map((x, i) => Math.abs(x - mesh.matrixWorld.elements[i]))), duration > 0 ? Math.hypot(m[3], m[7], m[11]) : 0);
      mesh.dispose();
    }
    return far;
  });
  assert.ok(result[0] < 1e-4 && result[2] < 1e-4 && result[1] > 0.01, JSON.stringify(result));
});

test('GLTFLoader plays scenes whose meshes move by a clip', { skip }, async () => {
  const result = await inPage(async () => {
    const { AnimationMixer } = await import('three');
    const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
    const { AnicGLTFExtension } = await import('anicodec/three');
    const { Anicodec } = await import('anicodec');
    const clip = await Anicodec.open('/tests/conformance/clips.anic'), name = 'clip of 29', outcome = {};
    for (const url of ['/moving.glb', '/beside.glb']) {
      const gltf = await new GLTFLoader().register((parser) => new AnicGLTFExtension(parser)).loadAsync(url), { scene, animations } = gltf;
      const mesh = scene.getObjectByName('shown'), mixer = new AnimationMixer(scene);
      const animation = animations.find((one) => one.name === name), { startTime } = clip.find(name);
      mixer.clipAction(animation).play();
      mixer.setTime(startTime + 0.5);
      scene.updateMatrixWorld();
      const far = (p, q) => p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0);
      const { position, normal } = mesh.geometry.attributes, length = normal.array.reduce((sum, v) => sum + v * v, 0) / normal.count;
      outcome[url] = { far: far(position.array, clip.meshes[0].sourcePositions(0.5, undefined, { clip: name })), length, names: animations.map((one) => one.name),
        material: mesh.material.name, players: gltf.userData.anicPlayers.length };
    }
    const plain = await new GLTFLoader().loadAsync('/moving.glb');
    outcome.still = plain.animations.length === 0 && plain.scene.getObjectByName('shown').isMesh;
    return outcome;
  });
  for (const url of ['/moving.glb', '/beside.glb']) {
    const one = result[url];
    assert.ok(one.far < 1e-4 && Math.abs(one.length - 1) < 0.05, JSON.stringify(result));
    assert.deepEqual([one.material, one.players, one.names.length], ['paint', 1, 6]);
  }
  assert.ok(result.still);
});

test('groups stay on points of the surface, in scenes and their clones too', { skip }, async () => {
  const result = await inPage(async () => {
    const THREE = await import('three'), { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js'), SkeletonUtils = await import('three/addons/utils/SkeletonUtils.js');
    const { AnicGLTFExtension, AnicLoader } = await import('anicodec/three'), outcome = { far: [], turned: [] }, [a, b] = ['clip of 70', 'clip of 29'];
    const load = async () => (await new GLTFLoader().register((parser) => new AnicGLTFExtension(parser)).loadAsync('/moving.glb')).scene;
    const scene = await load(), copy = SkeletonUtils.clone(scene), playerOf = (root) => root.getObjectByName('ANIC_mesh_animation');
    const mesh = await new AnicLoader().loadAsync('/tests/conformance/clips.anic');
    scene.position.set(1, 2, 3);
    for (const [root, player] of [[mesh, mesh], [scene, playerOf(scene)], [copy, playerOf(copy)]]) {
      root.updateMatrixWorld(true);
      const [source] = player.clip.meshes, { position, normal } = source.surfaceFrame({ vertices: source.indices.subarray(0, 3), weights: [0.5, 0.3, 0.2] }, 0);
      const from = root.localToWorld(new THREE.Vector3(...position).addScaledVector(new THREE.Vector3(...normal), player.clip.info.diagonal));
      const [hit] = new THREE.Raycaster(from, root.localToWorld(new THREE.Vector3(...position)).sub(from).normalize()).intersectObject(root, true);
      const group = player.anchor(hit), at = new THREE.Vector3(), { object, face, barycoord } = hit;
      const far = (point) => outcome.far.push(group.getWorldPosition(at).distanceTo(point) / player.clip.info.diagonal);
      root.updateMatrixWorld();
      far(hit.point);
      for (const [clip, time] of [[a, 0.4], [b, 0.7]]) {
        Object.assign(player, { current: clip, time });
        root.updateMatrixWorld();
        const corners = [face.a, face.b, face.c].map((v) => object.getVertexPosition(v, new THREE.Vector3()).applyMatrix4(object.matrixWorld));
        far(new THREE.Vector3().addScaledVector(corners[0], barycoord.x).addScaledVector(corners[1], barycoord.y).addScaledVector(corners[2], barycoord.z));
        const up = new THREE.Triangle(...corners).getNormal(new THREE.Vector3()), [x, y, z] = [0, 1, 2].map((c) => new THREE.Vector3().setFromMatrixColumn(group.matrixWorld, c));
        outcome.turned.push(up.angleTo(y), x.angleTo(corners[1].sub(corners[0])), z.angleTo(x.clone().cross(y)));
      }
    }
    // Scenes and their clones show moments of their own.
    playerOf(scene).time = 0;
    copy.updateMatrixWorld();
    scene.updateMatrixWorld();
    const shown = (root) => root.getObjectByName('shown').geometry.attributes;
    outcome.apart = shown(copy).position !== shown(scene).position && shown(copy).position.array.some((v, i) => v !== shown(scene).position.array[i]);
    // A mixer on a clone.
    const mixer = new THREE.AnimationMixer(copy);
    mixer.clipAction(playerOf(copy).animations.find(({ name }) => name === b)).play();
    mixer.setTime(playerOf(copy).clip.find(b).startTime + 0.5);
    outcome.played = [playerOf(copy).current, Math.round(1000 * playerOf(copy).time)];
    // A mesh that comes and goes.
    const two = await new AnicLoader().loadAsync('/tests/conformance/scene.anic'), on = two.anchor({ mesh: 1, vertices: [0, 1, 2], weights: [1, 0, 0] });
    outcome.visible = [0, 1, 4, 5].map((frame) => {
      two.time = two.clip.frameTime(frame);
      two.refresh();
      return on.visible;
    });
    // Objects of one clip close it with the last.
    const second = mesh.clone(), group = mesh.anchor({ vertices: [0, 1, 2], weights: [1, 0, 0] });
    outcome.parent = group.parent === mesh;
    try {
      mesh.anchor({ vertices: [0, 1, 1e6], weights: [1, 0, 0] });
    } catch ({ status }) {
      outcome.refused = status;
    }
    group.removeFromParent();
    mesh.time = 0.1;
    mesh.refresh();
    outcome.groups = mesh.children.length - mesh.parts.length;
    mesh.dispose();
    mesh.dispose();
    outcome.closed = [second.clip.closed];
    second.dispose();
    outcome.closed.push(second.clip.closed);
    return outcome;
  });
  assert.ok(result.far.length === 9 && result.far.every((far) => far < 1e-3) && result.turned.every((turned) => turned < 0.01), JSON.stringify(result));
  assert.deepEqual({ ...result, far: 0, turned: 0 },
    { far: 0, turned: 0, apart: true, played: ['clip of 29', 500], visible: [false, true, false, false], parent: true, refused: 'ANIC_E_ARGUMENT', groups: 1, closed: [false, true] });
});

test('three.js shows fields as colours', { skip }, async () => {
  const result = await inPage(async () => {
    const THREE = await import('three'), { AnicLoader } = await import('anicodec/three'), outcome = {};
    const load = (name) => new AnicLoader().loadAsync(`/tests/conformance/${name}`), mesh = await load('heated.anic'), { geometry } = mesh.parts[0];
    outcome.fields = mesh.fields;
    const own = { colour: geometry.attributes.color, material: mesh.parts[0].material };
    mesh.time = 0.5;
    const field = mesh.showField('temperature'), [part] = mesh.parts, [source] = mesh.clip.meshes;
    // Brighter as the value grows, and the range holds.
    const values = source.attribute(source.attributes.find(({ name }) => name === 'temperature').index, 0.5);
    const brightness = (v) => [0.2126, 0.7152, 0.0722].reduce((sum, w, c) => sum + w * part.geometry.attributes.color.getComponent(v, c), 0);
    const order = [...values.keys()].sort((p, q) => values[p] - values[q]);
    outcome.rises = order.every((v, i) => i === 0 || brightness(v) >= brightness(order[i - 1]) - 1e-6) && brightness(order.at(-1)) > brightness(order[0]) + 0.05;
    outcome.within = values.every((v) => v >= field.low - 0.2 * (field.high - field.low) && v <= field.high + 0.2 * (field.high - field.low));
    outcome.vertexColours = part.material.vertexColors && part.material !== own.material;
    const material = new THREE.MeshBasicMaterial({ vertexColors: true });
    outcome.given = mesh.showField('temperature', { low: -1e6, high: 1e6, material }).high === 1e6 && part.material === material;
    outcome.middle = new Set(part.geometry.attributes.color.array).size < 12;
    mesh.showField();
    outcome.back = part.material === own.material && part.geometry.attributes.color === own.colour;
    try {
      mesh.showField('pressure');
    } catch ({ message }) {
      outcome.refused = message;
    }
    const faces = await load('domains.anic');
    outcome.cells = [faces.showField('cells').name, new Set(faces.parts[0].geometry.attributes.color.array).size > 10];
    return outcome;
  });
  assert.deepEqual(result, { fields: ['temperature'], rises: true, within: true, vertexColours: true, given: true, middle: true, back: true,
    refused: 'there is no field pressure, but temperature', cells: ['cells', true] });
});

test('texture coordinates and colours of a scene move', { skip: skip || (texture ? false : 'ANICODEC_COMMAND names no command') }, async () => {
  const result = await inPage(async () => {
    const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js'), { AnicGLTFExtension } = await import('anicodec/three');
    const { scene, userData: { anicPlayers: [player] } } = await new GLTFLoader().register((parser) => new AnicGLTFExtension(parser)).loadAsync('/texture.glb');
    return [0, 0.5, 1].map((time) => {
      player.time = time;
      player.refresh(true);
      let mesh;
      scene.traverse((object) => { mesh = object.isMesh ? object : mesh; });
      return [...mesh.geometry.attributes.uv.array.slice(0, 4), ...mesh.geometry.attributes.color.array.slice(0, 3)];
    });
  });
  [0, 0.5, 1].forEach((t, i) => {
    const expected = [0.5 * t, 0.25 * t, 0.5 + 0.5 * t, 0.25 * t, 0.75 - 0.5 * t, 0.5 + 0.25 * t, 0.25];
    assert.ok(expected.every((x, k) => Math.abs(x - result[i][k]) < 0.01), JSON.stringify(result));
  });
});

test('the viewer plays the clips that are in it, without a network', { skip: skip || (existsSync(VIEWER) ? false : 'there is no viewer') }, async () => {
  const clip = `<script class="clip" type="application/octet-stream" data-name="heated.anic">${Buffer.from(bytesOf('heated.anic')).toString('base64')}</script>`;
  const viewer = readFileSync(VIEWER, 'utf8').replace('<!-- the clip -->', () => clip + clip);
  await withPage(async (page, messages) => {
    await page.route('**/*', (route) => (route.request().url() === 'http://viewer.test/' ? route.fulfill({ body: viewer, contentType: 'text/html' }) : route.abort()));
    await page.goto('http://viewer.test/');
    await page.waitForFunction(() => document.documentElement.dataset.ready === 'true');
    const clock = page.locator('#clock'), early = await clock.textContent();
    await page.waitForFunction((text) => document.getElementById('clock').textContent !== text, early);  // it plays
    await page.keyboard.press(' ');
    assert.equal(await page.locator('#play').textContent(), 'Play');
    // A field as colours, and its range.
    const reds = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
      const gl = document.getElementById('canvas').getContext('webgl2'), [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
      const pixels = new Uint8Array(4 * w * h);
      gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      done(pixels.reduce((sum, value, i) => sum + (i % 4 === 0 ? value : 0), 0));
    }))));
    const own = await reds();
    assert.ok(!await page.locator('#legend').isVisible());
    await page.locator('#field').selectOption('temperature');
    assert.match(await page.locator('#legend').textContent(), /^19\.7.*431/);
    assert.ok(Math.abs(await reds() - own) > 0.02 * own);
    await page.locator('#field').selectOption('');
    assert.ok(!await page.locator('#legend').isVisible());
    assert.ok(Math.abs(await reds() - own) < 0.001 * own);
    await page.locator('#error').click();
    await page.locator('#wires').click();
    assert.match(await page.locator('#figures').textContent(), /largest 0/);  // the clip against itself
    assert.match(await page.locator('#info').textContent(), /basis of the motion/);
    // Both halves show something.
    const lit = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
      const gl = document.getElementById('canvas').getContext('webgl2'), [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
      const pixels = new Uint8Array(4 * w * h), counts = [0, 0];
      gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      for (let i = 0; i < w * h; ++i)
        counts[i % w < w / 2 ? 0 : 1] += pixels[4 * i] !== pixels[0];
      done(counts);
    }))));
    assert.ok(lit.every((count) => count > 100), String(lit));
    await page.setInputFiles('#files', { name: 'moving.glb', mimeType: '', buffer: movingGlb(bytesOf('clips.anic'), await Anicodec.open(bytesOf('clips.anic'))) });
    await page.waitForFunction(() => document.getElementById('clip').options.length > 1);
    await page.locator('#clip').selectOption('clip of 29');
    await page.locator('#time').evaluate((range) => { range.value = 1; range.dispatchEvent(new Event('input')); });
    await page.waitForFunction(() => document.getElementById('clock').textContent.startsWith('7.84 s'));
    await page.setInputFiles('#files', { name: 'bad.anic', mimeType: '', buffer: Buffer.from('this is no clip') });
    await page.waitForFunction(() => !document.getElementById('message').hidden);
    assert.match(await page.locator('#message').textContent(), /bad\.anic: ANIC_E_MAGIC/);
    assert.deepEqual(messages, []);
  }, { viewport: { width: 900, height: 600 } });
});

test('the viewer shows all of a clip beside its panels, on a phone too', { skip: skip || (existsSync(VIEWER) ? false : 'there is no viewer') }, async () => {
  const clip = `<script class="clip" type="application/octet-stream" data-name="limb.anic">${Buffer.from(bytesOf('limb_default.anic')).toString('base64')}</script>`;
  const viewer = readFileSync(VIEWER, 'utf8').replace('<!-- the clip -->', () => clip);
  for (const [width, height, phone] of [[390, 844, true], [844, 390, true], [1280, 800, false], [320, 480, true]]) {
    await withPage(async (page, messages) => {
      await page.route('**/*', (route) => route.fulfill({ body: viewer, contentType: 'text/html' }));
      await page.goto('http://viewer.test/');
      await page.waitForFunction(() => document.documentElement.dataset.ready === 'true');
      assert.equal(await page.locator('#info').isVisible(), !phone);
      for (const about of [true, false]) {
        if (await page.locator('#info').isVisible() !== about)
          await page.locator('#about').click();
        const [stage, ...panels] = await Promise.all(['#canvas', '#controls', ...(about ? ['#info'] : [])].map((name) => page.locator(name).boundingBox()));
        assert.ok(stage.width > 200 && stage.height > 120, JSON.stringify(stage));
        for (const panel of panels) {
          const apart = panel.x >= stage.x + stage.width || panel.y >= stage.y + stage.height;
          assert.ok(apart && panel.x + panel.width <= width && panel.y + panel.height <= height, JSON.stringify({ stage, panel }));
        }
        // The rim of the picture is empty: nothing of the clip is cut off.
        const rim = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
          const gl = document.getElementById('canvas').getContext('webgl2'), [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
          const pixels = new Uint8Array(4 * w * h), at = (x, y) => pixels[4 * (y * w + x)];
          gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          let edge = 0, inside = 0;
          for (let y = 0; y < h; ++y) {
            for (let x = 0; x < w; ++x) {
              const drawn = at(x, y) !== at(0, 0);
              inside += drawn;
              edge += drawn && (x === 0 || y === 0 || x === w - 1 || y === h - 1);
            }
          }
          done({ edge, inside });
        }))));
        assert.ok(rim.edge === 0 && rim.inside > 100, JSON.stringify(rim));
      }
      assert.deepEqual(messages, []);
    }, { browser, viewport: { width, height }, hasTouch: phone, isMobile: phone });
  }
});

test('the graphics card plays instances as the CPU does', { skip }, async (t) => {
  let byCard = 0;
  await withPage(async (page, messages) => {
    await page.goto(`${server.url}/page`);
    for (const { file } of files.filter(({ what }) => what === 'valid')) {
      const result = await page.evaluate(async (name) => {
        const THREE = await import('three');
        const { Anicodec } = await import('anicodec');
        const { AnicInstances, AnicMesh } = await import('anicodec/three');
        const clip = await Anicodec.open(`/tests/conformance/${name}`, { inexact: true }).catch((error) => {
          if (!error.message.includes('feature 1 '))
            throw error;
        });
        if (!clip || clip.meshes.length > 1 || clip.meshes[0].triangleCount === 0)
          return undefined;
        const [mesh] = clip.meshes, renderer = globalThis.renderer ??= new THREE.WebGLRenderer();
        renderer.setSize(320, 240);
        const instances = new AnicInstances(mesh, 5, new THREE.MeshStandardMaterial({ side: THREE.DoubleSide })), { duration } = clip;
        instances.times.set([0, 0.37, 0.5, 0.9, 1].map((share) => share * duration));
        instances.update(renderer);
        const byCpu = instances.madeByCpu;
        let far = 0, turned = 0, cancelled = 0, size = 0;
        // Vertices whose areas all but cancel have no normal to speak of: rounding decides it.
        const area = ([a, b, c]) => {
          const [x, y] = [b, c].map((p) => p.map((value, axis) => value - a[axis]));
          return [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
        };
        // Far from the origin, the area of a sliver is rounding alone.
        const rounding = ([a, ...others]) =>
          2 ** -16 * Math.max(...a.map(Math.abs)) * Math.max(...others.map((p) => Math.hypot(...p.map((value, axis) => value - a[axis]))));
        const cancel = (triangles) => {
          const areas = triangles.map(area), sum = [0, 1, 2].map((axis) => areas.reduce((all, value) => all + value[axis], 0));
          const parts = areas.reduce((all, value) => all + Math.hypot(...value), 0);
          return Math.hypot(...sum) <= Math.max(1e-3 * parts, ...triangles.map(rounding));
        };
        const { normalElements, normalCorners } = mesh.normalPlan, at = (positions, v) => [...positions.subarray(3 * v, 3 * v + 3)];
        const cancels = (source, rendered, v) => {
          const [, centre, first, count] = normalElements.subarray(4 * v, 4 * v + 4);
          const corners = Array.from({ length: count }, (_, c) => [centre, ...normalCorners.subarray(4 * (first + c), 4 * (first + c) + 2)]);
          return cancel(corners.map((t) => t.map((c) => at(source, c)))) || cancel((fans.get(v) ?? []).map((t) => t.map((c) => at(rendered, c))));
        };
        const fans = new Map();
        for (let k = 0; k < mesh.indices.length; k += 3) {
          const corners = [...mesh.indices.subarray(k, k + 3)];
          for (const v of new Set(corners))
            fans.set(v, [...(fans.get(v) ?? []), corners]);
        }
        instances.times.forEach((time, i) => {
          const p = mesh.sourcePositions(time), q = instances.read(renderer, i), n = mesh.normals(time), m = instances.read(renderer, i, 'normals');
          const rendered = mesh.positions(time);
          p.forEach((x, k) => { far = Math.max(far, Math.abs(x - q[k])); size = Math.max(size, Math.abs(x)); });
          for (let k = 0; k < n.length; k += 3)
            if (Math.acos(Math.min(Math.max(n[k] * m[k] + n[k + 1] * m[k + 1] + n[k + 2] * m[k + 2], -1), 1)) > 0.05)
              cancels(p, rendered, k / 3) ? ++cancelled : ++turned;
        });
        // One instance beside the same frame by the CPU.
        const scene = new THREE.Scene(), light = new THREE.DirectionalLight(0xffffff, 3), cpu = new AnicMesh(clip, new THREE.MeshStandardMaterial({ side: THREE.DoubleSide }));
        cpu.rotation.set(0, 0, 0);
        light.position.set(1, 2, 3);
        const one = new AnicInstances(mesh, 1, new THREE.MeshStandardMaterial({ side: THREE.DoubleSide }));
        scene.add(light, cpu, one);
        const { center, radius } = one.geometry.boundingSphere, camera = new THREE.PerspectiveCamera(40, 4 / 3, radius / 10, radius * 10);
        camera.position.copy(center).add(new THREE.Vector3(radius, radius, 3 * radius));
        camera.lookAt(center);
        cpu.time = one.times[0] = 0.5 * duration;
        const shot = (shown, hidden) => {
          shown.visible = true;
          hidden.visible = false;
          one.update(renderer);
          renderer.render(scene, camera);
          const gl = renderer.getContext(), pixels = new Uint8Array(4 * 320 * 240);
          gl.readPixels(0, 0, 320, 240, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          return pixels;
        };
        const a = shot(cpu, one), b = shot(one, cpu);
        let different = 0, lit = 0;
        for (let k = 0; k < a.length; k += 4) {
          lit += a[k] > 8;
          different += Math.abs(a[k] - b[k]) > 24;
        }
        const ray = new THREE.Raycaster(camera.position, center.clone().sub(camera.position).normalize()), hits = ray.intersectObject(one).length;
        cpu.visible = true;
        const cpuHits = ray.intersectObject(cpu, true).length;
        // Many at once: one call, and little time of the script.
        const many = new AnicInstances(mesh, 40), scene2 = new THREE.Scene();
        scene2.add(many);
        const run = () => {
          for (let i = 0; i < 40; ++i)
            many.times[i] = (i * 0.37 % 1) * duration;
          const before = performance.now();
          many.update(renderer);
          return (performance.now() - before) / 40;
        };
        run();
        const ms = run();
        many.frustumCulled = false;
        renderer.render(scene2, camera);
        const { calls } = renderer.info.render;
        for (const object of [instances, one, many, cpu])
          object.dispose();
        return { byCpu, far, turned, cancelled, diagonal: clip.info.diagonal, size, different, lit, hits, cpuHits, calls, ms, vertices: mesh.vertexCount, error: renderer.getContext().getError() };
      }, file);
      assert.deepEqual(messages, []);
      if (!result)
        continue;  // coded by Draco, several meshes, or points
      t.diagnostic(`${file}: ${JSON.stringify(result)}`);
      byCard += 5 - result.byCpu;
      assert.ok(result.far <= 1e-4 * result.diagonal + 2e-6 * result.size, JSON.stringify(result));
      assert.ok(result.turned <= 0.02 * 5 * result.vertices, JSON.stringify(result));
      if (result.cancelled === 0)  // else rounding shades whole triangles
        assert.ok(result.different <= 0.01 * result.lit + 20, JSON.stringify(result));
      assert.equal(result.hits, result.cpuHits);
      assert.equal(result.calls, 1);
      assert.equal(result.error, 0);
    }
  }, { browser });
  assert.ok(byCard >= 5);
});

test('instances have fields as meshes do, and objects on their surfaces', { skip }, async () => {
  const result = await inPage(async () => {
    const THREE = await import('three'), { Anicodec } = await import('anicodec'), { AnicInstances, AnicMesh } = await import('anicodec/three');
    const clip = await Anicodec.open('/tests/conformance/heated.anic'), [mesh] = clip.meshes, renderer = new THREE.WebGLRenderer(), scene = new THREE.Scene();
    renderer.setSize(320, 240);
    const cpu = new AnicMesh(clip), many = new AnicInstances(mesh, 3), light = new THREE.DirectionalLight(0xffffff, 3), { center, radius } = many.geometry.boundingSphere;
    const camera = new THREE.PerspectiveCamera(40, 4 / 3, radius / 10, radius * 10), away = new THREE.Matrix4().makeTranslation(0, 100 * radius, 0);
    cpu.rotation.set(0, 0, 0);
    light.position.set(1, 2, 3);
    camera.position.copy(center).add(new THREE.Vector3(radius, radius, 3 * radius));
    camera.lookAt(center);
    scene.add(light, cpu, many);
    many.frustumCulled = false;
    const picture = () => {
      many.instanceMatrix.needsUpdate = true;
      many.update(renderer);
      renderer.render(scene, camera);
      const gl = renderer.getContext(), pixels = new Uint8Array(4 * 320 * 240);
      gl.readPixels(0, 0, 320, 240, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      return pixels;
    };
    const differing = (a, b) => a.reduce((sum, x, k) => sum + (Math.abs(x - b[k]) > 24), 0), outcome = { fields: many.fields, shares: [] };
    cpu.visible = false;
    const plain = picture();
    for (const share of [0.2, 0.8]) {
      const field = many.showField('temperature', { low: 0, high: 100 });
      many.times.set([0.5, share, 0.1].map((part) => part * clip.duration));
      [0, 2].forEach((i) => many.setMatrixAt(i, away));
      cpu.showField('temperature', field);
      cpu.time = many.times[1];
      const ours = picture();
      many.visible = false;
      cpu.visible = true;
      const theirs = picture();
      many.visible = true;
      cpu.visible = false;
      outcome.shares.push([differing(ours, theirs), theirs.reduce((sum, x, k) => sum + (k % 4 === 1 && x > 8), 0), differing(ours, plain)]);
    }
    many.showField();
    [0, 2].forEach((i) => many.setMatrixAt(i, new THREE.Matrix4()));
    many.times.fill(0);
    outcome.back = differing(picture(), plain);
    // An object on the second of them, which stands turned, moved and larger.
    const matrix = new THREE.Matrix4().compose(new THREE.Vector3(3, -2, 1), new THREE.Quaternion().setFromEuler(new THREE.Euler(0.3, 1, -0.4)), new THREE.Vector3(2, 2, 2));
    const point = { vertices: [0, 1, 2], weights: [0.5, 0.25, 0.25] }, pin = many.anchor({ instanceId: 1, ...point });
    many.setMatrixAt(1, matrix);
    many.position.set(0.5, 0, 0);
    many.times[1] = 0.6 * clip.duration;
    many.update(renderer);
    scene.updateMatrixWorld();
    const { position, normal } = mesh.surfaceFrame(point, many.times[1]), place = many.matrixWorld.clone().multiply(matrix), at = pin.localToWorld(new THREE.Vector3());
    outcome.pinned = new THREE.Vector3(...position).applyMatrix4(place).distanceTo(at);
    outcome.turned = new THREE.Vector3(...normal).transformDirection(place).distanceTo(pin.localToWorld(new THREE.Vector3(0, 1, 0)).sub(at).normalize());
    const target = center.clone().applyMatrix4(place), ray = new THREE.Raycaster(target.clone().add(new THREE.Vector3(0, 0, 20 * radius)), new THREE.Vector3(0, 0, -1));
    const [hit] = ray.intersectObject(many), held = many.anchor(hit);
    scene.updateMatrixWorld();
    outcome.held = [hit.instanceId, held.localToWorld(new THREE.Vector3()).distanceTo(hit.point)];
    held.removeFromParent();
    const before = held.position.clone();
    many.times[1] = 0;
    many.update(renderer);
    outcome.free = held.position.equals(before);
    outcome.faults = [() => many.anchor({ instanceId: 3, ...point }), () => many.anchor({ vertices: [0, 1, 1e9], weights: [1, 0, 0] }), () => many.showField('none')].map((wrong) => {
      try {
        wrong();
        return undefined;
      } catch (error) {
        return error.message;
      }
    });
    for (const object of [many, cpu])
      object.dispose();
    outcome.error = renderer.getContext().getError();
    return { ...outcome, radius };
  });
  assert.ok(result.fields.includes('temperature'));
  for (const [far, lit, changed] of result.shares)
    assert.ok(lit > 1000 && far <= 0.01 * lit + 20 && changed > 1000, JSON.stringify(result.shares));
  assert.equal(result.back, 0);
  assert.ok(result.pinned < 1e-4 * result.radius && result.turned < 1e-4, JSON.stringify(result));
  assert.deepEqual([result.held[0], result.held[1] < 1e-3 * result.radius, result.free, result.error], [1, true, true, 0]);
  assert.match(result.faults[0], /no instance 3 of 3/);
  assert.ok(result.faults.every(Boolean), JSON.stringify(result.faults));
});
