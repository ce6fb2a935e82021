// The live page of scree serve in a headless browser: bodies move, one drives by mouse, keys and panel, another watches.
// SCREE_PROGRAM=FILE node --test tests/viewer/live_test.mjs
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { Browser, pixelsOf } from './browser.mjs';
import { pause, Server } from './server.mjs';

const place = mkdtempSync(join(tmpdir(), 'scree-live-'));
let browser;
before(async () => (browser = await Browser.start()));
after(async () => {
  await browser.stop();
  rmSync(place, { recursive: true });
});

const scene = { bodies: [
  { name: 'ground', motion: 'fixed', shape: { plane: {} } },
  { name: 'crate', shape: { box: { half_extents: [1, 1, 1] } }, position: [0, 1, 0] },
  { name: 'ball', shape: { sphere: { radius: 0.5 } }, position: [-4, 3, 0], restitution: 0.95 },
], camera: { eye: [0, 3, 14], target: [0, 2, 0] } };

async function serving(args, work) {
  const server = await Server.start(args), pages = [];
  try {
    await work(server, async (options = {}) => {
      const page = await browser.page(server.address, { still: false, ...options });
      await page.send('Emulation.setFocusEmulationEnabled', { enabled: true });  // several pages are shown at a time
      pages.push(page);
      return page;
    });
    for (const page of pages) {
      assert.deepEqual(page.troubles, []);
      const elsewhere = page.requests.filter((request) => !request.startsWith(server.url.origin) && !request.startsWith('data:') && !request.startsWith('ws:'));
      assert.deepEqual(elsewhere, []);
    }
  } finally {
    const { status, ms } = await server.stop();
    for (const page of pages) await page.close();
    assert.equal(status, 130);
    assert.ok(ms < 2000);
  }
}
const file = () => {
  const path = join(place, 'scene.json');
  writeFileSync(path, JSON.stringify(scene));
  return path;
};
// Where a body is on the page, and in the world.
const spot = (page, name) => page.evaluate(`(() => { const p = window.scree, i = p.scene.bodies.findIndex((b) => b.name === '${name}'), c = p.renderer.canvas;
  const [x, y] = p.camera.pixelOf(p.positionOf(i)); return [x * c.clientWidth / c.width, y * c.clientHeight / c.height]; })()`);
const positionOf = (page, name) => page.evaluate(`(() => { const p = window.scree; return p.positionOf(p.scene.bodies.findIndex((b) => b.name === '${name}')); })()`);
const text = (page, id) => page.evaluate(`document.getElementById('${id}').textContent`);
const click = (page, id) => page.evaluate(`document.getElementById('${id}').click()`);
const server = (page) => page.state().then((state) => state.server);
const untilServer = (page, check) => page.until(`((s) => ${check})(window.scree.source.state)`);

test('the driver sees bodies move, pauses, grabs, throws, keeps and restores; a watcher sees the same, and takes over', { timeout: 240000 }, () => serving([file()], async (live, open) => {
  const page = await open();
  await page.until('window.scree.state().drives');
  assert.match(await text(page, 'badge'), /Live · You drive/);
  // The ball bounces: it is not where it was.
  const from = await positionOf(page, 'ball');
  await page.until(`(() => { const p = window.scree, i = p.scene.bodies.findIndex((b) => b.name === 'ball'); return Math.abs(p.positionOf(i)[1] - ${from[1]}) > 0.5; })()`);
  assert.equal(await page.evaluate('document.title'), 'scene.json · scree');

  // Space pauses, and a point steps.
  await page.evaluate("document.getElementById('view').focus()");
  await page.key('Space');
  await untilServer(page, 's.paused');
  await page.until("document.getElementById('badge').textContent.includes('Paused')");
  const { step } = await server(page);
  await page.key('.');
  await untilServer(page, `s.step === ${step + 1}`);
  await page.until(`window.scree.state().step === ${step + 1}`);
  await page.key('k');
  await untilServer(page, 's.kept !== null');
  const kept = await positionOf(page, 'crate');
  await click(page, 'play');
  await untilServer(page, '!s.paused');

  // A click chooses, with graphs.
  const [x, y] = await spot(page, 'crate');
  await page.click(x, y);
  await page.until("window.scree.state().picked === 'crate'");
  assert.equal(await text(page, 'picked-name'), 'crate');
  await page.until("document.querySelectorAll('#graphs canvas').length === 4 && window.scree.history.done > 5");

  // A drag lifts the crate; letting go while the pointer moves throws it.
  await page.mouse('mousePressed', x, y);
  await untilServer(page, 's.held !== null');
  for (let i = 1; i <= 12; ++i) {
    await page.mouse('mouseMoved', x + 6 * i, y - 14 * i);
    await pause(60);
  }
  await page.until("window.scree.positionOf(1)[1] > 2");
  assert.equal((await page.state()).held, 1);
  const pulling = pixelsOf(await page.screenshot());
  writeFileSync(join(tmpdir(), 'scree-live-driver.png'), await page.screenshot());
  let pull = 0;
  for (let v = 0; v < pulling.height; ++v) for (let u = 0; u < pulling.width; ++u) {
    const [r, g, b] = pulling.at(u, v);
    if (r > 220 && g > 190 && b < 140) ++pull;
  }
  assert.ok(pull > 20, `the pull is not drawn: ${pull} pixels`);
  await page.mouse('mouseReleased', x + 72, y - 168, 'left', 0);
  await untilServer(page, 's.held === null');
  // Beside bodies a drag turns the view.
  const { eye } = await page.state();
  await page.mouse('mousePressed', 300, 80);
  await page.mouse('mouseMoved', 360, 100);
  await page.mouse('mouseReleased', 360, 100, 'left', 0);
  await page.until(`Math.hypot(...window.scree.state().eye.map((c, i) => c - [${eye}][i])) > 0.2`);
  assert.equal((await server(page)).held, null);

  // A second viewer watches.
  const watcher = await open();
  await watcher.until("document.getElementById('badge').textContent.includes('You watch')");
  assert.equal(await watcher.evaluate("document.getElementById('play').disabled"), true);
  await watcher.evaluate("document.getElementById('view').focus()");
  await watcher.key('Space');
  await watcher.key('x');
  await pause(300);
  assert.equal((await server(watcher)).paused, false);
  await page.key('Space');
  await untilServer(watcher, 's.paused');
  await page.key('Shift+K');
  for (const one of [page, watcher]) {
    await untilServer(one, `s.step === ${step + 1}`);
    await one.until(`window.scree.state().step === ${step + 1}`);
    const again = await positionOf(one, 'crate');
    assert.ok(again.every((c, i) => Math.abs(c - kept[i]) < 0.03), `the crate is at ${again}, not ${kept}`);
  }
  // Restart.
  await click(page, 'restart');
  await watcher.until('window.scree.state().step === 0');
  assert.ok(Math.abs((await positionOf(watcher, 'ball'))[1] - 3) < 0.03);

  // Hand over, take over.
  await click(page, 'live');
  await click(page, 'wheel');
  await page.until("document.getElementById('badge').textContent.includes('Nobody drives')");
  await click(watcher, 'live');
  await watcher.until("!document.getElementById('wheel').disabled");
  await click(watcher, 'wheel');
  await watcher.until('window.scree.state().drives');
  await page.until("document.getElementById('badge').textContent.includes('You watch')");
  await click(watcher, 'play');
  await untilServer(page, '!s.paused');
}));

test('another demo, bodies, gravity, a ball and an explosion', { timeout: 240000 }, () => serving(['wall'], async (live, open) => {
  const page = await open();
  await click(page, 'live');
  const choose = (id, value) => page.evaluate(`(() => { const e = document.getElementById('${id}'); e.value = '${value}'; e.dispatchEvent(new Event('change')); })()`);
  await choose('scenes', 'pile');
  await untilServer(page, "s.scene === 'pile'");
  await page.until("window.scree.scene.head.title === 'pile' && window.scree.state().ready");
  assert.equal(await text(page, 'name'), 'pile');
  await page.evaluate("document.getElementById('bodies').value = '60'");
  await page.evaluate("document.querySelector('#live-panel .row button[title^=Open]').click()");
  await untilServer(page, 's.bodies === 60');
  await page.until('window.scree.scene.bodies.length < 100 && window.scree.scene.bodies.length > 50 && window.scree.state().drawn > 0');
  await choose('gravity', '-3');
  await untilServer(page, 's.gravity[1] === 3');
  const { there } = await server(page);
  await page.evaluate("document.getElementById('view').focus()");
  await page.mouse('mouseMoved', 640, 300, 'left', 0);
  await page.key('b');
  await untilServer(page, `s.there === ${there + 1}`);
  await page.until("window.scree.scene.bodies.some((body) => body.name === 'thrown')");
  await page.key('x');
  await pause(200);
  assert.equal((await server(page)).message, '');
  assert.equal(await text(page, 'message'), '');
  await page.drawn();
}));

test('a car is driven by keys', { timeout: 120000 }, () => serving(['cars', '--bodies', '5'], async (live, open) => {
  const page = await open();
  await page.evaluate("document.getElementById('view').focus()");
  await page.send('Input.dispatchKeyEvent', { type: 'keyDown', key: 's', code: 'KeyS', windowsVirtualKeyCode: 83, text: 's' });
  await untilServer(page, 's.vehicle.speed < -0.5 && !s.vehicle.by_route');
  assert.equal((await page.state()).follows, true);
  await page.send('Input.dispatchKeyEvent', { type: 'keyUp', key: 's', code: 'KeyS', windowsVirtualKeyCode: 83 });
  const pixels = pixelsOf(await page.screenshot());
  assert.ok(pixels.width === 1280);
}));

test('on a small screen the bar is in one row and a finger grabs', { timeout: 120000 }, () => serving([file()], async (live, open) => {
  const page = await open({ width: 390, height: 780, touch: true });
  const tops = await page.evaluate("[...new Set([...document.querySelectorAll('#bar button, #speed')].map((e) => Math.round(e.getBoundingClientRect().top)))]");
  assert.equal(tops.length, 1, `rows at ${tops}`);
  const right = await page.evaluate("Math.max(...[...document.querySelectorAll('#bar *')].map((e) => e.getBoundingClientRect().right))");
  assert.ok(right <= 390, `the bar ends at ${right}`);
  const [x, y] = await spot(page, 'crate');
  await page.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x, y }] });
  await untilServer(page, 's.held !== null');
  await page.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [{ x, y: y - 120 }] });
  await page.until('window.scree.positionOf(1)[1] > 1.5');
  await page.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await untilServer(page, 's.held === null');
}));

test('a page whose server ends says so', { timeout: 120000 }, async () => {
  const live = await Server.start(['wall']), page = await browser.page(live.address, { still: false });
  await live.stop();
  await page.until("!document.getElementById('trouble').hidden");
  assert.match(await text(page, 'trouble'), /has ended/);
  await page.until("document.getElementById('badge').textContent === 'Ended' && document.getElementById('play').disabled");
  assert.deepEqual(page.troubles, []);
  await page.close();
});
