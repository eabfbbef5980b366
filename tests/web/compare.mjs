// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node compare.mjs CLIP.anic PACKED.glb [RUNS]: what a clip costs in a page of three.js, in Chromium: bytes over the wire (brotli),
// milliseconds from nothing to the first frame drawn, and bytes held; as .anic, as morph targets that gltfpack packed, and as
// a vertex-animation texture of 16 bits. Each run has a page of its own; medians.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, constants } from 'node:zlib';
import { Anicodec } from '../../bindings/web/index.js';
import { threeImports } from './engines.mjs';
import { withPage } from './serve.mjs';

const [anic, glb, runs = 5] = process.argv.slice(2), root = fileURLToPath(new URL('../../', import.meta.url));
const bytes = new Uint8Array(readFileSync(anic)), clip = await Anicodec.open(bytes), [mesh] = clip.meshes;

// The texture holds a row of vertices for each frame, in the box around all frames.
const { vertexCount } = mesh, { frames } = clip, { min, max } = mesh.bounds, texture = new Uint16Array(4 * vertexCount * frames);
for (let f = 0; f < frames; ++f) {
  mesh.positions(clip.frameTime(f)).forEach((x, i) => {
    texture[4 * (f * vertexCount + Math.floor(i / 3)) + i % 3] = Math.round((x - min[i % 3]) / (max[i % 3] - min[i % 3]) * 65535);
  });
}
const three = '/tests/web/node_modules/three/';
const page = `<!doctype html><link rel=icon href="data:,"><script type=importmap>${JSON.stringify({ imports: threeImports })}</script><body></body>`;
const FILES = { '/page': page, '/clip.anic': bytes, '/clip.glb': readFileSync(glb), '/clip.vat': Buffer.from(texture.buffer), '/faces': Buffer.from(mesh.indices.buffer) };
const TYPES = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.anic': 'application/octet-stream', '': 'text/html' };
const packed = new Map(), pack = (path) => {
  if (!packed.has(path))
    packed.set(path, brotliCompressSync(FILES[path] ?? readFileSync(root + path), { params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24 } }));
  return packed.get(path);
};
const server = createServer((request, response) => {
  const path = new URL(request.url, 'http://x').pathname;
  response.writeHead(200, { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream', 'content-encoding': 'br' }).end(pack(path));
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const url = `http://127.0.0.1:${server.address().port}`;

/** In the page: gets a way, and measures it. three.js itself is there before the clock starts. */
async function show({ way, box, vertices, frames: count }) {
  const THREE = await import('three'), renderer = new THREE.WebGLRenderer(), scene = new THREE.Scene(), modules = {};
  if (way === 'morph') {
    modules.GLTFLoader = (await import('three/addons/loaders/GLTFLoader.js')).GLTFLoader;
    modules.MeshoptDecoder = (await import('three/addons/libs/meshopt_decoder.module.js')).MeshoptDecoder;
  } else if (way === 'anic') {
    modules.three = await import('anicodec/three');
  }
  const [low, high] = [box.min, box.max].map((v) => new THREE.Vector3(...v)), centre = low.clone().add(high).multiplyScalar(0.5), size = low.distanceTo(high);
  const camera = new THREE.PerspectiveCamera(40, 4 / 3, size / 100, size * 10);
  camera.position.copy(centre).add(new THREE.Vector3(0, 0, 1.5 * size));
  scene.add(new THREE.HemisphereLight());
  renderer.setSize(320, 240);
  const fetched = async (path) => new Uint8Array(await (await fetch(path)).arrayBuffer()), begin = performance.now();
  let held = 0;
  const attributesOf = ({ attributes, index }) => [...Object.values(attributes), index].reduce((sum, a) => sum + a.array.byteLength, 0);
  if (way === 'anic') {
    const object = await new modules.three.AnicLoader().loadAsync('/clip.anic');
    scene.add(object);
    held = object.clip.memoryBytes + attributesOf(object.parts[0].geometry);
  } else if (way === 'morph') {
    const gltf = await new modules.GLTFLoader().setMeshoptDecoder(modules.MeshoptDecoder).parseAsync((await fetched('/clip.glb')).buffer, '');
    scene.add(gltf.scene);
    gltf.scene.traverse(({ geometry }) => {
      for (const list of Object.values(geometry?.morphAttributes ?? {}))
        held += list.reduce((sum, a) => sum + a.array.byteLength, 0) + list.length * list[0].count * 16;  // and three's texture of them
      held += geometry ? attributesOf(geometry) : 0;
    });
  } else {
    const [data, faces] = [await fetched('/clip.vat'), await fetched('/faces')], geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * vertices), 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(faces.buffer), 1));
    const rows = Math.ceil(vertices * count / 4096), all = new Uint16Array(4 * 4096 * rows);
    all.set(new Uint16Array(data.buffer));
    const texture = Object.assign(new THREE.DataTexture(all, 4096, rows, THREE.RGBAIntegerFormat, THREE.UnsignedShortType), { internalFormat: 'RGBA16UI', needsUpdate: true });
    scene.add(Object.assign(new THREE.Mesh(geometry, new THREE.ShaderMaterial({
      uniforms: { map: { value: texture }, low: { value: low }, size: { value: high.clone().sub(low) } }, side: THREE.DoubleSide,
      vertexShader: 'uniform highp usampler2D map; uniform vec3 low, size; void main() { vec3 p = low + size * vec3(texelFetch(map, ivec2(gl_VertexID % 4096, gl_VertexID / 4096), 0).xyz) / 65535.0; gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.0); }',
      fragmentShader: 'void main() { gl_FragColor = vec4(1.0); }',
    })), { frustumCulled: false }));
    held = 2 * all.byteLength + attributesOf(geometry);  // here and on the card
  }
  renderer.render(scene, camera);
  const pixel = new Uint8Array(4), gl = renderer.getContext();
  gl.readPixels(160, 120, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits for the card
  return { ms: performance.now() - begin, held };
}

const sum = (...paths) => paths.reduce((all, path) => all + pack(path).length, 0);
const ways = {
  anic: ['anicodec', sum('/clip.anic'), sum('/bindings/web/dist/anicodec.wasm')],
  morph: ['morph targets, gltfpack -cc', sum('/clip.glb'), sum(`${three}examples/jsm/libs/meshopt_decoder.module.js`)],
  vat: ['texture of 16 bits', sum('/clip.vat', '/faces'), 0],
};
const results = Object.fromEntries(Object.keys(ways).map((way) => [way, []]));
for (let run = 0; run < Number(runs); ++run) {
  for (const way of Object.keys(ways)) {
    await withPage(async (tab) => {
      await tab.goto(`${url}/page`);
      results[way].push(await tab.evaluate(show, { way, box: { min, max }, vertices: vertexCount, frames }));
    });
  }
}
server.close();
console.log('| way | clip, bytes | decoder, bytes | first frame, ms | held, MB |\n|---|---|---|---|---|');
for (const [way, [name, wire, decoder]] of Object.entries(ways)) {
  const sorted = results[way].map(({ ms }) => ms).sort((a, b) => a - b);
  console.log(`| ${name} | ${wire} | ${decoder} | ${sorted[sorted.length >> 1].toFixed(0)} | ${(results[way][0].held / 1e6).toFixed(1)} |`);
}
