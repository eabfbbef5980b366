// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node try_page.mjs ADDRESS WORD PICTURE TOOLS: waits until the title of a page has WORD, and takes a picture. TOOLS is a folder
// that has playwright-core.
import { createRequire } from 'node:module';

const [address, word, picture, tools] = process.argv.slice(2);
const { chromium } = createRequire(`${tools}/package.json`)('playwright-core');
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-quic', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--enable-unsafe-swiftshader'] });
try {
  const page = await browser.newPage({ viewport: { width: 800, height: 600 } });
  page.on('console', (message) => console.log(`console: ${message.text()}`));
  page.on('pageerror', (error) => console.log(`error: ${error.message}`));
  await page.goto(address);
  await page.waitForFunction((text) => document.title.includes(text), word, { timeout: 60000 });
  await page.waitForTimeout(500);
  await page.screenshot({ path: picture });
  console.log(`${address}: ${await page.title()}; ${picture}`);
} finally {
  await browser.close();
}
