// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// anicodec/babylon in Chromium. `npm ci --prefix tests/web/babylon` installs Babylon.js.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { test } from 'node:test';
import { Anicodec } from '../../bindings/web/index.js';
import { babylonImports, babylonScripts, pageOf } from './engines.mjs';
import { bytesOf, movingGlb, sceneWithMovingTexture } from './files.mjs';
import { CHROMIUM, serve, withPage } from './serve.mjs';

const PAGE = pageOf(babylonImports(), babylonScripts);
// Corrections, shapes, trajectories, several segments, sharp turns, colours, clips, and regions.
const INSTANCED = ['quad_box_corrected', 'limb_default', 'schedules', 'rings', 'heated', 'clips', 'walk', 'regions', 'layers'].map((name) => `${name}.anic`);
const installed = existsSync(new URL('babylon/node_modules/babylonjs', import.meta.url));
const skip = !CHROMIUM ? 'there is no Chromium' : installed ? false : 'there is no Babylon.js: npm ci --prefix tests/web/babylon';

test('Babylon.js shows, plays and fades clips, and plays glTF scenes that move by them', { skip }, async () => {
  const bytes = bytesOf('clips.anic'), texture = sceneWithMovingTexture(), server = await serve({ '/page': PAGE, ...(texture ? { '/texture.glb': texture } : {}), '/moving.glb': movingGlb(bytes, await Anicodec.open(bytes)) });
  try {
    await withPage(async (page, messages) => {
      await page.goto(`${server.url}/page`);
      const result = await page.evaluate(async (textured) => {
        const { loadAnic, AnicGLTFExtension } = await import('anicodec/babylon');
        const { Anicodec } = await import('anicodec');
        const B = globalThis.BABYLON, canvas = document.getElementById('canvas'), engine = new B.Engine(canvas, false, { preserveDrawingBuffer: true });
        const far = (p, q) => p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0);
        const outcome = { steps: {} };
        const make = () => {
          const scene = new B.Scene(engine);
          scene.clearColor = new B.Color4(0, 0, 0, 1);
          new B.HemisphericLight('sky', new B.Vector3(0, 1, 0.3), scene);
          return scene;
        };
        const look = (scene, { min, max }) => {
          new B.HemisphericLight('sky', new B.Vector3(0, 1, -0.5), scene).intensity = 0.5;
          const low = B.Vector3.FromArray(min), high = B.Vector3.FromArray(max), centre = low.add(high).scale(0.5), size = high.subtract(low).length();
          centre.z *= scene.useRightHandedSystem ? 1 : -1;
          const camera = new B.FreeCamera('camera', centre.add(new B.Vector3(size, size, 2 * size)), scene);
          camera.setTarget(centre);
          camera.minZ = size / 100;
          camera.maxZ = size * 100;
        };
        const lit = async (scene) => {
          await scene.whenReadyAsync();
          scene.render();
          const gl = canvas.getContext('webgl2'), pixels = new Uint8Array(4 * 320 * 240);
          gl.readPixels(0, 0, 320, 240, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          return pixels.filter((v, i) => i % 4 === 0 && v > 8).length;
        };
        // A coloured clip, and whether its surface shows its front.
        const painted = make(), heated = await loadAnic('/tests/conformance/heated.anic', painted);
        look(painted, heated.clip.bounds);
        outcome.lit = await lit(painted);
        heated.parts.forEach((part) => { (part.material.subMaterials ?? [part.material]).forEach((one) => { one.backFaceCulling = true; }); });
        outcome.front = await lit(painted);
        heated.dispose();
        outcome.closed = heated.clip.closed;
        // Several clips.
        const scene = make(), mesh = await loadAnic('/tests/conformance/clips.anic', scene), { clip } = mesh, [a, b] = ['clip of 70', 'clip of 29'];
        const shown = () => mesh.parts[0].getVerticesData(B.VertexBuffer.PositionKind), expected = (time, options) => clip.positions(time, undefined, options);
        look(scene, clip.bounds);
        mesh.current = b;
        mesh.time = 0.5;
        scene.render();
        outcome.steps.set = far(shown(), expected(0.5, { clip: b }));
        const [first, second] = [a, b].map((name) => mesh.animationGroups[clip.find(name).index]);
        const hold = (group, seconds) => { group.pause(); group.goToFrame(60 * seconds); };
        mesh.play(a);
        hold(first, 0.25);
        scene.render();
        outcome.steps.playing = far(shown(), expected(0.25, { clip: a }));
        outcome.current = mesh.current;
        mesh.play(b);
        first.start(true);
        first.setWeightForAllAnimatables(0.75);
        second.setWeightForAllAnimatables(0.25);
        scene.render();
        const [wa, wb] = [a, b].map((name) => mesh.clipWeights[clip.find(name).index]);
        outcome.weights = [wa, wb];
        const [ta, tb] = [a, b].map((name) => mesh.clipTimes[clip.find(name).index] / mesh.clipWeights[clip.find(name).index]);
        outcome.steps.fading = far(shown(), expected(ta, { clip: a, blend: { clip: b, time: tb, weight: 0.25 } }));
        first.stop();
        second.stop();
        outcome.stopped = mesh.clipWeights.every((w) => w === 0);
        mesh.dispose();
        // The extension.
        B.GLTF2.registerGLTFExtension('ANIC_mesh_animation', true, (loader) => new AnicGLTFExtension(loader));
        const gltf = make();
        await B.SceneLoader.AppendAsync('/', 'moving.glb', gltf);
        const player = gltf.getNodeByName('ANIC_mesh_animation'), moving = gltf.meshes.find((one) => one.getTotalVertices() > 0);
        look(gltf, player.clip.bounds);
        // The loader starts the first group, as of every glTF.
        outcome.started = gltf.animationGroups.map((group) => group.isStarted).indexOf(true);
        gltf.animationGroups.forEach((group) => group.stop());
        player.current = b;
        player.time = 0.5;
        gltf.render();
        const again = await Anicodec.open('/tests/conformance/clips.anic');
        outcome.steps.gltf = far(moving.getVerticesData(B.VertexBuffer.PositionKind), again.meshes[0].sourcePositions(0.5, undefined, { clip: b }));
        outcome.groups = gltf.animationGroups.length;
        // In time with the source, and in a container.
        const timed = player.animationGroups[player.clip.find(a).index], { startTime } = player.clip.find(a);
        player.play(a);
        timed.pause();
        timed.goToFrame(60 * (startTime + 0.25));
        gltf.render();
        outcome.steps.begun = Math.abs(player.time - 0.25);
        const apart = make(), container = await B.LoadAssetContainerAsync('/moving.glb', apart);
        outcome.apart = [container.animationGroups.length, apart.animationGroups.length, apart.getNodeByName('ANIC_mesh_animation') === null];
        container.addAllToScene();
        outcome.apart.push(apart.animationGroups.length, apart.getNodeByName('ANIC_mesh_animation') !== null);
        container.dispose();
        outcome.material = moving.material.name;
        if (textured) {
          const moved = make();
          await B.SceneLoader.AppendAsync('/', 'texture.glb', moved);
          const sheet = moved.getNodeByName('ANIC_mesh_animation'), shown = moved.meshes.find((one) => one.getTotalVertices() > 0);
          sheet.time = 0.5;
          sheet.refresh(true);
          outcome.textured = [...shown.getVerticesData(B.VertexBuffer.UVKind).slice(0, 4), ...shown.getVerticesData(B.VertexBuffer.ColorKind).slice(0, 3)];
        }
        return outcome;
      }, texture !== undefined);
      assert.deepEqual(messages.filter((text) => !/BJS -|Babylon\.js v/.test(text)), []);
      assert.ok(Object.values(result.steps).every((distance) => distance < 1e-3), JSON.stringify(result));
      assert.ok(result.lit > 1000 && Math.abs(result.front - result.lit) < 0.02 * result.lit, JSON.stringify(result));
      assert.ok(Math.abs(result.weights[0] - 0.75) < 1e-6 && Math.abs(result.weights[1] - 0.25) < 1e-6, JSON.stringify(result));
      if (texture)
        [0.25, 0.125, 0.75, 0.125, 0.5, 0.625, 0.25].forEach((x, i) => assert.ok(Math.abs(x - result.textured[i]) < 0.01, JSON.stringify(result)));
      assert.deepEqual([result.current, result.closed, result.stopped, result.groups, result.material], ['clip of 70', true, true, 6, 'paint']);
      assert.deepEqual([result.started, ...result.apart], [0, 6, 0, true, 6, true]);
    });
  } finally {
    server.close();
  }
});

test('Babylon.js keeps nodes on points of the surface, and shows fields as colours', { skip }, async () => {
  const bytes = bytesOf('clips.anic'), server = await serve({ '/page': PAGE, '/moving.glb': movingGlb(bytes, await Anicodec.open(bytes)) });
  try {
    await withPage(async (page, messages) => {
      await page.goto(`${server.url}/page`);
      const result = await page.evaluate(async () => {
        const { loadAnic, AnicGLTFExtension } = await import('anicodec/babylon'), B = globalThis.BABYLON;
        const engine = new B.Engine(document.getElementById('canvas'), false), outcome = { far: [], turned: [], hands: [] }, [a, b] = ['clip of 70', 'clip of 29'];
        B.GLTF2.registerGLTFExtension('ANIC_mesh_animation', true, (loader) => new AnicGLTFExtension(loader));
        for (const right of [false, true]) {
          const scene = new B.Scene(engine);
          scene.useRightHandedSystem = right;
          new B.FreeCamera('camera', B.Vector3.Zero(), scene);
          await B.SceneLoader.AppendAsync('/', 'moving.glb', scene);
          scene.animationGroups.forEach((group) => group.stop());
          const shown = await loadAnic('/tests/conformance/clips.anic', scene), player = scene.getNodeByName('ANIC_mesh_animation');
          for (const [one, object] of [[shown, shown.parts[0]], [player, scene.meshes.find((mesh) => mesh.getTotalVertices() > 0 && mesh !== shown.parts[0])]]) {
            one.time = 0;
            scene.render();
            const corner = (v) => B.Vector3.TransformCoordinates(B.Vector3.FromArray(object.getVerticesData(B.VertexBuffer.PositionKind), 3 * v), object.computeWorldMatrix(true));
            const corners = () => [...object.getIndices().slice(0, 3)].map(corner), mean = corners().reduce((p, q) => p.add(q)).scale(1 / 3);
            const [p, q, r] = corners(), outside = B.Vector3.Cross(q.subtract(p), r.subtract(p)).normalize().scale(one.clip.info.diagonal), from = mean.add(outside);
            const hit = scene.pickWithRay(new B.Ray(from, mean.subtract(from).normalize(), 1e6), (mesh) => mesh === object), node = one.anchor(hit);
            node.computeWorldMatrix(true);
            outcome.far.push(B.Vector3.Distance(node.getAbsolutePosition(), hit.pickedPoint) / one.clip.info.diagonal);
            const face = [...object.getIndices().slice(3 * hit.faceId, 3 * hit.faceId + 3)];
            for (const [clip, time] of [[a, 0.4], [b, 0.7]]) {
              Object.assign(one, { current: clip, time });
              scene.render();
              const [x, y, z] = face.map(corner), world = node.computeWorldMatrix(true);
              const at = x.scale(hit.bu).add(y.scale(hit.bv)).add(z.scale(1 - hit.bu - hit.bv));
              outcome.far.push(B.Vector3.Distance(node.getAbsolutePosition(), at) / one.clip.info.diagonal);
              const axis = (v) => B.Vector3.TransformNormal(v, world).normalize(), normal = B.Vector3.Cross(y.subtract(x), z.subtract(x)).normalize().scale(right ? 1 : -1);
              outcome.turned.push(1 - B.Vector3.Dot(axis(B.Vector3.Up()), normal), 1 - B.Vector3.Dot(axis(B.Vector3.Right()), y.subtract(x).normalize()));
              outcome.hands.push(world.determinant() > 0);
            }
            node.parent = null;
            const before = node.position.clone();
            one.time = 0.1;
            scene.render();
            outcome.hands.push(before.equals(node.position));
          }
          scene.dispose();
        }
        const scene = new B.Scene(engine), mesh = await loadAnic('/tests/conformance/heated.anic', scene), [part] = mesh.parts, kind = B.VertexBuffer.ColorKind;
        new B.FreeCamera('camera', B.Vector3.Zero(), scene);
        const own = [part.material, part.getVerticesData(kind).slice()];
        mesh.time = 0.5;
        outcome.field = [mesh.fields, mesh.showField('temperature').name];
        const [source] = mesh.clip.meshes, values = source.attribute(source.attributes.find(({ name }) => name === 'temperature').index, 0.5), colours = part.getVerticesData(kind);
        const brightness = (v) => [0.2126, 0.7152, 0.0722].reduce((sum, w, c) => sum + w * colours[4 * v + c] ** 2.2, 0), order = [...values.keys()].sort((x, y) => values[x] - values[y]);
        outcome.rises = order.every((v, i) => i === 0 || brightness(v) >= brightness(order[i - 1]) - 1e-5) && brightness(order.at(-1)) > brightness(order[0]) + 0.05;
        scene.render();
        mesh.showField();
        mesh.time = 0;
        mesh.refresh();
        outcome.back = part.material === own[0] && part.getVerticesData(kind).every((v, i) => Math.abs(v - own[1][i]) < 1e-6);
        engine.dispose();
        return outcome;
      });
      assert.deepEqual(messages.filter((text) => !/BJS -|Babylon\.js v/.test(text)), []);
      assert.ok(result.far.length === 12 && result.far.every((far) => far < 1e-3) && result.turned.every((turned) => turned < 1e-3) && result.hands.every(Boolean), JSON.stringify(result));
      assert.deepEqual([result.field, result.rises, result.back], [[['temperature'], 'temperature'], true, true]);
    });
  } finally {
    server.close();
  }
});

test('Babylon.js draws instances by the graphics card as the CPU does', { skip }, async (t) => {
  const server = await serve({ '/page': PAGE });
  let byCard = 0;
  try {
    await withPage(async (page, messages) => {
      await page.goto(`${server.url}/page`);
      for (const file of INSTANCED) {
        const result = await page.evaluate(async (name) => {
          const { AnicInstances, AnicMesh } = await import('anicodec/babylon');
          const { Anicodec } = await import('anicodec');
          const clip = await Anicodec.open(`/tests/conformance/${name}`), B = globalThis.BABYLON, canvas = document.getElementById('canvas'), engine = new B.Engine(canvas, false, { preserveDrawingBuffer: true });
          const scene = new B.Scene(engine), [mesh] = clip.meshes, { duration } = clip, { min, max } = clip.bounds;
          scene.clearColor = new B.Color4(0, 0, 0, 1);
          const sun = new B.DirectionalLight('sun', new B.Vector3(-1, -2, 3), scene);
          new B.HemisphericLight('sky', new B.Vector3(0, 1, -0.5), scene).intensity = 0.5;
          const low = B.Vector3.FromArray(min), high = B.Vector3.FromArray(max), centre = low.add(high).scale(0.5), size = high.subtract(low).length();
          const turned = (p) => (clip.info.up === 'z' ? new B.Vector3(p.x, p.z, p.y) : new B.Vector3(p.x, p.y, -p.z)), target = turned(centre);
          const camera = new B.FreeCamera('camera', target.add(new B.Vector3(size / 3, size / 3, -size)), scene);
          camera.setTarget(target);
          Object.assign(camera, { minZ: size / 100, maxZ: size * 100 });
          const plain = () => Object.assign(new B.StandardMaterial('plain', scene), { backFaceCulling: false, twoSidedLighting: true, specularColor: B.Color3.Black() });
          const drawn = async () => {
            await scene.whenReadyAsync();
            for (let tries = 0; tries < 200 && (tries < 5 || scene.meshes.some((one) => one.update?.() === false)); ++tries) {
              scene.render();
              await new Promise((done) => { setTimeout(done, 10); });
            }
            scene.render();
            const gl = canvas.getContext('webgl2'), pixels = new Uint8Array(4 * 320 * 240);
            gl.readPixels(0, 0, 320, 240, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
            return pixels;
          };
          const far = (p, q) => p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0);
          const five = new AnicInstances(mesh, 5, scene, plain()), outcome = { far: 0, size: 0, byCpu: 0, diagonal: clip.info.diagonal };
          five.times.set([0, 0.37, 0.5, 0.9, 1].map((share) => share * duration));
          await drawn();
          outcome.byCpu = five.madeByCpu;
          for (let i = 0; i < 5; ++i) {
            const p = mesh.sourcePositions(five.times[i]);
            outcome.far = Math.max(outcome.far, far(p, await five.read(i)));
            outcome.size = p.reduce((most, v) => Math.max(most, Math.abs(v)), outcome.size);
          }
          five.dispose();
          // One instance beside the same frame by the CPU, with its shadow on a wall behind it.
          const wall = B.MeshBuilder.CreatePlane('wall', { size: 6 * size }, scene), shadows = new B.ShadowGenerator(256, sun);
          wall.position = target.add(new B.Vector3(0, 0, size));
          wall.receiveShadows = true;
          wall.material = plain();
          Object.assign(sun, { position: target.subtract(sun.direction.scale(size)), shadowMinZ: 0, shadowMaxZ: 6 * size });
          const cpu = new AnicMesh(clip, scene, plain()), one = new AnicInstances(mesh, 1, scene, plain());
          cpu.time = one.times[0] = 0.5 * duration;
          const shot = (shown, hidden) => {
            shown.setEnabled(true);
            hidden.setEnabled(false);
            shadows.getShadowMap().renderList = shown === one ? [one] : cpu.parts;
            return drawn();
          };
          const a = await shot(cpu, one), b = await shot(one, cpu);
          one.setEnabled(false);
          shadows.getShadowMap().renderList = [];
          const empty = await drawn();
          Object.assign(outcome, { different: 0, seen: 0 });
          for (let k = 0; k < a.length; k += 4) {
            outcome.seen += Math.abs(a[k] - empty[k]) > 8;
            outcome.different += Math.abs(a[k] - b[k]) > 24;
          }
          one.setEnabled(true);
          cpu.setEnabled(true);
          cpu.refresh(true);
          const ray = scene.createPickingRay(160, 120, B.Matrix.Identity(), camera), hit = one.pick(ray), by = scene.pickWithRay(ray, (picked) => cpu.parts.includes(picked));
          outcome.picked = hit ? Math.abs(hit.distance - by.distance) < 1e-3 * size && hit.thinInstanceIndex === 0 : !by.hit;
          const aim = by.hit ? by.pickedPoint : target, through = new B.Ray(camera.position, aim.subtract(camera.position).normalize(), 10 * size);
          const byScene = scene.pickWithRay(through, (picked) => picked === one), byMesh = one.pick(through);
          outcome.picked &&= byScene.hit === !!byMesh && (!byMesh || (byScene.pickedMesh === one && byScene.thinInstanceIndex === 0 && byScene.distance === byMesh.distance));
          one.dispose();
          // Many at once: one call, and little time of the script.
          cpu.setEnabled(false);
          wall.dispose();
          const many = new AnicInstances(mesh, 40, scene, plain());
          many.thinInstanceSetMatrixAt(7, B.Matrix.Translation(0, 0, 1));
          await drawn();
          for (let i = 0; i < 40; ++i)
            many.times[i] = (i * 0.37 % 1) * duration;
          const before = performance.now();
          many.update();
          outcome.ms = (performance.now() - before) / 40;
          const calls = new B.SceneInstrumentation(scene);
          scene.render();
          scene.render();
          outcome.calls = calls.drawCallsCounter.current;
          outcome.error = canvas.getContext('webgl2').getError();
          engine.dispose();
          clip.close();
          return outcome;
        }, file);
        t.diagnostic(`${file}: ${JSON.stringify(result)}`);
        byCard += 5 - result.byCpu;
        assert.ok(result.far <= 1e-4 * result.diagonal + 2e-6 * result.size, JSON.stringify(result));
        assert.ok(result.different <= 0.01 * result.seen + 20, JSON.stringify(result));
        assert.deepEqual([result.picked, result.error], [true, 0], JSON.stringify(result));
      }
      assert.deepEqual(messages.filter((text) => !/BJS -|Babylon\.js v|GPU stall/.test(text)), []);
    });
  } finally {
    server.close();
  }
  assert.ok(byCard >= 5);
});

test('Babylon.js shows fields of instances, and keeps nodes on their surfaces', { skip }, async () => {
  const server = await serve({ '/page': PAGE });
  try {
    await withPage(async (page, messages) => {
      await page.goto(`${server.url}/page`);
      const results = await page.evaluate(async () => {
        const { AnicInstances, AnicMesh } = await import('anicodec/babylon'), { Anicodec } = await import('anicodec');
        const B = globalThis.BABYLON, canvas = document.getElementById('canvas'), outcomes = [];
        for (const right of [false, true]) {
          const engine = new B.Engine(canvas, false, { preserveDrawingBuffer: true }), scene = new B.Scene(engine), clip = await Anicodec.open('/tests/conformance/heated.anic');
          scene.useRightHandedSystem = right;
          scene.clearColor = new B.Color4(0, 0, 0, 1);
          new B.HemisphericLight('sky', new B.Vector3(0, 1, 0), scene).groundColor = B.Color3.White();
          const [mesh] = clip.meshes, cpu = new AnicMesh(clip, scene), { min, max } = clip.bounds, { duration, info: { diagonal } } = clip;
          const centre = B.Vector3.TransformCoordinates(B.Vector3.Center(B.Vector3.FromArray(min), B.Vector3.FromArray(max)), cpu.computeWorldMatrix(true));
          const camera = new B.FreeCamera('camera', centre.add(new B.Vector3(diagonal / 3, diagonal / 3, -diagonal)), scene);
          camera.setTarget(centre);
          Object.assign(camera, { minZ: diagonal / 100, maxZ: diagonal * 100 });
          const drawn = async () => {
            await scene.whenReadyAsync();
            for (let tries = 0; tries < 200 && (tries < 5 || scene.meshes.some((one) => one.isEnabled() && one.update?.() === false)); ++tries) {
              scene.render();
              await new Promise((done) => { setTimeout(done, 10); });
            }
            const gl = canvas.getContext('webgl2'), pixels = new Uint8Array(4 * 320 * 240);
            scene.render();
            gl.readPixels(0, 0, 320, 240, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
            return pixels;
          };
          const two = new AnicInstances(mesh, 2, scene), outcome = { fields: two.fields, field: two.showField('temperature'), shown: cpu.showField('temperature'), far: [], turned: [], hands: [] };
          // Instance 1 at the origin beside the same frame by the CPU, with the other one out of sight.
          two.thinInstanceSetMatrixAt(0, B.Matrix.Translation(1e3 * diagonal, 0, 0));
          two.times.set([0, 0.5 * duration]);
          cpu.time = two.times[1];
          two.setEnabled(false);
          const a = await drawn();
          two.setEnabled(true);
          cpu.setEnabled(false);
          const b = await drawn();
          two.times[1] = 0;
          const c = await drawn();
          two.showField();
          const plain = await drawn(), count = (p, q) => p.reduce((sum, v, i) => sum + (Math.abs(v - q[i]) > 24), 0);
          Object.assign(outcome, { seen: a.filter((v, i) => i % 4 < 3 && v > 8).length, different: count(a, b), moved: count(b, c), coloured: count(c, plain), back: two.getVerticesData(B.VertexBuffer.ColorKind) !== null });
          // Points of an instance that is turned, moved and larger.
          const place = B.Matrix.Compose(new B.Vector3(2, 2, 2), B.Quaternion.RotationAxis(new B.Vector3(1, 2, 3).normalize(), 1), new B.Vector3(3, 1, 2));
          two.thinInstanceSetMatrixAt(1, place);
          two.times[1] = 0.25 * duration;
          await drawn();
          const face = [...mesh.indices.slice(0, 3)], weights = [0.5, 0.25, 0.25], node = two.anchor({ thinInstanceIndex: 1, vertices: face, weights });
          const corners = () => {
            const p = mesh.positions(two.times[1]), world = place.multiply(two.computeWorldMatrix(true));
            return face.map((v) => B.Vector3.TransformCoordinates(B.Vector3.FromArray(p, 3 * v), world));
          };
          for (const share of [0.25, 0.9]) {
            two.times[1] = share * duration;
            await drawn();
            const [x, y, z] = corners(), world = node.computeWorldMatrix(true), at = x.scale(0.5).add(y.scale(0.25)).add(z.scale(0.25));
            const axis = (v) => B.Vector3.TransformNormal(v, world).normalize(), normal = B.Vector3.Cross(y.subtract(x), z.subtract(x)).normalize().scale(right ? 1 : -1);
            outcome.far.push(B.Vector3.Distance(node.getAbsolutePosition(), at) / diagonal);
            outcome.turned.push(1 - B.Vector3.Dot(axis(B.Vector3.Up()), normal), 1 - B.Vector3.Dot(axis(B.Vector3.Right()), y.subtract(x).normalize()));
            outcome.hands.push(world.determinant() > 0);
          }
          const [x, y, z] = corners(), mean = x.add(y).add(z).scale(1 / 3), out = B.Vector3.Cross(y.subtract(x), z.subtract(x)).normalize().scale(right ? diagonal : -diagonal);
          const hit = two.pick(new B.Ray(mean.add(out), out.scale(-1 / diagonal), 10 * diagonal)), picked = two.anchor(hit);
          picked.computeWorldMatrix(true);
          outcome.far.push(B.Vector3.Distance(picked.getAbsolutePosition(), hit.pickedPoint) / diagonal);
          try {
            two.anchor({ thinInstanceIndex: 2, vertices: face, weights });
          } catch (error) {
            outcome.refused = error.message;
          }
          node.parent = null;
          const before = node.position.clone();
          two.times[1] = 0;
          await drawn();
          outcome.free = before.equals(node.position);
          outcome.error = canvas.getContext('webgl2').getError();
          engine.dispose();
          clip.close();
          outcomes.push(outcome);
        }
        return outcomes;
      });
      assert.deepEqual(messages.filter((text) => !/BJS -|Babylon\.js v|GPU stall/.test(text)), []);
      for (const result of results) {
        assert.ok(result.different <= 0.01 * result.seen + 20 && result.moved > 0.05 * result.seen && result.coloured > 0.2 * result.seen, JSON.stringify(result));
        assert.ok(result.far.length === 3 && result.far.every((far) => far < 1e-3) && result.turned.every((turned) => turned < 1e-3) && result.hands.every(Boolean), JSON.stringify(result));
        assert.deepEqual([result.fields, result.field, result.back, result.free, result.error], [['temperature'], result.shown, true, true, 0], JSON.stringify(result));
        assert.equal(result.refused, 'there is no instance 2 of 2');
      }
    });
  } finally {
    server.close();
  }
});
