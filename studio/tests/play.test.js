// Bodies that fall, are pulled, and become softer; how fast all that is.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { atRest, boxOf, played, push, settled, state, Studio, travelOf } from './browser.js';

/** Milliseconds that simulating a frame may take: 20 frames a second. */
const kMostSimulating = 50;
/** Frames a second to be seen of the robots where a processor draws, half of what two busy cores do. */
const kLeastFrames = 10;

let studio;
before(async () => {
  studio = await Studio.open();
});
after(() => studio?.close());

/** Waits until a body's box is as it shall be. */
async function until(page, enough, what) {
  let box;
  for (let i = 0; i < 100; ++i) {
    box = await boxOf(page);
    if (enough(box)) return box;
    await page.waitForTimeout(100);
  }
  return assert.fail(`${what}: ${JSON.stringify(box)}`);
}

test('a body falls, is pulled by the mouse, falls again, and starts anew', async () => {
  await studio.with('#sample=sphere&voxels=48&tets=800', async (page) => {
    await settled(page);
    await page.click('#drop');
    await played(page, 1);
    const high = (await boxOf(page)).middle[2];
    await until(page, (box) => box.middle[2] < high - 0.25, 'it falls');
    const lying = await atRest(page);
    const canvas = await page.locator('.canvas canvas').boundingBox();
    const [x, y] = [canvas.x + canvas.width / 2, canvas.y + canvas.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x, y - 300, { steps: 6 });
    await until(page, (box) => box.middle[2] > lying.middle[2] + 0.1, 'it is pulled up');
    await page.mouse.move(x + 250, y - 300, { steps: 6 });
    await until(page, (box) => box.middle[0] > lying.middle[0] + 0.1, 'it is pulled aside');
    await page.mouse.up();
    await until(page, (box) => box.middle[2] < lying.middle[2] + 0.05, 'it falls again');
    await page.click('#pause');
    await page.waitForTimeout(300);
    const { frames } = await state(page);
    await page.waitForTimeout(300);
    assert.equal((await state(page)).frames, frames, 'a pause');
    await page.click('#reset');
    await page.waitForFunction((n) => Number(document.getElementById('app').dataset.frames) < n, Number(frames));
    await until(page, (box) => box.middle[2] > lying.middle[2] + 0.2, 'it starts where it did');
    await page.click('#back');
    await page.waitForSelector('.bar .segments input[value=votes]', { state: 'attached' });
    assert.equal((await state(page)).state, 'done');
    assert.match(await page.textContent('.status'), /tets in/);
  });
});

test('a softer body is flatter where it lies, and a stiffer one rises', async () => {
  await studio.with('#sample=sphere&voxels=48&tets=500&stiffness=6.5', async (page) => {
    await settled(page);
    await page.click('#drop');
    await played(page, 90);
    const stiff = await boxOf(page);
    await push(page, 'stiffness', travelOf(3.7));
    const soft = await until(page, (box) => box.height < 0.8 * stiff.height, 'it sinks');
    assert.ok(soft.width > stiff.width, 'what it loses in height it wins in width');
    await push(page, 'stiffness', travelOf(6.5));
    await until(page, (box) => box.height > 0.95 * stiff.height, 'it rises');
  });
});

test('four robots on the tree are simulated at 20 frames a second or better, and seen moving', async () => {
  await studio.with('', async (page) => {
    await page.click('#watch');
    const { simulate, draw, fps } = await played(page, 60);
    console.log(`# simulating ${simulate} ms a frame, drawing without a GPU ${draw} ms, ${fps} frames/s shown`);
    assert.ok(Number(simulate) < kMostSimulating, `${simulate} ms a frame`);
    assert.ok(Number(fps) >= kLeastFrames, `${fps} frames/s`);
    assert.match(await page.textContent('[data-report=simulation]'), /No graphics card/, 'who draws is said');
    assert.match(await page.textContent('.status'), /frames\/s · simulating .*, drawing/, 'times are said apart');
  });
});

test('a body falls in its own size, of the material that is said, and the panel shows that alone', async () => {
  await studio.with('#sample=torus&voxels=48&tets=500&unit=cm&stiffness=5.2', async (page) => {
    await settled(page);
    const said = await page.textContent('[data-report=simulation]');
    assert.match(await page.textContent('#panel-simulation .brief'), /^\d+ kPa$/);
    assert.match(said, /1\.5 m long, [\d,.]+ kg/);
    await page.click('#drop');
    await played(page, 30);
    const box = await boxOf(page);
    assert.ok(Math.abs(box.width / 1.5 - 1) < 0.2, `${box.width} m`);
    assert.equal(await page.locator('#panel-soup').isVisible(), false);
    assert.equal(await page.locator('#panel-simulation').isVisible(), true);
    await page.click('#back');
    assert.equal(await page.locator('#panel-soup').isVisible(), true);
  });
});
