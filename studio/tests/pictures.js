// Takes the pictures of docs/STUDIO.md: node tests/pictures.js
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { kNarrow, repository, settled, Studio } from './browser.js';

const folder = join(repository, 'docs/images/studio');
mkdirSync(folder, { recursive: true });
const studio = await Studio.open();
async function take(name, hash, prepare, size) {
  const page = await studio.page(hash, size);
  if (hash) await settled(page);
  await prepare?.(page);
  await page.waitForTimeout(1200);
  await page.screenshot({ path: join(folder, `${name}.jpg`), type: 'jpeg', quality: 80 });
  await page.close();
}
await take('tets', '#sample=robot', (page) => page.click('[data-control=clip]'));
await take('votes', '#sample=palm&view=votes');
await take('quality', '#sample=robot', (page) => page.click('[data-flag=quality]'), kNarrow);
await take('play', '', async (page) => {
  await page.click('#watch');
  await page.waitForFunction(() => Number(document.getElementById('app').dataset.frames) > 75, null, { timeout: 60000 });
});
await studio.close();
