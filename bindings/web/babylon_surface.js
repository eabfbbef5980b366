// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A mesh of a clip as one of Babylon.js: its faces, what does not move, and its materials.
import { VertexBuffer } from '@babylonjs/core/Buffers/buffer.js';
import { BoundingInfo } from '@babylonjs/core/Culling/boundingInfo.js';
import { MultiMaterial } from '@babylonjs/core/Materials/multiMaterial.js';
import { PBRMetallicRoughnessMaterial } from '@babylonjs/core/Materials/PBR/pbrMetallicRoughnessMaterial.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { SubMesh } from '@babylonjs/core/Meshes/subMesh.js';

export const boundingInfo = ({ min, max }) => new BoundingInfo(Vector3.FromArray(min), Vector3.FromArray(max));

/** The material of a group of triangles, with the values that the file has; `metadata.anic` names its images. */
function materialOf({ material: name = 'anic', look }, scene) {
  if (!look)
    return Object.assign(new StandardMaterial(name, scene), { backFaceCulling: false });
  const { baseColour, metallic, roughness, emissive, alpha, alphaCutoff, doubleSided } = look;
  return Object.assign(new PBRMetallicRoughnessMaterial(name, scene), {
    baseColor: Color3.FromArray(baseColour), metallic, roughness, emissiveColor: Color3.FromArray(emissive), alpha: alpha === 'opaque' ? 1 : baseColour[3],
    transparencyMode: ['opaque', 'mask', 'blend'].indexOf(alpha), alphaCutOff: alphaCutoff, backFaceCulling: !doubleSided, doubleSided, metadata: { anic: look },
  });
}

/**
 * Gives an object the faces of a mesh, with positions and normals that are all 0. Without a material it has those of the
 * file; each is passed to `prepare` first. Returns the colours, if they move.
 */
export function giveSurface(object, mesh, scene, { material, prepare = (one) => one, updatable = true } = {}) {
  const n = mesh.vertexCount;
  object.setVerticesData(VertexBuffer.PositionKind, new Float32Array(3 * n), updatable);
  object.setVerticesData(VertexBuffer.NormalKind, new Float32Array(3 * n), updatable);
  const uv = mesh.attribute('uv'), colour = mesh.attributes.find((a) => a.kind === 'colour' && a.components >= 3 && a.domain !== 'polygons');
  if (uv && uv.length === 2 * n)
    object.setVerticesData(VertexBuffer.UVKind, uv);
  if (colour)
    object.setVerticesData(VertexBuffer.ColorKind, mesh.attribute(colour.index), colour.moves, colour.components);
  object.setIndices(mesh.indices, n);
  const made = (material ? [material] : mesh.groups.map((group) => materialOf(group, scene))).map(prepare);
  if (made.length < 2) {
    [object.material] = made;
  } else {
    object.material = Object.assign(new MultiMaterial(object.name, scene), { subMaterials: made });
    object.subMeshes = [];
    mesh.groups.forEach(({ start, count }, i) => new SubMesh(i, 0, n, start, count, object));
  }
  if (mesh.bounds)
    object.setBoundingInfo(boundingInfo(mesh.bounds));
  else
    object.alwaysSelectAsActiveMesh = true;
  return colour?.moves ? colour : undefined;
}

/** Turns a node that shows a clip to the axes of a scene. Clips are right-handed. */
export function turnToScene(node, clip, scene) {
  if (!scene.useRightHandedSystem)
    node.scaling.z = -1;
  if (clip.info.up === 'z')
    node.rotation.x = scene.useRightHandedSystem ? -Math.PI / 2 : Math.PI / 2;
}

/** Places a node on a point of a mesh's surface, in the space of the clip; false, and it is disabled, when the mesh is not there. */
export function placeOnSurface(node, mesh, point, time, options) {
  const present = mesh.isPresent(time, options);
  node.setEnabled(present);
  if (!present)
    return false;
  const { position, normal, tangent } = mesh.surfaceFrame(point, time, options), x = Vector3.FromArray(tangent), y = Vector3.FromArray(normal);
  node.position.copyFromFloats(...position);
  node.rotationQuaternion = Quaternion.RotationQuaternionFromAxis(x, y, Vector3.Cross(x, y));
  // Clips are mirrored in a left-handed scene, but not what is on them.
  node.scaling.z = node.getScene().useRightHandedSystem ? 1 : -1;
  return true;
}
