// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Textures of `export-vat`, played by the shaders of bindings/shaders in Chromium, against the decoder.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Anicodec } from '../../bindings/web/index.js';
import { CHROMIUM, launch, serve, withPage } from './serve.mjs';
import { check, checkByDxc, godot, has, three, translated, unity, unreal } from './vat_shaders.mjs';

const command = process.env.ANICODEC_COMMAND;
const skip = !command ? 'there is no command (ANICODEC_COMMAND)' : false;
const skipDrawing = skip || (CHROMIUM ? false : 'there is no Chromium');
const skipCompiling = has('glslangValidator') ? false : 'there is no glslang (Debian: glslang-tools)';
const IMPORTS = JSON.stringify({ imports: {
  three: '/tests/web/node_modules/three/build/three.module.js', 'three/addons/': '/tests/web/node_modules/three/examples/jsm/',
} });
const PAGE = `<!doctype html><link rel=icon href="data:,"><script type=importmap>${IMPORTS}</script><body style="margin:0"></body>`;
const folder = mkdtempSync(join(tmpdir(), 'anicodec-'));
// A loop of 72 frames: its end, and a third turn, too.
const RATE = 24, TIMES = [0, 7, 9.25, 23.6, 71.7, 151.5].map((frame) => frame / RATE);
let server, browser, clip, error, description;

/** Positions of the decoder; a loop goes from the last frame to the first. */
const wanted = (time) => Array.from(clip.meshes[0].sourcePositions(time));

before(async () => {
  if (skipDrawing)
    return;
  const run = (...options) => execFileSync(command, options, { encoding: 'utf8', cwd: folder });
  run('corpus', 'limb', '-o', 'limb.pc2');
  run('encode', '-q', 'limb.obj', 'limb.pc2', '-o', 'limb.anic', '--fps', String(RATE), '--kg', '0.1', '--loop');
  error = JSON.parse(run('export-vat', 'limb.anic', '-o', 'out', '--json', '--rmse', '0.05%', '--normal-error', '3'));
  clip = await Anicodec.open(new Uint8Array(readFileSync(join(folder, 'limb.anic'))));
  const files = Object.fromEntries(error.files.map(({ file }) => [`/vat/${file}`, readFileSync(join(folder, 'out', file))]));
  description = JSON.parse(readFileSync(join(folder, 'out', 'limb_basis.json'), 'utf8'));
  browser = await launch();
  server = await serve({ ...files, '/page': PAGE });
});
after(async () => {
  rmSync(folder, { recursive: true });
  server?.close();
  clip?.close();
  await browser?.close();
});

async function inPage(body, argument) {
  return withPage(async (page, messages) => {
    await page.goto(`${server.url}/page`);
    const result = await page.evaluate(body, argument);
    assert.deepEqual(messages, []);
    return result;
  }, { browser });
}

test('shaders compile', { skip: skipCompiling }, (t) => {
  for (const glsl of [godot(), three()])
    check(glsl, folder);
  for (const hlsl of [unity(), unreal()])
    translated(hlsl, folder);
  if (!has('dxc'))
    return t.diagnostic('there is no dxc (tests/scripts/dxc.py): HLSL is compiled by glslang alone');
  for (const hlsl of [unity(), unreal({ hoisted: false })])
    checkByDxc(hlsl, folder);
});

/** Runs vertex shaders in the page; gives for each time, by its uniforms, positions and normals of all vertices of the GLB. */
async function runShaders({ shaders, description: json }) {
  const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js'), { EXRLoader } = await import('three/addons/loaders/EXRLoader.js');
  const { FloatType } = await import('three');
  const exr = (name) => new EXRLoader().setDataType(FloatType).loadAsync(`/vat/${name}`);
  const [gltf, basis, weights] = await Promise.all([new GLTFLoader().loadAsync(`/vat/${json.mesh}`), exr(json.basis), exr(json.weights)]);
  const { geometry } = gltf.scene.getObjectByProperty('isMesh', true);
  const gl = document.createElement('canvas').getContext('webgl2');
  const count = geometry.attributes.position.count;
  const upload = ({ image: { data, width, height } }, unit, fromTop) => {
    const rows = new Float32Array(data.length), row = 4 * width;
    for (let y = 0; y < height; ++y)
      rows.set(data.subarray(row * y, row * (y + 1)), row * (fromTop ? height - 1 - y : y));
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, rows);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
  };
  const results = {};
  for (const { name, code, outputs, textures, uniforms, fromTop, place } of shaders) {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, code], [gl.FRAGMENT_SHADER, '#version 300 es\nprecision highp float;\nout vec4 c;\nvoid main() { c = vec4(1.0); }']]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
        throw new Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
      gl.attachShader(program, shader);
    }
    gl.transformFeedbackVaryings(program, outputs, gl.SEPARATE_ATTRIBS);
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
      throw new Error(`${name}: ${gl.getProgramInfoLog(program)}`);
    gl.useProgram(program);
    upload(basis, 0, fromTop);
    upload(weights, 1, fromTop);
    const at = (uniform) => gl.getUniformLocation(program, uniform);
    textures.forEach((texture, i) => gl.uniform1i(at(texture), i));
    // As the importers of the engine give them.
    const { position, normal, uv1 } = geometry.attributes, [x, n, uv] = [position, normal, uv1].map(({ array }) => Float32Array.from(array));
    if (place === 'mirrored') {
      for (let v = 0; v < count; ++v) {
        x[3 * v] *= -1;
        n[3 * v] *= -1;
        uv[2 * v + 1] = 1 - uv[2 * v + 1];
      }
    } else if (place === 'unreal') {
      for (let v = 0; v < count; ++v) {
        const own = x.slice(3 * v, 3 * v + 3);
        x.set([100 * own[0], 100 * own[2], 100 * own[1]], 3 * v);
      }
    }
    [[x, 3], [n, 3], [uv, 2]].forEach(([data, size], i) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, size, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
    const buffers = outputs.map((_, i) => {
      const buffer = gl.createBuffer();
      gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, i, buffer);
      gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 12 * count, gl.STREAM_READ);
      return buffer;
    });
    results[name] = uniforms.map((values) => {
      for (const [uniform, kind, value] of values)
        gl[kind](at(uniform), value);
      gl.enable(gl.RASTERIZER_DISCARD);
      gl.beginTransformFeedback(gl.POINTS);
      gl.drawArrays(gl.POINTS, 0, count);
      gl.endTransformFeedback();
      gl.disable(gl.RASTERIZER_DISCARD);
      const [shown, direction] = buffers.map((buffer) => {
        const data = new Float32Array(3 * count);
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, buffer);
        gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, data);
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, null);
        return data;
      });
      for (let v = 0; v < count; ++v) {
        for (const [data, scale] of [[shown, 100], [direction, 1]]) {
          if (place === 'mirrored')
            data[3 * v] *= -1;
          else if (place === 'unreal')
            data.set([data[3 * v] / scale, data[3 * v + 2] / scale, data[3 * v + 1] / scale], 3 * v);
        }
      }
      return { positions: [...shown], normals: [...direction] };
    });
  }
  return results;
}

/** Shaders as runShaders() takes them. */
function shadersAt(times) {
  const { rows, position_layers: layers, normal_layers: normalLayers, clips: [{ first_frame: first, frame_count: frames, rate, loop }] } = description;
  const decoding = [description.basis_scale, description.basis_bias, description.weight_scale, description.weight_bias];
  const outputs = ['shown', 'shownNormal'];
  const all = [{
    name: 'godot', code: godot(), outputs, textures: ['anic_basis', 'anic_weights'], fromTop: true,
    uniforms: times.map((seconds) => [
      ['rows', 'uniform1i', rows], ['position_layers', 'uniform1i', layers], ['normal_layers', 'uniform1i', normalLayers], ['decoding', 'uniform4fv', decoding],
      ['first_frame', 'uniform1i', first], ['frame_count', 'uniform1i', frames], ['rate', 'uniform1f', rate], ['loop', 'uniform1i', loop ? 1 : 0], ['clip_time', 'uniform1f', seconds],
    ]),
  }, {
    name: 'three', code: three(), outputs, textures: ['anicBasis', 'anicWeights'],
    uniforms: times.map((seconds) => [
      ['anicRows', 'uniform1i', rows], ['anicPositionLayers', 'uniform1i', layers], ['anicNormalLayers', 'uniform1i', normalLayers], ['anicDecoding', 'uniform4fv', decoding],
      ['anicClip', 'uniform4fv', [first, frames, rate, loop ? 1 : 0]], ['anicSeconds', 'uniform1f', seconds],
    ]),
  }];
  for (const [name, hlsl, rest] of has('glslangValidator') && has('spirv-cross') ? [['unity', unity(), { place: 'mirrored' }], ['unreal', unreal(), { place: 'unreal', fromTop: true }]] : []) {
    const code = translated(hlsl, folder), find = (text) => [...code.matchAll(text)].map(([, word]) => word);
    const textures = ['Basis', 'Weights'].map((texture) => find(/uniform highp sampler2D (\w+);/g).find((word) => word.includes(`Combined${texture}`)));
    all.push({
      name, code, textures, outputs: find(/^out vec3 (\w+);/gm), ...rest,
      uniforms: times.map((seconds) => [['Params', 'uniform4fv', [rows, layers, normalLayers, 0, ...decoding, first, frames, rate, loop ? 1 : 0, seconds, 0, 0, 0]]]),
    });
  }
  return all;
}

const distance = (a, b, v) => Math.hypot(...[0, 1, 2].map((c) => a[3 * v + c] - b[3 * v + c]));

test('shaders show what the decoder shows', { skip: skipDrawing }, async (t) => {
  const shaders = shadersAt(TIMES), results = await inPage(runShaders, { shaders, description });
  if (shaders.length < 4)
    t.diagnostic('HLSL is not drawn: it wants glslangValidator and spirv-cross (Debian: glslang-tools spirv-cross)');
  for (const [name, shown] of Object.entries(results)) {
    TIMES.forEach((time, i) => {
      const expected = wanted(time), { positions, normals } = shown[i], count = expected.length / 3;
      assert.equal(positions.length, expected.length);
      const largest = Math.max(...Array.from({ length: count }, (_, v) => distance(positions, expected, v)));
      assert.ok(largest <= error.largest_error * 1.001 + 1e-6, `${name} at ${time}: ${largest} m, and the command says ${error.largest_error}`);
      // All shaders agree on normals, which the command has measured.
      const far = Array.from({ length: count }, (_, v) => distance(normals, results.godot[i].normals, v));
      assert.ok(Math.max(...far) < 1e-4, `${name} at ${time}: normals differ by ${Math.max(...far)}`);
      assert.ok(normals.every(Number.isFinite));
    });
  }
});

/** Draws the clip by AnicBasis, and by positions as they are; gives pictures and the shares of pixels that differ. */
async function draw({ description: json, times, positions }) {
  const THREE = await import('three'), { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js'), { EXRLoader } = await import('three/addons/loaders/EXRLoader.js');
  const { AnicBasis } = await import('/bindings/shaders/anicodec_basis.js');
  const exr = (name) => new EXRLoader().loadAsync(`/vat/${name}`);
  const [gltf, basis, weights] = await Promise.all([new GLTFLoader().loadAsync(`/vat/${json.mesh}`), exr(json.basis), exr(json.weights)]);
  const mesh = gltf.scene.getObjectByProperty('isMesh', true), plain = new THREE.Mesh(mesh.geometry.clone(), mesh.material.clone());
  const played = new AnicBasis(mesh, { basis, weights, description: json });
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(320, 240, false);
  renderer.shadowMap.enabled = true;
  const camera = new THREE.PerspectiveCamera(40, 4 / 3, 0.01, 1000), centre = mesh.geometry.boundingBox.getCenter(new THREE.Vector3());
  camera.position.copy(centre).add(new THREE.Vector3(0.3, 0.4, 1).multiplyScalar(2.2 * mesh.geometry.boundingSphere.radius));
  camera.lookAt(centre);
  const lamp = new THREE.DirectionalLight(0xffffff, 3);
  lamp.position.copy(centre).add(new THREE.Vector3(1, 2, 1.5).multiplyScalar(mesh.geometry.boundingSphere.radius));
  lamp.target.position.copy(centre);
  const pixels = new Uint8Array(4 * 320 * 240);
  const picture = (object) => {
    const scene = new THREE.Scene().add(object, lamp, lamp.target, new THREE.AmbientLight(0xffffff, 0.5));
    renderer.render(scene, camera);
    renderer.getContext().readPixels(0, 0, 320, 240, renderer.getContext().RGBA, renderer.getContext().UNSIGNED_BYTE, pixels);
    return pixels.slice();
  };
  const shares = times.map((time, i) => {
    played.seconds = time;
    const ours = picture(mesh);
    plain.geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions[i], 3));
    plain.geometry.computeVertexNormals();
    const theirs = picture(plain);
    let lit = 0, off = 0;
    for (let p = 0; p < ours.length; p += 4) {
      const a = ours[p] + ours[p + 1] + ours[p + 2], b = theirs[p] + theirs[p + 1] + theirs[p + 2];
      lit += b > 0;
      off += Math.abs(a - b) > 30;
    }
    return { lit: lit / 76800, off: off / lit };
  });
  document.body.append(renderer.domElement);
  return shares;
}

// Without the turn of the loop, whose positions are no surface that has normals.
test('three.js draws what the decoder shows', { skip: skipDrawing }, async () => {
  for (const { lit, off } of await inPage(draw, { description, times: TIMES.slice(0, 4), positions: TIMES.slice(0, 4).map(wanted) })) {
    assert.ok(lit > 0.02, `${lit} of the picture`);
    assert.ok(off < 0.02, `${off} of the pixels differ`);
  }
});
