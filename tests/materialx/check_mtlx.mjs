// check_mtlx.mjs FOLDER FILE... --wrong FILE...: the MaterialX library, installed in FOLDER, finds each file valid, a
// definition for each of its nodes and inputs, and shaders for its materials; and those after --wrong not.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

const [folder, ...files] = process.argv.slice(2), mark = [...files, '--wrong'].indexOf('--wrong');
const bin = resolve(folder, 'node_modules/@needle-tools/materialx/bin');
globalThis.require = createRequire(import.meta.url); // the library is built for a page and for CommonJS
globalThis.__dirname = bin;
const { default: open } = await import(`${bin}/JsMaterialXGenShader.js`);
const library = await open({
  locateFile: name => resolve(bin, name.endsWith('.data') ? `${name}.txt` : name),
  wasmBinary: readFileSync(`${bin}/JsMaterialXGenShader.wasm`),
});
const generator = library.EsslShaderGenerator.create();
const context = new library.GenContext(generator);
const definitions = library.loadStandardLibraries(context);

function lengthOfShader(material) {
  try {
    return generator.generate(material.getName(), material, context).getSourceCode('pixel').length;
  } catch {
    return 0; // a node or input that is unknown
  }
}

// What is wrong with it; empty where nothing is.
async function complaint(file) {
  const document = library.createDocument();
  await library.readFromXmlString(document, readFileSync(file, 'utf8'));
  document.importLibrary(definitions);
  const said = {};
  if (!document.validate(said)) {
    return said.message.trim();
  }
  const unknown = document.getNodes().filter(node => !node.getNodeDef()).map(node => node.getCategory());
  if (unknown.length) {
    return `no definition of ${unknown.join(', ')}`;
  }
  const lengths = document.getMaterialNodes().map(lengthOfShader);
  return lengths.length && !lengths.includes(0) ? '' : `shaders of ${lengths.join(', ')} characters`;
}

for (const [i, file] of files.entries()) {
  if (i !== mark) {
    const found = await complaint(file), isMeant = i > mark;
    console.log(`${file}: ${found || 'valid'}${isMeant ? ', which was meant' : ''}`);
    process.exitCode ||= Boolean(found) === isMeant ? 0 : 1;
  }
}
