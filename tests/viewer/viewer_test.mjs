// The page of scree run --html in a headless browser: what it shows and tells, by mouse, by keyboard alone and on a small screen.
// SCREE_PROGRAM=FILE node --test tests/viewer/viewer_test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { pathToFileURL } from 'node:url';
import { Browser, pixelsOf } from './browser.mjs';

const program = process.env.SCREE_PROGRAM ?? 'build/release/demos/scree';
const place = mkdtempSync(join(tmpdir(), 'scree-viewer-'));
const WICKED = '</script><img src=x onerror=alert(1)>';
let browser;

function record(name, args) {
  const file = join(place, `${name}.html`);
  execFileSync(program, ['run', ...args, '--backend', 'cpu', '--quiet', '--html', file]);
  return pathToFileURL(file).href;
}
function recordScene(name, scene, args = []) {
  const file = join(place, `${name}.json`);
  writeFileSync(file, JSON.stringify(scene));
  return record(name, [file, ...args]);
}

before(async () => (browser = await Browser.start()));
after(async () => {
  await browser.stop();
  rmSync(place, { recursive: true });
});

// A page whose test ends without trouble.
async function on(url, options, work) {
  const page = await browser.page(url, options);
  try {
    await work(page);
    assert.deepEqual(page.troubles, []);
    assert.deepEqual(page.requests.filter((request) => !request.startsWith('file:') && !request.startsWith('data:')), []);
  } finally {
    await page.close();
  }
}

const near = (a, b, limit) => a.every((x, i) => Math.abs(x - b[i]) <= limit);
// Whether a part of the picture has these colours somewhere.
function has(pixels, color, limit, [left, top, right, bottom] = [0, 0, pixels.width, pixels.height]) {
  for (let y = Math.floor(top); y < bottom; ++y)
    for (let x = Math.floor(left); x < right; ++x) if (near(pixels.at(x, y), color, limit)) return true;
  return false;
}
function colorsOf(pixels) {
  const found = new Set();
  for (let y = 0; y < pixels.height; y += 3) for (let x = 0; x < pixels.width; x += 3) found.add(pixels.at(x, y).map((c) => c >> 4).join());
  return found.size;
}
// Where a body's middle is on the page.
const middleOf = (page, place) => page.evaluate(`(() => { const p = window.scree, view = document.getElementById('view');
  return p.camera.pixelOf(p.positionOf(${place})).map((x) => x * view.clientWidth / p.camera.width); })()`);
const rectangleOf = (page, id) => page.evaluate(`(() => { const r = document.getElementById('${id}').getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; })()`);

const twoBalls = {
  bodies: [
    { name: 'ground', motion: 'fixed', shape: { plane: {} } },
    { name: WICKED, shape: { sphere: { radius: 0.5 } }, position: [0, 4, 0] },
    { name: 'still', motion: 'fixed', shape: { box: { half_extents: [0.5, 0.5, 0.5] } }, position: [2, 0.5, 0] },
  ],
  camera: { eye: [0, 3, 10], target: [0, 2, 0] },
};

test('a pile is shown, with the colours of its legend, and plays', async () => {
  await on(record('pile', ['pile', '--bodies', '300', '--seconds', '3']), {}, async (page) => {
    const { bodies, frames, time } = await page.state();
    assert.equal(frames, 91);
    assert.equal(time, 0);
    const exist = await page.evaluate('window.scree.scene.bodies.length');
    assert.equal(bodies, exist);
    await page.evaluate('window.scree.seek(36)');
    await page.drawn();
    const pixels = pixelsOf(await page.screenshot());
    assert.ok(colorsOf(pixels) > 60, 'the picture is nearly blank');
    const legend = await rectangleOf(page, 'legend-bar');
    for (const part of [0, 31, 63]) {
      const hex = await page.evaluate(`window.scree.scene.head.colors.map[${part}]`);
      const color = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
      assert.ok(has(pixels, color, 4, legend), `the legend lacks ${hex}`);
    }
    // Bodies in warm colours of the scale: much red, little blue.
    let warm = 0;
    for (let y = 100; y < 560; y += 2) for (let x = 200; x < 1000; x += 2) {
      const [r, , b] = pixels.at(x, y);
      if (r > 140 && r > 1.8 * b) ++warm;
    }
    assert.ok(warm > 300, `${warm} warm pixels`);
    await page.evaluate('window.scree.setPlaying(true)');
    await page.until('window.scree.frame > 40 || window.scree.frame < 36');
    assert.equal((await page.state()).playing, true);
  });
});

test('names are text, also those that would be elements; a click tells of a body', async () => {
  await on(recordScene('balls', twoBalls, ['--seconds', '2']), {}, async (page) => {
    const at = await middleOf(page, 1);
    await page.click(at[0], at[1]);
    await page.until('window.scree.selected === 1');
    assert.equal((await page.state()).picked, WICKED);
    assert.equal(await page.evaluate(`document.getElementById('picked-name').textContent`), WICKED);
    assert.equal(await page.evaluate(`document.querySelectorAll('img').length`), 0);
    await page.until('window.scree.history.done === window.scree.source.count');
    // It falls by g: momentum and net force are those of a free fall, then there is a contact force of about its weight.
    const told = await page.evaluate(`(() => { const h = window.scree.history; return { mass: window.scree.scene.bodies[1].mass, speed: h.speed.values[15],
      momentum: h.momentum.values[15], net: h.net.values[15], contact: h.contact.values[59], air: h.contact.values[15] }; })()`);
    assert.ok(Math.abs(told.speed - 9.81 * 0.5) < 0.05, `${told.speed} m/s`);
    assert.ok(Math.abs(told.momentum / told.mass - told.speed) < 1e-3);
    assert.ok(Math.abs(told.net / told.mass - 9.81) < 0.5, `${told.net / told.mass}`);
    assert.ok(Math.abs(told.contact / told.mass - 9.81) < 1.2, `${told.contact / told.mass}`);
    assert.equal(told.air, 0);
    const graph = await page.evaluate(`document.querySelector('#graphs canvas').getAttribute('aria-label')`);
    assert.match(graph, /Momentum over time, now .* kg m\/s/);
    // The one contact at the end is where the ball meets the ground, and bears its weight.
    await page.evaluate('window.scree.seek(60)');
    await page.until('window.scree.source.now.index === 60');
    const contact = await page.evaluate(`(() => { const { now, decoder } = window.scree.source, c = now.contacts;
      return { count: c.count, a: c.a[0], b: c.b[0], point: Array.from(c.point), normal: Array.from(c.normal), force: decoder.forceOf(c.level[0]) }; })()`);
    assert.deepEqual([contact.count, contact.a, contact.b], [1, 0, 1]);
    assert.ok(near(contact.point, [0, 0, 0], 0.01), `${contact.point}`);
    assert.ok(near(contact.normal, [0, 1, 0], 0.02), `${contact.normal}`);
    assert.ok(Math.abs(contact.force / told.mass - 9.81) < 1.2, `${contact.force}`);
    // Nothing is there: no body is chosen.
    await page.click(640, 30);
    await page.until('window.scree.selected === -1');
    assert.match(await page.evaluate('document.title'), /balls/);
  });
});

test('a title is text, too', async () => {
  const file = join(place, '<b>&amp;.json');
  writeFileSync(file, JSON.stringify(twoBalls));
  await on(record('title', [file, '--steps', '2']), {}, async (page) => {
    assert.equal(await page.evaluate('document.title'), '<b>&amp;.json · scree');
    assert.equal(await page.evaluate(`document.querySelectorAll('b').length`), 0);
  });
});

test('a body that breaks is gone at its frame, and its fragments are there', async () => {
  const scene = {
    bodies: [
      { name: 'ground', motion: 'fixed', shape: { plane: {} } },
      { name: 'crate', shape: { box: { half_extents: [0.5, 0.5, 0.5] } }, position: [0, 3, 0], fracture: { impulse: 100, pieces: 5 } },
    ],
  };
  await on(recordScene('crate', scene, ['--seconds', '2']), {}, async (page) => {
    assert.equal((await page.state()).bodies, 2);
    const broke = await page.evaluate(`window.scree.scene.events.find(({ kind }) => kind === 'broke').time`);
    assert.ok(broke > 0.6 && broke < 0.9, `${broke} s`);
    const frame = Math.ceil(broke * 30 - 1e-6);
    await page.evaluate(`window.scree.seek(${frame} - 0.01)`);
    await page.drawn();
    assert.equal((await page.state()).bodies, 2);
    await page.evaluate(`window.scree.seek(${frame})`);
    await page.drawn();
    assert.equal((await page.state()).bodies, 6);
    const { drawn } = await page.state();
    assert.equal(drawn, 5);
    await page.evaluate('window.scree.seek(0)');
    await page.drawn();
    assert.equal((await page.state()).bodies, 2);
  });
});

test('the keyboard alone is enough', async () => {
  await on(recordScene('keys', twoBalls, ['--seconds', '2']), {}, async (page) => {
    await page.key('Tab');
    assert.equal(await page.evaluate('document.activeElement.id'), 'view');
    const { eye } = await page.state();
    await page.key('ArrowLeft');
    await page.drawn();
    assert.ok(!near((await page.state()).eye, eye, 0.1), 'the view turns');
    await page.key('Shift+ArrowUp');
    await page.key('+');
    await page.key('Home');
    await page.drawn();
    assert.ok(near((await page.state()).eye, eye, 1e-3), 'and returns');
    await page.key('n');
    assert.equal((await page.state()).picked, WICKED);
    assert.match(await page.evaluate(`document.getElementById('status').textContent`), /chosen: sphere/);
    await page.key('f');
    assert.equal((await page.state()).follows, true);
    await page.key('.');
    await page.key('.');
    await page.drawn();
    assert.equal((await page.state()).frame, 2);
    await page.key(',');
    assert.equal((await page.state()).frame, 1);
    await page.key('Space');
    assert.equal((await page.state()).playing, true);
    await page.key('Space');
    assert.equal((await page.state()).playing, false);
    await page.key('[');
    assert.equal((await page.state()).speed, 0.5);
    await page.key('c');
    assert.equal((await page.state()).color, 'speed');
    await page.key('Escape');
    assert.equal((await page.state()).picked, null);
    // Every control can be reached, is told to all, and shows that it has the focus.
    const reached = new Set();
    await page.evaluate(`document.getElementById('more').click(); document.getElementById('view').focus()`);
    for (let i = 0; i < 40; ++i) {
      await page.key('Tab');
      const on = await page.evaluate(`(() => { const e = document.activeElement; return [e.id, e.getAttribute('aria-label') || e.labels?.[0]?.textContent.trim()
        || e.textContent.trim(), getComputedStyle(e).outlineStyle]; })()`);
      if (!on[0]) break;
      assert.ok(on[1], `${on[0]} has no name`);
      assert.notEqual(on[2], 'none', `${on[0]} shows no focus`);
      reached.add(on[0]);
    }
    for (const id of ['play', 'time', 'speed', 'loop', 'more', 'ask', 'color', 'sky', 'theme', 'quality', 'show-velocities', 'find', 'home'])
      assert.ok(reached.has(id), `${id} is not reached`);
    await page.evaluate(`document.getElementById('time').focus()`);
    await page.key('End');
    assert.equal((await page.state()).frame, 60);
    assert.match(await page.evaluate(`document.getElementById('time').getAttribute('aria-valuetext')`), /seconds/);
  });
});

test('a small screen has all controls in reach, and a tap tells of a body', async () => {
  await on(record('small', ['pile', '--bodies', '60', '--seconds', '1']), { width: 360, height: 640, scale: 2, touch: true }, async (page) => {
    for (const id of ['play', 'time', 'speed', 'loop', 'more', 'ask', 'legend', 'title']) {
      const [left, top, right, bottom] = await rectangleOf(page, id);
      assert.ok(left >= 0 && top >= 0 && right <= 360 && bottom <= 640 && right > left, `${id}: ${[left, top, right, bottom]}`);
      if (['play', 'loop', 'more', 'ask'].includes(id)) assert.ok(right - left >= 40 && bottom - top >= 40, `${id} is too small to touch`);
    }
    assert.equal(await page.evaluate('document.documentElement.scrollWidth'), 360);
    const at = await middleOf(page, await page.evaluate('window.scree.scene.bodies.findIndex(({ mass }) => mass > 0)'));
    await page.tap(at[0], at[1]);
    await page.until('window.scree.selected >= 0');
    const [, top, , bottom] = await rectangleOf(page, 'picked');
    assert.ok(top > 200 && bottom < 600, `${top} ${bottom}`);
  });
});

test('light and dark differ, by the system and by choice', async () => {
  const url = recordScene('themes', twoBalls, ['--steps', '10']);
  const page = async (dark) => {
    let ink;
    await on(url, { dark }, async (opened) => {
      ink = await opened.evaluate('getComputedStyle(document.getElementById("bar")).backgroundColor');
      const chosen = await opened.evaluate(`(() => { const t = document.getElementById('theme'); t.value = '${dark ? 'light' : 'dark'}';
        t.dispatchEvent(new Event('change')); const ink = getComputedStyle(document.getElementById("bar")).backgroundColor;
        t.value = 'auto'; t.dispatchEvent(new Event('change')); return ink; })()`);
      assert.notEqual(chosen, ink);
    });
    return ink;
  };
  assert.notEqual(await page(true), await page(false));
});

test('all shapes and a compound are drawn, each where the program has it', async () => {
  const shapes = [{ sphere: { radius: 0.5 } }, { box: { half_extents: [0.5, 0.5, 0.5] } }, { capsule: { radius: 0.3, half_height: 0.4 } },
    { cylinder: { radius: 0.5, half_height: 0.5 } }, { cone: { radius: 0.5, height: 1 } }, { ellipsoid: { radii: [0.6, 0.4, 0.5] } },
    { hull: { points: [[0.6, 0, 0], [-0.6, 0, 0], [0, 0.6, 0], [0, -0.6, 0], [0, 0, 0.6], [0, 0, -0.6]] } },
    { compound: { parts: [{ shape: { box: { half_extents: [0.6, 0.2, 0.2] } } }, { shape: { sphere: { radius: 0.4 } }, position: [0, 0.3, 0] }] } }];
  const fixed = [{ mesh: { vertices: [[-0.6, -0.4, 0], [0.6, -0.4, 0], [0, 0.6, 0]], triangles: [[0, 1, 2]] } },
    { height_field: { columns: 2, rows: 2, spacing: 1, heights: [0.4, 0.4, -0.4, -0.4] } }];
  const scene = { gravity: [0, 0, 0], camera: { eye: [0, 0, 16], target: [0, 0, 0] },
    bodies: [...shapes, ...fixed].map((shape, i) => ({ name: `shape ${i}`, shape, position: [(i % 5) * 2 - 4, i < 5 ? 1.5 : -1.5, 0],
      ...(i >= shapes.length ? { motion: 'fixed' } : {}) })) };
  await on(recordScene('shapes', scene, ['--steps', '4']), {}, async (page) => {
    for (let i = 0; i < scene.bodies.length; ++i) {
      const at = await middleOf(page, i);
      await page.click(at[0], at[1]);
      await page.until(`window.scree.selected === ${i}`, 4000);
      assert.equal((await page.state()).picked, `shape ${i}`);
    }
  });
});
