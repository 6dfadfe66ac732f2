// report.html in a browser: it asks for nothing, shows the numbers of results.json, draws the shell and moves it.
// node report_test.mjs PROGRAM PACKAGES OUTPUT [PICTURES]; ends with 77 if there is no Chromium.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, statSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import { openPage, runTests } from './browser.mjs';

const [program, packages, output, pictures] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));

const run = (...more) => execFileSync(program, ['run', join(here, 'case.toml'), '--quiet', '--output', output, ...more], { stdio: 'inherit' });
rmSync(output, { recursive: true, force: true });
run();
assert.ok(existsSync(join(output, 'report.html')));
run('--no-report');
assert.ok(!existsSync(join(output, 'report.html')), 'a refused report is not written, and an earlier one goes');
run();
const results = JSON.parse(readFileSync(join(output, 'results.json'), 'utf8'));

const { page, stage, address, complaints, requests, pixels, changeBy, close } = await openPage(packages, join(output, 'report.html'));

const tests = {
  async 'asks for nothing but itself'() {
    assert.deepEqual(requests, [address]);
  },
  async 'shows titles and names as texts'() {
    assert.equal(await page.evaluate(() => window.injected), undefined);
    assert.equal(await page.title(), results.title);
    assert.equal(await page.locator('h1').textContent(), results.title);
    assert.equal(await page.locator('img[src=x]').count(), 0);
  },
  async 'shows the numbers of results.json'() {
    const shown = await page.locator('[data-path]').evaluateAll((nodes) => nodes.map((n) => [n.dataset.path, n.title, n.textContent, n.className, n.closest('.tile') !== null]));
    const numbers = shown.filter(([, title]) => title !== '');
    assert.ok(numbers.length > 80, `${numbers.length} numbers`);
    for (const [path, title, text, name, isTile] of numbers) {
      const value = path.split('/').reduce((json, step) => json[step], results);
      assert.equal(Number(title), value, path);
      const digits = name.includes('rounding') ? 0.06 : isTile ? 5.01e-4 : 1e-6;
      assert.ok(Math.abs(Number(text) - value) <= digits * Math.abs(value), `${path}: ${text} is not ${value}`);
    }
    assert.equal(await page.locator('strong[data-path=status]').textContent(), results.status);
    assert.equal(await page.locator('#levels tbody tr').count(), results.levels.length);
    assert.equal(await page.locator('#history tbody tr').count(), results.history.length);
    assert.equal(await page.locator('#certificate tbody tr').count(), Object.keys(results.certificate).length);
  },
  async 'draws the shell'() {
    const { colours } = await pixels(await stage.screenshot());
    assert.ok(colours > 100, `${colours} colours`);
  },
  async 'moves the shell with the slider'() {
    const slider = page.getByLabel('Scale of the displacements');
    const moved = await changeBy(() => slider.fill('0'));
    assert.equal(await page.locator('#view').getAttribute('data-scale'), '0');
    assert.ok(moved > 2000, `${moved} pixels`);
    const back = await changeBy(() => page.getByTitle('Displacements times 1', { exact: true }).click());
    assert.ok(back > 2000, `${back} pixels`);
  },
  async 'shows any field with its scale'() {
    const select = page.locator('.choice select').first();
    assert.ok((await select.locator('option').count()) > 30);
    const changed = await changeBy(() => select.selectOption('u:length'));
    assert.ok(changed > 2000, `${changed} pixels`);
    assert.match(await page.locator('.bar-title').textContent(), /displacement.*\[m\]/);
    const largest = Number(await page.locator('.bar-labels span').last().textContent());
    assert.ok(Math.abs(largest / results.size.max_displacement - 1) < 0.01, `${largest}`);
    const other = await changeBy(() => page.locator('.choice select').nth(1).selectOption('cividis'));
    assert.ok(other > 2000, `${other} pixels`);
  },
  async 'plays the steps'() {
    const steps = page.getByLabel('Instant of the steps');
    const first = await changeBy(() => steps.fill('0'));
    assert.equal(Number(await page.locator('#view').getAttribute('data-time')), results.history[0].time);
    assert.ok(first > 500, `${first} pixels`);
    const select = page.locator('.choice select').first();
    assert.ok(['u:length', 'eta:0'].includes(await select.inputValue()));
    await select.selectOption(await select.locator('option[value*="von_mises"]').first().getAttribute('value'));
    assert.equal(Number(await page.locator('#view').getAttribute('data-time')), results.history.at(-1).time, 'other quantities are of the last instant');
    await steps.fill('0');
    await page.getByTitle('Shows the instants one after the other').click();
    await page.waitForFunction((time) => Number(document.querySelector('#view').dataset.time) === time, results.history.at(-1).time);
  },
  async 'shows the shapes of modes'() {
    const shape = page.getByLabel('Shape');
    const colours = page.locator('.choice select').first();
    const changed = await changeBy(() => shape.selectOption('buckling_1'));
    assert.ok(changed > 2000, `${changed} pixels`);
    assert.equal(await colours.inputValue(), 'buckling_1:length');
    assert.equal(await page.locator('.bar-labels span').last().textContent(), '1');
    await colours.selectOption('u:length');
    assert.equal(await shape.inputValue(), '', 'other quantities are of the solution');
    await shape.selectOption('buckling_2');
    await shape.selectOption('');
    assert.equal(await colours.inputValue(), 'u:length', 'the solution has its former colours');
    assert.equal(Number(await page.locator('#view').getAttribute('data-time')), results.history.at(-1).time);
    await shape.selectOption('buckling_1');
    await page.getByLabel('Instant of the steps').fill('0');
    assert.equal(await shape.inputValue(), '');
    assert.equal(await colours.inputValue(), 'u:length');
    await page.getByLabel('Instant of the steps').fill('1');
  },
  async 'shows and hides its layers'() {
    for (const label of ['mesh', 'undeformed', 'obstacles', 'contact boundary', 'loads']) {
      const changed = await changeBy(() => page.getByLabel(label, { exact: true }).click());
      assert.ok(changed > 300, `${label}: ${changed} pixels`);
    }
  },
  async 'shows the values at a click, and none beside the shell'() {
    const box = await stage.boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    const u = await page.locator('.probe tr[data-key=u] td').nth(1).textContent();
    assert.equal(u.split(', ').length, 3);
    assert.ok(u.split(', ').every((value) => Math.abs(Number(value)) <= results.size.max_displacement * 1.01), u);
    await page.mouse.click(box.x + 5, box.y + 5);
    assert.equal(await page.locator('.probe tr').count(), 0);
  },
  async 'turns by the keyboard and by the mouse'() {
    await stage.focus();
    const turned = await changeBy(() => page.keyboard.press('ArrowUp'));
    assert.ok(turned > 2000, `${turned} pixels`);
    await page.keyboard.press('p');
    assert.ok((await page.locator('.probe tr').count()) > 10);
    const box = await stage.boundingBox();
    const dragged = await changeBy(async () => {
      await page.mouse.move(box.x + 300, box.y + 200);
      await page.mouse.down();
      await page.mouse.move(box.x + 400, box.y + 260, { steps: 3 });
      await page.mouse.up();
    });
    assert.ok(dragged > 2000, `${dragged} pixels`);
    await page.keyboard.press('0');
  },
  async 'saves a picture'() {
    const waiting = page.waitForEvent('download');
    await page.getByText('Save picture').click();
    const file = join(output, 'shell.png');
    await (await waiting).saveAs(file);
    const { colours } = await pixels(readFileSync(file));
    assert.ok(statSync(file).size > 10000 && colours > 100, `${statSync(file).size} bytes, ${colours} colours`);
  },
  async 'follows light and dark'() {
    const changed = await changeBy(() => page.emulateMedia({ colorScheme: 'dark' }));
    const { width, height } = await stage.boundingBox();
    assert.ok(changed > (width * height) / 4, `${changed} pixels`);
  },
  async 'shows the table of meshes on a page of 1000 pixels, each row in one line'() {
    await page.setViewportSize({ width: 1000, height: 850 });
    // The longest numbers that the table can have.
    await page.locator('#levels tbody tr').first().locator('td').evaluateAll((cells) => {
      const texts = ['19', '123456', '12345678', '1234', ...Array(2).fill('-1.234567e-05'), '123456', ...Array(2).fill('-1.234567e-05'), '1234.567'];
      cells.forEach((cell, i) => { cell.textContent = texts[i]; });
    });
    const { room, width, heights, line } = await page.locator('#levels .wide').evaluate((box) => ({
      room: box.clientWidth, width: box.scrollWidth, heights: [...box.querySelectorAll('tr')].map((row) => row.offsetHeight),
      line: parseFloat(getComputedStyle(box.querySelector('td')).lineHeight),
    }));
    assert.ok(width <= room, `${width} > ${room}`);
    assert.ok(heights.every((height) => height < 2 * line), `${heights}, lines of ${line}`);
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

async function takePictures() {
  mkdirSync(pictures, { recursive: true });
  for (const width of [1280, 400])
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMedia({ colorScheme });
      await page.setViewportSize({ width, height: 900 });
      await page.screenshot({ path: join(pictures, `report-${width}-${colorScheme}.png`), fullPage: true });
    }
}

const failed = await runTests(tests);
if (pictures) await takePictures();
await close();
process.exit(failed ? 1 : 0);
