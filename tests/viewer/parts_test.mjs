// The page of `plastron parts --page` in a browser: it draws the mesh by regions, names what is clicked, and follows its list.
// node parts_test.mjs PROGRAM PACKAGES OUTPUT [PICTURES [MESH...]]; ends with 77 if there is no Chromium. Pictures are also taken of each MESH.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, join, resolve } from 'node:path';

import { openPage, runTests } from './browser.mjs';

const [program, packages, output, pictures, ...meshes] = process.argv.slice(2).map((path) => resolve(path));

/** A floor, a wall at 90 degrees and a flap at 25 degrees to the wall (doubtful: the limit is 30), each of 2 x 2 facets. Element 3 is turned. */
function bentSheet() {
  const tilt = (25 * Math.PI) / 180;
  const profile = [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [2 + Math.sin(tilt), 2 + Math.cos(tilt)], [2 + 2 * Math.sin(tilt), 2 + 2 * Math.cos(tilt)]];
  const node = (i, j) => 3 * i + j + 1;
  const nodes = profile.flatMap(([x, z], i) => [0, 1, 2].map((j) => `${node(i, j)} ${x} ${j} ${z}`));
  const elements = [];
  for (let i = 0; i < 6; ++i)
    for (let j = 0; j < 2; ++j) {
      const corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
      const region = 11 + Math.floor(i / 2);
      elements.push(`${elements.length + 1} 3 2 ${region} ${region} ${(elements.length === 2 ? corners.reverse() : corners).join(' ')}`);
    }
  for (const [i, curve] of [[0, 1], [2, 2]])
    for (let j = 0; j < 2; ++j) elements.push(`${elements.length + 1} 1 2 ${curve} ${curve} ${node(i, j)} ${node(i, j + 1)}`);
  const names = ['1 1 "foot"', '1 2 "knee"', '2 11 "floor"', '2 12 "wall <img src=x onerror=window.injected=1>"', '2 13 "flap"'];
  const block = (name, lines) => `$${name}\n${lines.length}\n${lines.join('\n')}\n$End${name}\n`;
  return `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n${block('PhysicalNames', names)}${block('Nodes', nodes)}${block('Elements', elements)}`;
}

function makePage(mesh, name) {
  const file = join(output, name);
  execFileSync(program, ['parts', mesh, '--page', file], { stdio: ['ignore', 'ignore', 'pipe'] });
  return file;
}

rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
const mesh = join(output, 'sheet.msh');
writeFileSync(mesh, bentSheet());
const { page, stage, address, complaints, requests, pixels, changeBy, close } = await openPage(packages, makePage(mesh, 'sheet.html'));

const row = (key) => page.locator(`.probe tr[data-key=${key}] td`).nth(1);
const choice = (name) => page.locator('.choices button', { hasText: name });

/** Looks along -Z at the whole part, where x runs to the right, and clicks at parts of the width and the height of the stage. */
async function clickFromAbove(x, y) {
  await page.getByTitle('Seen from Z', { exact: true }).click();
  const box = await stage.boundingBox();
  await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
}

const tests = {
  async 'asks for nothing but itself'() {
    assert.deepEqual(requests, [address]);
  },
  async 'shows names as texts'() {
    assert.equal(await page.evaluate(() => window.injected), undefined);
    assert.equal(await page.locator('img[src=x]').count(), 0);
    assert.equal(await page.title(), 'Parts of sheet.msh');
  },
  async 'has the tables of the terminal'() {
    assert.equal(await page.locator('#regions tbody tr').count(), 3);
    const curves = await page.locator('#curves tbody tr td:first-child').allTextContents();
    assert.deepEqual(curves, ['foot', 'knee', 'fold 1', '(borders without name)']);
    assert.equal(await page.locator('#doubtful tbody tr').count(), 2);
    assert.match(await page.locator('.warnings').textContent(), /25 degrees/);
  },
  async 'draws each region in its colour'() {
    const colours = await page.locator('.choices button .swatch:first-child').evaluateAll((nodes) => nodes.slice(0, 3).map((n) => getComputedStyle(n).backgroundColor));
    assert.equal(new Set(colours).size, 3);
    const { colours: drawn } = await pixels(await stage.screenshot());
    assert.ok(drawn > 100, `${drawn} colours`);
  },
  async 'names the region, the cell and the normal at a click'() {
    await clickFromAbove(0.3, 0.4);
    assert.match(await row('region').textContent(), /floor in a case: region = "floor"/);
    const cell = await row('cell').textContent();
    assert.match(cell, /^element [1-4], line \d+ of the file/);
    const number = Number(cell.match(/element (\d+)/)[1]);
    const line = readFileSync(mesh, 'utf8').split('\n')[Number(cell.match(/line (\d+)/)[1]) - 1];
    assert.ok(line.startsWith(`${number} 3 2 11`), line);
    assert.match(await row('normal').textContent(), /^\(0, 0, -?1\)$/);
    assert.match(await page.locator('.probe').textContent(), /boundary = "foot"/);
    const box = await stage.boundingBox();
    await page.mouse.click(box.x + 5, box.y + box.height - 5);
    assert.equal(await page.locator('.probe tr').count(), 0);
  },
  async 'says which cell was turned'() {
    const found = [];
    for (const x of [0.3, 0.5])
      for (const y of [0.4, 0.62]) {
        await clickFromAbove(x, y);
        found.push(await row('cell').textContent());
      }
    assert.equal(new Set(found).size, 4, found.join('; '));
    await clickFromAbove(0.02, 0.02); // beside the part: nothing covers the picture any more
    assert.deepEqual(found.filter((text) => text.includes('turned')).map((text) => text.split(',')[0]), ['element 3']);
  },
  async 'shows the two sides in different shades'() {
    await page.getByLabel('normals a3').uncheck();
    await page.getByTitle('Seen from Z', { exact: true }).click();
    const above = await stage.screenshot();
    await page.getByTitle('Seen from -Z', { exact: true }).click();
    const mean = (png) => page.evaluate(async (text) => {
      const image = new Image();
      image.src = `data:image/png;base64,${text}`;
      await image.decode();
      const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data.reduce((sum, value) => sum + value, 0) / (image.width * image.height);
    }, png.toString('base64'));
    const difference = Math.abs((await mean(above)) - (await mean(await stage.screenshot())));
    assert.ok(difference > 20, `${difference}`);
    await page.getByTitle('The first view again (key 0)').click();
    await page.getByLabel('normals a3').check();
  },
  async 'shows and hides its layers'() {
    for (const label of ['normals a3', /turned cells/, 'mesh', 'names of regions', 'names of curves', 'see through', /border \(/, /fold \(/, /doubtful \(/]) {
      const box = page.getByLabel(label, { exact: true }).first();
      const changed = await changeBy(() => box.click());
      assert.ok(changed > 30, `${label}: ${changed} pixels`);
      await box.click();
    }
  },
  async 'shows the region and the curve that are chosen'() {
    for (const [name, least] of [['floor', 2000], ['knee', 200], ['(borders', 200]]) {
      const changed = await changeBy(() => choice(name).click());
      assert.ok(changed > least, `${name}: ${changed} pixels`);
      assert.equal(await choice(name).getAttribute('aria-pressed'), 'true');
      await choice(name).click();
      assert.equal(await choice(name).getAttribute('aria-pressed'), 'false');
    }
  },
  async 'writes names beside the part, and none over another'() {
    const boxes = await page.locator('.label3d:not([hidden])').evaluateAll((nodes) => nodes.map((n) => [n.textContent.trim(), n.getBoundingClientRect().toJSON()]));
    const names = boxes.map(([name]) => name);
    for (const name of ['foot', 'floor', 'flap']) assert.ok(names.includes(name), `${name}: ${names}`);
    boxes.forEach(([, a], k) => boxes.slice(k + 1).forEach(([, b]) => assert.ok(a.right < b.left + 1 || b.right < a.left + 1 || a.bottom < b.top + 1 || b.bottom < a.top + 1)));
  },
  async 'turns by the keyboard, and the names follow'() {
    const place = () => page.locator('.label3d', { hasText: 'flap' }).evaluate((n) => n.style.transform);
    const before = await place();
    await stage.focus();
    const turned = await changeBy(() => page.keyboard.press('ArrowLeft'));
    assert.ok(turned > 2000, `${turned} pixels`);
    await page.waitForTimeout(400);
    assert.notEqual(await place(), before);
    await page.keyboard.press('0');
  },
  async 'saves a picture'() {
    const waiting = page.waitForEvent('download');
    await page.getByText('Save picture').click();
    const file = join(output, 'parts.png');
    await (await waiting).saveAs(file);
    const { colours } = await pixels(readFileSync(file));
    assert.ok(statSync(file).size > 10000 && colours > 100, `${statSync(file).size} bytes, ${colours} colours`);
  },
  async 'follows light and dark'() {
    const changed = await changeBy(() => page.emulateMedia({ colorScheme: 'dark' }));
    const { width, height } = await stage.boundingBox();
    assert.ok(changed > (width * height) / 4, `${changed} pixels`);
  },
  async 'fits a phone'() {
    await page.setViewportSize({ width: 400, height: 850 });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 400);
    const { colours } = await pixels(await stage.screenshot());
    assert.ok(colours > 100, `${colours} colours`);
  },
  async 'has not complained'() {
    assert.deepEqual(complaints, []);
  },
};

async function takePictures(shown, name) {
  mkdirSync(pictures, { recursive: true });
  for (const [width, height] of [[1400, 900], [400, 900]])
    for (const colorScheme of ['light', 'dark']) {
      await shown.emulateMedia({ colorScheme });
      await shown.setViewportSize({ width, height });
      await shown.waitForTimeout(500);
      await shown.screenshot({ path: join(pictures, `${name}-${width}-${colorScheme}.png`), fullPage: true });
    }
}

const failed = await runTests(tests);
if (pictures) await takePictures(page, 'parts');
await close();
for (const file of meshes) {
  const name = basename(file).replace(/\W+/g, '-');
  const opened = await openPage(packages, makePage(file, `${name}.html`));
  await takePictures(opened.page, name);
  await opened.close();
}
process.exit(failed ? 1 : 0);
