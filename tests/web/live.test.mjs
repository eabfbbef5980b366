// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A capture over a network, as examples/live sends and shows it: frames in real time, the command, a WebSocket on loopback, two pages.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { CHROMIUM, launch, withPage } from './serve.mjs';

const command = process.env.ANICODEC_COMMAND, hasSockets = existsSync(new URL('../../bindings/web/node_modules/ws', import.meta.url));
const skip = !CHROMIUM ? 'there is no Chromium' : !command ? 'ANICODEC_COMMAND names no command'
  : !hasSockets ? 'npm ci --prefix bindings/web installs ws' : false;
const FPS = 24, PIECE = 0.5, SECONDS = 12, LOST = 5, JOINS_AT = 4500;
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Writes frames to a pipe at their rate. */
async function capture(frames, size, pipe) {
  const begin = Date.now();
  for (let f = 0; f < FPS * SECONDS; ++f) {
    await sleep(Math.max(0, begin + 1000 * (f + 1) / FPS - Date.now()));
    const at = f % (frames.length / size);
    pipe.write(frames.subarray(size * at, size * (at + 1)));
  }
  pipe.end();
}

test('pages play a capture three files behind, over a lost file, and join late', { skip, timeout: 120000 }, async () => {
  const { filesOf, serve } = await import('../../bindings/web/examples/live/server.mjs');
  const folder = mkdtempSync(join(tmpdir(), 'anicodec-')), at = (name) => join(folder, name);
  const browser = await launch();
  let encoder, server;
  try {
    execFileSync(command, ['corpus', 'limb', '-q', '-o', at('limb.pc2'), '--vertices', '400', '--frame-count', '48']);
    const cache = readFileSync(at('limb.pc2')), vertices = cache.readUInt32LE(16);
    encoder = spawn(command, ['encode', '--live', at('limb.obj'), '--fps', String(FPS), '--piece', String(PIECE), '--key-every', '2',
      '--effort', 'fast', '-o', at('take.anic'), '--json'], { stdio: ['pipe', 'pipe', 'inherit'] });
    server = await serve(filesOf(at('take.anic'), encoder.stdout), { lose: (number) => number === LOST });
    const watch = (body, onOpen) => withPage(async (page, messages) => {
      await page.goto(server.url);
      await page.waitForFunction(() => window.live);
      onOpen?.();
      await page.waitForFunction(() => window.live?.ended, undefined, { timeout: 60000 });
      await page.waitForTimeout(200);
      body(await page.evaluate(() => window.live), messages, await page.screenshot());
    }, { browser });
    const check = ({ pictures, delay }, messages, picture) => {
      assert.ok(pictures > 5, `${pictures} pictures`);
      // Three files, one that grows, and what a machine that runs other tests takes for it.
      assert.ok(delay > PIECE && delay < 12 * PIECE, `${delay} s`);
      assert.ok(messages.some((text) => / s behind the capture/.test(text)), messages.join('\n'));
      assert.ok(messages.every((text) => text.startsWith('info:')), messages.join('\n'));
      assert.ok(picture.length > 2000);
    };
    let open;
    const opened = new Promise((resolve) => (open = resolve));
    const first = watch((live, ...rest) => {
      check(live, ...rest);
      // Up to the next that begins anew, as files do every two seconds.
      assert.deepEqual(live.losses, [{ from: LOST * PIECE, to: 4, files: 2 }]);
    }, open);
    await Promise.race([opened, first]);
    await Promise.all([capture(cache.subarray(32), 12 * vertices, encoder.stdin), sleep(JOINS_AT).then(() => watch(check)), first]);
    await server.sent;
  } finally {
    server?.close();
    encoder?.kill();
    await browser.close();
    rmSync(folder, { recursive: true });
  }
});
