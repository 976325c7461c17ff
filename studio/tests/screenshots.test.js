// Pictures of the page at both widths, compared with those that were looked at. STUDIO_UPDATE=1 takes them anew.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import pixelmatch from 'pixelmatch';
import { PNG } from 'pngjs';
import { kNarrow, kWide, settled, Studio, studio as root } from './browser.js';

const kFolder = join(root, 'tests/screenshots');
const kOut = join(root, 'tests/out');
/** Share of pixels that may differ: fonts and drawing are not the same on all machines. */
const kTolerance = 0.03;
const kColorThreshold = 0.2;

let studio;
before(async () => {
  mkdirSync(kOut, { recursive: true });
  mkdirSync(kFolder, { recursive: true });
  studio = await Studio.open();
});
after(() => studio?.close());

const kPictures = [
  ['empty', ''],
  ['tets', '#sample=robot', async (page) => page.click('[data-control=clip]')],
  ['quality', '#sample=robot', async (page) => page.click('[data-flag=quality]')],
  ['votes', '#sample=palm&view=votes'],
  ['surface', '#sample=robot&damage=30&view=surface', async (page) => page.click('[data-control=clip]')],
  ['export', '#sample=torus', async (page) => {
    await page.click('#export');
    await page.selectOption('#export-what', 'engine:mujoco');
  }],
  ['dark', '#sample=heart&view=lattice', async (page) => page.click('[aria-label^="Switch between"]')],
];

for (const [size, viewport] of [['1280', kWide], ['390', kNarrow]])
  for (const [name, hash, prepare] of kPictures)
    test(`${name} at ${size} pixels looks as it did`, async () => {
      const page = await studio.page(hash, viewport);
      if (hash) await settled(page);
      await prepare?.(page);
      // Times differ from run to run.
      await page.addStyleTag({ content: '.status { visibility: hidden }' });
      await page.waitForTimeout(1200);
      const shot = await page.screenshot();
      await page.evaluate(() => localStorage.clear());
      await page.close();
      const path = join(kFolder, `${name}-${size}.png`);
      if (process.env.STUDIO_UPDATE === '1') return writeFileSync(path, shot);
      writeFileSync(join(kOut, `${name}-${size}.png`), shot);
      assert.ok(existsSync(path), `${path} is missing; STUDIO_UPDATE=1 takes it`);
      const [now, then] = [PNG.sync.read(shot), PNG.sync.read(readFileSync(path))];
      assert.deepEqual([now.width, now.height], [then.width, then.height]);
      const different = pixelmatch(now.data, then.data, null, now.width, now.height, { threshold: kColorThreshold });
      assert.ok(different < kTolerance * now.width * now.height, `${different} pixels differ; see tests/out/${name}-${size}.png`);
    });
