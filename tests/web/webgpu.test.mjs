// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Instances of a clip by WebGPURenderer of three.js, in Chromium by SwiftShader.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { threeImports } from './engines.mjs';
import { files } from './files.mjs';
import { CHROMIUM, serve, withPage } from './serve.mjs';

const PAGE = `<!doctype html><link rel=icon href="data:,"><script type=importmap>${JSON.stringify({ imports: threeImports })}</script><body style="margin:0"></body>`;
let server;
before(async () => { server = await serve({ '/page': PAGE }); });
after(() => server.close());

test('WebGPU plays instances as the CPU does', { skip: CHROMIUM ? false : 'there is no Chromium' }, async (t) => {
  const names = files.filter(({ what }) => what === 'valid').map(({ file }) => file);
  const results = await withPage(async (page, messages) => {
    await page.goto(`${server.url}/page`);
    if (!await page.evaluate(async () => !!await navigator.gpu?.requestAdapter()))
      return undefined;
    const all = await page.evaluate(async (list) => {
      const GPU = await import('three/webgpu'), { Anicodec } = await import('anicodec'), { AnicMesh } = await import('anicodec/three');
      const { AnicInstances } = await import('anicodec/three/webgpu');
      const renderer = new GPU.WebGPURenderer();
      renderer.setSize(320, 240);
      document.body.append(renderer.domElement);
      await renderer.init();
      // Vertices whose areas all but cancel have no normal to speak of: rounding decides it.
      const cancels = ({ vertexCount, indices }, p) => {
        const sums = new Float64Array(4 * vertexCount), at = (v) => [0, 1, 2].map((c) => p[3 * v + c]);
        for (let k = 0; k < indices.length; k += 3) {
          const [a, b, c] = [0, 1, 2].map((i) => new GPU.Vector3(...at(indices[k + i]))), area = b.sub(a).cross(c.sub(a));
          for (let i = 0; i < 3; ++i)
            [...area.toArray(), area.length()].forEach((x, j) => { sums[4 * indices[k + i] + j] += x; });
        }
        return sums.some((whole, j) => j % 4 === 3 && Math.hypot(...sums.subarray(j - 3, j)) <= 1e-3 * whole);
      };
      const target = new GPU.RenderTarget(320, 240), outcome = { webgpu: renderer.backend.isWebGPUBackend, clips: {} };
      for (const name of list) {
        const clip = await Anicodec.open(`/tests/conformance/${name}`, { inexact: true }).catch((error) => {
          if (!error.message.includes('feature 1 '))
            throw error;
        });
        if (!clip || clip.meshes.length > 1 || clip.meshes[0].triangleCount === 0)
          continue;
        const [mesh] = clip.meshes, { duration } = clip, material = new GPU.MeshStandardNodeMaterial({ side: GPU.DoubleSide });
        const many = new AnicInstances(mesh, 5, material), scene = new GPU.Scene(), light = new GPU.DirectionalLight(0xffffff, 3);
        many.times.set([0, 0.37, 0.5, 0.9, 1].map((share) => share * duration));
        many.update(renderer);
        let far = 0, size = 0;
        for (let i = 0; i < 5; ++i) {
          const p = mesh.isPresent(many.times[i]) ? mesh.sourcePositions(many.times[i]) : [], q = await many.read(renderer, i);
          p.forEach((x, k) => { far = Math.max(far, Math.abs(x - q[k])); size = Math.max(size, Math.abs(x)); });
        }
        // The third instance, alone in the picture, beside the same frame by the CPU.
        const cpu = new AnicMesh(clip, material), { center, radius } = many.geometry.boundingSphere, away = new GPU.Matrix4().makeTranslation(0, 100 * radius, 0);
        cpu.rotation.set(0, 0, 0);
        cpu.time = many.times[2];
        [0, 1, 3, 4].forEach((i) => many.setMatrixAt(i, away));
        many.update(renderer);
        light.position.set(1, 2, 3);
        scene.add(light, many, cpu);
        const camera = new GPU.PerspectiveCamera(40, 4 / 3, radius / 10, radius * 10);
        camera.position.copy(center).add(new GPU.Vector3(radius, radius, 3 * radius));
        camera.lookAt(center);
        const shot = async (shown, hidden) => {
          shown.visible = true;
          hidden.visible = false;
          renderer.setRenderTarget(target);
          renderer.render(scene, camera);
          renderer.setRenderTarget(null);
          return renderer.readRenderTargetPixelsAsync(target, 0, 0, 320, 240);
        };
        const a = await shot(cpu, many), b = await shot(many, cpu);
        let lit = 0, different = 0;
        for (let k = 0; k < a.length; k += 4) {
          lit += a[k] > 8;
          different += Math.abs(a[k] - b[k]) > 24;
        }
        many.visible = true;
        const ray = new GPU.Raycaster(camera.position, center.clone().sub(camera.position).normalize());
        const hits = ray.intersectObject(many).length, cpuHits = ray.intersectObject(cpu, true).length;
        outcome.clips[name] = { byCpu: many.madeByCpu, far, size, diagonal: clip.info.diagonal, lit, different, hits, cpuHits, cancelled: cancels(mesh, mesh.positions(many.times[2])) };
        many.dispose();
        cpu.dispose();
      }
      return outcome;
    }, names);
    assert.deepEqual(messages, []);
    return all;
  }, { webgpu: true });
  if (!results) {
    t.skip('this Chromium offers no WebGPU');
    return;
  }
  assert.ok(results.webgpu);
  let byCard = 0;
  for (const [name, one] of Object.entries(results.clips)) {
    const said = `${name}: ${JSON.stringify(one)}`;
    t.diagnostic(said);
    byCard += 5 - one.byCpu;
    assert.ok(one.far <= 1e-4 * one.diagonal + 2e-6 * one.size, said);
    if (!one.cancelled)  // else rounding shades whole triangles
      assert.ok(one.different <= 0.01 * one.lit + 20, said);
    assert.equal(one.hits, one.cpuHits, said);
  }
  assert.ok(byCard >= 5);
});

test('objects stay on instances that WebGPU plays', { skip: CHROMIUM ? false : 'there is no Chromium' }, async (t) => {
  const result = await withPage(async (page, messages) => {
    await page.goto(`${server.url}/page`);
    if (!await page.evaluate(async () => !!await navigator.gpu?.requestAdapter()))
      return undefined;
    const outcome = await page.evaluate(async () => {
      const GPU = await import('three/webgpu'), { Anicodec } = await import('anicodec'), { AnicInstances } = await import('anicodec/three/webgpu');
      const clip = await Anicodec.open('/tests/conformance/limb_small.anic'), [mesh] = clip.meshes, renderer = new GPU.WebGPURenderer();
      await renderer.init();
      const many = new AnicInstances(mesh, 2), point = { vertices: [0, 1, 2], weights: [0.5, 0.25, 0.25] }, pin = many.anchor({ instanceId: 1, ...point });
      const matrix = new GPU.Matrix4().compose(new GPU.Vector3(3, -2, 1), new GPU.Quaternion().setFromEuler(new GPU.Euler(0.3, 1, -0.4)), new GPU.Vector3(2, 2, 2));
      many.setMatrixAt(1, matrix);
      many.times[1] = 0.6 * clip.duration;
      many.update(renderer);
      many.updateMatrixWorld();
      const { position } = mesh.surfaceFrame(point, many.times[1]), at = pin.localToWorld(new GPU.Vector3());
      return { far: new GPU.Vector3(...position).applyMatrix4(matrix).distanceTo(at) / clip.info.diagonal, moved: at.length() > 0, parent: pin.parent === many };
    });
    assert.deepEqual(messages, []);
    return outcome;
  }, { webgpu: true });
  if (!result)
    return t.skip('this Chromium has no WebGPU');
  assert.ok(result.far < 1e-5 && result.moved && result.parent, JSON.stringify(result));
});

test('instances of WebGPU show fields as meshes do', { skip: CHROMIUM ? false : 'there is no Chromium' }, async (t) => {
  const result = await withPage(async (page, messages) => {
    await page.goto(`${server.url}/page`);
    if (!await page.evaluate(async () => !!await navigator.gpu?.requestAdapter()))
      return undefined;
    const outcome = await page.evaluate(async () => {
      const GPU = await import('three/webgpu'), { Anicodec } = await import('anicodec'), { AnicMesh } = await import('anicodec/three'), { AnicInstances } = await import('anicodec/three/webgpu');
      const clip = await Anicodec.open('/tests/conformance/heated.anic'), [mesh] = clip.meshes, renderer = new GPU.WebGPURenderer(), target = new GPU.RenderTarget(320, 240);
      renderer.setSize(320, 240);
      await renderer.init();
      const cpu = new AnicMesh(clip), many = new AnicInstances(mesh, 3), scene = new GPU.Scene(), light = new GPU.DirectionalLight(0xffffff, 3), { center, radius } = many.geometry.boundingSphere;
      const camera = new GPU.PerspectiveCamera(40, 4 / 3, radius / 10, radius * 10), away = new GPU.Matrix4().makeTranslation(0, 100 * radius, 0);
      cpu.rotation.set(0, 0, 0);
      light.position.set(1, 2, 3);
      camera.position.copy(center).add(new GPU.Vector3(radius, radius, 3 * radius));
      camera.lookAt(center);
      scene.add(light, cpu, many);
      [0, 2].forEach((i) => many.setMatrixAt(i, away));
      const picture = async (shown, hidden) => {
        shown.visible = true;
        hidden.visible = false;
        many.update(renderer);
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, 320, 240);
        renderer.setRenderTarget(null);
        return pixels;
      };
      const differing = (p, q) => p.reduce((sum, x, k) => sum + (Math.abs(x - q[k]) > 24), 0), shares = [], plain = await picture(many, cpu);
      for (const share of [0.2, 0.8]) {
        const field = many.showField('temperature', { low: 0, high: 100 });
        many.times.set([0.5, share, 0.1].map((part) => part * clip.duration));
        cpu.showField('temperature', field);
        cpu.time = many.times[1];
        const ours = await picture(many, cpu), theirs = await picture(cpu, many);
        shares.push([differing(ours, theirs), theirs.reduce((sum, x, k) => sum + (k % 4 === 1 && x > 8), 0), differing(ours, plain)]);
      }
      many.showField();
      many.times.fill(0);
      return { shares, fields: many.fields, back: differing(await picture(many, cpu), plain) };
    });
    assert.deepEqual(messages, []);
    return outcome;
  }, { webgpu: true });
  if (!result)
    return t.skip('this Chromium has no WebGPU');
  for (const [different, lit, changed] of result.shares)
    assert.ok(different <= 0.01 * lit + 20 && changed > 0.2 * lit, JSON.stringify(result));
  assert.deepEqual([result.fields, result.back], [['temperature'], 0], JSON.stringify(result));
});
