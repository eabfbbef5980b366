// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// node validate.mjs FILE...: prints what the Khronos validator finds, a line per message; exit status
// 1 when there is an error or a warning.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

let bad = false;
for (const path of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), { uri: path });
  const { numErrors, numWarnings, numInfos, numHints } = report.issues;
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
  for (const m of report.issues.messages)
    console.log(`  ${m.severity} ${m.code} ${m.pointer}: ${m.message}`);
  bad ||= numErrors > 0 || numWarnings > 0;
}
process.exit(bad ? 1 : 0);
