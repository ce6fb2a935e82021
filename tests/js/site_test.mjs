// The playground within the documentation site, in a headless browser: SCREE_SITE=FOLDER node --test tests/js/site_test.mjs
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import test, { after, before } from 'node:test';
import { Browser } from '../viewer/browser.mjs';

const site = process.env.SCREE_SITE ?? 'build/site';
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm',
  '.json': 'application/json' };
const lessons = readdirSync(join(site, 'lessons')).filter((name) => name.endsWith('.html')).map((name) => name.slice(0, -5));
// The addresses of the playground that a page of the site links to.
const linksOf = (page) => [...readFileSync(join(site, page), 'utf8').matchAll(/href="\.\.\/(playground\/index\.html[^"]*)"/g)].map(([, link]) => link.replaceAll('&amp;', '&'));
let browser, server, url;

before(async () => {
  browser = await Browser.start();
  server = createServer(async (request, response) => {
    const path = normalize(new URL(request.url, 'http://localhost').pathname);
    const content = await readFile(join(site, path)).catch(() => null);
    response.writeHead(content ? 200 : 404, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' });
    response.end(content ?? '');
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  url = `http://127.0.0.1:${server.address().port}/`;
});
after(async () => {
  await browser?.stop();
  server?.closeAllConnections();
  server?.close();
});

async function opened(link, work) {
  const page = await browser.page(url + link, { still: false });
  try {
    await page.until('window.scree.state().checked', 120000);
    await work(page);
    assert.deepEqual(page.troubles, [], link);
    assert.deepEqual(page.requests.filter((request) => !request.startsWith(url) && !/^(data|blob):/.test(request)), [], link);
  } finally {
    await page.close();
  }
}

test('there are ten lessons', () => assert.equal(lessons.length, 10, lessons.join()));

for (const lesson of lessons)
  test(`the lesson ${lesson} opens its scene in the playground, and it runs there`, async () => {
    const links = linksOf(`lessons/${lesson}.html`);
    assert.deepEqual(links, [`playground/index.html?scene=${lesson}.json`]);
    const scene = JSON.parse(readFileSync(join(site, `lessons/${lesson}.json`), 'utf8'));
    await opened(links[0], async (page) => {
      const { bodies, source, troubles } = await page.state();
      assert.deepEqual(JSON.parse(source.json), scene);
      assert.ok(bodies > 1, `${bodies} bodies`);
      assert.equal(troubles, 0);
      assert.equal(await page.evaluate(`document.getElementById('name').textContent`), `${lesson}.json`);
      await page.until('window.scree.state().steps > 5', 120000);
      assert.equal((await page.state()).follows >= 0, lesson === 'car');  // the view goes with the vehicle
    });
  });

test('names of the gallery open demos of the playground', async () => {
  const links = linksOf('guide/gallery.html');
  assert.ok(links.length >= 26, links.join());
  let known = null;
  for (const name of ['wall', 'ragdolls'])
    await opened(links.find((link) => link.endsWith(`?demo=${name}`)), async (page) => {
      assert.equal((await page.state()).source.demo, name);
      known = await page.evaluate('window.scree.demos.map(({ name }) => name)');
    });
  for (const link of links) assert.ok(known.includes(link.split('=')[1]), `${link} is none of the playground's demos`);
});

test('the page of the guide opens it', () => assert.ok(linksOf('guide/playground.html').includes('playground/index.html')));
