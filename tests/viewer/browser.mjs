// A page in a headless Chromium without a network, for the tests of pages.
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const chromiumPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
if (!chromiumPath) {
  console.log('skipped: Chromium is not installed (scripts/test-report installs it)');
  process.exit(77);
}

const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** Opens a file and waits for its view. PACKAGES has playwright-core. */
export async function openPage(packages, file) {
  const { chromium } = createRequire(join(packages, 'package.json'))('playwright-core');
  const profile = mkdtempSync(join(tmpdir(), 'plastron-browser-'));
  const browser = await chromium.launchPersistentContext(profile, {
    executablePath: chromiumPath, headless: true, args: flags, viewport: { width: 1280, height: 1000 }, colorScheme: 'light', offline: true,
  });
  const close = async () => {
    await browser.close();
    rmSync(profile, { recursive: true, force: true });
  };
  const page = browser.pages()[0];
  const complaints = [];
  const requests = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('request', (request) => /^(data|blob):/.test(request.url()) || requests.push(request.url()));
  const address = pathToFileURL(file).href;
  const stage = page.locator('.stage');

  /** How many colours a PNG has, and at how many places two PNGs differ. Decoded by the browser. */
  const pixels = (...pngs) =>
    page.evaluate(async (texts) => {
      const images = await Promise.all(texts.map(async (text) => {
        const image = new Image();
        image.src = `data:image/png;base64,${text}`;
        await image.decode();
        const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
        const context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        return new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
      }));
      const differences = images.length > 1 ? images[0].reduce((sum, value, i) => sum + (value !== images[1][i] ? 1 : 0), 0) : 0;
      return { colours: new Set(images[0]).size, differences };
    }, pngs.map((png) => png.toString('base64')));

  /** The stage twice, before and after something was done: at how many pixels they differ. */
  const changeBy = async (action) => {
    const before = await stage.screenshot();
    await action();
    return (await pixels(before, await stage.screenshot())).differences;
  };

  try {
    await page.goto(address);
    await page.waitForSelector('#view[data-ready]', { timeout: 60000 });
  } catch (error) {
    console.log(complaints.join('\n'));
    await close();
    throw error;
  }
  return { page, stage, address, complaints, requests, pixels, changeBy, close };
}

/** Runs {name: async function} and returns how many failed. */
export async function runTests(tests) {
  let failed = 0;
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log(`ok      ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n${error.message}`);
    }
  }
  return failed;
}
