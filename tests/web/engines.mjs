// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Import maps of pages that play clips in an engine, by modules of the checkout.
import { readFileSync } from 'node:fs';

const THREE = '/tests/web/node_modules/three/', BABYLON = '/tests/web/babylon/node_modules', PAGES = '/tests/web/pages/node_modules';

export const threeImports = {
  anicodec: '/bindings/web/index.js', 'anicodec/three': '/bindings/web/three.js', 'anicodec/three/webgpu': '/bindings/web/three_webgpu.js',
  three: `${THREE}build/three.module.js`, 'three/webgpu': `${THREE}build/three.webgpu.js`, 'three/tsl': `${THREE}build/three.tsl.js`, 'three/addons/': `${THREE}examples/jsm/`,
};

export const playcanvasImports = { anicodec: '/bindings/web/index.js', 'anicodec/playcanvas': '/bindings/web/playcanvas.js', playcanvas: `${PAGES}/playcanvas/build/playcanvas.min.mjs` };

/** The package for scripts, which is one file, stands in for the one of modules, which are thousands. */
export function babylonImports() {
  const imports = { anicodec: '/bindings/web/index.js', 'anicodec/babylon': '/bindings/web/babylon.js' };
  for (const file of ['babylon.js', 'babylon_surface.js', 'babylon_instances.js']) {
    const text = readFileSync(new URL(`../../bindings/web/${file}`, import.meta.url), 'utf8');
    for (const [, names, module] of text.matchAll(/^import (?:\{ (.*) \} from )?'(@babylonjs\/.*)';$/gm)) {
      const exported = (names ?? '').split(', ').filter(Boolean).map((name) => `export const ${name} = BABYLON.${name};`);
      imports[module] = `${imports[module] ?? 'data:text/javascript,'}${exported.filter((one) => !imports[module]?.includes(one)).join('')}`;
    }
  }
  return imports;
}

export const babylonScripts = `<script src="${BABYLON}/babylonjs/babylon.js"></script><script src="${BABYLON}/babylonjs-loaders/babylon.glTF2FileLoader.js"></script>`;

/** A page with a canvas that can import what a map names. */
export const pageOf = (imports, scripts = '') => `<!doctype html><link rel=icon href="data:,">${scripts}<script type=importmap>${JSON.stringify({ imports })}</script>
<body style="margin:0"><canvas id=canvas width=320 height=240></canvas></body>`;
