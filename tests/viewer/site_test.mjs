// Reports of the site in a browser, opened as files from its gallery: each has the title of its case, draws its view and complains of nothing.
// node site_test.mjs PACKAGES SITE; ends with 77 if there is no Chromium. At most five reports, spread over all; scripts/build-site --browser.
import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

import { openPage, runTests } from './browser.mjs';

const [packages, site] = process.argv.slice(2).map((path) => resolve(path));
const file = (name, of) => join(site, 'cases', name, 'results', of);
const all = readdirSync(join(site, 'cases')).filter((name) => existsSync(file(name, 'report.html')));
const chosen = all.filter((_, k) => k % Math.ceil(all.length / 5) === 0);
assert.ok(chosen.length > 0, 'the site has no report');
const { page, stage, complaints, requests, pixels, close } = await openPage(packages, file(chosen[0], 'report.html'));

async function show(name) {
  await page.goto(pathToFileURL(join(site, 'docs', 'gallery.html')).href);
  await page.locator(`a[href$="/${name}/results/report.html"]`).click();
  await page.waitForSelector('#view[data-ready]', { timeout: 60000 });
  assert.equal(await page.title(), JSON.parse(readFileSync(file(name, 'results.json'), 'utf8')).title);
  assert.ok((await pixels(await stage.screenshot())).colours > 100, 'the view is empty');
  assert.deepEqual(complaints, []);
}

const tests = Object.fromEntries(chosen.map((name) => [`shows ${name}`, () => show(name)]));
tests['asks for nothing outside of the site'] = () => {
  assert.deepEqual(requests.filter((address) => !address.startsWith(pathToFileURL(site).href)), []);
};
const failed = await runTests(tests);
await close();
process.exitCode = failed > 0 ? 1 : 0;
