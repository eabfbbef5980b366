// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node run.mjs FILE...: runs tests of the npm package; exit status 77 when what they need is absent.
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const need = {
  '../../sdk/web/dist/anicodec-full.wasm': 'preset wasm builds the modules',
  '../../sdk/web/dist/anicodec-scalar.wasm': 'preset wasm-scalar builds the module without SIMD',
  'node_modules/playwright-core': 'npm ci --prefix tests/web installs what they need',
};
for (const [path, how] of Object.entries(need)) {
  if (!existsSync(fileURLToPath(new URL(path, import.meta.url)))) {
    console.log(`Skipped: ${path} is absent; ${how}`);
    process.exit(77);
  }
}
process.exit(spawnSync(process.execPath, ['--test', ...process.argv.slice(2)], { stdio: 'inherit' }).status ?? 1);
