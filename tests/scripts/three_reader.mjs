// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Shows scenes of glTF to second_reader.py as three.js sees them: three_reader.mjs FOLDER_OF_NODE_MODULES
// For each line of the standard input, {file, animation, times}, it prints a line: for each time a list of triangles, [x, y, z] of three
// corners in the world and whether their order has a meaning (of skins glTF says nothing).
import { readFile } from 'node:fs/promises';
import { createInterface } from 'node:readline';
import { pathToFileURL } from 'node:url';

globalThis.self = globalThis;
const from = (path) => import(pathToFileURL(`${process.argv[2]}/three/${path}`));
const { AnimationMixer, LoopOnce, Vector3 } = await from('build/three.module.js');
const { GLTFLoader } = await from('examples/jsm/loaders/GLTFLoader.js');

function trianglesOf(scene) {
  scene.updateMatrixWorld(true);
  const triangles = [];
  scene.traverse((mesh) => {
    if (!mesh.isMesh)
      return;
    mesh.skeleton?.update();
    const { index, attributes: { position } } = mesh.geometry;
    const points = Array.from({ length: position.count }, (_, i) => mesh.getVertexPosition(i, new Vector3()).applyMatrix4(mesh.matrixWorld).toArray());
    const turned = mesh.matrixWorld.determinant() < 0;
    const count = index ? index.count : position.count;
    for (let i = 0; i + 2 < count; i += 3) {
      const corners = [0, 1, 2].map((k) => points[index ? index.getX(i + k) : i + k]);
      triangles.push([...(turned ? corners.reverse() : corners).flat(), mesh.isSkinnedMesh ? 0 : 1]);
    }
  });
  return triangles;
}

for await (const line of createInterface({ input: process.stdin })) {
  const { file, animation, times } = JSON.parse(line);
  const bytes = await readFile(file);
  const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '');
  const mixer = new AnimationMixer(gltf.scene);
  if (animation !== null) {
    const action = mixer.clipAction(gltf.animations[animation]);
    action.setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
  }
  const frames = times.map((time) => {
    if (animation !== null)
      mixer.setTime(time);
    return trianglesOf(gltf.scene);
  });
  process.stdout.write(`${JSON.stringify(frames)}\n`);
}
