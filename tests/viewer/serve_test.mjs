// scree serve and its protocol: who gets in, what is refused, who drives, and how it ends.
// SCREE_PROGRAM=FILE node --test tests/viewer/serve_test.mjs
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { inflateSync } from 'node:zlib';
import { chunksOf, Reader } from '../../demos/viewer/bytes.js';
import { FrameDecoder } from '../../demos/viewer/frames.js';
import { Scene } from '../../demos/viewer/scene.js';
import { pause, Server } from './server.mjs';

const program = process.env.SCREE_PROGRAM ?? 'build/release/demos/scree';
const without = spawnSync(program, ['serve', 'nothing'], { timeout: 20000, encoding: 'utf8' }).stderr?.match(/this scree was built without.*/)?.[0];
const options = without ? { skip: without } : { timeout: 120000 };
const place = mkdtempSync(join(tmpdir(), 'scree-serve-'));
test.after(() => rmSync(place, { recursive: true }));

// A viewer's page without a picture: what it knows after each block.
class Eyes {
  constructor(viewer) {
    this.viewer = viewer;
    this.moments = 0;
    this.wholes = 0;
    viewer.onBlock = (block) => this.take(block);
  }
  take(block) {
    assert.equal(block[0], 1);
    for (const chunk of chunksOf(new Uint8Array(inflateSync(block.subarray(1))))) {
      if (chunk.name === 'head') {
        if (this.expectsScene()) this.scene = new Scene();
        this.scene.take(chunk);
        this.decoder = new FrameDecoder(this.scene.head.units);
      } else if (chunk.name === 'fram') {
        const from = new Reader(chunk.bytes);
        from.f64();
        from.count();
        if (from.u8() & 1) ++this.wholes;
        this.decoder.planes = this.scene.bodies.map((body) => body.plane !== null);
        this.decoder.decode(chunk.bytes, this.moments++);
        if (this.viewer.follows) this.viewer.seen(this.moments);
      } else {
        this.scene.take(chunk);
      }
    }
  }
  expectsScene() {
    const begins = this.viewer.texts.filter(({ type }) => type === 'begin').length, first = begins !== this.begins;
    this.begins = begins;
    return first;
  }
  get now() { return this.decoder.now; }
  position(place) { return [0, 1, 2].map((k) => this.now.position[3 * place + k] * this.scene.head.units.position); }
  placeOf(name) { return this.scene.bodies.findIndex((body) => body.name === name); }
}

const fall = { bodies: [{ name: 'ground', motion: 'fixed', shape: { plane: {} } }, { name: 'ball', shape: { sphere: { radius: 0.5 } }, position: [0, 40, 0] },
  { name: 'box', shape: { box: { half_extents: [0.5, 0.5, 0.5] } }, position: [3, 0.5, 0] }], camera: { eye: [0, 3, 12], target: [0, 2, 0] } };
function sceneFile(name, scene) {
  const file = join(place, `${name}.json`);
  writeFileSync(file, JSON.stringify(scene));
  return file;
}
// A server for the work, which must end well.
async function serving(args, work) {
  const server = await Server.start(args);
  try {
    await work(server);
  } finally {
    const end = await server.stop();
    assert.equal(end.status, 130, `ended by ${end.signal}: ${server.errors}`);
    assert.ok(end.ms < 2000, `took ${end.ms} ms to end`);
  }
}
// Looks from the front at a point of the plane z = 0.
const at = (x, y) => ({ eye: [x, y, 10], target: [x, y, 0], fov: 45, width: 800, height: 600, x: 400, y: 300 });

test('serve: the page and the stream are for those with the token, from its own address', options, () => serving(['wall'], async (server) => {
  assert.match(server.address, /^http:\/\/127\.0\.0\.1:\d+\/\?token=[0-9a-f]{32}$/);
  const page = await server.get(`/?token=${server.token}`);
  assert.equal(page.status, 200);
  assert.match(page.text, /data-kind="live"/);
  assert.match(page.text, /connect-src 'self' ws:\/\/127\.0\.0\.1:\d+;/);
  assert.match(page.text, /Referrer-Policy: no-referrer/);
  const statusOf = async (path, headers) => (await server.get(path, headers)).status;
  const other = server.token.replace(/./g, (c) => (c === '0' ? '1' : '0'));
  for (const token of ['', other, server.token.slice(1), `${server.token}0`, `%${server.token}`])
    assert.equal(await statusOf(`/?token=${token}`), 403, token);
  assert.equal(await statusOf('/'), 403);
  for (const path of ['/favicon.ico', '/etc/passwd', '/../../etc/passwd', '//', '/index.html', '/stream/', '/%2e%2e/', '/?token', `/x?token=${server.token}`])
    assert.equal(await statusOf(path), path.startsWith('/?') ? 403 : 404, path);
  const port = server.url.port, good = `/?token=${server.token}`;
  for (const host of [`localhost:${port}`, 'localhost', '127.0.0.1:9000', '[::1]:1'])  // such as of ssh -L
    assert.equal(await statusOf(good, { Host: host }), 200, host);
  for (const host of ['evil.example', `evil.example:${port}`, '10.0.0.1', '127.0.0.1.evil.example', 'localhost.', 'localhost@evil', '[::1', '',
    '[::1]]:80', '[::1]"><script>alert(1)</script>', '[::1]; script-src *', '127.0.0.1:99999999999', 'localhost:80;'])
    assert.equal(await statusOf(good, { Host: host }), 403, host);
  assert.equal((await server.request(`GET ${good} HTTP/1.1\r\n\r\n`)).status, 403);
  assert.equal((await server.request(`POST ${good} HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n`)).status, 405);
  assert.equal((await server.request(`HEAD ${good} HTTP/1.1\r\nHost: localhost\r\n\r\n`)).text.endsWith('\r\n\r\n'), true);
  assert.equal(await statusOf(`/stream?token=${server.token}`), 426);
  for (const origin of ['http://evil.example', 'null', `https://${server.url.host}`, `http://localhost:${port}`, 'http://127.0.0.1', `${server.url.origin}/`])
    assert.equal((await server.viewer({ origin })).status, 403, origin);
  assert.equal((await server.viewer({ token: other })).status, 403);
  assert.equal((await server.viewer({ headers: { Host: 'evil.example' } })).status, 403);
  const viewer = await server.viewer();
  assert.equal(viewer.status, 101);
  assert.equal((await server.viewer({ origin: null })).status, 101);  // no browser
  // As through ssh -L 9000:127.0.0.1:PORT.
  assert.equal((await server.viewer({ origin: 'http://localhost:9000', headers: { Host: 'localhost:9000' } })).status, 101);
  // A connection that says nothing is ended.
  const begun = Date.now();
  await server.request('GET /?tok');
  assert.ok(Date.now() - begun < 14000, 'it is kept open');
}));

test('serve: bodies move, and a driver pauses, steps, keeps, returns, restarts and goes back', options, () => serving([sceneFile('fall', fall)], async (server) => {
  const viewer = await server.viewer(), eyes = new Eyes(viewer);
  await viewer.until(() => eyes.moments > 12, 'frames');
  assert.ok(viewer.drives);
  assert.equal(viewer.state.scene, 'fall.json');  // and no folder
  assert.ok(!JSON.stringify(viewer.texts).includes(place));
  const ball = eyes.placeOf('ball'), high = eyes.position(ball)[1];
  assert.ok(high < 39.9 && high > 1, `the ball is at ${high}`);
  const { time } = eyes.now;
  assert.ok(Math.abs(high - (40 - 0.5 * 9.81 * time * time)) < 0.05 + 0.1 * time, 'it falls as it should');
  viewer.tell({ do: 'pause', on: true });
  await viewer.until(({ state }) => state.paused, 'a pause');
  await pause(300);
  const { step } = eyes.now, { moments } = eyes;
  await pause(500);
  assert.equal(eyes.moments, moments, 'frames come while nothing moves');
  viewer.tell({ do: 'step' });
  viewer.tell({ do: 'step' });
  await viewer.until(() => eyes.now.step === step + 2, 'two steps');
  viewer.tell({ do: 'keep' });
  await viewer.until(({ state }) => state.kept !== null, 'a kept state');
  const there = eyes.position(ball);
  viewer.tell({ do: 'pause', on: false });
  await viewer.until(() => eyes.now.step > step + 20, 'more steps');
  viewer.tell({ do: 'pause', on: true });
  viewer.tell({ do: 'restore' });
  await viewer.until(() => eyes.now.step === step + 2, 'the kept state');
  eyes.position(ball).forEach((x, k) => assert.ok(Math.abs(x - there[k]) < 0.02, 'another place'));
  viewer.tell({ do: 'go', step: 3 });
  await viewer.until(() => eyes.now.step === 3, 'a step long ago');
  assert.equal(viewer.state.farthest >= step + 2, true);
  const shown = eyes.moments;
  viewer.tell({ do: 'restart' });
  await viewer.until(() => eyes.moments > shown && eyes.now.step === 0, 'the beginning');
  assert.ok(Math.abs(eyes.position(ball)[1] - 40) < 0.02);
}));

test('serve: a driver grabs, throws, explodes, changes gravity and speed, and opens demos', options, () => serving([sceneFile('fall2', fall), '--set', 'bodies/ball/position=[0,0.5,0]'], async (server) => {
  const viewer = await server.viewer(), eyes = new Eyes(viewer);
  await viewer.until(() => eyes.moments > 3, 'frames');
  const box = eyes.placeOf('box'), boxId = eyes.scene.bodies[box].id;
  viewer.tell({ do: 'press', body: boxId, at: at(3, 0.5) });
  await viewer.until(({ state }) => state.held === boxId, 'a held box');
  for (let y = 0.5; y <= 3; y += 0.25) viewer.tell({ do: 'move', at: { ...at(3, y), eye: [3, 0.5, 10], target: [3, 0.5, 0], y: 300 - (y - 0.5) * 72 } });
  await viewer.until(() => eyes.position(box)[1] > 1.5, 'a lifted box');
  viewer.tell({ do: 'release' });
  await viewer.until(({ state }) => state.held === null, 'nothing held');
  // Seen where it no longer is: by its number, not by what is under the pointer.
  viewer.tell({ do: 'press', body: boxId, at: at(30, 30) });
  await viewer.until(({ state }) => state.held === boxId, 'a box that has moved on');
  viewer.tell({ do: 'release' });
  viewer.tell({ do: 'press', body: 0, at: at(3, 0.5) });  // the ground
  viewer.tell({ do: 'press', body: 99999, at: at(3, 0.5) });
  const { there } = viewer.state;
  viewer.tell({ do: 'ball', at: at(0, 2) });
  await viewer.until(({ state }) => state.there === there + 1, 'a ball');
  await viewer.until(() => eyes.placeOf('thrown') > 0 && eyes.now.exists[eyes.placeOf('thrown')], 'the ball in the stream');
  assert.equal(viewer.state.held, null);
  viewer.tell({ do: 'undo' });
  await viewer.until(({ state }) => state.there === there, 'no ball');
  viewer.tell({ do: 'explode', at: at(0, 0.5) });
  const ball = () => eyes.placeOf('ball');
  await viewer.until(() => Math.hypot(...eyes.position(ball())) > 1.5, 'a ball blown away');
  viewer.tell({ do: 'set', gravity: [0, 4, 0], substeps: 5 });
  await viewer.until(({ state }) => state.gravity[1] === 4 && state.substeps === 5, 'another gravity');
  await viewer.until(() => eyes.position(ball())[1] > 5, 'a ball that falls up');
  viewer.tell({ do: 'speed', value: 0.25 });
  await viewer.until(({ state }) => state.speed === 0.25, 'another speed');
  viewer.tell({ do: 'open', name: 'pile', bodies: 50 });
  await viewer.until(({ state }) => state.scene === 'pile', 'another demo');
  await viewer.until(() => eyes.scene.head.title === 'pile' && eyes.scene.bodies.length > 40, 'its bodies');
  for (const name of ['/etc/passwd', '../pile', 'no such demo', sceneFile('other', fall), '']) {
    viewer.tell({ do: 'open', name });
    await viewer.until(({ state }) => state.message !== '', `a refusal of ${name}`);
    assert.equal(viewer.state.scene, 'pile');
    viewer.tell({ do: 'step' });
    await viewer.until(({ state }) => state.message === '', 'no message');
  }
  viewer.tell({ do: 'open', name: 'fall2.json' });
  await viewer.until(({ state }) => state.scene === 'fall2.json', 'its own scene');
  assert.equal(viewer.closed, null);
}));

test('serve: vehicles drive by keys', options, () => serving(['cars', '--bodies', '5'], async (server) => {
  const viewer = await server.viewer(), eyes = new Eyes(viewer);
  await viewer.until(({ state }) => state?.vehicle?.by_route, 'a car on its route');
  viewer.tell({ do: 'key', key: 's', on: true });
  await viewer.until(({ state }) => state.vehicle.speed < -0.5, 'a car that goes back', 20000);
  assert.equal(viewer.state.vehicle.by_route, false);
  viewer.tell({ do: 'key', key: 's', on: false });
  assert.ok(eyes.moments > 0);
}));

test('serve: one drives; another watches, and takes over when the first hands over or leaves', options, () => serving(['wall', '--viewers', '2'], async (server) => {
  const first = await server.viewer();
  await first.until(({ state }) => state !== null, 'a state');
  const second = await server.viewer(), eyes = new Eyes(second);
  await second.until(() => eyes.moments > 3, 'frames');
  assert.equal((await server.viewer()).status, 503);
  assert.ok(first.drives && !second.drives);
  second.tell({ do: 'pause', on: true });
  second.tell({ do: 'take' });
  await pause(400);
  assert.equal(second.state.paused, false);
  assert.ok(!second.drives);
  first.tell({ do: 'press', body: 5, at: at(0, 2) });
  await first.until(({ state }) => state.held === 5, 'a held brick');
  first.tell({ do: 'yield' });
  await second.until(({ state }) => state.driver === 0, 'a free wheel');
  assert.equal(second.state.held, null, 'what the driver held is let go');
  second.tell({ do: 'take' });
  await second.until(() => second.drives, 'the wheel');
  second.tell({ do: 'pause', on: true });
  await first.until(({ state }) => state.paused, 'a pause');
  second.close();
  await first.until(({ state }) => state.driver === 0 && state.viewers === 1, 'a driver that has left');
  first.tell({ do: 'take' });
  await first.until(() => first.drives, 'the wheel again');
  const third = await server.viewer(), late = new Eyes(third);  // it comes while nothing moves, and sees it
  await third.until(() => late.moments > 0, 'a frame of the pause');
  assert.ok(!third.drives);
}));

test('serve: messages that no page sends are answered with an end, and harm nobody', options, () => serving(['wall', '--viewers', '64'], async (server) => {
  const watcher = await server.viewer(), eyes = new Eyes(watcher);
  await watcher.until(() => eyes.moments > 0, 'frames');
  const ends = async (what, send, code) => {
    const viewer = await server.viewer();
    assert.equal(viewer.status, 101, what);
    await viewer.until(({ hello }) => hello !== null, 'a welcome');
    send(viewer);
    await viewer.until(({ closed, socket }) => closed !== null || socket.destroyed, `${what}: an end`);
    if (code) assert.equal(viewer.closed, code, what);
    viewer.close();
    return viewer;
  };
  const texts = ['', 'null', '[]', '{}', '{"do":', '{"do":1}', '{"do":"nothing"}', '{"do":"seen"}', '{"do":"seen","frames":-1}', '{"do":"seen","frames":1e300}',
    '{"do":"seen","frames":999999}', '{"do":"pace","fps":null}', '{"do":"speed","value":0}', '{"do":"speed","value":"1"}', '{"do":"go","step":1.5}', '{"do":"pause"}',
    '{"do":"key","key":"q","on":true}', '{"do":"set","gravity":[1,2]}', '{"do":"set","gravity":[1e9,0,0]}', '{"do":"set","substeps":0}', '{"do":"open"}',
    '{"do":"open","name":"wall","bodies":-5}', '{"do":"press","body":1}', '{"do":"press","body":1,"at":{"eye":[0,0,0],"target":[0,0,0],"fov":45,"width":9,"height":9,"x":1,"y":1}}',
    '{"do":"explode","at":[]}', '{"do":"move","at":{}}', `${'['.repeat(4000)}`, '{"do":"wheel","clicks":1e99}'];
  for (const text of texts) {
    const viewer = await ends(text, (one) => one.send(text), 1008);
    assert.match(viewer.bye, /not understood/, text);
  }
  assert.match((await ends('bytes', (one) => one.send(Buffer.from([1, 2, 3]), 2), 1008)).bye, /JSON/);
  await ends('a long message', (one) => one.send(JSON.stringify({ do: 'open', name: 'x'.repeat(5000) })), 1009);
  await ends('a message that claims to be long', (one) => one.send('{"do":"step"}', 1, { lie: 2 ** 31 - 1 }), 1009);
  await ends('many pieces', (one) => {
    one.send('{"do":"', 1, { final: false });
    for (let i = 0; i < 100; ++i) one.send('x'.repeat(100), 0, { final: false });
  }, 1009);
  await ends('no UTF-8', (one) => one.send(Buffer.from([0x22, 0xff, 0xfe, 0x22])), 1007);
  await ends('no mask', (one) => one.send('{"do":"step"}', 1, { masked: false }), 1002);
  await ends('reserved bits', (one) => one.send('{"do":"step"}', 1, { reserved: 4 }), 1002);
  await ends('an unknown kind', (one) => one.send('x', 5), 1002);
  const { moments } = eyes;
  await watcher.until(() => eyes.moments > moments + 3, 'frames for the one who behaves');
  assert.equal((await server.request('\x16\x03\x01\x00\xa5\x01\x00\x00')).status, 400);
  assert.equal((await server.request(`GET /?token=${server.token} HTTP/1.1\r\nHost: localhost\r\nX: ${'y'.repeat(20000)}\r\n\r\n`)).status, 431);
}));

test('serve: thousands of random messages and bytes end viewers at most', { ...options, timeout: 240000 }, () => serving(['wall', '--viewers', '64'], async (server) => {
  const watcher = await server.viewer(), eyes = new Eyes(watcher);
  await watcher.until(() => eyes.moments > 0, 'frames');
  let seed = 12345;
  const random = (count) => ((seed = Math.imul(seed, 1103515245) + 12345 >>> 0) >>> 8) % count;
  const deeds = ['seen', 'watch', 'pace', 'take', 'yield', 'pause', 'step', 'restart', 'keep', 'restore', 'go', 'speed', 'set', 'press', 'move', 'release', 'wheel', 'key',
    'ball', 'box', 'explode', 'undo', 'remove', 'duplicate', 'righten', 'select'];
  const values = [0, 1, -1, 2.5, 1e9, 1e-9, 1e308, true, false, null, 'w', '', [], {}, [0, 1, 2], [0, -9.81, 0], at(0, 2), { ...at(0, 2), fov: -1 }, 'wall', 5];
  const keys = ['frames', 'on', 'fps', 'step', 'value', 'name', 'bodies', 'gravity', 'substeps', 'at', 'body', 'clicks', 'key'];
  let sent = 0, ended = 0;
  for (let round = 0; sent < 3000; ++round) {
    const viewer = await server.viewer();
    if (viewer.status !== 101) continue;
    if (round % 3 === 0) watcher.tell({ do: 'yield' }), viewer.tell({ do: 'take' });
    for (let i = 0; i < 60 && viewer.closed === null && !viewer.socket.destroyed; ++i, ++sent) {
      const message = { do: deeds[random(deeds.length)] };
      for (let k = random(4); k > 0; --k) message[keys[random(keys.length)]] = values[random(values.length)];
      if (message.do === 'go') message.step = random(100);
      let bytes = Buffer.from(JSON.stringify(message));
      if (random(12) === 0) bytes[random(bytes.length)] = random(256);
      if (random(40) === 0) bytes = randomBytes(random(200));
      if (random(60) === 0) viewer.socket.write(randomBytes(1 + random(300)));
      else viewer.send(bytes, random(30) === 0 ? random(16) : 1, { final: random(30) > 0, reserved: random(60) === 0 ? random(8) : 0 });
      if (random(4) === 0) await pause(1);
    }
    await pause(5);
    if (viewer.closed !== null || viewer.socket.destroyed) ++ended;
    viewer.close();
  }
  assert.ok(ended > 10, `${sent} sent, ${ended} ended`);
  const last = await server.viewer(), sees = new Eyes(last);
  await last.until(() => sees.moments > 0, 'a frame after all that');
  assert.equal(server.child.exitCode, null);
}));

test('serve: who reads slowly gets fewer frames and all bodies; who reads nothing is told and closed', { ...options, timeout: 180000 }, () => serving(['pile', '--bodies', '2k'], async (server) => {
  const fast = await server.viewer(), eyes = new Eyes(fast);
  await fast.until(() => eyes.moments > 5, 'frames');
  const slow = await server.viewer({ follows: false }), slowEyes = new Eyes(slow), dead = await server.viewer({ follows: false });
  let acknowledged = 0;
  const timer = setInterval(() => {
    if (acknowledged < slowEyes.moments) slow.seen(++acknowledged);
  }, 400);
  dead.socket.pause();
  const before = eyes.moments;
  for (let i = 0; i < 4; ++i) {
    await pause(600);
    fast.tell({ do: 'ball', at: at(0, 20) });
  }
  const thrown = ({ scene }) => scene.bodies.filter((body) => body.name === 'thrown').length;
  await slow.until(() => thrown(slowEyes) === 4, 'every ball, for the slow one as well');
  await slow.until(() => [...slowEyes.scene.bodies.keys()].filter((i) => slowEyes.scene.bodies[i].name === 'thrown' && slowEyes.now.exists[i]).length === 4, 'the balls in its frames');
  assert.ok(slowEyes.moments - 8 < 0.7 * (eyes.moments - before), `${slowEyes.moments} for the slow one, ${eyes.moments - before} for the fast one`);
  assert.ok(eyes.wholes < 8, 'the fast one is not held up');
  dead.socket.resume();
  await dead.until(({ bye }) => bye !== undefined, 'a word to the one who sees nothing', 30000);
  assert.match(dead.bye, /cannot keep up/);
  await dead.until(({ closed }) => closed === 1008, 'an end');
  assert.equal(slow.closed, null);
  // A page that is hidden asks for nothing, and is not dropped.
  clearInterval(timer);
  slow.tell({ do: 'watch', on: false });
  await pause(500);
  const { moments } = slowEyes;
  await pause(600);
  assert.equal(slowEyes.moments, moments);
  slow.seen(moments);
  slow.tell({ do: 'watch', on: true });
  await slow.until(() => slowEyes.moments > moments, 'frames again');
}));

test('serve: fewer frames are sent to who asks for fewer', options, () => serving(['wall'], async (server) => {
  const viewer = await server.viewer(), eyes = new Eyes(viewer);
  await viewer.until(() => eyes.moments > 3, 'frames');
  viewer.tell({ do: 'pace', fps: 8 });
  await pause(500);
  const { moments } = eyes;
  await pause(2000);
  assert.ok(eyes.moments - moments <= 18 && eyes.moments - moments >= 4, `${eyes.moments - moments} frames in 2 s`);
  assert.equal(eyes.scene.head.seconds, 4 / 30);
}));

test('serve: it ends by itself after --steps, with a report, and refuses what cannot be', options, async () => {
  const report = join(place, 'report.json');
  const server = await Server.start(['wall', '--steps', '20', '--report', report]);
  const viewer = await server.viewer();
  const end = await server.ended;
  assert.equal(end.status, 0, server.errors);
  assert.match(viewer.bye ?? '', /ended/);
  const told = JSON.parse(readFileSync(report, 'utf8'));
  assert.equal(told.steps, 20);
  // The same bits as of scree run.
  const run = JSON.parse(execFileSync(program, ['run', 'wall', '--steps', '20', '--backend', 'cpu', '--quiet', '--report', '-'], { encoding: 'utf8' }));
  assert.equal(told.state_hash, run.state_hash);
  const refused = (args, words) => {
    const { status, stderr } = spawnSync(program, ['serve', ...args], { encoding: 'utf8', timeout: 20000 });
    assert.match(stderr, words);
    return status;
  };
  assert.equal(refused(['no_such_demo'], /no_such_demo/), 2);
  assert.equal(refused(['wall', '--port', '70000'], /--port/), 2);
  assert.equal(refused(['wall', '--host', 'example.invalid', '--backend', 'cpu'], /no address of this machine/), 1);
  const busy = await Server.start(['wall']);
  assert.equal(refused(['wall', '--port', busy.url.port, '--backend', 'cpu'], /in use/), 1);
  const { status, ms } = await busy.stop('SIGTERM');
  assert.equal(status, 130);
  assert.ok(ms < 2000);
  const open = await Server.start(['wall', '--host', '0.0.0.0']);
  assert.match(open.errors, /may watch and drive; nothing is encrypted/);
  await open.stop();
});
