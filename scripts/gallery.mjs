// docs/gallery.md and its pictures from results: node scripts/gallery.mjs PACKAGES RESULTS [CASE...]. PACKAGES has playwright-core, RESULTS a
// folder for each case; CASE: pictures of these alone. Numbers are those of results.json, with the digits of report.html; pictures are what "Save picture" of report.html gives.
// scripts/gallery.json says for each case which numbers, and which picture where it is not the page's first; one with a
// "place" has a picture for that place and no section.
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const [packages, results] = process.argv.slice(2, 4).map((path) => resolve(path));
const only = process.argv.slice(4);
const root = dirname(dirname(fileURLToPath(import.meta.url)));
const read = (...path) => readFileSync(join(root, ...path), 'utf8');
const entries = JSON.parse(read('scripts', 'gallery.json'));

/** As printf's %.7g, which report.html uses. */
function sevenDigits(value) {
  const [digits, exponent] = value.toExponential(6).split('e').map(Number);
  if (value === 0 || (exponent >= -4 && exponent < 7)) return String(Number(value.toPrecision(7)));
  return `${digits}e${exponent < 0 ? '-' : '+'}${String(Math.abs(exponent)).padStart(2, '0')}`;
}

const valueOrNull = (json, path) => path.split('.').reduce((part, step) => part?.[step], json);

function valueAt(json, path) {
  const value = valueOrNull(json, path);
  if (!Number.isFinite(value)) throw new Error(`results.json of "${json.title}" has no number ${path}`);
  return value;
}

/** The number at a path like probes.tip.u.2 of results.json, with its unit. Beside a much larger number, rounding counts as 0. */
function numberAt(json, path, beside = 0) {
  const steps = path.split('.');
  const given = valueAt(json, path);
  const value = Math.abs(given) <= 1e-10 * Math.abs(beside) ? 0 : given;
  const place = steps.filter((step, k) => k < steps.length - 1 || !/^\d+$/.test(step)); // without the component of a vector
  const isNamed = (key) => key.split('/').length === place.length && key.split('/').every((part, k) => part === '*' || part === place[k]);
  const unit = json.units[Object.keys(json.units).find(isNamed)];
  if (unit === undefined) throw new Error(`results.json has no unit for ${path}`);
  return `${sevenDigits(value)}${unit === '1' ? '' : ` ${unit}`}`;
}

/** The picture is a file of the results, or the view of report.html with what the entry says of it. */
const pictureFile = (entry) => `${entry.case}${typeof entry.picture === 'string' ? extname(entry.picture) : '.webp'}`;

const question = (text) => text.match(/\*\*Question\.\*\* ([\s\S]*?)\n\n/)[1].replace(/\s+/g, ' ').trim();

/** The answers of an entry in a file of results, beside those of another file. */
const answers = (entry, json, other = json) =>
  entry.answers.map(([label, path]) => `${label} **${numberAt(json, path, valueAt(other, path))}** (\`${path}\`)`).join('; ');

/** The answers of the other model where they were computed, else the largest difference of the two models, in per cent. */
function linearity(entry, json) {
  const linear = join(results, `${entry.case}-linear`, 'results.json');
  if (existsSync(linear)) {
    const other = JSON.parse(readFileSync(linear, 'utf8'));
    const known = entry.answers.filter(([, path]) => Number.isFinite(valueOrNull(other, path)));
    return `Rotations are finite. In the linear model ${answers({ ...entry, answers: known }, other)}.`;
  }
  if (json.rotations === 'finite') return 'Rotations are finite.';
  const finite = join(results, `${entry.case}-finite`, 'results.json');
  if (existsSync(finite)) return `With finite rotations ${answers(entry, JSON.parse(readFileSync(finite, 'utf8')), json)}.`;
  const part = json.linearity.difference;
  if (part === null) return 'With finite rotations there is no stable solution nearby.';
  const share = part < 1e-4 ? 'less than 0.01' : part < 10 ? Number((100 * part).toPrecision(2)) : 'more than 1000';
  return `Finite rotations: ${share} %.`;
}

function section(entry) {
  const json = JSON.parse(readFileSync(join(results, entry.case, 'results.json'), 'utf8'));
  return `## ${json.title}

![${json.title}](gallery/${pictureFile(entry)})

${question(read('cases', entry.case, 'README.md'))}

Answer: ${answers(entry, json)}. ${linearity(entry, json)} Case [${entry.case}](../cases/${entry.case}/README.md)
`;
}

const top = `# Gallery

\`plastron run cases/NAME/case.toml --output out/NAME\` computes a case of [cases](../cases). Each answer has its path in \`results.json\`.
Answers are those of the linear model, unless the case says \`rotations = "finite"\`. "Finite rotations" is the largest difference of energy, reactions and displacement from the
[model of finite rotations](methods/finite-rotations.md). From 5 % on the run warns, and the answer of that model stands beside.
Red lines bound contact zones, grey surfaces are obstacles. Small displacements are enlarged.

\`plastron new mine --from NAME\` copies a case with its meshes ([new](command-line.md#new)). \`scripts/build-site\` makes a site with the interactive report of each case. The [tutorial](python.md) is
a notebook with its results. \`scripts/make-gallery\` makes this page.
`;

/** The picture that the page saves, as WebP: a fifth of the PNG. */
async function takePicture(page, entry) {
  const { shape, field, scale, layers = {}, view, keys = [] } = entry.picture ?? {};
  await page.goto(pathToFileURL(join(results, entry.case, 'report.html')).href);
  await page.waitForSelector('#view[data-ready]', { timeout: 60000 });
  if (shape) await page.getByLabel('Shape').selectOption(shape);
  if (field) await page.locator('.choice select').first().selectOption(field);
  if (scale !== undefined) await page.getByLabel('Scale of the displacements').fill(String(scale));
  for (const [label, is] of Object.entries(layers)) await page.getByLabel(label, { exact: true }).setChecked(is);
  if (view) await page.getByTitle(`Seen from ${view}`, { exact: true }).click();
  await page.locator('.stage').focus();
  for (const key of keys) await page.keyboard.press(key);
  const waiting = page.waitForEvent('download');
  await page.getByText('Save picture').click();
  const png = readFileSync(await (await waiting).path());
  const webp = await page.evaluate(async (text) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    canvas.getContext('2d').drawImage(image, 0, 0);
    return canvas.toDataURL('image/webp', 0.85).split(',')[1];
  }, png.toString('base64'));
  return Buffer.from(webp, 'base64');
}

const { chromium } = createRequire(join(packages, 'package.json'))('playwright-core');
const profile = mkdtempSync(join(tmpdir(), 'plastron-gallery-'));
const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];
const browser = await chromium.launchPersistentContext(profile, {
  executablePath: '/usr/bin/chromium', headless: true, args: flags, viewport: { width: 760, height: 600 }, colorScheme: 'light', offline: true,
});
try {
  if (only.length === 0) rmSync(join(root, 'docs', 'gallery'), { recursive: true, force: true });
  mkdirSync(join(root, 'docs', 'gallery'), { recursive: true });
  for (const entry of entries.filter((each) => only.length === 0 || only.includes(each.case))) {
    const isFile = typeof entry.picture === 'string';
    const bytes = isFile ? readFileSync(join(results, entry.case, entry.picture)) : await takePicture(browser.pages()[0], entry);
    writeFileSync(join(root, 'docs', 'gallery', pictureFile(entry)), bytes);
  }
  writeFileSync(join(root, 'docs', 'gallery.md'), [top, ...entries.filter((entry) => !entry.place).map(section)].join('\n'));
} finally {
  await browser.close();
  rmSync(profile, { recursive: true, force: true });
}
