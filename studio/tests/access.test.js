// For everybody: what axe-core finds, by keyboard, by touch, on a phone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import { atRest, boxOf, kNarrow, kWide, played, settled, state, Studio } from './browser.js';

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
/** Pixels that a finger needs, and that a mouse needs. */
const kFinger = 40;
const kPointer = 24;

let studio;
before(async () => {
  studio = await Studio.open();
});
after(() => studio?.close());

/** Everything that axe-core objects to, also what it only recommends. */
async function objections(page) {
  await page.evaluate(kAxe);
  const found = await page.evaluate(async () => (await globalThis.axe.run(document, {
    runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'],
  })).violations);
  return found.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html.slice(0, 100)} ${node.any[0]?.message ?? ''}`));
}

test('axe-core is heard: it finds what is put in wrongly', async () => {
  await studio.with('', async (page) => {
    await page.evaluate(() => document.querySelector('main').append(document.createElement('button')));
    assert.match((await objections(page)).join(), /button-name/);
  });
});

const kStates = [
  ['without a model', '', async () => undefined],
  ['a mesh and its quality', '#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.click('[data-flag=quality]');
    await page.click('[data-control=clip]');
    await page.click('#panel-advanced > summary');
    await page.click('#place > summary');
    await page.click('#panel-volume .more >> nth=0');
  }],
  ['the verdict', '#sample=palm&tets=4000', async (page) => {
    await settled(page);
    await page.click('#verdict');
    await page.click('#verdict-card summary');
    await page.waitForSelector('#verdict-card li:has-text("overlap")');
  }],
  ['votes', '#sample=torus&voxels=48&view=votes', async (page) => settled(page)],
  ['the export dialog', '#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.click('#export');
  }],
  ['an error', '#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.setInputFiles('input[type=file]', { name: 'broken.stl', mimeType: '', buffer: Buffer.from('solid nothing\nfacet normal 0 0\n') });
    await page.waitForSelector('.notice.watch:not([hidden])');
  }],
  ['while playing', '#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.click('#drop');
    await played(page, 5);
  }],
];

for (const [size, viewport] of [['1280', kWide], ['390', kNarrow]])
  for (const theme of ['light', 'dark'])
    test(`axe-core has no objection at ${size} pixels, ${theme}`, async () => {
      const all = [];
      for (const [name, hash, prepare] of kStates)
        await studio.with(hash, async (page) => {
          await prepare(page);
          assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), theme);
          all.push(...(await objections(page)).map((text) => `${name}: ${text}`));
        }, viewport, theme);
      assert.deepEqual([...new Set(all)], []);
    });

/** What is seen and can be pressed, but is smaller than it should be; a label's place is its control's, too. */
async function small(page, least) {
  return page.evaluate((size) => [...document.querySelectorAll('button, input, select, summary, a')].filter((e) => {
    if (!e.checkVisibility({ visibilityProperty: true, opacityProperty: false }) || e.type === 'file') return false;
    const boxes = [e, ...(e.labels ?? [])].map((x) => x.getBoundingClientRect());
    return !boxes.some((box) => box.width >= size && box.height >= size);
  }).map((e) => `${e.outerHTML.slice(0, 80)} ${Math.round(e.getBoundingClientRect().width)} x ${Math.round(e.getBoundingClientRect().height)}`), least);
}

for (const [size, viewport, least] of [['1280', kWide, kPointer], ['390', kNarrow, kFinger]])
  test(`at ${size} pixels all that is pressed is at least ${least} pixels large, and nothing is wider than the page`, async () => {
    for (const [, hash, prepare] of kStates)
      await studio.with(hash, async (page) => {
        await prepare(page);
        assert.deepEqual(await small(page, least), []);
        const width = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(width <= viewport.width, `${width} pixels`);
      }, viewport);
  });

test('all is reached by keyboard', async () => {
  await studio.with('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.click('#panel-advanced > summary');
    await page.locator('input[data-control=passes][type=range]').focus();
    const { job } = await state(page);
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction((before) => document.getElementById('app').dataset.job !== before, job);
    await settled(page);
    await page.locator('.canvas canvas').focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('2');
    assert.match(page.url(), /view=votes/);
    await page.locator('[data-control=up][value=y]').focus();
    await page.keyboard.press('5');
    assert.match(page.url(), /view=surface/, 'a choice has no use for digits');
    await page.locator('#panel-mesh .number').first().focus();
    await page.keyboard.press('3');
    assert.match(page.url(), /view=surface/, 'a number has');
    await page.click('#export');
    await page.keyboard.press('Escape');
    assert.equal(await page.locator('dialog[open]').count(), 0);
    assert.equal(await page.evaluate(() => document.activeElement?.id), 'export', 'the keyboard is back where it was');
  });
});

/** One finger, from place to place, that stays at the last for a while. */
async function finger(page, places, stay = 0) {
  const touch = await page.context().newCDPSession(page);
  await touch.send('Emulation.setTouchEmulationEnabled', { enabled: true });
  const send = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
  await send('touchStart', [places[0]]);
  for (const place of places.slice(1)) {
    await send('touchMove', [place]);
    await page.waitForTimeout(30);
  }
  await page.waitForTimeout(stay);
  const seen = stay ? await boxOf(page) : null;
  await send('touchEnd', []);
  await touch.detach();
  return seen;
}

function line([x, y], [dx, dy], steps = 8) {
  return Array.from({ length: steps + 1 }, (_, i) => [x + (dx * i) / steps, y + (dy * i) / steps]);
}

async function middleOf(page) {
  const box = await page.locator('.canvas canvas').boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}

test('a finger turns the model, and the page does not scroll under it', async () => {
  await studio.with('#sample=heart&voxels=48', async (page) => {
    await settled(page);
    const picture = () => page.locator('.canvas canvas').screenshot();
    const before = await picture();
    await finger(page, line(await middleOf(page), [120, 40]));
    await page.waitForTimeout(300);
    assert.ok(!before.equals(await picture()));
    assert.equal(await page.evaluate(() => scrollY), 0);
  }, kNarrow);
});

test('a finger pulls the body that plays', async () => {
  await studio.with('#sample=heart&voxels=48&tets=800', async (page) => {
    await settled(page);
    await page.click('#drop');
    await played(page, 30);
    const lying = await atRest(page);
    await page.evaluate(() => scrollTo(0, 0));
    const [x, y] = await middleOf(page);
    const pulled = await finger(page, line([x, y], [0, -110]), 1500);
    assert.ok(pulled.middle[2] > lying.middle[2] + 0.05, `${lying.middle[2]} to ${pulled.middle[2]} m`);
  }, kNarrow);
});
