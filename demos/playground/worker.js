// The solver of the playground, in a worker: runs a world at its pace, and sends what a frame shows. Of a frame there is one copy, out
// of the module's memory into a buffer that moves to the page and comes back.
import { load } from '../js/lib/index.js';
import { chunksOf } from '../viewer/bytes.js';
import { Scene as Drawn } from '../viewer/scene.js';
import { heapOf } from './heap.js';
import { SHAPES } from './shapes.js';

const MOST_THROWN = 60, BUFFERS = 2, LONGEST = 0.1;  // s, of time that is caught up with
const CHECKED_STEPS = 12, CHECKED_BODIES = 300;      // as of demos/records/hashes.txt
const MOST_POINTS = 20000;                           // of contacts in a frame
const SCRIPTED = ['fountain'];                       // whose bodies come and go during a run

let scree, counts;  // of demos whose number of bodies may be chosen: the usual one
let followed;                                        // whether the world's demo is scripted
let world, live, drawn, placeOf, views, thrown, grips, settings, buffers = [], rate = 60;
let shows = { contacts: false, joints: false };
let playing = false, speed = 1, due = 0, timer = null, wantsFrame = true;
let spent = [], lateSteps = 0;
const tell = (kind, more = {}, moved = []) => postMessage({ kind, ...more }, moved);

function take(chunks) {
  for (const chunk of chunksOf(chunks)) drawn.take(chunk);
  placeOf = new Int32Array(world.count('bodies')).fill(-1);
  drawn.bodies.forEach((body, place) => (placeOf[body.id] = place));
}
function dropViews() {
  for (const view of views ?? []) view.dispose();
  views = null;
}
function look() {
  views ??= ['poses', 'velocities', 'ids'].map((name) => world.view(name));
  return views;
}
// All that bodies do, by place: position (3), orientation (4), velocity (3), and bytes: there, asleep.
function frame() {
  const count = drawn.bodies.length, bytes = 42 * count;
  const buffer = buffers.pop();
  if (!buffer) return null;
  const room = buffer.byteLength >= bytes ? buffer : new ArrayBuffer(Math.ceil(1.2 * bytes / 8) * 8);
  const position = new Float32Array(room, 0, 3 * count), orientation = new Float32Array(room, 12 * count, 4 * count),
    velocity = new Float32Array(room, 28 * count, 3 * count), exists = new Uint8Array(room, 40 * count, count), asleep = new Uint8Array(room, 41 * count, count);
  const [poses, velocities, ids] = look(), p = poses.data, v = velocities.data, id = ids.data, step = poses.stride, pace = velocities.stride;
  for (let row = 0; row < ids.count; ++row) {
    const place = placeOf[id[row * ids.stride]], from = row * step, along = row * pace;
    if (!(place >= 0)) continue;
    for (let k = 0; k < 3; ++k) {
      position[3 * place + k] = p[from + k];
      velocity[3 * place + k] = v[along + k];
    }
    for (let k = 0; k < 4; ++k) orientation[4 * place + k] = p[from + 4 + k];
  }
  const told = world.read(['exists', 'asleep']);
  let sleepers = 0;
  exists.fill(0);
  for (let i = 0; i < placeOf.length; ++i) {
    const place = placeOf[i];
    if (place < 0) continue;
    exists[place] = told.exists[i];
    asleep[place] = told.asleep[i];
    sleepers += told.asleep[i];
  }
  return { buffer: room, count, sleepers };
}
// Points that touch: places, points, normals, forces (N).
function touching() {
  const points = [];
  for (const { a, b, normal, count, position, force } of world.contacts())
    for (let k = 0; k < count && points.length < MOST_POINTS; ++k) if (force[k] > 0) points.push([placeOf[a], placeOf[b], position[k], normal, force[k]]);
  return { count: points.length, a: Int32Array.from(points, ([a]) => a), b: Int32Array.from(points, ([, b]) => b),
    point: Float32Array.from(points.flatMap(([, , at]) => at)), normal: Float32Array.from(points.flatMap(([, , , normal]) => normal)),
    force: Float32Array.from(points, ([, , , , force]) => force) };
}
// Forces of joints, N; below 0: it is broken.
const jointForces = () => Float32Array.from(world.joints(), ({ force, broken }) => (broken ? -1 : Math.hypot(...force)));

function send() {
  const sent = frame();
  wantsFrame = sent === null;
  if (!sent) return;
  const pace = spent.length ? [...spent].sort((a, b) => a - b) : [0];
  const more = { touching: shows.contacts ? touching() : null, joints: shows.joints ? jointForces() : null };
  tell('frame', { ...sent, ...more, steps: world.steps, time: world.time, stepMs: pace[pace.length >> 1], slowestMs: pace[pace.length - 1], late: lateSteps },
    [sent.buffer]);
}
function follow(of, { demo, bodies = 0 }) {
  if (SCRIPTED.includes(demo)) of.followDemo(demo, { bodies });
  return SCRIPTED.includes(demo);
}
// One step, and the bodies that were born in it.
function advance() {
  if (followed) dropViews();
  world.step();
  if (!followed) return;
  const chunks = live.take();
  if (chunks.length === 0) return;
  take(chunks);
  tell('scene', { chunks: chunks.slice() });
}
function step(count) {
  for (let i = 0; i < count; ++i) {
    const begun = performance.now();
    advance();
    spent.push(performance.now() - begun);
    if (spent.length > 60) spent.shift();
  }
}
// As many steps as are due; what cannot be caught up with is left out, so that the world is slow rather than the page.
function run() {
  timer = null;
  if (!playing || !world) return;
  try {
    const now = performance.now() / 1000, length = 1 / (rate * speed);
    if (now - due > LONGEST) {
      lateSteps += Math.floor((now - due - LONGEST) / length);
      due = now - LONGEST;
    }
    const until = performance.now() + 25;
    let some = false;
    while (due <= now && performance.now() < until) {
      step(1);
      due += length;
      some = true;
    }
    if (some) send();
    plan(Math.max(0, 1000 * due - performance.now()));
  } catch (error) {
    playing = false;
    tell('failed', { message: error.message });
  }
}
function plan(ms = 0) {
  if (timer === null) timer = setTimeout(run, ms);
}

function sceneOf({ demo, bodies, heap, json }) {
  if (json !== undefined) return scree.Scene.fromJSON(json);
  if (heap) return heapOf(scree.Scene, heap);
  return scree.Scene.demo(demo, { bodies: bodies ?? 0 });
}
function apply(given) {
  if (given.gravity !== undefined && given.gravity !== null) world.setGravity([0, -given.gravity, 0]);
  if (given.friction !== undefined) world.set('friction_factor', given.friction);
}

const asked = {
  async open({ source, given }) {
    const scene = sceneOf(source), made = new scree.World(scene, source.heap ? {} : undefined);
    const chassis = source.json !== undefined && scene.count('vehicles') > 0 ? scene.get('scene').vehicles[0].chassis : undefined;
    scene.dispose();
    dropViews();
    live?.dispose();
    world?.dispose();
    world = made;
    followed = follow(world, source);
    live = world.record({ live: 1, fps: 60, contacts: -1 });
    drawn = new Drawn();
    [thrown, grips, spent, lateSteps] = [[], new Map(), [], 0];
    settings = world.get('settings');
    rate = settings.rate;
    const gravity = Array.from(world.gravity());
    apply(given);
    const chunks = live.take(true);
    take(chunks);
    due = performance.now() / 1000;
    tell('opened', { chunks, gravity, friction: settings.friction_factor ?? 1, bodies: world.count('bodies_there'), source, chassis });
    send();
    if (playing) plan();
  },
  play({ on }) {
    playing = on;
    due = performance.now() / 1000;
    spent = [];
    if (on && world) plan();
  },
  step({ count }) {
    step(count);
    send();
  },
  show({ shows: wanted }) {
    shows = wanted;
    if (world && !playing) send();
  },
  speed({ value }) {
    speed = value;
    due = performance.now() / 1000;
  },
  set({ given }) {
    apply(given);
    const { exists } = world.read(['exists']);
    world.wake(Array.from(exists.keys()).filter((body) => exists[body]));
  },
  // The oldest of its shape flies again when there are many.
  throw({ shape, size, position, velocity }) {
    const alike = thrown.filter((one) => one.shape === shape && one.size === size);
    if (thrown.length >= MOST_THROWN && alike.length > 0) {
      const [oldest] = alike;
      thrown = [...thrown.filter((one) => one !== oldest), oldest];
      world.write(oldest.index, { position: [position], velocity: [velocity], angular_velocity: [[0, 0, 0]] });
    } else {
      const scene = new scree.Scene();
      scene.addBodies({ name: 'thrown', shape: SHAPES[shape].shape(size), position, velocity, density: 2000 });
      dropViews();
      const [{ index }] = world.addBodies(scene);
      scene.dispose();
      thrown.push({ index, shape, size });
      const chunks = live.take();
      take(chunks);
      tell('scene', { chunks: chunks.slice() });
    }
    if (!playing) send();
  },
  // Of the body that a ray meets: a spring pulls the point there.
  grab({ from, along, hand }) {
    const [hit] = world.castRays([{ from, along }]);
    if (!hit || !(placeOf[hit.body] >= 0)) return tell('grabbed', { place: -1, hand });
    const { position, orientation } = world.readOf(hit.body), place = placeOf[hit.body];
    if (drawn.bodies[place].motion !== 0) return tell('grabbed', { place: -1, hand });
    const [x, y, z, w] = orientation, d = [0, 1, 2].map((k) => hit.point[k] - position[k]);
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const u = cross([-x, -y, -z], d).map((n) => 2 * n), then = cross([-x, -y, -z], u);  // back into its frame
    const grip = world.grip(hit.body, d.map((n, k) => n + w * u[k] + then[k]), hit.point, { hertz: 4, max_acceleration: 250 });
    grips.set(hand, grip);
    tell('grabbed', { place, point: hit.point, hand });
  },
  move({ hand, target }) {
    if (grips.has(hand)) world.moveGrip(grips.get(hand), target);
  },
  drop({ hand }) {
    if (grips.has(hand)) world.releaseGrip(grips.get(hand));
    grips.delete(hand);
  },
  // The hash after some steps of a world of its own, whatever happens in the one that is shown.
  check({ source }) {
    const checked = source.demo ? { demo: source.demo, bodies: counts.has(source.demo) ? CHECKED_BODIES : 0 } : source;
    const scene = sceneOf(checked), begun = performance.now(), other = new scree.World(scene);
    try {
      follow(other, checked);
      other.step(CHECKED_STEPS);
      tell('checked', { source, hash: other.hash(), bodies: other.count('bodies_there'), ms: performance.now() - begun });
    } finally {
      other.dispose();
      scene.dispose();
    }
    due = performance.now() / 1000;
  },
  hash() {
    tell('hash', { hash: world.hash(), steps: world.steps });
  },
  // Milliseconds of `count` steps, one by one, without pictures.
  measure({ count }) {
    const times = [];
    for (let i = 0; i < count; ++i) {
      const begun = performance.now();
      advance();
      times.push(performance.now() - begun);
    }
    tell('measured', { times });
    send();
  },
  back({ buffer }) {
    if (buffers.length < BUFFERS) buffers.push(buffer);
    if (wantsFrame && world) send();
  },
};

onmessage = async ({ data }) => {
  try {
    if (data.kind === 'begin') {
      const lines = [];
      const options = { folder: data.folder, print: (line) => lines.push(line), printError: (line) => lines.push(line) };
      scree = data.threads > 1 ? await load({ ...options, threads: data.threads }).catch(() => load(options)) : await load(options);
      for (let i = 0; i < BUFFERS; ++i) buffers.push(new ArrayBuffer(0));
      scree.command(['list']);
      counts = new Map(lines.map((line) => line.trim().split(/\s+/)).filter(([, , word]) => word === '--bodies').map(([name, count]) => [name, Number(count)]));
      const demos = scree.describe('demos').map(([name, line]) => ({ name, line, count: counts.get(name) ?? 0 }));
      return tell('ready', { version: scree.version, threads: scree.threads, demos });
    }
    await asked[data.kind](data);
  } catch (error) {
    tell('failed', { message: error.place ? `${error.place}: ${error.message}` : error.message, of: data.kind });
  }
};
