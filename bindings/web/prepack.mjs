// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Run by npm before it packs: refuses a package without its modules, and brings the licence.
import { copyFileSync, existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
for (const [name, preset] of Object.entries({ 'anicodec.wasm': 'wasm', 'anicodec-full.wasm': 'wasm', 'anicodec-scalar.wasm': 'wasm-scalar', 'viewer.html': 'wasm' })) {
  if (!existsSync(here(`dist/${name}`)) || readFileSync(here(`dist/${name}`)).length === 0) {
    console.error(`dist/${name} is absent: cmake --preset ${preset} && cmake --build --preset ${preset}`);
    process.exit(1);
  }
}
copyFileSync(here('../../LICENSE'), here('LICENSE'));
