// Looks at the gallery's page in Chromium, without a network.
//
//   gallery.mjs use PAGE                                   the page as a visitor uses it
//   gallery.mjs without-webgl PAGE                         the same where there is none
//   gallery.mjs compare PAGE {SCENE.json PICTURE.png}...   its shaders against pictures of the tools: a line each, mean and
//                                                          largest difference of bytes; exit 1 where a mean is above ½ or more
//                                                          than 5 % differ by more than 1: borders of texels, and their weights
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { load } from './node_package.mjs';

const { chromium } = (await load('playwright-core')).default;
const [what, file, ...rest] = process.argv.slice(2);
const swiftshader = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const browser = await chromium.launch({
  executablePath: process.env.BURNISH_CHROMIUM,
  args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    ...(what === 'without-webgl' ? ['--disable-3d-apis'] : swiftshader)],
});
const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
const complaints = [], requests = [];
page.on('console', (m) => {
  if (['error', 'warning'].includes(m.type()) && !m.text().includes('GPU stall due to ReadPixels')) complaints.push(m.text());
});
page.on('pageerror', (e) => complaints.push(e.message));
page.on('request', (r) => { if (!/^(file|data|blob):/.test(r.url())) requests.push(r.url()); });
await page.goto(`file://${file}`);

// The bytes of a live canvas, and how many colours there are.
const canvasOf = (figure) => figure.$eval('.stage canvas', (canvas) => canvas.toDataURL());
const coloursOf = (figure) => figure.$eval('.stage canvas', (canvas) => {
  const flat = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).getContext('2d');
  flat.drawImage(canvas, 0, 0);
  return new Set(new Uint32Array(flat.getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;
});

const changed = (figure, old) => page.waitForFunction(
  ([f, was]) => f.querySelector('.stage canvas').toDataURL() !== was, [figure, old], { timeout: 30000 });

if (what === 'use') {
  const figures = await page.$$('.live');
  assert.equal(figures.length, 3);
  for (const figure of figures) {
    await figure.scrollIntoViewIfNeeded();
    await page.waitForFunction((f) => 'ready' in f.dataset, figure, { timeout: 60000 });
    const id = await figure.getAttribute('id'), before = await canvasOf(figure);
    assert(await coloursOf(figure) > 100, `${id} is empty`);
    const box = await (await figure.$('.stage')).boundingBox();
    await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.4 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.8 * box.width, box.y + 0.7 * box.height, { steps: 3 });
    await page.mouse.up();
    await changed(figure, before);
    const dragged = await canvasOf(figure);
    await (await figure.$('.stage')).press('ArrowUp');
    await changed(figure, dragged);
    for (const button of await figure.$$('.choice button')) {
      const old = await canvasOf(figure);
      if (await button.getAttribute('aria-pressed') === 'true') continue;
      await button.click();
      await changed(figure, old);
    }
    console.log(`${id}: drawn, and lit anew by pointer and key`);
  }
  const compare = await page.$('.compare'), box = await compare.boundingBox();
  await compare.scrollIntoViewIfNeeded();
  const at = () => compare.evaluate((c) => Number.parseFloat(c.style.getPropertyValue('--at')));
  const shown = async () => (await compare.screenshot()).toString('base64');
  assert.equal(await at(), 50);
  const middle = await shown(), there = await compare.boundingBox();
  await page.mouse.click(there.x + 0.9 * there.width, there.y + 0.5 * there.height);
  assert(await at() > 80 && box.width > 0, `the slider is at ${await at()}`);
  assert.notEqual(await shown(), middle);
  await (await compare.evaluateHandle((c) => c.parentElement.querySelector('.differ'))).click();
  assert(await compare.evaluate((c) => c.classList.contains('differing')));
}

if (what === 'without-webgl') {
  await page.waitForSelector('#without-webgl:not([hidden])', { timeout: 60000 });
  assert((await page.textContent('#without-webgl')).includes('WebGL'));
  assert(await page.$eval('.compare img', (i) => i.naturalWidth > 0));
  complaints.length = 0;  // Chromium's own, of the context it could not make
}

if (what === 'compare') {
  let failed = false;
  for (let i = 0; i < rest.length; i += 2) {
    const scene = readFileSync(rest[i], 'utf8'), picture = readFileSync(rest[i + 1]).toString('base64');
    const found = await page.evaluate(async ([sceneText, reference]) => {
      const bytesOf = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const scene = JSON.parse(sceneText);
      for (const f of Object.values(scene.files)) f.bytes = bytesOf(f.base64);
      const { width, height } = scene, ours = await window.gallery.pixels(scene);
      const { bitmap } = await window.gallery.pictureOf(bytesOf(reference));
      if (bitmap.width !== width || bitmap.height !== height) throw Error('the picture has another size');
      const flat = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
      flat.drawImage(bitmap, 0, 0);
      const theirs = flat.getImageData(0, 0, width, height).data;
      let sum = 0, most = 0, over = 0;
      const values = new Set();
      for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++)
          for (let c = 0; c < 3; c++) {  // WebGL's first row is the lowest
            const a = ours[4 * ((height - 1 - y) * width + x) + c], b = theirs[4 * (y * width + x) + c], d = Math.abs(a - b);
            sum += d;
            most = Math.max(most, d);
            over += d > 1;
            values.add(b);
          }
      return { mean: sum / (3 * width * height), most, over: over / (3 * width * height), values: values.size };
    }, [scene, picture]);
    const over = (100 * found.over).toFixed(2);
    console.log(`${rest[i]}: mean ${found.mean.toFixed(3)} of 255, largest ${found.most}, ${over} % differ by more than 1`);
    if (found.values < 30) { console.log(`${rest[i + 1]}: hardly a picture, ${found.values} values`); failed = true; }
    failed ||= !(found.mean <= 0.5 && found.over <= 0.05);
  }
  assert(!failed, 'a shader gives another picture than the tools');
}

await browser.close();
assert.deepEqual(requests, [], 'the page asked a network');
assert.deepEqual(complaints, [], 'the console complains');
