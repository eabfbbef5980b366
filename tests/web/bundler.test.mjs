// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The packed package in an empty project of Vite, with the lines of the README. `npm ci --prefix tests/web/vite` installs Vite.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { bytesOf } from './files.mjs';
import { CHROMIUM, withPage } from './serve.mjs';

const here = (path) => fileURLToPath(new URL(path, import.meta.url)), VITE = here('vite/node_modules/vite/dist/node/index.js');
const skip = !CHROMIUM ? 'there is no Chromium' : existsSync(VITE) ? false : 'there is no Vite: npm ci --prefix tests/web/vite';
const SETUP = `import { DirectionalLight, PerspectiveCamera, Scene, Timer, WebGLRenderer } from 'three';
const scene = new Scene(), renderer = new WebGLRenderer(), camera = new PerspectiveCamera(50, 1, 0.01, 100), timer = new Timer();
scene.add(new DirectionalLight());
camera.position.set(0, 0, 5);
`;
const TYPES = { '.js': 'text/javascript', '.html': 'text/html', '.wasm': 'application/wasm' };

test('the packed package is built by Vite and plays', { skip }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'anicodec-'));
  try {
    mkdirSync(join(folder, 'node_modules'));
    mkdirSync(join(folder, 'public'));
    const [tarball] = JSON.parse(execFileSync('npm', ['pack', '--json', '--pack-destination', folder], { cwd: here('../../bindings/web'), encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
    execFileSync('tar', ['xf', join(folder, tarball.filename), '-C', folder]);
    renameSync(join(folder, 'package'), join(folder, 'node_modules/anicodec'));
    symlinkSync(here('node_modules/three'), join(folder, 'node_modules/three'));
    writeFileSync(join(folder, 'public/dancer.anic'), bytesOf('limb_small.anic'));
    const lines = readFileSync(here('../../bindings/web/README.md'), 'utf8').match(/```js\n(import \{ AnicLoader \}[^`]*)```/)[1];
    writeFileSync(join(folder, 'main.js'), `${lines.match(/^import.*$/m)[0]}\n${SETUP}${lines.replace(/^import.*$/m, '')}\nglobalThis.dancer = dancer;\n`);
    writeFileSync(join(folder, 'index.html'), '<!doctype html><link rel="icon" href="data:,"><script type="module" src="/main.js"></script>');
    const { build } = await import(VITE);
    await build({ root: folder, configFile: false, logLevel: 'error', build: { target: 'es2022', modulePreload: false } });
    assert.ok(readdirSync(join(folder, 'dist/assets')).some((name) => name.endsWith('.wasm')));
    const server = createServer((request, response) => {
      const path = join(folder, 'dist', new URL(request.url, 'http://x').pathname.replace(/\/$/, '/index.html'));
      response.writeHead(existsSync(path) ? 200 : 404, { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' }).end(existsSync(path) ? readFileSync(path) : '');
    });
    await new Promise((done) => server.listen(0, '127.0.0.1', done));
    try {
      await withPage(async (page, messages) => {
        await page.goto(`http://127.0.0.1:${server.address().port}/`);
        await page.waitForFunction(() => globalThis.dancer?.time > 0, undefined, { timeout: 20000 });
        assert.deepEqual(messages, []);
      });
    } finally {
      server.close();
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});
