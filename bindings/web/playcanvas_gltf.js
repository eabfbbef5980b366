// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Scenes of glTF in PlayCanvas whose meshes move by clips: container assets with the extension ANIC_mesh_animation.
import { Asset, Entity, SEMANTIC_COLOR, SEMANTIC_NORMAL, SEMANTIC_TEXCOORD, TYPE_FLOAT32, TYPE_UINT16, TYPE_UINT8 } from 'playcanvas';
import { EXTENSION } from './glb.js';
import { GltfSurface } from './gltf_surface.js';
import { open } from './index.js';
import { Player, boxOf } from './playcanvas_player.js';

const WHOLE = { [TYPE_UINT8]: 255, [TYPE_UINT16]: 65535 };  // what stands for 1

/** PlayCanvas' name of an attribute of a glTF; undefined if it has none for it. */
function semanticOf(attribute) {
  const [kind, number] = attribute.split('_');
  if (kind === 'COLOR')
    return number === '0' ? SEMANTIC_COLOR : undefined;
  return `${SEMANTIC_TEXCOORD}${number}`;
}

/** Moves the meshes of a glTF scene that a clip is for. loadAnicScene() makes it. */
export class AnicScene extends Player {
  static scriptName = 'anicScene';

  #surfaces = new Map();
  #parts = [];

  /** Lets a mesh follow, with all that draw it. */
  move(made, instances, { mesh = 0, firstVertex = 0 }) {
    const moving = this.clip.meshes[mesh];
    if (!moving)
      throw new Error(`${EXTENSION}: the clip has no mesh ${mesh}`);
    if (!this.#surfaces.has(mesh))
      this.#surfaces.set(mesh, new GltfSurface(moving));
    const { format: { elements }, numVertices: count } = made.vertexBuffer, find = (semantic) => elements.find(({ name }) => name === semantic);
    const attributes = this.#surfaces.get(mesh).attributes.flatMap((one) => {
      const semantic = semanticOf(one.name), element = semantic && find(semantic);
      if (!element)
        return [];
      const whole = element.dataType === TYPE_FLOAT32 ? 1 : element.normalize ? WHOLE[element.dataType] : undefined;
      if (!whole)
        throw new Error(`${EXTENSION}: ${one.name} of the scene is in numbers that cannot move`);
      return [{ one, semantic, whole, width: element.numComponents, values: new Float32Array(count * element.numComponents).fill(whole) }];
    });
    this.#parts.push({
      made, instances, mesh, firstVertex, count, attributes, type: made.primitive[0].type,
      positions: new Float32Array(3 * count), normals: find(SEMANTIC_NORMAL) ? new Float32Array(3 * count) : undefined,
    });
    if (moving.bounds)
      made.aabb = boxOf(moving.bounds);
    for (const instance of instances)
      instance.cull = !!moving.bounds;
  }

  show(time, options) {
    const present = new Map([...this.#surfaces].map(([mesh, surface]) => [mesh, surface.seek(time, options)]));
    for (const { made, instances, mesh, firstVertex, count, attributes, type, positions, normals } of this.#parts) {
      const surface = this.#surfaces.get(mesh);
      for (const instance of instances)
        instance.visible = present.get(mesh);
      if (!present.get(mesh))
        continue;
      surface.take(firstVertex, count, positions, normals);
      made.setPositions(positions);
      if (normals)
        made.setNormals(normals);
      for (const { one, semantic, whole, width, values } of attributes) {
        surface.takeAttribute(one, firstVertex, count, values, width);
        made.setVertexStream(semantic, whole === 1 ? values : values.map((x, i) => (i % width < one.components ? whole * x : x)), width);
      }
      made.update(type, false);
    }
  }

  pointOf(mesh) {
    const part = this.#parts.find((one) => one.mesh === mesh && one.instances.length > 0);
    if (!part)
      throw new Error(`${EXTENSION}: the clip moves no mesh ${mesh}`);
    return { parent: part.instances[0].node, mesh: this.clip.meshes[mesh] };
  }
}

/** A container asset of a file, and the bytes of its buffer views. */
async function loadContainer(url, app) {
  const bytes = new Map(), asset = new Asset(url, 'container', { url }, undefined, {
    bufferView: { postprocess: (view, data) => { bytes.set(view, data); } },
  });
  await new Promise((resolve, reject) => {
    asset.once('load', resolve);
    asset.once('error', (message) => reject(new Error(message)));
    app.assets.add(asset);
    app.assets.load(asset);
  });
  return { asset, bytes };
}

/**
 * Loads a glTF scene, whose meshes move by the clips inside: an entity, which is yours to place. Below it, the entity ANIC_mesh_animation
 * has the script `anicScene`, which plays the first clip. Options are those of open().
 */
export async function loadAnicScene(url, app, options = {}) {
  const { asset, bytes } = await loadContainer(url, app), { gltf, renders } = asset.resource.data, root = asset.resource.instantiateRenderEntity();
  const all = root.findComponents('render').flatMap(({ meshInstances }) => meshInstances), base = new URL(url, globalThis.document?.baseURI);
  const clips = await Promise.all((gltf.extensions?.[EXTENSION]?.files ?? []).map(({ bufferView, uri }) => (
    open(bufferView === undefined ? new URL(uri, base).href : bytes.get(gltf.bufferViews[bufferView]).slice(), options))));
  const scenes = clips.map((clip, file) => {
    const entity = new Entity(file > 0 ? `${EXTENSION}_${file}` : EXTENSION, app);
    entity.addComponent('script');
    root.addChild(entity);
    const scene = entity.script.create(AnicScene);
    scene.clip = clip;
    scene.play();
    return scene;
  });
  (gltf.meshes ?? []).forEach(({ primitives }, m) => primitives.forEach(({ extensions }, p) => {
    const moved = extensions?.[EXTENSION], made = renders[m].meshes[p];
    if (moved)
      scenes[moved.file ?? 0].move(made, all.filter(({ mesh }) => mesh === made), moved);
  }));
  for (const scene of scenes)
    scene.refresh(true);
  root.once('destroy', () => {
    for (const clip of clips)
      clip.close();
    app.assets.remove(asset);
    asset.unload();
  });
  return root;
}
