// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node bundle.mjs DECODER.wasm OUT.html: the viewer as one file, with the decoder inside.
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const [decoder, out] = process.argv.slice(2);
const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const { outputFiles: [script] } = await build({
  entryPoints: [here('viewer.js')], bundle: true, minify: true, format: 'esm', target: 'es2022', write: false,
  external: ['node:fs/promises'], legalComments: 'none', charset: 'utf8',
});
const base64 = gzipSync(readFileSync(decoder), { level: 9 }).toString('base64');
const parts = {
  '<!-- the decoder -->': `<script id="decoder" type="application/octet-stream">${base64}</script>`,
  '/* the viewer */': script.text.replaceAll('</script', '<\\/script'),
};
let page = readFileSync(here('viewer.html'), 'utf8');
for (const [mark, text] of Object.entries(parts)) {
  if (!page.includes(mark))
    throw new Error(`viewer.html has no ${mark}`);
  page = page.replace(mark, () => text);
}
writeFileSync(out, page);
