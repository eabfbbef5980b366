// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Many instances of a clip's mesh at different times, played by the graphics card of a WebGL 2 engine of Babylon.js.
//
// Two passes make positions and normals of all instances, as instance_textures.js says; standard and PBR materials then
// fetch both. The CPU does the rest for the instances concerned.
import { VertexBuffer } from '@babylonjs/core/Buffers/buffer.js';
import { PickingInfo } from '@babylonjs/core/Collisions/pickingInfo.js';
import { Ray } from '@babylonjs/core/Culling/ray.js';
import { Constants } from '@babylonjs/core/Engines/constants.js';
import { EffectRenderer, EffectWrapper } from '@babylonjs/core/Materials/effectRenderer.js';
import { MaterialPluginBase } from '@babylonjs/core/Materials/materialPluginBase.js';
import { ShadowDepthWrapper } from '@babylonjs/core/Materials/shadowDepthWrapper.js';
import { RawTexture } from '@babylonjs/core/Materials/Textures/rawTexture.js';
import { RawTexture2DArray } from '@babylonjs/core/Materials/Textures/rawTexture2DArray.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Matrix, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import '@babylonjs/core/Meshes/thinInstanceMesh.js';
import { boundingInfo, giveSurface, placeOnSurface, turnToScene } from './babylon_surface.js';
import { FieldSteps, stepColours } from './field_steps.js';
import { fieldNames, fieldOf } from './fields.js';
import { FETCH, FIELD, FULL, InstanceStates, NORMALS, POSITIONS, WIDTH, normalTexels, pointsOf, rowsOf } from './instance_textures.js';

const NEAREST = Constants.TEXTURE_NEAREST_SAMPLINGMODE;
const FLOATS = [Constants.TEXTUREFORMAT_RGBA, Constants.TEXTURETYPE_FLOAT];
const BYTES = [Constants.TEXTUREFORMAT_R, Constants.TEXTURETYPE_UNSIGNED_BYTE];
const INTEGERS = new Map([
  [Int16Array, Constants.TEXTURETYPE_SHORT], [Int32Array, Constants.TEXTURETYPE_INT], [Uint32Array, Constants.TEXTURETYPE_UNSIGNED_INTEGER],
]);

const kindOf = (data) => (data instanceof Float32Array ? FLOATS : data instanceof Uint8Array ? BYTES : [Constants.TEXTUREFORMAT_RGBA_INTEGER, INTEGERS.get(data.constructor)]);

function sheet(scene, data, width, height) {
  const [format, type] = kindOf(data);
  return new RawTexture(data, width, height, format, scene, false, false, NEAREST, type);
}

function layers(scene, { data, rows, layers: depth }) {
  const [format, type] = kindOf(data);
  return new RawTexture2DArray(data, WIDTH, rows, depth, format, scene, false, false, NEAREST, type);
}

const SAMPLERS = { positions: ['wide', 'narrow', 'pose', 'state'], normals: ['positions', 'elements', 'corners'] };
const NUMBERS = { positions: ['segment', 'rows', 'wideCount', 'narrowCount', 'scalar', 'hasPose', 'regionTexels', 'origin'], normals: ['rows', 'sourceRows'] };

const pass = (engine, name, fragmentShader) => new EffectWrapper({
  engine, name: `anicodec ${name}`, vertexShader: `#version 300 es${FULL}`, fragmentShader: `#version 300 es${fragmentShader}`,
  uniformNames: NUMBERS[name], samplerNames: SAMPLERS[name],
});

/** Lets a material fetch what the passes made. */
class FetchPlugin extends MaterialPluginBase {
  #textures;
  #rows;

  constructor(material, textures, rows, defines = {}) {
    super(material, 'AnicInstances', 200, { ANICODEC: true, ...defines });
    this.#textures = textures;
    this.#rows = rows;
    this._enable(true);
  }

  getClassName() { return 'AnicInstances'; }

  getSamplers(samplers) { samplers.push('anicPositions', 'anicNormals'); }

  getUniforms() {
    return { ubo: [{ name: 'anicSize', size: 3, type: 'vec3' }], vertex: 'uniform vec3 anicSize;' };
  }

  bindForSubMesh(uniforms) {
    uniforms.updateFloat3('anicSize', this.#rows.normals, this.#rows.positions, this.#rows.field ?? 0);
    uniforms.setTexture('anicPositions', this.#textures.positions);
    uniforms.setTexture('anicNormals', this.#textures.normals);
  }

  getCustomCode(stage) {
    if (stage !== 'vertex')
      return null;
    return {
      CUSTOM_VERTEX_DEFINITIONS: `uniform highp sampler2D anicPositions, anicNormals;
#define anicRows int(anicSize.x)
#define anicSourceRows int(anicSize.y)
${FETCH}`,
      CUSTOM_VERTEX_UPDATE_POSITION: 'positionUpdated = anicPosition();',
      CUSTOM_VERTEX_UPDATE_NORMAL: 'normalUpdated = anicNormal().xyz;',
    };
  }
}

/** The same, with the colours of a field: { texture, colours, rows }. */
class FieldPlugin extends FetchPlugin {
  #field;

  constructor(material, textures, rows, field) {
    super(material, textures, { ...rows, field: field.rows }, { ANICODEC_FIELD: true });
    this.#field = field;
  }

  getSamplers(samplers) {
    super.getSamplers(samplers);
    samplers.push('anicField', 'anicColours');
  }

  bindForSubMesh(uniforms) {
    super.bindForSubMesh(uniforms);
    uniforms.setTexture('anicField', this.#field.texture);
    uniforms.setTexture('anicColours', this.#field.colours);
  }

  getCustomCode(stage) {
    const code = super.getCustomCode(stage);
    return code && {
      ...code,
      CUSTOM_VERTEX_DEFINITIONS: `${code.CUSTOM_VERTEX_DEFINITIONS}
uniform highp sampler2D anicField, anicColours;
#define anicFieldRows int(anicSize.z)
${FIELD}`,
      CUSTOM_VERTEX_MAIN_END: 'vColor = vec4(anicFieldColour(), 1.0);',
    };
  }
}

/** Instances of a mesh of a clip. `times` are seconds, of the clips that `clips` numbers; matrices are those of thin instances. */
export class AnicInstances extends Mesh {
  #mesh;
  #rows;
  #states;
  #state;
  #targets;
  #renderer;
  #passes;
  #plan;
  #prepare;
  #anchors = [];
  #shown;  // of a field: its bytes and textures, the material and the colours before

  constructor(mesh, count, scene, material, options = {}) {
    super(mesh.name || 'anic', scene);
    const engine = scene.getEngine();
    if (engine.isWebGPU || !engine.getCaps().textureFloatRender)
      throw new Error('AnicInstances needs a WebGL 2 engine that draws into float textures; AnicMesh plays on the CPU');
    if (!mesh.bounds)
      throw new Error('AnicInstances needs a clip that was opened with bounds');
    this.#mesh = mesh;
    this.#states = new InstanceStates(mesh, count);
    Object.assign(this, { options, times: new Float64Array(count), clips: new Uint16Array(count).fill(mesh.clip.find(options.clip).index), madeByCpu: 0 });
    this.#rows = { positions: rowsOf(mesh.sourceVertexCount), normals: rowsOf(mesh.vertexCount) };
    const target = (name) => {
      const made = new RenderTargetTexture(`anicodec ${name}`, { width: WIDTH, height: count * this.#rows[name] }, scene, {
        generateMipMaps: false, generateDepthBuffer: false, samplingMode: NEAREST, format: FLOATS[0], type: FLOATS[1],
      });
      return Object.assign(made, { wrapU: Constants.TEXTURE_CLAMP_ADDRESSMODE, wrapV: Constants.TEXTURE_CLAMP_ADDRESSMODE });
    };
    this.#targets = { positions: target('positions'), normals: target('normals') };
    this.#renderer = new EffectRenderer(engine);
    this.#passes = { positions: pass(engine, 'positions', POSITIONS), normals: pass(engine, 'normals', NORMALS) };
    const { elements, corners } = normalTexels(mesh);
    this.#plan = { elements: sheet(scene, elements.data, WIDTH, elements.rows), corners: sheet(scene, corners.data, WIDTH, corners.rows) };
    this.#prepare = (one, field) => {
      if (field)
        new FieldPlugin(one, this.#targets, this.#rows, field);
      else
        new FetchPlugin(one, this.#targets, this.#rows);
      one.shadowDepthWrapper = new ShadowDepthWrapper(one, scene);
      return one;
    };
    giveSurface(this, mesh, scene, { material, prepare: (one) => this.#prepare(material ? one.clone(one.name) : one), updatable: false });
    turnToScene(this, mesh.clip, scene);
    this.alwaysSelectAsActiveMesh = true;  // instances are elsewhere than the box of the mesh
    this.rawBoundingInfo = boundingInfo(mesh.bounds);  // or it would be made of the positions, which are 0
    const matrices = new Float32Array(16 * count);
    for (let i = 0; i < count; ++i)
      Matrix.Identity().copyToArray(matrices, 16 * i);
    this.thinInstanceSetBuffer('matrix', matrices, 16, false);
    const observer = scene.onBeforeRenderObservable.add(() => this.update());
    this.onDisposeObservable.addOnce(() => {
      scene.onBeforeRenderObservable.remove(observer);
      this.#release();
    });
  }

  #optionsOf(instance) {
    return { ...this.options, clip: this.clips[instance] };
  }

  /** A segment with its textures, made when an instance first shows it. */
  #segment(index) {
    const scene = this.getScene(), segment = this.#states.segment(index), { wide, narrow, pose } = segment.texels;
    segment.made ??= { wide: layers(scene, wide), narrow: layers(scene, narrow), pose: sheet(scene, pose.data, WIDTH, pose.rows) };
    return segment;
  }

  #draw(name, textures, { origin, ...numbers }) {
    const wrapper = this.#passes[name], engine = this.getScene().getEngine();
    this.#renderer.applyEffectWrapper(wrapper);
    engine.setAlphaMode(Constants.ALPHA_DISABLE);
    for (const [sampler, one] of Object.entries(textures))
      wrapper.effect.setTexture(sampler, one);
    for (const [uniform, one] of Object.entries(numbers))
      wrapper.effect.setInt(uniform, one);
    if (origin)
      wrapper.effect.setFloat3('origin', ...origin);
    this.#renderer.draw();
  }

  /** Makes positions and normals of all instances for their times; false while shaders are compiled. The scene calls it before it renders. */
  update() {
    const scene = this.getScene(), engine = scene.getEngine(), { positions, normals } = this.#targets;
    if (!this.#passes.positions.effect.isReady() || !this.#passes.normals.effect.isReady())
      return false;
    const { segments, byCpu } = this.#states.fill(this.times, (i) => this.#optionsOf(i)), { data, width } = this.#states;
    if (this.#state?.getSize().width === width) {
      this.#state.update(data);
    } else {
      this.#state?.dispose();
      this.#state = sheet(scene, data, width, this.times.length);
    }
    this.#renderer.saveStates();
    const into = (target, draw) => {
      engine.bindFramebuffer(target.renderTarget);
      this.#renderer.setViewport();
      draw();
      engine.unBindFramebuffer(target.renderTarget, true);
    };
    into(positions, () => {
      for (const index of segments) {
        const { made, uniforms, origin } = this.#segment(index);
        this.#draw('positions', { ...made, state: this.#state }, { ...uniforms, origin });
      }
    });
    for (const [i, present] of byCpu) {
      const rows = this.#states.positions(present, this.times[i], this.#optionsOf(i));
      engine.updateTextureData(positions.getInternalTexture(), rows, 0, i * this.#rows.positions, WIDTH, this.#rows.positions);
    }
    into(normals, () => this.#draw('normals', { positions, ...this.#plan }, { rows: this.#rows.normals, sourceRows: this.#rows.positions }));
    this.#renderer.restoreStates();
    engine.restoreDefaultFramebuffer();
    this.madeByCpu = byCpu.length;
    this.#anchors = this.#anchors.filter(({ node }) => node.parent === this && !node.isDisposed());
    for (const anchor of this.#anchors)
      this.#place(anchor);
    if (this.#shown?.steps.update(this.times, (i) => this.#optionsOf(i)))
      this.#shown.texture.update(this.#shown.steps.data);
    return true;
  }

  /**
   * Keeps a node on a point of an instance's surface, as AnicMesh.anchor() does: a PickingInfo, or a point of ClipMesh.intersectRay(), with
   * the number `thinInstanceIndex`. update() moves it.
   */
  anchor({ thinInstanceIndex: instance = 0, faceId, bu, bv, vertices, weights }, node = new TransformNode('anchor', this.getScene())) {
    if (!(instance >= 0 && instance < this.times.length))
      throw new Error(`there is no instance ${instance} of ${this.times.length}`);
    const point = vertices ? { vertices, weights } : { vertices: this.#mesh.indices.slice(3 * faceId, 3 * faceId + 3), weights: [bu, bv, 1 - bu - bv] };
    const anchor = { node, instance, point };
    this.#place(anchor);  // throws for a point that is none
    this.#anchors = [...this.#anchors.filter((one) => one.node !== node), anchor];
    node.parent = this;
    return node;
  }

  #place({ node, instance, point }) {
    if (!placeOnSurface(node, this.#mesh, point, this.times[instance], this.#optionsOf(instance)))
      return;
    const matrix = Matrix.Compose(new Vector3(1, 1, node.scaling.z), node.rotationQuaternion, node.position).multiply(this.thinInstanceGetWorldMatrices()[instance]);
    matrix.decompose(node.scaling, node.rotationQuaternion, node.position);
  }

  /** Names of the fields of the mesh. */
  get fields() { return fieldNames({ meshes: [this.#mesh] }); }

  /** Shows a field as colours, as AnicMesh.showField() does, from the next update() on. Each instance has those of its time. */
  showField(name, { material, ...range } = {}) {
    const scene = this.getScene(), mesh = this.#mesh, kind = VertexBuffer.ColorKind;
    const field = name === undefined ? undefined : fieldOf(mesh.clip, name, mesh.clip.find(this.clips[0]), range);
    const own = this.#shown?.own ?? { material: this.material, colours: this.getVerticesData(kind)?.slice(), width: this.getVertexBuffer(kind)?.getSize() };
    this.#hideField();
    this.material = own.material;
    if (!field) {
      if (own.colours)
        this.setVerticesData(kind, own.colours, false, own.width);
      else
        this.removeVerticesData(kind);
      return undefined;
    }
    const rows = this.#rows.normals, steps = new FieldSteps(mesh, field, this.times.length, WIDTH * rows);
    const texture = sheet(scene, steps.data, WIDTH, steps.data.length / WIDTH), colours = sheet(scene, stepColours('srgb'), 256, 1);
    const plain = () => Object.assign(new StandardMaterial('field', scene), { backFaceCulling: false, twoSidedLighting: true, specularColor: Color3.Black() });
    const made = this.#prepare(material?.clone(material.name) ?? plain(), { texture, colours, rows: steps.moves ? rows : 0 });
    this.setVerticesData(kind, new Float32Array(4 * mesh.vertexCount).fill(1), false, 4);  // lets the material have colours
    this.material = made;
    this.#shown = { own, steps, texture, colours, made };
    return field;
  }

  #hideField() {
    for (const one of ['texture', 'colours', 'made'])
      this.#shown?.[one].dispose();
    this.#shown = undefined;
  }

  /** Reads back what the card made: positions in the order of the source, or normals. For tests. */
  async read(instance, what = 'positions') {
    const rows = this.#rows[what], texels = await this.#targets[what].readPixels(0, 0, null, true, true, 0, instance * rows, WIDTH, rows);
    return pointsOf(texels, what === 'positions' ? this.#mesh.sourceVertexCount : this.#mesh.vertexCount);
  }

  /** The first hit of a ray: a PickingInfo with `thinInstanceIndex`, of instances as they are at their times; null if there is none. */
  pick(ray) {
    const world = this.computeWorldMatrix(true), found = this.intersects(Ray.Transform(ray, Matrix.Invert(world)), false, undefined, false, world);
    return found.hit ? found : null;
  }

  /** The same for a ray in the space of this mesh, with the parameters of AbstractMesh.intersects(), through which scenes pick. */
  intersects(ray, fastCheck, trianglePredicate, onlyBoundingInfo = false, world = this.getWorldMatrix()) {
    const probe = new Mesh('anic', this.getScene());
    let nearest = new PickingInfo();
    probe.setVerticesData(VertexBuffer.PositionKind, new Float32Array(3 * this.#mesh.vertexCount), true);
    probe.setIndices(this.#mesh.indices, this.#mesh.vertexCount);
    for (const [i, matrix] of this.thinInstanceGetWorldMatrices().entries()) {
      const local = Ray.Transform(ray, Matrix.Invert(matrix));
      if (!local.intersectsBox(this.rawBoundingInfo.boundingBox) || !this.#mesh.isPresent(this.times[i], this.#optionsOf(i)))
        continue;
      probe.updateVerticesData(VertexBuffer.PositionKind, this.#mesh.positions(this.times[i], undefined, this.#optionsOf(i)), true);
      const hit = probe.intersects(local, fastCheck, trianglePredicate, onlyBoundingInfo, matrix.multiply(world));
      if (hit.hit && !(nearest.hit && nearest.distance <= hit.distance))
        nearest = Object.assign(hit, { thinInstanceIndex: i, pickedMesh: this });
      if (nearest.hit && fastCheck)
        break;
    }
    probe.dispose();
    return nearest;
  }

  #release() {
    this.#hideField();
    const made = [...this.#states.segments].flatMap((segment) => Object.values(segment.made ?? {}));
    for (const one of [...made, ...Object.values(this.#targets), ...Object.values(this.#plan), ...Object.values(this.#passes), this.#renderer, this.#state])
      one?.dispose();
  }
}
