// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Rays of three.js against instances of a clip that the graphics card plays.
import { BufferAttribute, BufferGeometry, Matrix4, Mesh, Sphere } from 'three';

/** Intersects a ray with the instances of an object, as they are at their times; options of ClipMesh.positions() by instance. */
export function raycastInstances(object, mesh, optionsOf, raycaster, intersects) {
  const shown = new Mesh(new BufferGeometry().setIndex(object.geometry.index), object.material), matrix = new Matrix4(), sphere = new Sphere();
  shown.geometry.boundingSphere = object.geometry.boundingSphere;
  for (let i = 0; i < object.count; ++i) {
    object.getMatrixAt(i, matrix);
    shown.matrixWorld.multiplyMatrices(object.matrixWorld, matrix);
    sphere.copy(object.geometry.boundingSphere).applyMatrix4(shown.matrixWorld);
    if (!raycaster.ray.intersectsSphere(sphere) || !mesh.isPresent(object.times[i], optionsOf(i)))
      continue;
    shown.geometry.setAttribute('position', new BufferAttribute(mesh.positions(object.times[i], undefined, optionsOf(i)), 3));
    const hits = [];
    shown.raycast(raycaster, hits);
    for (const hit of hits)
      intersects.push({ ...hit, instanceId: i, object });
  }
}
