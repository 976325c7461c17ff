// Debian's Chromium, driven by Playwright, and what all tests need of the page.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { serve } from './server.js';

export const studio = resolve(dirname(fileURLToPath(import.meta.url)), '..');
export const repository = resolve(studio, '..');
export const dist = process.env.STUDIO_DIST ?? join(studio, 'dist');
export const kWide = { width: 1280, height: 800 };
export const kNarrow = { width: 390, height: 844 };

export const kTool = join(repository, 'build/release/bin/tetsoup');
export const kOut = join(studio, 'tests/out');

const kArguments = [
  '--headless', '--no-sandbox', '--disable-gpu', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
  '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
];

export function chromiumPath() {
  return process.env.CHROMIUM ?? '/usr/bin/chromium';
}

/** A real model beside the repository, or null. */
export function model(name) {
  const path = resolve(repository, '../shared/models', name);
  return existsSync(path) ? path : null;
}

export class Studio {
  static async open({ isolated = true, folder = dist } = {}) {
    const self = new Studio();
    self.server = await serve(folder, { isolated });
    self.profile = mkdtempSync(join(tmpdir(), 'studio-'));
    self.context = await chromium.launchPersistentContext(self.profile, {
      executablePath: chromiumPath(), args: kArguments, viewport: kWide, deviceScaleFactor: 1, colorScheme: 'light', acceptDownloads: true,
    });
    return self;
  }

  /** A page at an address of settings, of which every message on the console is kept. */
  async page(hash = '', size = kWide, theme = 'light') {
    const page = await this.context.newPage();
    await page.setViewportSize(size);
    await page.emulateMedia({ colorScheme: theme });
    page.complaints = [];
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver|swiftshader/i.test(message.text())) page.complaints.push(message.text());
    });
    page.on('pageerror', (error) => page.complaints.push(String(error)));
    await page.goto(this.server.address + hash);
    await page.waitForSelector('#app[data-threads]', { timeout: 60000 });
    return page;
  }

  /** Runs with a page that is closed afterwards and must not have complained. */
  async with(hash, body, size, theme) {
    const page = await this.page(hash, size, theme);
    try {
      await body(page);
      assert.deepEqual(page.complaints, [], 'nothing is said on the console');
    } finally {
      await page.close();
    }
  }

  async close() {
    await this.context.close();
    await this.server.close();
    rmSync(this.profile, { recursive: true, force: true });
  }
}

export async function state(page) {
  return page.evaluate(() => ({ ...document.getElementById('app').dataset }));
}

export async function settled(page, timeout = 60000) {
  await page.waitForFunction(() => ['done', 'error'].includes(document.getElementById('app').dataset.state), null, { timeout });
  const now = await state(page);
  assert.equal(now.state, 'done');
  return now;
}

/** Moves a slider as a hand does, and waits for the mesh that follows. */
export async function slide(page, control, travel) {
  const before = await state(page);
  await page.locator(`input[type=range][data-control="${control}"]`).evaluate((input, t) => {
    input.value = String(Number(input.min) + t * (Number(input.max) - Number(input.min)));
    input.dispatchEvent(new Event('input', { bubbles: true }));
    input.dispatchEvent(new Event('change', { bubbles: true }));
  }, travel);
  await page.waitForFunction((job) => {
    const { dataset } = document.getElementById('app');
    return dataset.state === 'done' && dataset.job !== job;
  }, before.job, { timeout: 60000 });
  return state(page);
}

/** Moves a slider, and waits for nothing. */
export async function push(page, control, value) {
  await page.locator(`input[type=range][data-control="${control}"]`).evaluate((input, v) => {
    input.value = String(v);
    input.dispatchEvent(new Event('input', { bubbles: true }));
    input.dispatchEvent(new Event('change', { bubbles: true }));
  }, value);
}

/** Where the slider of stiffness stands at so many powers of ten of a pascal. */
export function travelOf(stiffness) {
  return Math.round((1000 * (stiffness - 3.7)) / 3.3);
}

/** Waits until so many frames were played since it began. */
export async function played(page, frames, timeout = 60000) {
  await page.waitForFunction((n) => Number(document.getElementById('app').dataset.frames) > n, frames, { timeout });
  return state(page);
}

/** Where the first body is: least and greatest x, y, z in metres. */
export async function boxOf(page) {
  const [left, front, low, right, back, high] = (await state(page)).box.split(' ').map(Number);
  return { middle: [(left + right) / 2, (front + back) / 2, (low + high) / 2], width: right - left, height: high - low };
}

/** Waits until the first body lies still, and looks at it from near by. */
export async function atRest(page) {
  let before = await boxOf(page);
  for (let i = 0; i < 100; ++i) {
    await page.waitForTimeout(300);
    const now = await boxOf(page);
    const moved = Math.hypot(...now.middle.map((x, axis) => x - before.middle[axis]));
    before = now;
    if (moved < 0.002) break;
  }
  await page.click('[aria-label="Fit to view"]');
  await page.waitForTimeout(300);
  return before;
}

export async function dropFile(page, path) {
  await page.setInputFiles('input[type=file]', path);
}
