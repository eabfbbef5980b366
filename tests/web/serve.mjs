// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A server of the checkout's files, and a browser that shows them.
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
const TYPES = { '.js': 'text/javascript', '.mjs': 'text/javascript', '.html': 'text/html', '.wasm': 'application/wasm' };
export const CHROMIUM = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);

const WEBGPU = ['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan', '--ignore-gpu-blocklist'];

/** Serves files of the checkout, and pages: path to HTML or a file. `folders`: [path, folder of the checkout], the first one counts. Gives its address. */
export async function serve(pages = {}, folders = []) {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost'), [path, folder] = folders.find(([one]) => pathname.startsWith(one)) ?? ['', ''];
    try {
      const body = pages[pathname] ?? await readFile(root + folder + decodeURIComponent(pathname.slice(path.length)).replaceAll('..', ''));
      response.writeHead(200, { 'content-type': pages[pathname] && !extname(pathname) ? 'text/html' : TYPES[extname(pathname)] ?? 'application/octet-stream' });
      response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** Starts a browser, which the caller closes. */
export async function launch({ webgpu = false } = {}) {
  const { chromium } = await import('playwright-core');
  return chromium.launch({ executablePath: CHROMIUM, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', ...(webgpu ? WEBGPU : [])] });
}

/** Runs body(page, messages) in a new page, of `browser` or of one of its own; messages are what the console and the page's errors say. */
export async function withPage(body, { browser, webgpu = false, ...options } = {}) {
  const used = browser ?? await launch({ webgpu });
  const context = await used.newContext({ viewport: { width: 320, height: 240 }, ...options }), messages = [];
  context.setDefaultTimeout(120_000);  // of processors that do other things, too
  try {
    const page = await context.newPage();
    page.on('console', (message) => messages.push(`${message.type()}: ${message.text()}`));
    page.on('pageerror', (error) => messages.push(String(error)));
    return await body(page, messages);
  } finally {
    await (browser ? context : used).close();
  }
}
