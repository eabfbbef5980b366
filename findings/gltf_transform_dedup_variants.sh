#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# glTF-Transform 4.5.1: dedup() and extensions of primitives.
#
# Two meshes may have the same vertices and the same material, and differ in an extension of their primitives alone, such as
# KHR_materials_variants: two chairs, one of which turns red in the variant "red" and the other blue. dedup() compares attributes,
# indices, material, mode and targets of primitives, and no extensions: it makes one mesh of both. All nodes then show the first one's
# variants, though the extension is registered and written. Nothing says so.
#
# Output seen: "before: red blue, after: red red". Exit status 1 if it is another.
# Way out: dedup({ propertyTypes: [...] }) without PropertyType.MESH, or an attribute of its own name on each such primitive.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true, "type": "module"}' >package.json
npm install --silent --no-audit --no-fund --ignore-scripts \
  @gltf-transform/core@4.5.1 @gltf-transform/extensions@4.5.1 @gltf-transform/functions@4.5.1

cat >try.mjs <<'P'
import { Document, Logger, NodeIO } from '@gltf-transform/core';
import { KHRMaterialsVariants } from '@gltf-transform/extensions';
import { dedup } from '@gltf-transform/functions';

const document = new Document().setLogger(new Logger(Logger.Verbosity.SILENT)), variants = document.createExtension(KHRMaterialsVariants);
const position = document.createAccessor().setType('VEC3').setArray(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0])).setBuffer(document.createBuffer());
const plain = document.createMaterial('plain'), variant = variants.createVariant('painted'), scene = document.createScene();
for (const [colour, factor] of [['red', [1, 0, 0, 1]], ['blue', [0, 0, 1, 1]]]) {
  const mapping = variants.createMapping().setMaterial(document.createMaterial(colour).setBaseColorFactor(factor)).addVariant(variant);
  const primitive = document.createPrimitive().setAttribute('POSITION', position).setMaterial(plain);
  primitive.setExtension('KHR_materials_variants', variants.createMappingList().addMapping(mapping));
  scene.addChild(document.createNode(colour).setMesh(document.createMesh(colour).addPrimitive(primitive)));
}
const io = new NodeIO().registerExtensions([KHRMaterialsVariants]);
const shown = async () => (await io.readBinary(await io.writeBinary(document))).getRoot().listScenes()[0].listChildren().map((node) =>
  node.getMesh().listPrimitives()[0].getExtension('KHR_materials_variants').listMappings()[0].getMaterial().getName()).join(' ');
const before = await shown();
await document.transform(dedup());
console.log(`before: ${before}, after: ${await shown()}`);
P
seen=$(node try.mjs)
echo "$seen"
[[ $seen == "before: red blue, after: red red" ]]
