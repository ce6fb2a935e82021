// The npm package in Node: SCREE_PACKAGE=FOLDER node --test tests/js/package_test.mjs, SCREE_THREADS=2 for the form with threads.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

const folder = process.env.SCREE_PACKAGE ?? 'build/wasm/package';
const { load, ScreeError } = await import(`${pathToFileURL(folder)}/lib/index.js`);
const threads = Number(process.env.SCREE_THREADS ?? 1);
const scree = await load({ threads });
const { Scene, World } = scree;

const ball = { shape: { sphere: { radius: 0.5 } }, position: [0, 2, 0], name: 'ball' };
const ground = { shape: { plane: {} }, motion: 'fixed', name: 'ground' };
function falling() {
  const scene = new Scene();
  scene.addBodies(ground);
  scene.addBodies(ball);
  return scene;
}

test('the version is that of the package', async () => {
  const { readFile } = await import('node:fs/promises');
  assert.equal(scree.version, JSON.parse(await readFile(`${folder}/package.json`)).version);
  assert.equal(scree.threads, threads);
});

test('a ball falls by g and comes to rest on the ground', () => {
  const world = new World(falling());
  world.step(30);
  assert.equal(world.steps, 30);
  const { position, velocity } = world.read(['position', 'velocity']);
  assert.ok(position instanceof Float32Array && position.length === 6);
  assert.ok(Math.abs(velocity[4] + 9.81 * 0.5) < 0.02, `${velocity[4]}`);
  world.step(300);
  assert.ok(Math.abs(world.readOf(1).position[1] - 0.5) < 0.01);
  const [contact] = world.contacts();
  assert.equal(contact.count, 1);
  assert.deepEqual([contact.a, contact.b].sort(), [0, 1]);
  assert.equal(contact.position.length, 1);
  world.dispose();
});

test('worlds of one scene have equal hashes, and others after a push', () => {
  const scene = Scene.demo('pile', { bodies: 50 });
  const one = new World(scene);
  const other = new World(scene);
  one.step(20);
  other.step(20);
  assert.match(one.hash(), /^[0-9a-f]{16}$/);
  assert.equal(one.hash(), other.hash());
  other.apply(other.count('bodies') - 1, { impulse: [[1, 0, 0]] });
  other.step();
  one.step();
  assert.notEqual(one.hash(), other.hash());
});

test('a saved state goes on with the same bits', () => {
  const world = new World(Scene.demo('pile', { bodies: 50 }));
  world.step(10);
  const saved = world.save();
  world.step(10);
  const hash = world.hash();
  world.restore(saved);
  assert.equal(world.steps, 10);
  world.step(10);
  assert.equal(world.hash(), hash);
  world.keepState();
  world.step(5);
  assert.deepEqual(world.keptStates(), [20]);
  world.rollBack(5);
  assert.equal(world.hash(), hash);
  assert.throws(() => world.restore(saved.slice(0, 100)), (error) => error instanceof ScreeError && error.kind === 'BAD_CHECKPOINT');
});

test('errors tell kind, place and reason', () => {
  assert.throws(() => Scene.fromJSON({ bodies: [{ shape: { sphere: { radius: 'wide' } } }] }), (error) => {
    assert.ok(error instanceof ScreeError);
    assert.equal(error.kind, 'BAD_SCENE');
    assert.match(error.place, /^\/bodies\/0/);
    return /number/.test(error.message);
  });
  assert.throws(() => Scene.demo('no such demo'), /no such demo/);
  const world = new World(falling());
  assert.throws(() => world.readOf(7), (error) => error.kind === 'BAD_INDEX');
  assert.throws(() => world.read(['colour']), /colour.*known/);
  assert.throws(() => world.setEvents({ colour: 1 }), /colour.*known/);
});

test('what was disposed of is refused', () => {
  const scene = falling();
  const world = new World(scene);
  scene.dispose();
  world.step();
  world.dispose();
  world.dispose();
  assert.throws(() => world.step(), (error) => error.kind === 'BAD_HANDLE');
  assert.throws(() => new World(scene), (error) => error.kind === 'BAD_HANDLE');
});

test('views look into tables without a copy, and hold bodies', () => {
  const scene = falling();
  const world = new World(scene);
  const [ids, poses] = [world.view('ids'), world.view('poses')];
  world.step(10);
  const row = ids.data.indexOf(1);
  assert.equal(poses.data[row * poses.stride + 1], world.readOf(1).position[1]);
  assert.throws(() => world.addBodies(scene), (error) => error.kind === 'VIEWED');
  for (const view of [ids, poses]) view.dispose();
  assert.throws(() => poses.data, /disposed/);
  const more = new Scene();
  more.addBodies({ ...ball, position: [3, 5, 0], name: 'second' });
  const [added] = world.addBodies(more);
  assert.equal(added.index, 2);
  world.removeBodies(added);
  assert.deepEqual(world.areValid([added]), [false]);
});

test('bodies are written, moved by forces, and found by name', () => {
  const world = new World(falling());
  const body = world.find('bodies', 'ball');
  assert.equal(body, 1);
  assert.equal(world.find('bodies', 'none'), -1);
  world.write(body, { position: [[0, 10, 0]], velocity: [[1, 0, 0]] });
  world.step(6);
  const { position } = world.readOf(body);
  assert.ok(Math.abs(position[0] - 0.1) < 1e-4 && position[1] > 9.9);
  world.setGravity([0, 0, 0]);
  assert.deepEqual(Array.from(world.gravity()), [0, 0, 0]);
  world.setBody(body, 'mass', 3);
  assert.equal(world.read(['mass']).mass[body], 3);
});

test('events tell of a hit', () => {
  const world = new World(falling());
  world.setEvents({ contacts: 1, hit_speed: 1 });
  world.step(60);
  const events = world.takeEvents();
  assert.ok(events.some((event) => event.kind === 'begin'));
  const hit = events.find((event) => event.kind === 'hit');
  assert.ok(hit.speed > 5 && hit.speed < 6, `${hit.speed}`);
  assert.deepEqual(world.takeEvents(), []);
});

test('joints are driven', () => {
  const scene = new Scene();
  scene.addBodies({ shape: { box: { half_extents: [0.5, 0.5, 0.5] } }, motion: 'fixed', position: [0, 3, 0] });
  scene.addBodies({ shape: { box: { half_extents: [0.5, 0.1, 0.1] } }, position: [1.2, 3, 0] });
  scene.set('gravity', [0, 0, 0]);
  const world = new World(scene);
  const joint = world.addJoint({ kind: { hinge: {} }, a: 0, b: 1 }, [0.7, 3, 0], [0, 0, 1]);
  world.setMotors(joint, { speed: 1, max_force: 1000 });
  world.step(60);
  const state = world.joints()[joint];
  assert.ok(Math.abs(state.rates[state.axis] - 1) < 0.05, JSON.stringify(state));
  assert.equal(state.broken, false);
  assert.equal(world.drives(-1).length, 1);
});

test('queries see bodies', () => {
  const world = new World(falling());
  const down = { from: [0, 10, 0], along: [0, -1, 0] };
  const [hit, none] = world.castRays([down, { from: [0, 10, 0], along: [0, 1, 0] }]);
  assert.equal(hit.body, 1);
  assert.ok(Math.abs(hit.distance - 7.5) < 1e-4);
  assert.equal(none, null);
  assert.deepEqual(world.raysHit([down]), [true]);
  assert.deepEqual(world.castRaysThrough([down])[0].map(({ body }) => body).sort(), [0, 1]);
  const [parts] = world.overlaps({ sphere: { radius: 1 } }, [{ position: [0, 2.5, 0] }]);
  assert.deepEqual(parts.map(({ body }) => body), [1]);
  const [depths] = world.penetrations({ sphere: { radius: 1 } }, [{ position: [0, 3, 0] }]);
  assert.ok(Math.abs(depths[0].depth - 0.5) < 1e-3);
  const [cast] = world.castShapes({ sphere: { radius: 0.5 } }, [{ from: [0, 10, 0], along: [0, -1, 0], reach: 100 }]);
  assert.ok(Math.abs(cast.distance - 7) < 1e-3);
  const [closest] = world.closestPoints([{ point: [0, 4, 0], reach: 10 }]);
  assert.equal(closest.body, 1);
  assert.ok(world.debugDrawing().lines.length % 9 === 0);
});

test('files of other programs are read with what they name', () => {
  const mjcf = '<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom type="sphere" size="0.1"/></body></worldbody></mujoco>';
  const scene = Scene.fromFiles({ 'robot/ball.xml': mjcf }, 'robot/ball.xml', { ground: 1 });
  assert.equal(scene.count('bodies'), 2);
  assert.throws(() => Scene.fromFiles({ 'a.xml': '<mujoco>' }, 'a.xml'), (error) => error instanceof ScreeError);
  assert.throws(() => Scene.fromFiles({ '../a.xml': mjcf }, '../a.xml'), RangeError);
});

test('a scene is read, changed and written again', () => {
  const scene = Scene.fromJSON(JSON.stringify({ bodies: [ground, ball] }));
  const copy = scene.copy();
  assert.equal(copy.hash(), scene.hash());
  copy.addBodies({ shape: { box: { half_extents: [0.5, 0.5, 0.5] } } }, 3, { position: [[0, 5, 0], [0, 7, 0], [0, 9, 0]] });
  assert.equal(copy.count('bodies'), 5);
  assert.deepEqual(copy.get('bodies').slice(0, 2), ['ground', 'ball']);
  assert.equal(Scene.fromJSON(copy.toJSON()).hash(), copy.hash());
  assert.deepEqual(copy.check(), []);
});

test('copies run side by side', () => {
  const world = new World(falling(), { copies: 3 });
  world.setGravity([0, 0, 0], 1);
  world.step(10);
  const [a, b, c] = world.copyHashes();
  assert.equal(a, c);
  assert.notEqual(a, b);
  world.reset([0, 1, 2]);
  assert.equal(new Set(world.copyHashes()).size, 1);
});

test('recordings are pages, and live ones give chunks', () => {
  const world = new World(falling());
  const names = (bytes) => {
    const found = [];
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    for (let at = 0; at < bytes.length; at += 8 + view.getUint32(at + 4, true)) found.push(String.fromCharCode(...bytes.subarray(at, at + 4)));
    return found;
  };
  const live = world.record({ live: 1 });
  assert.deepEqual(names(live.take(true)), ['head', 'body', 'fram']);
  world.step(10);
  assert.deepEqual(names(live.take(true)), ['fram']);
  assert.equal(live.take().length, 0);
  assert.throws(() => live.page(), (error) => error.kind === 'IMPOSSIBLE');
  const recording = world.record({ title: '<a>', fps: 60, contacts: 1 });
  world.step(20);
  recording.stop();
  world.step(20);
  assert.equal(recording.count(), 21);
  assert.match(recording.page(), /<title>&lt;a&gt; · scree<\/title>[^]*data-frames="21"/);
  assert.throws(() => world.record({ sky: 'green' }), /sky.*known/);
  assert.throws(() => world.record({ look: { sky: 'green' } }), /sky/);
  recording.dispose();
  live.dispose();
  world.dispose();
});

test('many scenes and worlds take no memory when they are disposed of', () => {
  const run = () => {
    const scene = falling();
    const world = new World(scene);
    world.step();
    world.dispose();
    scene.dispose();
  };
  for (let i = 0; i < 20; ++i) run();
  const kept = new World(falling());
  const before = kept.library.memory.buffer.byteLength;
  for (let i = 0; i < 300; ++i) run();
  assert.equal(kept.library.memory.buffer.byteLength, before);
});

test('guide: every block of JavaScript runs', async () => {
  const { mkdtemp, readFile, rm, writeFile } = await import('node:fs/promises');
  const page = await readFile('demos/docs/guide/javascript.md', 'utf8');
  const blocks = Array.from(page.matchAll(/```js\n([^]*?)```/g), ([, text]) => text);
  assert.ok(blocks.length > 4);
  const place = await mkdtemp(`${folder}/guide-`);
  try {
    // Each goes on where the one before ended.
    const text = blocks.join('\n').replace("from 'scree'", `from '${pathToFileURL(folder)}/lib/index.js'`);
    await writeFile(`${place}/guide.mjs`, text);
    execFileSync(process.execPath, [`${place}/guide.mjs`], { encoding: 'utf8' });
  } finally {
    await rm(place, { recursive: true });
  }
});

test('the program runs in Node', () => {
  const output = execFileSync(process.execPath, [`${folder}/bin/scree.js`, 'run', 'wall', '--steps', '12', '--quiet', '--report', '-'],
    { encoding: 'utf8' });
  const world = new World(Scene.demo('wall'));
  world.step(12);
  assert.equal(JSON.parse(output).state_hash, world.hash());
});
