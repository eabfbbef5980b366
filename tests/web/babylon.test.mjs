// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// anicodec/babylon in Chromium. `npm ci --prefix tests/web/babylon` installs Babylon.js.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { test } from 'node:test';
import { Anicodec } from '../../sdk/web/index.js';
import { bytesOf, movingGlb } from './files.mjs';
import { CHROMIUM, serve, withPage } from './serve.mjs';

const PACKAGES = '/tests/web/babylon/node_modules';
const MODULES = {
  'Animations/animation': 'Animation', 'Animations/animationGroup': 'AnimationGroup', 'Buffers/buffer': 'VertexBuffer', 'Culling/boundingInfo': 'BoundingInfo',
  'Materials/multiMaterial': 'MultiMaterial', 'Materials/standardMaterial': 'StandardMaterial', 'Materials/PBR/pbrMetallicRoughnessMaterial': 'PBRMetallicRoughnessMaterial', 'Maths/math.color': 'Color3', 'Maths/math.vector': 'Vector3', 'Meshes/mesh': 'Mesh',
  'Meshes/subMesh': 'SubMesh', 'Meshes/transformNode': 'TransformNode',
};
// The package for scripts, which is one file, stands in for the one of modules, which are thousands.
const imports = { anicodec: '/sdk/web/index.js', 'anicodec/babylon': '/sdk/web/babylon.js' };
for (const [path, name] of Object.entries(MODULES))
  imports[`@babylonjs/core/${path}.js`] = `data:text/javascript,export const ${name} = BABYLON.${name};`;
const PAGE = `<!doctype html><link rel=icon href="data:,"><script src="${PACKAGES}/babylonjs/babylon.js"></script>
<script src="${PACKAGES}/babylonjs-loaders/babylon.glTF2FileLoader.js"></script><script type=importmap>${JSON.stringify({ imports })}</script><canvas id=canvas width=320 height=240></canvas>`;
const installed = existsSync(new URL('babylon/node_modules/babylonjs', import.meta.url));
const skip = !CHROMIUM ? 'there is no Chromium' : installed ? false : 'there is no Babylon.js: npm ci --prefix tests/web/babylon';

test('Babylon.js shows, plays and fades clips, and plays glTF scenes that move by them', { skip }, async () => {
  const bytes = bytesOf('clips.anic'), server = await serve({ '/page': PAGE, '/moving.glb': movingGlb(bytes, await Anicodec.open(bytes)) });
  try {
    await withPage(async (page, messages) => {
      await page.goto(`${server.url}/page`);
      const result = await page.evaluate(async () => {
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
        player.current = b;
        player.time = 0.5;
        gltf.render();
        const again = await Anicodec.open('/tests/conformance/clips.anic');
        outcome.steps.gltf = far(moving.getVerticesData(B.VertexBuffer.PositionKind), again.meshes[0].sourcePositions(0.5, undefined, { clip: b }));
        outcome.groups = gltf.animationGroups.length;
        outcome.material = moving.material.name;
        return outcome;
      });
      assert.deepEqual(messages.filter((text) => !/BJS -|Babylon\.js v/.test(text)), []);
      assert.ok(Object.values(result.steps).every((distance) => distance < 1e-3), JSON.stringify(result));
      assert.ok(result.lit > 1000 && Math.abs(result.front - result.lit) < 0.02 * result.lit, JSON.stringify(result));
      assert.ok(Math.abs(result.weights[0] - 0.75) < 1e-6 && Math.abs(result.weights[1] - 0.25) < 1e-6, JSON.stringify(result));
      assert.deepEqual([result.current, result.closed, result.stopped, result.groups, result.material], ['clip of 70', true, true, 6, 'paint']);
    });
  } finally {
    server.close();
  }
});
