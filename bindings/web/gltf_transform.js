// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The glTF extension ANIC_mesh_animation in glTF-Transform, which drops what it does not know.
//
// A clip moves the vertices of a primitive by their numbers. Functions of glTF-Transform put vertices in another order, split,
// merge and drop them, so that each primitive carries an attribute with the numbers that its vertices had when it was read.
// The order is restored before it is written.
import { Accessor, Extension, ExtensionProperty, PropertyType } from '@gltf-transform/core';
import { EXTENSION } from './glb.js';

const NUMBERS = /^_ANIC_\d+$/;
let read = 0;  // primitives: each has an attribute of its own name, or functions would join those of different clips

/** An .anic file of an asset: its bytes, or its address beside the asset. */
export class AnicFile extends ExtensionProperty {
  static EXTENSION_NAME = EXTENSION;

  init() {
    Object.assign(this, { extensionName: EXTENSION, propertyType: 'AnicFile', parentTypes: ['MeshAnimation'] });
  }

  getDefaults() {
    return Object.assign(super.getDefaults(), { bytes: null, uri: '' });
  }

  getBytes() { return this.get('bytes'); }

  setBytes(bytes) { return this.set('bytes', bytes); }

  getURI() { return this.get('uri'); }

  setURI(uri) { return this.set('uri', uri); }
}

/** The mesh of a file that a primitive moves by, and the vertex there that is the primitive's first. */
export class MeshAnimation extends ExtensionProperty {
  static EXTENSION_NAME = EXTENSION;

  init() {
    Object.assign(this, { extensionName: EXTENSION, propertyType: 'MeshAnimation', parentTypes: [PropertyType.PRIMITIVE] });
  }

  getDefaults() {
    return Object.assign(super.getDefaults(), { file: null, mesh: 0, firstVertex: 0, positions: null });
  }

  getFile() { return this.getRef('file'); }

  setFile(file) { return this.setRef('file', file); }

  getMesh() { return this.get('mesh'); }

  setMesh(mesh) { return this.set('mesh', mesh); }

  getFirstVertex() { return this.get('firstVertex'); }

  setFirstVertex(vertex) { return this.set('firstVertex', vertex); }

  /** @hidden Positions as they were read. */
  getPositions() { return this.get('positions'); }

  /** @hidden */
  setPositions(positions) { return this.set('positions', positions); }
}

const numbersOf = (primitive) => primitive.listSemantics().find((semantic) => NUMBERS.test(semantic));

/** Gives an accessor the elements of `from`, undefined ones being those of the first that is there. */
function take(accessor, from) {
  const size = accessor.getElementSize(), old = accessor.getArray(), made = new old.constructor(size * from.length), any = from.find((i) => i !== undefined) ?? 0;
  for (let i = 0; i < from.length; ++i)
    made.set(old.subarray(size * (from[i] ?? any), size * ((from[i] ?? any) + 1)), size * i);
  return accessor.clone().setArray(made);
}

/** Puts the vertices of a primitive back into the order in which they were read. Throws if they are no longer those. */
function restore(primitive, name) {
  const animation = primitive.getExtension(EXTENSION), semantic = numbersOf(primitive), fail = (what) => { throw new Error(`${EXTENSION}: ${name} ${what}`); };
  if (semantic && !animation)
    fail('was joined from primitives that clips move');
  if (!animation)
    return;
  if (!animation.getFile())
    fail('moves by no file');
  if (!semantic)
    return;
  const positions = animation.getPositions(), count = positions.length / 3, from = new Array(count).fill(undefined);
  const numbers = primitive.getAttribute(semantic).getArray();
  numbers.forEach((number, i) => { from[number] ??= i; });
  const attributes = primitive.listSemantics().map((one) => [one, primitive.getAttribute(one)]);
  for (const [one, accessor] of attributes) {
    const size = accessor.getElementSize(), array = accessor.getArray();
    numbers.forEach((number, i) => {
      for (let c = 0; c < size && from[number] !== i; ++c) {
        if (array[size * i + c] !== array[size * from[number] + c])
          fail(`has two values of ${one} at a vertex, which its clip has once`);
      }
    });
  }
  const point = primitive.getAttribute('POSITION').getArray();
  if (numbers.some((number, i) => [0, 1, 2].some((c) => point[3 * i + c] !== positions[3 * number + c])))
    fail('has other positions than its clip: quantize() it without POSITION, and bake no transform into it');
  if (numbers.length === count && numbers.every((number, i) => number === i))
    return;
  const indices = primitive.getIndices(), faces = Uint32Array.from(indices?.getArray() ?? numbers.keys(), (i) => numbers[i]);
  const made = indices?.clone() ?? primitive.getAttribute('POSITION').clone().setType(Accessor.Type.SCALAR);
  for (const [one, accessor] of attributes)
    primitive.setAttribute(one, one === 'POSITION' ? accessor.clone().setArray(positions.slice()) : take(accessor, from));
  primitive.getAttribute(semantic).setArray(Uint32Array.from({ length: count }, (_, i) => i));
  primitive.setIndices(made.setArray(count > 65535 ? faces : Uint16Array.from(faces)));
  for (const accessor of [indices, ...attributes.map(([, accessor]) => accessor)]) {
    if (accessor?.listParents().every(({ propertyType }) => propertyType === PropertyType.ROOT))
      accessor.dispose();
  }
}

/**
 * Lets glTF-Transform read, keep and write scenes that move by clips: io.registerExtensions([ANICMeshAnimation]). Files of the same
 * bytes are written once. Writing fails where a scene would be shown wrong: positions that were quantized or transformed, Draco.
 */
export class ANICMeshAnimation extends Extension {
  static EXTENSION_NAME = EXTENSION;

  extensionName = EXTENSION;

  prewriteTypes = [PropertyType.ACCESSOR, PropertyType.BUFFER];

  #files = [];

  createFile() { return new AnicFile(this.document.getGraph()); }

  createMeshAnimation() { return new MeshAnimation(this.document.getGraph()); }

  read({ jsonDoc: { json }, bufferViews, meshes }) {
    const files = (json.extensions?.[EXTENSION]?.files ?? []).map(({ bufferView, uri = '' }) => {
      const file = this.createFile().setURI(uri);
      return bufferView === undefined ? file : file.setBytes(bufferViews[bufferView].slice());
    });
    (json.meshes ?? []).forEach((mesh, m) => mesh.primitives.forEach(({ extensions }, p) => {
      const moved = extensions?.[EXTENSION];
      if (!moved)
        return;
      const primitive = meshes[m].listPrimitives()[p], position = primitive.getAttribute('POSITION'), file = files[moved.file ?? 0];
      if (!file)
        throw new Error(`${EXTENSION}: mesh ${m} names file ${moved.file ?? 0}, and there are ${files.length}`);
      const numbers = this.document.createAccessor().setBuffer(position.getBuffer()).setArray(Uint32Array.from({ length: position.getCount() }, (_, i) => i));
      primitive.setAttribute(`_ANIC_${read++}`, numbers);
      primitive.setExtension(EXTENSION, this.createMeshAnimation().setFile(file).setMesh(moved.mesh ?? 0).setFirstVertex(moved.firstVertex ?? 0)
        .setPositions(Float32Array.from(position.getArray())));
    }));
    return this;
  }

  /** Primitives of the document: [primitive, its name, its mesh, its number there]. */
  #primitives() {
    return this.document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives().map((primitive, p) => [primitive, `primitive ${p} of mesh "${mesh.getName()}"`, mesh, p]));
  }

  prewrite(context, type) {
    const root = this.document.getRoot();
    if (type === PropertyType.ACCESSOR) {
      if (root.listExtensionsUsed().some(({ extensionName }) => extensionName === 'KHR_draco_mesh_compression'))
        throw new Error(`${EXTENSION}: Draco would change the order of vertices`);
      for (const [primitive, name] of this.#primitives()) {
        restore(primitive, name);
        const semantic = numbersOf(primitive);
        if (semantic)
          context.accessorIndexMap.set(primitive.getAttribute(semantic), -1);  // or it would be written
      }
      return this;
    }
    this.#files = [];
    for (const [primitive] of this.#primitives()) {
      const file = primitive.getExtension(EXTENSION)?.getFile();
      if (file && this.#index(file) < 0)
        this.#files.push({ bytes: file.getBytes(), uri: file.getURI() });
    }
    const inside = this.#files.map(({ bytes }) => bytes).filter(Boolean);
    if (inside.length > 0) {
      const buffer = root.listBuffers()[0] ?? this.document.createBuffer();
      context.otherBufferViews.set(buffer, [...context.otherBufferViews.get(buffer) ?? [], ...inside]);
    }
    return this;
  }

  #index(file) {
    const a = file.getBytes();
    return this.#files.findIndex(({ bytes: b, uri }) => (a && b ? a.length === b.length && a.every((x, i) => x === b[i]) : !a && !b && uri === file.getURI()));
  }

  write({ jsonDoc: { json }, otherBufferViewsIndexMap, meshIndexMap }) {
    for (const [primitive, , mesh, p] of this.#primitives()) {
      const animation = primitive.getExtension(EXTENSION), made = json.meshes[meshIndexMap.get(mesh)].primitives[p];
      delete made.attributes[numbersOf(primitive)];
      if (!animation)
        continue;
      const moved = { file: this.#index(animation.getFile()), mesh: animation.getMesh(), firstVertex: animation.getFirstVertex() };
      made.extensions = { ...made.extensions, [EXTENSION]: moved };
    }
    if (this.#files.length > 0) {
      const files = this.#files.map(({ bytes, uri }) => (bytes ? { bufferView: otherBufferViewsIndexMap.get(bytes) } : { uri }));
      json.extensions = { ...json.extensions, [EXTENSION]: { files } };
    }
    return this;
  }
}
