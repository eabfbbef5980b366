// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Many instances of a clip's mesh at different times, played by the graphics card of a WebGLRenderer.
//
// Two passes fill textures for all instances: positions, as combinations of the resident basis, and normals, as sums over
// the corners that the CPU sums too. Materials of three.js then fetch both by the number of the vertex, whatever they do
// with them: light, shadows, fog. The CPU does the rest, such as corrections of single vertices, frames between two
// segments, and geometry interpolation, for the instances concerned.
import {
  BufferAttribute, BufferGeometry, DataArrayTexture, DataTexture, DoubleSide, FloatType, GLSL3,
  InstancedMesh, IntType, Matrix4, Mesh, MeshDepthMaterial, MeshDistanceMaterial, MeshStandardMaterial, NearestFilter,
  OrthographicCamera, RGBADepthPacking, RGBAFormat, RGBAIntegerFormat, RawShaderMaterial, RedFormat, ShortType, Sphere, UnsignedByteType, UnsignedIntType,
  Vector2, Vector3, WebGLRenderTarget,
} from 'three';
import { FieldSteps, stepColours } from './field_steps.js';
import { fieldNames, fieldOf } from './fields.js';
import { FETCH, FIELD, FULL, InstanceStates, NORMALS, POSITIONS, WIDTH, normalTexels, pointsOf, rowsOf } from './instance_textures.js';
import { InstanceAnchors } from './three_instance_anchors.js';
import { raycastInstances } from './three_rays.js';

const DECLARED = `
uniform highp sampler2D anicPositions, anicNormals;
uniform int anicRows, anicSourceRows;`;
const OF_FIELD = `
uniform highp sampler2D anicField, anicColours;
uniform int anicFieldRows;`;
const FLOATS = [FloatType, RGBAFormat, 'RGBA32F'];

function texture(Class, data, size, [type, format, internalFormat]) {
  const made = new Class(data, ...size);
  return Object.assign(made, { format, type, internalFormat, minFilter: NearestFilter, magFilter: NearestFilter, generateMipmaps: false, unpackAlignment: 1, needsUpdate: true });
}

const sheet = (data, width, height, kind) => texture(DataTexture, data, [width, height], kind);

const layers = (texels, kind) => texture(DataArrayTexture, texels.data, [WIDTH, texels.rows, texels.layers], kind);

/** Instances of a mesh of a clip. `times` are seconds, of the clips that `clips` numbers; setMatrixAt() and all else is as for InstancedMesh. */
export class AnicInstances extends InstancedMesh {
  #mesh;
  #rows;
  #sourceRows;
  #targets;
  #states;
  #state;
  #screen;
  #camera = new OrthographicCamera();
  #passes;
  #patched;
  #anchors;
  #shown;  // of a field: its bytes and textures, the material before

  constructor(mesh, count, material = new MeshStandardMaterial(), options = {}) {
    const geometry = new BufferGeometry();
    // Both come from textures; three.js counts vertices by the first, and shades them flat without the second.
    const unused = new BufferAttribute(new Float32Array(3 * mesh.vertexCount), 3);
    geometry.setAttribute('position', unused);
    geometry.setAttribute('normal', unused);
    geometry.setIndex(new BufferAttribute(mesh.indices, 1));
    const uv = mesh.attribute('uv');
    if (uv)
      geometry.setAttribute('uv', new BufferAttribute(uv, uv.length / mesh.vertexCount));
    if (!mesh.bounds)
      throw new Error('AnicInstances needs a clip that was opened with bounds');
    const { min, max } = mesh.bounds, low = new Vector3(...min), high = new Vector3(...max);
    geometry.boundingSphere = new Sphere(low.clone().add(high).multiplyScalar(0.5), low.distanceTo(high) / 2);
    super(geometry, material, count);
    this.#mesh = mesh;
    this.#states = new InstanceStates(mesh, count);
    this.options = options;
    this.times = new Float64Array(count);
    this.clips = new Uint16Array(count).fill(mesh.clip.find(options.clip).index);
    this.madeByCpu = 0;  // instances, by the last update()
    this.#rows = rowsOf(mesh.vertexCount);
    this.#sourceRows = rowsOf(mesh.sourceVertexCount);
    const target = (rows) => new WebGLRenderTarget(WIDTH, rows * count, {
      type: FloatType, format: RGBAFormat, internalFormat: 'RGBA32F', minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: false, generateMipmaps: false,
    });
    this.#targets = { positions: target(this.#sourceRows), normals: target(this.#rows) };
    const uniforms = {
      anicPositions: { value: this.#targets.positions.texture }, anicNormals: { value: this.#targets.normals.texture },
      anicRows: { value: this.#rows }, anicSourceRows: { value: this.#sourceRows },
    };
    this.#patched = (one, field) => {
      one.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, uniforms, field);
        shader.vertexShader = DECLARED + FETCH + (field ? OF_FIELD + FIELD : '') + shader.vertexShader
          .replace('#include <begin_vertex>', 'vec3 transformed = anicPosition();')
          .replace('#include <beginnormal_vertex>', 'vec3 objectNormal = anicNormal().xyz;')
          .replace('#include <color_vertex>', field ? '#include <color_vertex>\nvColor.rgb = anicFieldColour();' : '#include <color_vertex>');
      };
      one.customProgramCacheKey = () => (field ? 'anicodec field' : 'anicodec');
      return one;
    };
    this.material = this.#patched(material.clone());
    this.customDepthMaterial = this.#patched(new MeshDepthMaterial({ depthPacking: RGBADepthPacking }));
    this.customDistanceMaterial = this.#patched(new MeshDistanceMaterial());
    this.#anchors = new InstanceAnchors(this, mesh, (i) => this.#optionsOf(i));
    for (let i = 0; i < count; ++i)
      this.setMatrixAt(i, new Matrix4());
    this.#makePasses();
  }

  /** A texture of the plan for normals: what each vertex and each corner refer to. */
  #makePasses() {
    const { elements, corners } = normalTexels(this.#mesh);
    const uints = ({ data, rows }) => sheet(data, WIDTH, rows, [UnsignedIntType, RGBAIntegerFormat, 'RGBA32UI']);
    const pass = (fragmentShader, uniforms) => new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: FULL, fragmentShader, uniforms, depthTest: false, depthWrite: false });
    const uniform = (names) => Object.fromEntries(names.map((name) => [name, { value: null }]));
    this.#passes = {
      positions: pass(POSITIONS, uniform(['wide', 'narrow', 'pose', 'state', 'segment', 'rows', 'wideCount', 'narrowCount', 'scalar', 'hasPose', 'regionTexels', 'origin'])),
      normals: pass(NORMALS, {
        positions: { value: this.#targets.positions.texture }, elements: { value: uints(elements) }, corners: { value: uints(corners) },
        rows: { value: this.#rows }, sourceRows: { value: this.#sourceRows },
      }),
    };
    const triangle = new BufferGeometry();
    triangle.setAttribute('position', new BufferAttribute(Float32Array.of(-1, -1, 0, 3, -1, 0, -1, 3, 0), 3));
    this.#screen = new Mesh(triangle, this.#passes.positions);
    this.#screen.frustumCulled = false;
  }

  /** A segment with its textures, made when an instance first shows it. */
  #segment(index) {
    const segment = this.#states.segment(index), { wide, narrow, pose } = segment.texels;
    segment.made ??= {
      wide: layers(wide, [IntType, RGBAIntegerFormat, 'RGBA32I']), narrow: layers(narrow, [ShortType, RGBAIntegerFormat, 'RGBA16I']),
      pose: sheet(pose.data, WIDTH, pose.rows, FLOATS),
    };
    return segment;
  }

  #optionsOf(instance) {
    return { ...this.options, clip: this.clips[instance] };
  }

  /** Makes positions and normals of all instances for their times. Call it before rendering. */
  update(renderer) {
    if (!renderer.extensions.has('EXT_color_buffer_float'))
      throw new Error('this graphics card draws into no float textures; AnicMesh plays on the CPU');
    const { segments, byCpu } = this.#states.fill(this.times, (i) => this.#optionsOf(i)), { data, width } = this.#states;
    if (this.#state?.image.data !== data) {
      this.#state?.dispose();
      this.#state = sheet(data, width, this.count, FLOATS);
    }
    this.#state.needsUpdate = true;

    const target = renderer.getRenderTarget(), clears = renderer.autoClear;
    renderer.autoClear = false;
    renderer.setRenderTarget(this.#targets.positions);
    for (const index of segments) {
      const segment = this.#segment(index), { uniforms } = this.#passes.positions;
      for (const [name, value] of Object.entries({ ...segment.made, ...segment.uniforms, state: this.#state, origin: new Vector3(...segment.origin) }))
        uniforms[name].value = value;
      this.#passes.positions.uniformsNeedUpdate = true;
      this.#screen.material = this.#passes.positions;
      renderer.render(this.#screen, this.#camera);
    }
    this.madeByCpu = byCpu.length;
    for (const [i, present] of byCpu)
      this.#upload(renderer, i, present);
    renderer.setRenderTarget(this.#targets.normals);
    this.#screen.material = this.#passes.normals;
    renderer.render(this.#screen, this.#camera);
    renderer.setRenderTarget(target);
    renderer.autoClear = clears;
    this.#anchors.update();
    if (this.#shown?.steps.update(this.times, (i) => this.#optionsOf(i)))
      this.#shown.texture.needsUpdate = true;
  }

  /**
   * Keeps a group on a point of an instance's surface, as AnicMesh.anchor() does: a hit of a Raycaster, or a point of ClipMesh.intersectRay()
   * with the number `instanceId`. update() moves it.
   */
  anchor(point, group) { return this.#anchors.add(point, group); }

  /** Names of the fields of the mesh. */
  get fields() { return fieldNames({ meshes: [this.#mesh] }); }

  /** Shows a field as colours, as AnicMesh.showField() does, from the next update() on. Each instance has those of its time. */
  showField(name, { material, ...range } = {}) {
    const field = name === undefined ? undefined : fieldOf(this.#mesh.clip, name, this.#mesh.clip.find(this.clips[0]), range);
    const own = this.#shown?.own ?? this.material;
    if (this.#shown) {
      this.#shown.texture.dispose();
      this.#shown.colours.dispose();
      this.material.dispose();
    }
    this.material = own;
    this.#shown = undefined;
    if (!field)
      return undefined;
    const rows = this.#rows, steps = new FieldSteps(this.#mesh, field, this.count, WIDTH * rows);
    const texture = sheet(steps.data, WIDTH, steps.data.length / WIDTH, [UnsignedByteType, RedFormat, 'R8']), colours = sheet(stepColours(), 256, 1, FLOATS);
    this.material = this.#patched(material?.clone() ?? new MeshStandardMaterial({ side: DoubleSide }), {
      anicField: { value: texture }, anicColours: { value: colours }, anicFieldRows: { value: steps.moves ? rows : 0 },
    });
    this.material.vertexColors = true;
    this.#shown = { own, steps, texture, colours };
    return field;
  }

  /** Positions of one instance by the CPU. */
  #upload(renderer, instance, present) {
    const data = this.#states.positions(present, this.times[instance], this.#optionsOf(instance));
    const rows = sheet(data, WIDTH, this.#sourceRows, FLOATS);
    renderer.copyTextureToTexture(rows, this.#targets.positions.texture, null, new Vector2(0, instance * this.#sourceRows));
    rows.dispose();
  }

  /** Reads back what the card made: positions in the order of the source, or normals. For tests. */
  read(renderer, instance, what = 'positions') {
    const rows = what === 'positions' ? this.#sourceRows : this.#rows, data = new Float32Array(4 * WIDTH * rows);
    renderer.readRenderTargetPixels(this.#targets[what], 0, instance * rows, WIDTH, rows, data);
    return pointsOf(data, what === 'positions' ? this.#mesh.sourceVertexCount : this.#mesh.vertexCount);
  }

  /** Rays hit the instances as they are at their times. */
  raycast(raycaster, intersects) {
    raycastInstances(this, this.#mesh, (i) => this.#optionsOf(i), raycaster, intersects);
  }

  dispose() {
    super.dispose();
    this.showField();
    for (const target of Object.values(this.#targets))
      target.dispose();
    for (const { made } of this.#states.segments)
      for (const one of Object.values(made ?? {}))
        one.dispose();
    this.#state?.dispose();
    this.#passes.normals.uniforms.elements.value.dispose();
    this.#passes.normals.uniforms.corners.value.dispose();
    for (const pass of Object.values(this.#passes))
      pass.dispose();
    this.geometry.dispose();
    this.material.dispose();
  }
}
