// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The package in Node: conformance files, damage, streams, limits. node --test decoder.test.mjs
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { brotliCompressSync } from 'node:zlib';
import { Anicodec, AnicError, provideModule, readBounds, readMetadata } from '../../bindings/web/index.js';
import { bytesOf, clipWithLooks, factsOf, files } from './files.mjs';

const dist = new URL('../../bindings/web/dist/', import.meta.url);
const moduleOf = (name) => WebAssembly.compile(readFileSync(new URL(name, dist)));
const KINDS = { small: 'anicodec.wasm', full: 'anicodec-full.wasm', scalar: 'anicodec-scalar.wasm' };
/** Files whose key-frames Draco coded: the package has no Draco. */
const isDraco = (error) => error instanceof AnicError && error.status === 'ANIC_E_FEATURE' && error.message.includes('feature 1 ');

async function expectFacts(file) {
  const facts = factsOf(file), clip = await Anicodec.open(bytesOf(file));
  assert.equal(clip.meshes.length, facts.meshes.length);
  clip.verify();
  assert.deepEqual(clip.clips.map(({ frames, loop }) => [frames, loop]), facts.clip.clips.map(({ frames, loop }) => [frames, loop]));
  const clipOf = (frame) => clip.clips.findLast(({ firstFrame }) => firstFrame <= frame).index;
  facts.meshes.forEach((expected, m) => {
    const mesh = clip.meshes[m], [vertices, frames, polygons] = expected.counts;
    assert.deepEqual([mesh.sourceVertexCount, clip.frames, mesh.polygonCount], [vertices, frames, polygons]);
    for (const [frame, vertex, ...point] of expected.points) {
      const time = clip.frameTime(frame), options = { sampling: 'step', clip: clipOf(frame) };
      if (point[0] === null) {
        assert.ok(!mesh.isPresent(time, options));
        continue;
      }
      const seen = mesh.sourcePositions(time, undefined, options);
      for (let c = 0; c < 3; ++c)
        assert.ok(Math.abs(seen[3 * vertex + c] - point[c]) <= Math.max(expected.tolerance, 1e-6 * Math.abs(point[c])),
          `${file}, mesh ${m}, frame ${frame}, vertex ${vertex}: ${seen[3 * vertex + c]}, not ${point[c]}`);
    }
  });
  clip.close();
}

/** Bytes in pieces, as they come over a network. */
const inPieces = (bytes, size) => new ReadableStream({
  start(controller) {
    for (let at = 0; at < bytes.length; at += size)
      controller.enqueue(bytes.slice(at, at + size));
    controller.close();
  },
});

async function clipsOf(stream, each, onLoss = (loss) => assert.fail(JSON.stringify(loss))) {
  const starts = [];
  for await (const clip of Anicodec.live(stream, { onLoss })) {
    starts.push(clip.info.startTime);
    each?.(clip);
    clip.close();
  }
  return starts;
}

/** The files of a live stream have, one after the other, what the facts say of one clip. */
async function expectStream(file) {
  const facts = factsOf(file), [mesh] = facts.meshes, bytes = bytesOf(file), rate = facts.clip.clips[0].rate[0] / facts.clip.clips[0].rate[1];
  for (const size of [100, bytes.length]) {
    let frames = 0, points = 0;
    const starts = await clipsOf(inPieces(bytes, size), (clip) => {
      clip.verify();
      for (const [frame, vertex, ...point] of mesh.points.filter(([f]) => f >= frames && f < frames + clip.frames)) {
        const seen = clip.meshes[0].sourcePositions(clip.frameTime(frame - frames), undefined, { sampling: 'step' });
        point.forEach((value, c) => assert.ok(Math.abs(seen[3 * vertex + c] - value) <= mesh.tolerance));
        ++points;
      }
      frames += clip.frames;
    });
    assert.deepEqual([frames, points], [mesh.counts[1], mesh.points.length]);
    assert.ok(starts[0] === 0 && Math.abs(starts[1] * rate % 1) < 1e-6);
    starts.forEach((start, i) => assert.ok(start === 0 || Math.abs(start - starts[i - 1] - starts[1]) < 1e-6));  // 0: a file that begins anew
  }
  await assert.rejects(clipsOf(bytes.slice(0, -3)), ({ status }) => status === 'ANIC_E_TRUNCATED');
  await assert.rejects(clipsOf(Uint8Array.of(...bytes, 0)), ({ status }) => status === 'ANIC_E_TRAILING_BYTES');
  await assert.rejects(Anicodec.open(bytes), ({ status }) => status === 'ANIC_E_TRAILING_BYTES');
}

/** The files that a stream is made of. */
function filesOf(stream) {
  const all = [];
  for (let at = 0; at < stream.length; at += all.at(-1).length)
    all.push(stream.subarray(at, at + Number(new DataView(stream.buffer, stream.byteOffset + at + 24).getBigUint64(0, true))));
  return all;
}

test('a lost file of a live stream is named, and the next that begins anew is played', async () => {
  provideModule('small', await moduleOf(KINDS.small));
  const all = filesOf(bytesOf('streams/goes_on.anic')), clips = [], losses = [];
  const starts = await clipsOf(Uint8Array.from(all.flatMap((file) => [...file])), (clip) => clips.push([clip.frames, clip.info.rate]));
  const ends = starts.map((start, i) => start + clips[i][0] / clips[i][1]);
  const play = async (numbers) => {
    losses.length = 0;
    return clipsOf(Uint8Array.from(numbers.flatMap((i) => [...all[i]])), undefined, (loss) => losses.push(loss));
  };
  const keys = [];  // those that play behind the first file alone
  for (let i = 1; i < all.length; ++i) {
    const played = await play([0, i]);
    if (played.length === 2)
      keys.push(i);
    const continues = i > 1 && played.length === 1;
    assert.deepEqual(losses, i === 1 ? [] : [{ from: ends[0], to: continues ? undefined : starts[i], files: continues ? 1 : 0 }]);
  }
  const key = keys.find((i) => i > 2);
  assert.ok(key, 'a file that begins anew behind two that do not');
  const numbers = all.map((_, i) => i).filter((i) => i !== 1);
  assert.deepEqual(await play(numbers), [starts[0], ...starts.slice(key)]);
  assert.deepEqual(losses, [{ from: ends[0], to: starts[key], files: key - 2 }]);
});

for (const [small, full] of [['small', 'full'], ['scalar', 'scalar']]) {
  test(`conformance files, module ${small}`, async (t) => {
    provideModule('small', await moduleOf(KINDS[small]));
    provideModule('full', await moduleOf(KINDS[full]));
    let opened = 0;
    for (const { what, file, status } of files) {
      await t.test(file, async (own) => {
        if (what === 'valid') {
          await expectFacts(file).then(() => ++opened, (error) => {
            if (!isDraco(error))
              throw error;
            own.skip('coded by Draco');
          });
        } else if (what === 'stream') {
          await expectStream(file);
        } else if (what === 'invalid_stream' && status === 'ANIC_E_SEGMENT_MISSING') {
          const losses = [];
          await clipsOf(bytesOf(file), (clip) => clip.verify(), (loss) => losses.push(loss));
          assert.ok(losses[0].files > 0);
        } else if (what === 'invalid_stream') {
          await assert.rejects(clipsOf(bytesOf(file), (clip) => clip.verify()), (error) => error instanceof AnicError && error.status === status);
        } else {
          const bytes = bytesOf(file);
          await assert.rejects(Anicodec.open(bytes).then((clip) => clip.verify()).then(() => readMetadata(bytes)).then(() => readBounds(bytes)),
            (error) => error instanceof AnicError && (error.status === status || isDraco(error)) && error.message.length > 5);
        }
      });
    }
    assert.ok(opened > 5);
  });
}

const CLIP = 'limb_small.anic';
const PLAIN = files.filter(({ what, file }) => what === 'valid' && /soup|interpolated|painted/.test(file)).map(({ file }) => file);

/** The first of the files that this package opens. */
async function openable() {
  for (const file of [CLIP, ...PLAIN]) {
    try {
      (await Anicodec.open(bytesOf(file))).close();
      return file;
    } catch (error) {
      if (!isDraco(error))
        throw error;
    }
  }
  throw new Error('no file can be opened');
}

test('flipped bits end in an AnicError, or play', async () => {
  const good = bytesOf(await openable());
  let refused = 0;
  for (let i = 0; i < 60; ++i) {
    const bytes = good.slice();
    bytes[(i * 7919) % bytes.length] ^= 1 << (i % 8);
    try {
      const clip = await Anicodec.open(bytes);
      clip.positions(0);
      clip.close();
    } catch (error) {
      assert.ok(error instanceof AnicError, String(error));
      assert.match(error.status, /^ANIC_E_/);
      ++refused;
    }
  }
  assert.ok(refused > 40);
});

test('positions, normals and values of render vertices', async () => {
  const clip = await Anicodec.open(bytesOf('heated.anic'));
  const [mesh] = clip.meshes, p = mesh.positions(0.1), source = mesh.sourcePositions(0.1);
  assert.equal(p.length, 3 * mesh.vertexCount);
  mesh.sourceVertices.forEach((v, r) => assert.deepEqual([...p.subarray(3 * r, 3 * r + 3)], [...source.subarray(3 * v, 3 * v + 3)]));
  assert.ok(mesh.vertexCount >= mesh.sourceVertexCount);
  const n = mesh.normals(0.1);
  for (let i = 0; i < n.length; i += 3)
    assert.ok(Math.abs(Math.hypot(n[i], n[i + 1], n[i + 2]) - 1) < 1e-5);
  assert.equal(mesh.groups.reduce((sum, g) => sum + g.count, 0), mesh.indices.length);
  assert.equal(mesh.attribute('uv').length, 2 * mesh.vertexCount);
  const out = new Float32Array(p.length);
  assert.equal(mesh.positions(0.1, out), out);
  assert.deepEqual(out, p);
  assert.throws(() => mesh.positions(0.1, new Float32Array(3)), { status: 'ANIC_E_BUFFER_SIZE' });
  assert.throws(() => mesh.positions(0.1, undefined, { wrap: 'round' }), /clamp, loop, ping-pong/);
  assert.throws(() => clip.positions(NaN), { status: 'ANIC_E_ARGUMENT' });
  clip.close();
  clip.close();
  assert.throws(() => clip.positions(0), { status: 'ANIC_E_STATE' });
});

test('clips of a file by name, faded into each other, and opened alone', async () => {
  const bytes = bytesOf('clips.anic'), clip = await Anicodec.open(bytes), [mesh] = clip.meshes;
  const names = clip.clips.map(({ name }) => name), [a, b] = ['clip of 70', 'clip of 29'], wrap = 'clamp';
  assert.ok(names.includes(a) && names.includes(b));
  assert.equal(clip.find(b), clip.clips[names.indexOf(b)]);
  assert.throws(() => clip.find('run'), { status: 'ANIC_E_ABSENT', message: /no clip run, but .*clip of 70/ });
  const p = mesh.sourcePositions(0.1, undefined, { clip: a, wrap }), q = mesh.sourcePositions(0.5, undefined, { clip: b, wrap });
  assert.notDeepEqual(p, q);
  assert.deepEqual(mesh.sourcePositions(0.5, undefined, { clip: names.indexOf(b), wrap }), q);
  const blend = { clip: b, time: 0.5, wrap };
  const faded = (weight) => mesh.sourcePositions(0.1, undefined, { clip: a, wrap, blend: { ...blend, weight } });
  assert.deepEqual(faded(0), p);
  assert.deepEqual(faded(1), q);
  const half = faded(0.5), far = p.reduce((most, v, i) => Math.max(most, Math.abs(half[i] - (v + q[i]) / 2)), 0);
  assert.ok(far <= 1e-3 * clip.info.diagonal, String(far));  // rigid parts turn, which is no straight line
  assert.throws(() => mesh.positions(0, undefined, { blend: { clip: a, time: 0, weight: 2 } }), { status: 'ANIC_E_ARGUMENT' });
  const alone = await Anicodec.open(bytes, { clips: [b] });
  assert.deepEqual(alone.clips.filter(({ isOpen }) => isOpen).map(({ name }) => name), [b]);
  assert.equal(alone.duration, alone.find(b).duration);
  assert.deepEqual(alone.meshes[0].sourcePositions(0.5, undefined, { wrap }), q);
  assert.throws(() => alone.positions(0, undefined, { clip: a }), { status: 'ANIC_E_ABSENT', message: /not opened/ });
  await assert.rejects(Anicodec.open(bytes, { clips: ['run'] }), { status: 'ANIC_E_ABSENT' });
});

test('a file that arrives in pieces plays before its end, and then exactly', async () => {
  const file = await openable(), bytes = bytesOf(file);
  let given = 0, refined = 0;
  const source = new ReadableStream({
    pull(controller) {
      controller.enqueue(bytes.slice(given, given += 257));
      if (given >= bytes.length)
        controller.close();
    },
  });
  const clip = await Anicodec.open(source, { progressive: true, onRefine: () => ++refined });
  const early = clip.info.partial;
  clip.positions(0);
  await clip.finished;
  assert.equal(refined, early ? 1 : 0);
  assert.equal(clip.info.partial, false);
  const whole = await Anicodec.open(bytes);
  assert.deepEqual(clip.positions(0.05), whole.positions(0.05));
});

test('limits, aborting and progress', async () => {
  const bytes = bytesOf(await openable());
  await assert.rejects(Anicodec.open(bytes, { maxBytes: 2000 }), { status: 'ANIC_E_LIMIT' });
  const controller = new AbortController();
  await assert.rejects(Anicodec.open(bytes, { signal: controller.signal, onProgress: () => controller.abort() }), { name: 'AbortError' });
  const shares = [];
  await Anicodec.open(bytes, { onProgress: ({ stage, done }) => stage === 'decode' && shares.push(done) });
  assert.ok(shares.length > 0 && shares.every((s, i) => s >= (shares[i - 1] ?? 0) && s <= 1));
  await assert.rejects(Anicodec.open(42), TypeError);
  await assert.rejects(Anicodec.open(new URL('absent.anic', import.meta.url)), /absent/);
});

test('events, and the motion of the whole in and out of positions', async () => {
  const bytes = bytesOf('walk.anic'), clip = await Anicodec.open(bytes), still = await Anicodec.open(bytes, { inPlace: true });
  assert.deepEqual(clip.find('turn').events.map(({ name }) => name), ['left', 'right', '']);
  assert.deepEqual(clip.find('stand').events, []);
  const { turn, matrix } = clip.rootMotion(0.4, { clip: 'turn' });
  assert.ok(Math.abs(turn - 1.2) < 0.3, String(turn));
  const p = clip.meshes[0].sourcePositions(0.4, undefined, { clip: 'turn' }), q = still.meshes[0].sourcePositions(0.4, undefined, { clip: 'turn' });
  assert.notDeepEqual(p, q);
  for (let i = 0; i < p.length; i += 3) {
    for (let c = 0; c < 3; ++c) {
      const x = matrix[4 * c] * q[i] + matrix[4 * c + 1] * q[i + 1] + matrix[4 * c + 2] * q[i + 2] + matrix[4 * c + 3];
      assert.ok(Math.abs(x - p[i + c]) < 1e-4);
    }
  }
});

test('points of the surface, and rays', async () => {
  const clip = await Anicodec.open(bytesOf('walk.anic'), { bounds: true }), [mesh] = clip.meshes, options = { clip: 'turn', wrap: 'loop' }, time = 0.27;
  const positions = mesh.positions(time, undefined, options), vertices = mesh.indices.subarray(9, 12), weights = [0.25, 0.25, 0.5];
  const at = (vertex, c) => positions[3 * vertex + c];
  const { position, normal, tangent } = mesh.surfaceFrame({ vertices, weights }, time, options);
  const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0), along = (from, to) => [0, 1, 2].map((c) => at(vertices[to], c) - at(vertices[from], c));
  for (let c = 0; c < 3; ++c)
    assert.ok(Math.abs(position[c] - weights.reduce((sum, w, i) => sum + w * at(vertices[i], c), 0)) < 1e-5);
  assert.ok(Math.abs(dot(normal, normal) - 1) < 1e-5 && Math.abs(dot(normal, along(0, 1))) < 1e-5 && Math.abs(dot(normal, along(0, 2))) < 1e-5);
  assert.ok(Math.abs(dot(tangent, along(0, 1)) - Math.hypot(...along(0, 1))) < 1e-5);
  const ray = { origin: position.map((x, c) => x + 1e-3 * normal[c]), direction: normal.map((x) => -x) }, hit = mesh.intersectRay(ray, time, options);
  assert.deepEqual([hit.triangle, hit.vertices, hit.side], [3, [...vertices], 'front']);
  assert.ok(Math.abs(hit.distance - 1e-3) < 1e-5 && hit.weights.every((w, i) => Math.abs(w - weights[i]) < 1e-2), JSON.stringify(hit));
  assert.equal(mesh.intersectRay({ ...ray, farthest: 1e-4 }, time, options), undefined);
  assert.equal(mesh.intersectRay({ ...ray, direction: normal, side: 'front' }, time, options), undefined);
  const refused = (error) => error.status === 'ANIC_E_ARGUMENT';
  assert.throws(() => mesh.surfaceFrame({ vertices: [0, 1, mesh.vertexCount], weights }, time, options), refused);
  assert.throws(() => mesh.intersectRay({ ...ray, direction: [0, 0, 0] }, time, options), refused);
  assert.throws(() => mesh.intersectRay({ ...ray, side: 'left' }, time, options), refused);
});

const looks = clipWithLooks();
test('looks of materials', { skip: looks ? false : 'ANICODEC_COMMAND names no command' }, async () => {
  const clip = await Anicodec.open(looks), [mesh] = clip.meshes, material = mesh.attributes.find(({ kind }) => kind === 'material');
  assert.deepEqual(material.labels, ['wood', 'metal']);
  const [wood] = material.looks;
  const { baseColour, emissive, metallic, roughness, alpha, baseColourImage, normalImage } = wood;
  assert.deepEqual([baseColour.at(-1), metallic, roughness, alpha, baseColourImage, normalImage], [0.75, 0.25, 0.875, 'blend', undefined, 'wood_normal.png']);
  assert.ok(emissive[0] === 0 && emissive[1] > 0 && baseColour[0] > 2 * baseColour[2], JSON.stringify(wood));
  assert.equal(mesh.groups.find((group) => group.material === 'wood').look, wood);
});

test('a character goes on through the turns of a loop', async () => {
  const clip = await Anicodec.open(bytesOf('walk.anic'), { inPlace: true }), options = { clip: 'turn', wrap: 'loop' }, { loopDuration } = clip.find('turn');
  const whole = clip.rootStep(0, 2.5 * loopDuration, options);
  let turn = 0;
  const at = [0, 0, 0];
  for (let i = 0; i < 25; ++i) {
    const step = clip.rootStep(0.1 * i * loopDuration, 0.1 * (i + 1) * loopDuration, options);
    assert.deepEqual(step.pivot, [0, 0, 0]);
    const [a, b] = clip.info.up === 'z' ? [0, 1] : [2, 0], c = Math.cos(turn), s = Math.sin(turn);
    at[a] += c * step.move[a] - s * step.move[b];
    at[b] += s * step.move[a] + c * step.move[b];
    turn += step.turn;
  }
  assert.ok(Math.abs(turn - whole.turn) < 1e-6 && at.every((x, i) => Math.abs(x - whole.move[i]) < 1e-5), JSON.stringify([turn, at, whole]));
  assert.ok(Math.abs(whole.turn) > Math.abs(clip.rootStep(0, loopDuration, options).turn));
});

test('modules import what decoder.js gives, and are small', async () => {
  const allowed = ['env.emscripten_notify_memory_growth', 'env.web_progress', 'wasi_snapshot_preview1.proc_exit'];
  // Bytes of brotli; raised only for a reason that CHANGELOG.md gives.
  const limits = { small: 103000, full: 119000, scalar: 119000 };
  for (const [kind, name] of Object.entries(KINDS)) {
    const module = await moduleOf(name);
    for (const { module: from, name: what } of WebAssembly.Module.imports(module))
      assert.ok(allowed.includes(`${from}.${what}`), `${name} imports ${from}.${what}`);
    const size = brotliCompressSync(readFileSync(new URL(name, dist))).length;
    console.log(`${name}: ${size} bytes of brotli`);
    assert.ok(size < limits[kind], `${name} has ${size} bytes of brotli`);
  }
});
