// What a step of each slider takes in the page, from the wish to the finished picture, and of it in the core: a table.
// On a machine with nothing else to do: node tests/times.js
import { settled, slide, Studio } from './browser.js';

const kSteps = 9;
/** The sliders, and where along their way each goes back and forth. */
const kSliders = [['k', 0.8, 0.95], ['tets', 0.45, 0.5], ['rho', 0.35, 0.55], ['translate-x', 0.3, 0.7], ['passes', 0.3, 0.6]];

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

async function measure(isolated) {
  const studio = await Studio.open({ isolated });
  const page = await studio.page('#sample=robot&voxels=96&tets=2000');
  await settled(page);
  await page.click('#panel-advanced > summary');
  await page.click('[data-control=k-auto]');
  await page.click('#place > summary');
  await settled(page);
  const rows = [];
  for (const [control, from, to] of kSliders) {
    const whole = [];
    const core = [];
    for (let i = 0; i <= kSteps; ++i) {
      const { ms, core: inside } = await slide(page, control, from + ((to - from) * ((i * 4) % (kSteps + 1))) / kSteps);
      if (i > 0) whole.push(Number(ms)), core.push(Number(inside));
    }
    rows.push([control, median(core).toFixed(0), median(whole).toFixed(0), Math.max(...whole).toFixed(0)]);
  }
  await studio.close();
  return rows;
}

for (const isolated of [true, false]) {
  console.log(`\n| slider, ${isolated ? 'threads' : 'one thread'} | in the worker, ms | to the picture, ms | at most |\n|---|---|---|---|`);
  for (const row of await measure(isolated)) console.log(`| ${row.join(' | ')} |`);
}
