// check_glb.mjs FOLDER FILE...: Khronos's validator, installed in FOLDER, finds nothing wrong with each GLB.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';

const [folder, ...files] = process.argv.slice(2);
const validator = createRequire(resolve(folder, 'package.json'))('gltf-validator');
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  const { numErrors, numWarnings } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${report.info.totalVertexCount} vertices`);
  if (numErrors + numWarnings > 0) {
    console.log(JSON.stringify(report.issues.messages.slice(0, 10), null, 1));
    process.exitCode = 1;
  }
}
