// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Objects of three.js that stay on points of the surfaces of instances, which the graphics card plays.
import { Group, Matrix4, Vector3 } from 'three';

export class InstanceAnchors {
  #instances;
  #mesh;
  #optionsOf;
  #all = [];

  /** `instances` is an object with count, times and getMatrixAt(); `optionsOf` gives options of ClipMesh.positions() by instance. */
  constructor(instances, mesh, optionsOf) {
    this.#instances = instances;
    this.#mesh = mesh;
    this.#optionsOf = optionsOf;
  }

  add({ instanceId = 0, face, barycoord, vertices, weights }, group = new Group()) {
    const instances = this.#instances;
    if (!(instanceId >= 0 && instanceId < instances.count))
      throw new Error(`there is no instance ${instanceId} of ${instances.count}`);
    const point = face ? { vertices: [face.a, face.b, face.c], weights: barycoord.toArray() } : { vertices, weights }, anchor = { group, instanceId, point };
    this.#place(anchor);  // throws for a point that is none
    this.#all = [...this.#all.filter((one) => one.group !== group), anchor];
    if (group.parent !== instances)
      instances.add(group);
    return group;
  }

  /** Places those that are still there at the times of their instances. */
  update() {
    this.#all = this.#all.filter(({ group }) => group.parent === this.#instances);
    for (const anchor of this.#all)
      this.#place(anchor);
  }

  #place({ group, instanceId, point }) {
    const time = this.#instances.times[instanceId], options = this.#optionsOf(instanceId);
    group.visible = this.#mesh.isPresent(time, options);
    if (!group.visible)
      return;
    const { position, normal, tangent } = this.#mesh.surfaceFrame(point, time, options), x = new Vector3(...tangent), y = new Vector3(...normal);
    const frame = new Matrix4().makeBasis(x, y, x.clone().cross(y)).setPosition(...position), matrix = new Matrix4();
    this.#instances.getMatrixAt(instanceId, matrix);
    matrix.multiply(frame).decompose(group.position, group.quaternion, group.scale);
  }
}
