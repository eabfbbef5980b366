// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The part of peers.py that runs in Node, in a folder with the packages: node peers.mjs draco|meshopt|gltf FOLDER. Arrays lie in the folder
// without headers, numbers in FOLDER/task.json; it prints an object.
import { readFileSync, writeFileSync } from 'node:fs';
import draco3d from 'draco3d';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';

const [, , peer, folder] = process.argv;
const task = JSON.parse(readFileSync(`${folder}/task.json`));
const read = (name, Type) => new Type(new Uint8Array(readFileSync(`${folder}/${name}`)).buffer);
const write = (name, array) => writeFileSync(`${folder}/${name}`, new Uint8Array(array.buffer, array.byteOffset, array.byteLength));

function concatenated(parts, Type) {
  const all = new Type(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** The result of a function, and the seconds of processor time it takes. */
function timed(work) {
  const begin = process.cpuUsage();
  const result = work();
  const { user, system } = process.cpuUsage(begin);
  return [result, (user + system) / 1e6];
}

/** Every frame a mesh of its own, speed 0; `decoded` gets the points that come back, which Draco reorders and merges. */
async function draco() {
  const { origin, step, bits, vertices, frames } = task;
  const points = read('points', Float32Array), triangles = read('triangles', Uint32Array);
  const encoderModule = await draco3d.createEncoderModule({}), decoderModule = await draco3d.createDecoderModule({});
  const encoded = (frame) => {
    const builder = new encoderModule.MeshBuilder(), mesh = new encoderModule.Mesh(), encoder = new encoderModule.Encoder();
    const out = new encoderModule.DracoInt8Array();
    builder.AddFacesToMesh(mesh, triangles.length / 3, triangles);
    builder.AddFloatAttributeToMesh(mesh, encoderModule.POSITION, vertices, 3, points.subarray(3 * vertices * frame, 3 * vertices * (frame + 1)));
    encoder.SetSpeedOptions(0, 0);
    encoder.SetEncodingMethod(encoderModule.MESH_EDGEBREAKER_ENCODING);
    encoder.SetAttributeExplicitQuantization(encoderModule.POSITION, bits, 3, origin, step * (2 ** bits - 1));
    const size = encoder.EncodeMeshToDracoBuffer(mesh, out);
    if (size <= 0)
      throw new Error(`Draco does not take frame ${frame}`);
    const bytes = Int8Array.from({ length: size }, (_, i) => out.GetValue(i));
    for (const object of [out, encoder, mesh])
      encoderModule.destroy(object);
    encoderModule.destroy(builder);
    return bytes;
  };
  const decoded = (bytes) => {
    const decoder = new decoderModule.Decoder(), mesh = new decoderModule.Mesh(), buffer = new decoderModule.DecoderBuffer();
    buffer.Init(bytes, bytes.length);
    if (!decoder.DecodeBufferToMesh(buffer, mesh).ok())
      throw new Error('Draco does not read what it has written');
    const size = 12 * mesh.num_points(), place = decoderModule._malloc(size);
    decoder.GetAttributeDataArrayForAllPoints(mesh, decoder.GetAttribute(mesh, 0), decoderModule.DT_FLOAT32, size, place);
    const positions = new Float32Array(decoderModule.HEAPF32.buffer, place, size / 4).slice();
    decoderModule._free(place);
    for (const object of [buffer, mesh, decoder])
      decoderModule.destroy(object);
    return positions;
  };
  const numbers = Array.from({ length: frames }, (_, frame) => frame);
  const [parts, encodeSeconds] = timed(() => numbers.map(encoded));
  const [back, decodeSeconds] = timed(() => parts.map(decoded));
  write('decoded', concatenated(back, Float32Array));
  return {
    bytes: parts.reduce((sum, part) => sum + part.length, 0), counts: back.map((part) => part.length / 3), encodeSeconds, decodeSeconds,
  };
}

/** Differences of integers to the frame before through the vertex codec, triangles through the index codec: four variants. */
async function meshopt() {
  await MeshoptEncoder.ready;
  await MeshoptDecoder.ready;
  const { vertices, frames, largest } = task;
  const grid = read('grid', Uint32Array), triangles = read('triangles', Uint32Array);
  const Value = largest < 65536 ? Uint16Array : Uint32Array, width = largest < 65536 ? 4 : 3;
  const stride = width * Value.BYTES_PER_ELEMENT, sign = 8 * Value.BYTES_PER_ELEMENT - 1, level = 3, version = 1;
  const encoded = (byUse, folded) => {
    const indices = triangles.slice();
    const remap = byUse ? MeshoptEncoder.reorderMesh(indices, true, true)[0] : null;
    const before = new Value(3 * vertices), deltas = new Value(width * vertices);
    const parts = [MeshoptEncoder.encodeIndexBuffer(new Uint8Array(indices.buffer), indices.length, 4)];
    let unused = 0;
    const places = Uint32Array.from({ length: vertices }, (_, v) => v);
    if (remap) {  // vertices without a face go to the end
      const used = remap.reduce((count, place) => count + (place !== 0xffffffff), 0);
      for (let v = 0; v < vertices; ++v)
        places[v] = remap[v] === 0xffffffff || remap[v] === undefined ? used + unused++ : remap[v];
    }
    for (let frame = 0; frame < frames; ++frame) {
      for (let v = 0; v < vertices; ++v) {
        for (let c = 0; c < 3; ++c) {
          const from = 3 * v + c, value = grid[3 * vertices * frame + from];
          deltas[width * places[v] + c] = value - before[from];
          before[from] = value;
        }
      }
      if (folded) {
        for (let i = 0; i < deltas.length; ++i)
          deltas[i] = (deltas[i] << 1) ^ (deltas[i] >> sign ? -1 : 0);
      }
      parts.push(MeshoptEncoder.encodeVertexBufferLevel(new Uint8Array(deltas.buffer), vertices, stride, level, version));
    }
    return { parts, places };
  };
  const decoded = (parts, folded) => {
    const indices = new Uint8Array(4 * triangles.length), deltas = new Value(width * vertices), values = new Value(3 * vertices);
    MeshoptDecoder.decodeIndexBuffer(indices, triangles.length, 4, parts[0]);
    const all = new Uint32Array(3 * vertices * frames);
    for (let frame = 0; frame < frames; ++frame) {
      MeshoptDecoder.decodeVertexBuffer(new Uint8Array(deltas.buffer), vertices, stride, parts[frame + 1]);
      for (let v = 0; v < vertices; ++v) {
        for (let c = 0; c < 3; ++c) {
          const delta = deltas[width * v + c];
          values[3 * v + c] += folded ? (delta >>> 1) ^ -(delta & 1) : delta;
        }
      }
      all.set(values, 3 * vertices * frame);
    }
    return all;
  };
  const variants = [];
  for (const byUse of [false, true]) {
    for (const folded of [false, true]) {
      const [{ parts, places }, encodeSeconds] = timed(() => encoded(byUse, folded));
      const [back, decodeSeconds] = timed(() => decoded(parts, folded));
      for (let i = 0; i < grid.length; i += 3 * vertices) {
        for (let v = 0; v < vertices; ++v) {
          for (let c = 0; c < 3; ++c) {
            if (back[i + 3 * places[v] + c] !== grid[i + 3 * v + c])
              throw new Error('meshoptimizer gives other numbers back');
          }
        }
      }
      const name = `variant${variants.length}`;
      write(name, concatenated(parts, Uint8Array));
      variants.push({ name, encodeSeconds, decodeSeconds });
    }
  }
  return { variants };
}

const COMPONENTS = { SCALAR: 1, VEC3: 3 };
const TYPES = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const LARGEST = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535 };

/** Frames at whole multiples of task.interval of a GLB with one mesh whose morph targets are animated; `decoded` gets them. */
async function gltf() {
  await MeshoptDecoder.ready;
  const file = readFileSync(`${folder}/packed.glb`);
  const jsonSize = file.readUInt32LE(12);
  const document = JSON.parse(file.subarray(20, 20 + jsonSize)), binary = new Uint8Array(file.subarray(28 + jsonSize));
  const viewsRead = new Map();
  const view = (index) => {
    if (!viewsRead.has(index)) {
      const { byteOffset = 0, byteLength, byteStride, extensions = {} } = document.bufferViews[index];
      const packed = extensions.KHR_meshopt_compression ?? extensions.EXT_meshopt_compression;
      let bytes = binary.subarray(byteOffset, byteOffset + byteLength), stride = byteStride;
      if (packed) {
        const { byteOffset: from = 0, byteLength: size, count, mode, filter } = packed;
        bytes = new Uint8Array(count * packed.byteStride);
        stride = byteStride ?? (mode === 'ATTRIBUTES' ? packed.byteStride : undefined);
        MeshoptDecoder.decodeGltfBuffer(bytes, count, packed.byteStride, binary.subarray(from, from + size), mode, filter);
      }
      viewsRead.set(index, { bytes, stride });
    }
    return viewsRead.get(index);
  };
  const accessor = (index) => {
    const { bufferView, byteOffset = 0, componentType, count, type, normalized, sparse } = document.accessors[index];
    const width = COMPONENTS[type], out = new Float32Array(count * width), Type = TYPES[componentType], size = Type.BYTES_PER_ELEMENT;
    if (sparse)
      throw new Error('a sparse accessor');
    if (bufferView === undefined)
      return out;
    const { bytes, stride = width * size } = view(bufferView);
    const values = new Type(bytes.buffer, bytes.byteOffset + byteOffset, Math.floor((bytes.length - byteOffset) / size));
    for (let i = 0; i < count; ++i) {
      for (let c = 0; c < width; ++c) {
        const value = values[i * stride / size + c];
        out[i * width + c] = normalized ? Math.max(value / LARGEST[componentType], -1) : value;
      }
    }
    return out;
  };
  const decoded = () => {
    const mesh = document.nodes.find((node) => node.mesh !== undefined);
    const placed = document.nodes.filter((node) => node.scale || node.translation || node.rotation || node.matrix);
    const { primitives } = document.meshes[mesh.mesh];
    if (document.meshes.length !== 1 || primitives.length !== 1 || placed.some((node) => node.rotation || node.matrix) || placed.length > 1)
      throw new Error('another scene than one mesh');
    const { scale = [1, 1, 1], translation = [0, 0, 0] } = placed[0] ?? {};
    const base = accessor(primitives[0].attributes.POSITION), targets = primitives[0].targets.map((target) => accessor(target.POSITION));
    accessor(primitives[0].indices);
    const [{ input, output }] = document.animations[0].samplers;
    const times = accessor(input), weights = accessor(output);
    const all = new Float32Array(base.length * task.frames);
    for (let frame = 0; frame < task.frames; ++frame) {
      const time = frame * task.interval;
      let key = 0;
      while (key + 2 < times.length && times[key + 1] <= time)
        ++key;
      const share = times.length > 1 ? Math.min(Math.max((time - times[key]) / (times[key + 1] - times[key]), 0), 1) : 0;
      const out = Float64Array.from(base);
      for (let t = 0; t < targets.length; ++t) {
        const at = weights[key * targets.length + t], next = weights[Math.min(key + 1, times.length - 1) * targets.length + t];
        const weight = at + share * (next - at);
        if (Math.abs(weight) > 1e-4) {
          for (let i = 0; i < out.length; ++i)
            out[i] += weight * targets[t][i];
        }
      }
      for (let i = 0; i < out.length; ++i)
        all[frame * out.length + i] = out[i] * scale[i % 3] + translation[i % 3];
    }
    return all;
  };
  const [all, decodeSeconds] = timed(decoded);
  write('decoded', all);
  return { vertices: all.length / 3 / task.frames, decodeSeconds };
}

console.log(JSON.stringify(await { draco, meshopt, gltf }[peer]()));
