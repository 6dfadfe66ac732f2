// node build.mjs PACKAGES OUTPUT: bundles src/main.js with what of vtk.js it imports from PACKAGES/node_modules into one script, headed by the
// licences of the packages that are in it. OUTPUT.source is what the page's policy says of it: browsers run no other script.
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, output] = process.argv.slice(2).map((path) => resolve(path));
const modules = join(packages, 'node_modules');
const { build } = createRequire(join(packages, 'package.json'))('esbuild');

const result = await build({
  entryPoints: [join(dirname(fileURLToPath(import.meta.url)), 'src', 'main.js')],
  nodePaths: [modules],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  legalComments: 'none', // the licences stand in full at the top
  logLevel: 'warning',
  metafile: true,
  write: false,
});

/** "@kitware/vtk.js" of "build/node_modules/@kitware/vtk.js/macros.js". */
function packageOf(path) {
  const parts = path.split('node_modules/').pop().split('/');
  return parts[0].startsWith('@') ? parts.slice(0, 2).join('/') : parts[0];
}

function licenceOf(name) {
  const folder = join(modules, name);
  const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e(\.\w+)?$/i.test(entry));
  const text = file ? readFileSync(join(folder, file), 'utf8').trim() : license;
  return `${name} ${version} (${license})\n\n${text}`;
}

const inside = Object.entries(Object.values(result.metafile.outputs)[0].inputs)
  .filter(([path, { bytesInOutput }]) => path.includes('node_modules/') && bytesInOutput > 0)
  .map(([path]) => packageOf(path));
const licences = [...new Set(inside)].sort().map(licenceOf).join('\n\n---\n\n');
const banner = `/*! Plastron's three-dimensional view (GPL-3.0-or-later), with parts of:\n\n${licences}\n*/\n`;
if (/<\/script|\*\/[^]*\*\//i.test(banner)) throw new Error('a licence cannot stand in a comment of a page');
const script = (banner + result.outputFiles[0].text).replaceAll('\r\n', '\n'); // a page's parser does the same
writeFileSync(output, script);
writeFileSync(`${output}.source`, `'sha256-${createHash('sha256').update(script).digest('base64')}'`);
