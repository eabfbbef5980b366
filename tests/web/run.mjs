// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node run.mjs FILE...: runs tests of the npm package; exit status 77 when what they need is absent.
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const need = {
  '../../bindings/web/dist/anicodec-full.wasm': 'preset wasm builds the modules',
  '../../bindings/web/dist/anicodec-scalar.wasm': 'preset wasm-scalar builds the module without SIMD',
  'node_modules/playwright-core': 'npm ci --prefix tests/web installs what they need',
};
for (const [path, how] of Object.entries(need)) {
  if (!existsSync(fileURLToPath(new URL(path, import.meta.url)))) {
    console.log(`Skipped: ${path} is absent; ${how}`);
    process.exit(77);
  }
}
const run = spawnSync(process.execPath, ['--test', ...process.argv.slice(2)], { stdio: ['inherit', 'pipe', 'inherit'], encoding: 'utf8' });
console.log(run.stdout);
const all_skipped = /^\W+ pass 0$/m.test(run.stdout) && !/^\W+ skipped 0$/m.test(run.stdout);
process.exit(run.status === 0 && all_skipped ? 77 : run.status ?? 1);
