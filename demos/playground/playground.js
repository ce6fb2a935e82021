// The playground's page: the solver runs in a worker (worker.js), and this shows its frames with the viewer's renderer.
import { chunksOf } from '../viewer/bytes.js';
import { Camera } from '../viewer/camera.js';
import { numberText, Palette, quantitiesOf } from '../viewer/colors.js';
import { FrameDecoder } from '../viewer/frames.js';
import { cameraKey, followPointers } from '../viewer/gestures.js';
import { drawLegend } from '../viewer/legend.js';
import { Marks } from '../viewer/marks.js';
import { add, length, scaled, sub, unit } from '../viewer/math.js';
import { Pose } from '../viewer/pose.js';
import { Governor } from '../viewer/quality.js';
import { isSoftware, Lines, Renderer, SKIES } from '../viewer/renderer.js';
import { DYNAMIC, Scene } from '../viewer/scene.js';
import { accent, followTheme } from '../viewer/theme.js';
import record from '../records/hashes.txt';
import { SHAPES } from './shapes.js';

const element = (id) => document.getElementById(id);
const HASHES = new Map(record.split('\n').filter((line) => line && line[0] !== '#').map((line) => line.split(' ')));
const STEPS = /after (\d+) steps/.exec(record)[1];
const GRAVITIES = [[1.62, 'Moon'], [3.72, 'Mars'], [9.81, 'Earth'], [24.79, 'Jupiter']];
const HAND = 'pointer', KEYS = 'keys';  // what grabs
const MOST_UNASKED = 1000;              // bodies of a demo that has more by default
const UNTOLD = ['contact-impulse', 'spin', 'kinetic-energy', 'angular-momentum'];  // of frames
const SHOWN = ['contacts', 'joints', 'velocities'];
const FILE = /^[\w-][\w.-]*\.json$/;    // beside this page

class Playground {
  constructor() {
    this.canvas = element('view');
    this.software = isSoftware();
    this.renderer = new Renderer(this.canvas, this.software);
    this.ownShapes = this.renderer.drawn.length;
    this.camera = new Camera();
    this.pose = new Pose();
    this.lines = new Lines();
    this.jointLines = new Lines();
    this.marks = new Marks(this);
    this.governor = new Governor(this.renderer);
    this.shows = {};
    this.scene = null;
    this.selected = -1;
    this.grabs = null;        // { hand, place, target }
    this.playing = false;
    this.dirty = false;
    this.frames = this.pictures = 0;
    this.rates = [];
    this.waiting = new Map();  // for answers of the worker
    this.source = null;
    this.file = null;          // { name, json } of a scene file
    this.given = {};           // what the visitor changed: gravity, friction
    this.troubles = 0;
    this.worker = new Worker('worker.js', { type: 'module' });
    this.worker.onmessage = ({ data }) => this.hear(data);
    this.worker.onerror = (event) => this.trouble(event.message || 'the solver cannot be loaded');
    this.canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    this.canvas.addEventListener('webglcontextrestored', () => location.reload());
  }
  tell(kind, more = {}, moved = []) { this.worker.postMessage({ kind, ...more }, moved); }
  // The worker's next message of this kind.
  answer(kind) { return new Promise((resolve) => this.waiting.set(kind, resolve)); }
  change() { this.dirty = true; }
  say(text) { element('status').textContent = text; }
  trouble(message) {
    ++this.troubles;
    const box = element('trouble');
    box.textContent = message;
    box.hidden = false;
    clearTimeout(this.troubleEnds);
    this.troubleEnds = setTimeout(() => (box.hidden = true), 9000);
  }

  hear(message) {
    this[`on_${message.kind}`]?.(message);
    this.waiting.get(message.kind)?.(message);
    this.waiting.delete(message.kind);
  }
  on_ready({ demos, version, threads }) {
    this.demos = demos;
    this.version = version;
    this.threads = threads;
  }
  on_opened({ chunks, gravity, source, bodies, chassis }) {
    this.source = source;
    this.scene = new Scene();
    const all = chunksOf(chunks);
    for (const chunk of all) this.scene.take(chunk);
    const { head } = this.scene, decoder = new FrameDecoder(head.units), first = all.find(({ name }) => name === 'fram');
    decoder.planes = this.scene.bodies.map((body) => body.plane !== null);
    decoder.decode(first.bytes, 0);
    this.first = decoder.now.camera;
    // Another scene has meshes of its own.
    for (const { array } of this.renderer.drawn.splice(this.ownShapes)) this.renderer.gl.deleteVertexArray(array);
    this.renderer.sceneVersion = -1;
    this.renderer.shapesOfMeshes = 0;
    this.renderer.sky = this.renderer.ownSky = element('sky').value || head.sky;
    this.renderer.ownSky = head.sky;
    this.renderer.sun = head.sun;
    const by = this.palette?.by;
    this.palette = new Palette(head);
    this.palette.paler = this.shows.contacts ?? false;
    this.fillColors();
    if (by && [...element('color').options].some(({ value }) => value === by)) this.palette.choose(by);
    element('color').value = this.palette.by;
    drawLegend(this.palette);
    element('show-joints').disabled = this.scene.joints.length === 0;
    this.pose = new Pose();
    this.selected = -1;
    this.grabs = null;
    if (this.frame) this.tell('back', { buffer: this.frame.buffer }, [this.frame.buffer]);
    this.frame = null;
    this.bodies = bodies;
    this.rates = [];
    if (this.given.gravity === undefined) {
      this.sceneGravity = -gravity[1];
      element('gravity').value = this.sceneGravity;
      this.showNumbers();
    }
    this.goHome();
    this.follow(this.scene.bodies.findIndex(({ id }) => id === chassis));
    this.say(`${element('name').textContent}: ${bodies} bodies`);
  }
  on_scene({ chunks }) {
    for (const chunk of chunksOf(chunks)) this.scene.take(chunk);
  }
  on_frame(frame) {
    if (!this.scene) return;
    if (this.frame) this.tell('back', { buffer: this.frame.buffer }, [this.frame.buffer]);
    this.frame = frame;
    ++this.frames;
    const { buffer, count } = frame, { pose } = this;
    if (pose.size !== count) pose.room(count);
    // The arrays of the frame are the pose: nothing is copied here.
    pose.position = new Float32Array(buffer, 0, 3 * count);
    pose.orientation = new Float32Array(buffer, 12 * count, 4 * count);
    pose.velocity = new Float32Array(buffer, 28 * count, 3 * count);
    pose.exists = new Uint8Array(buffer, 40 * count, count);
    pose.asleep = new Uint8Array(buffer, 41 * count, count);
    this.dirty = true;
  }
  on_grabbed({ place, point, hand }) {
    if (!this.grabs || this.grabs.hand !== hand) return this.tell('drop', { hand });
    if (place < 0) {
      this.grabs = null;
      this.canvas.classList.remove('grabs');
      return this.say('nothing to grab');
    }
    Object.assign(this.grabs, { place, point, target: this.grabs.target ?? point });
    this.select(place);
    this.say(`${this.scene.bodies[place].label} grabbed`);
  }
  on_checked({ source, hash, bodies, ms }) {
    if (JSON.stringify(source) !== JSON.stringify(this.source)) return;
    const name = source.demo, native = name ? HASHES.get(name) : undefined, box = element('bits');
    element('bits-of').textContent = `State after ${STEPS} steps${name ? ` of ${name}, ${bodies.toLocaleString('en')} bodies` : ''}`;
    element('bits-here').textContent = hash;
    element('bits-native').textContent = native ?? 'none on record';
    box.className = `panel ${native === undefined ? '' : native === hash ? 'same' : 'other'}`;
    element('bits-verdict').textContent = native === undefined ? source.heap ? 'Heaps are not on record; demos are.' : 'Compare: scree run FILE --steps 12 --report -'
      : native === hash ? '✓ same bits as on every machine' : '✗ other bits';
    this.checked = { native, here: hash, ms };
  }
  on_failed({ message, of }) {
    this.trouble(message);
    if (of === 'open') this.setPlaying(false);
  }

  // ---- scene and settings
  async begin() {
    const asked = new URLSearchParams(location.search);
    const threads = Math.min(64, Math.max(1, Number(asked.get('threads')) || (globalThis.crossOriginIsolated ? Math.min(navigator.hardwareConcurrency || 1, 8) : 1)));
    this.tell('begin', { threads: globalThis.crossOriginIsolated ? threads : 1, folder: new URL('module/', location.href).href });
    await this.answer('ready');
    const scenes = element('scene'), demos = document.createElement('optgroup');
    demos.label = 'Demos';
    demos.append(...this.demos.map(({ name }) => new Option(name[0].toUpperCase() + name.slice(1), name)));
    scenes.append(demos, new Option('A heap of my own', '(heap)'));
    for (const [id, mixed] of [['shape', true], ['missile', false]]) {
      if (mixed) element(id).append(new Option('All shapes', 'mixed'));
      for (const [name, { label, one }] of Object.entries(SHAPES)) element(id).append(new Option(mixed ? label : one, name));
    }
    element('missile').value = 'sphere';
    element('sky').append(new Option('The scene’s', ''), ...Object.keys(SKIES).map((name) => new Option(name[0].toUpperCase() + name.slice(1), name)));
    this.setUp();
    this.read(asked);
    const file = asked.get('scene');
    if (file !== null) await this.openFile(file); else await this.open();
    if (!matchMedia('(prefers-reduced-motion: reduce)').matches && asked.get('play') !== '0') this.setPlaying(true);
  }
  read(asked) {
    const number = (key, id) => {
      if (asked.has(key) && Number.isFinite(Number(asked.get(key)))) element(id).value = asked.get(key);
    };
    const choice = (key, id) => {
      if ([...element(id).options].some(({ value }) => value === asked.get(key))) element(id).value = asked.get(key);
    };
    const demo = asked.get('demo');
    element('scene').value = asked.has('heap') ? '(heap)' : this.demos.some(({ name }) => name === demo) ? demo : 'wall';
    if (demo !== null && element('scene').value !== demo) this.trouble(`demo: there is none named ${demo}`);
    if (asked.has('heap') && [...element('shape').options].some(({ value }) => value === asked.get('heap'))) element('shape').value = asked.get('heap');
    for (const [key, id] of [['count', 'count'], ['gravity', 'gravity'], ['friction', 'friction'], ['size', 'size'], ['pace', 'pace']]) number(key, id);
    this.ownCount = asked.has('count');
    for (const [key, id] of [['throw', 'missile'], ['sky', 'sky'], ['speed', 'speed']]) choice(key, id);
    for (const name of (asked.get('show') ?? '').split(',')) if (SHOWN.includes(name)) element(`show-${name}`).checked = true;
    this.show();
    if (asked.has('gravity')) this.given.gravity = Number(element('gravity').value);
    if (asked.has('friction')) this.given.friction = Number(element('friction').value);
    this.colorAsked = asked.get('color');
    if (asked.has('speed')) this.tell('speed', { value: Number(element('speed').value) });
  }
  // What the page's address says of scene and settings.
  write() {
    const kept = new URLSearchParams(location.search), to = new URLSearchParams();
    for (const key of ['threads', 'play']) if (kept.has(key)) to.set(key, kept.get(key));
    const { source } = this;
    if (this.file?.name) to.set('scene', this.file.name);
    else if (source?.demo) to.set('demo', source.demo);
    else if (source?.heap) to.set('heap', source.heap.shape);
    if (source?.bodies && this.ownCount) to.set('count', source.bodies);
    if (source?.heap) to.set('count', source.heap.count);
    for (const key of ['gravity', 'friction']) if (this.given[key] !== undefined) to.set(key, this.given[key]);
    for (const [key, id, usual] of [['throw', 'missile', 'sphere'], ['size', 'size', '0.5'], ['pace', 'pace', '18'], ['sky', 'sky', ''], ['speed', 'speed', '1']])
      if (element(id).value !== usual) to.set(key, element(id).value);
    const shown = SHOWN.filter((name) => this.shows[name]);
    if (shown.length > 0) to.set('show', shown);
    if (this.palette && this.palette.by !== this.scene.head.colors.first) to.set('color', this.palette.by);
    history.replaceState(null, '', `${location.pathname}?${String(to).replaceAll('%2C', ',')}`);
  }
  async openFile(name) {
    try {
      if (!FILE.test(name)) throw new Error(`scene: "${name}" is no name of a .json file in this page's folder`);
      const response = await fetch(new URL(name, location.href), { credentials: 'omit', redirect: 'error' });
      if (!response.ok) throw new Error(`scene: ${name} cannot be loaded: ${response.status}`);
      this.file = { name, json: await response.text() };
    } catch (error) {
      this.trouble(error.message);
      this.file = null;
    }
    await this.open();
  }
  chosen() {
    if (this.file) return { json: this.file.json };
    const name = element('scene').value, count = Number(element('count').value);
    if (name === '(heap)') return { heap: { shape: element('shape').value, count } };
    const demo = this.demos.find((one) => one.name === name);
    return demo.count ? { demo: name, bodies: this.ownCount ? count : Math.min(demo.count, MOST_UNASKED) } : { demo: name };
  }
  // A scene of a file or of a text stands in the list while it is the scene.
  showFile() {
    const scenes = element('scene'), shown = [...scenes.options].find(({ value }) => value === '(file)');
    if (!this.file) return shown?.remove();
    const option = shown ?? scenes.appendChild(new Option('', '(file)'));
    option.textContent = this.file.name || 'A pasted scene';
    scenes.value = '(file)';
  }
  async open() {
    this.showFile();
    const source = this.chosen(), name = element('scene').value, demo = this.demos.find((one) => one.name === name);
    const heap = name === '(heap)';
    element('name').textContent = this.file ? this.file.name || 'A pasted scene' : heap ? 'A heap' : name[0].toUpperCase() + name.slice(1);
    element('line').textContent = this.file || heap ? '' : demo.line;
    element('count').disabled = Boolean(this.file) || !(heap || demo.count);
    element('shape-row').hidden = !heap;
    for (const id of ['bits-here', 'bits-native']) element(id).textContent = '…';
    element('bits-verdict').textContent = '';
    element('bits').className = 'panel';
    element('bits-of').textContent = 'Comparing bits';
    this.checked = null;
    this.tell('open', { source, given: this.given });
    const opened = await Promise.race([this.answer('opened'), this.answer('failed')]);
    if (opened.kind === 'failed') {
      element('bits-of').textContent = 'No scene';
      return false;
    }
    if (this.colorAsked) this.chooseColor(this.colorAsked);
    this.colorAsked = null;
    if (!heap) element('count').value = source.bodies ?? opened.bodies;
    this.showNumbers();
    this.write();
    this.tell('check', { source });
    return true;
  }
  set() {
    this.tell('set', { given: this.given });
    this.write();
  }
  showNumbers() {
    const gravity = Number(element('gravity').value), known = GRAVITIES.find(([value]) => Math.abs(value - gravity) < 0.011);
    element('gravity-told').textContent = known ? known[1] : `${gravity} m/s²`;
    element('gravity').setAttribute('aria-valuetext', `${gravity} metres per second squared${known ? `, ${known[1]}` : ''}`);
    element('friction-told').textContent = `× ${element('friction').value}`;
    element('count-told').textContent = Number(element('count').value).toLocaleString('en');
    element('size-told').textContent = `${element('size').value} m`;
    element('pace-told').textContent = `${element('pace').value} m/s`;
  }
  // What is drawn over the bodies, as the boxes have it.
  show() {
    for (const name of SHOWN) this.shows[name] = element(`show-${name}`).checked;
    this.tell('show', { shows: { contacts: this.shows.contacts, joints: this.shows.joints } });
    if (this.palette) {
      this.palette.paler = this.shows.contacts;
      this.palette.choose(this.palette.by);
      drawLegend(this.palette);
      this.write();
    }
    this.change();
  }
  toggle(name) {
    const box = element(`show-${name}`);
    if (box.disabled) return;
    box.checked = !box.checked;
    this.show();
    this.say(`${name} ${box.checked ? 'shown' : 'not shown'}`);
  }
  fillColors() {
    const color = element('color'), { palette, scene } = this;
    color.replaceChildren(...quantitiesOf(palette, scene).filter(([value]) => !UNTOLD.includes(value)).map(([value, text]) => new Option(text, value)));
    if (![...color.options].some(({ value }) => value === palette.by)) palette.choose('speed');
  }
  chooseColor(value) {
    if (![...element('color').options].some((option) => option.value === value)) return;
    this.palette.choose(value);
    element('color').value = value;
    drawLegend(this.palette);
    this.say(`coloured by ${value}`);
    this.write();
    this.change();
  }

  setPlaying(on) {
    this.playing = on;
    this.tell('play', { on });
    element('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
    element('play-icon').setAttribute('d', on ? 'M3 2h4v12H3zM9 2h4v12H9z' : 'M4 2l10 6-10 6z');
    this.rates = [];
    this.change();
  }
  step() {
    this.setPlaying(false);
    this.tell('step', { count: 1 });
  }

  // ---- view and hands
  // The view goes with a body; -1: with none.
  follow(place) {
    this.follows = place;
    this.followed = null;
    this.change();
  }
  toggleFollow() {
    const on = this.follows !== this.selected && this.selected >= 0;
    this.follow(on ? this.selected : -1);
    this.say(on ? `following ${this.scene.bodies[this.selected].label}` : 'following no body');
  }
  keepFollowing() {
    const { follows } = this;
    if (!(follows >= 0) || !this.pose.exists[follows]) return;
    const at = this.positionOf(follows);
    if (this.followed) this.camera.move(sub(at, this.followed));
    this.followed = at;
  }
  goHome() {
    const { low, high } = this.scene.head, middle = scaled(add(low, high), 0.5);
    this.camera.set(this.first ?? { eye: add(middle, scaled([0.55, 0.4, 0.75], 1.4 * length(sub(high, low)))), target: middle, fov: 45, orthographic: false });
    this.change();
  }
  takeCamera() {}
  pan(right, up) { this.camera.pan(right, up); }
  positionOf(place) { return this.marks.positionOf(place); }
  // The line of sight through a pixel of the page.
  ray(x, y) {
    const { camera, canvas } = this, view = camera.frame(), px = x / canvas.clientWidth * camera.width, py = (1 - y / canvas.clientHeight) * camera.height;
    const at = add(add(view.corner, scaled(view.stepX, px)), scaled(view.stepY, py));
    return camera.orthographic ? { from: sub(add(camera.eye, at), scaled(view.back, -100 * camera.distance)), along: scaled(view.back, -1) }
      : { from: [...camera.eye], along: unit(at) };
  }
  throwAt(x = this.canvas.clientWidth / 2, y = this.canvas.clientHeight / 2) {
    const { from, along } = this.ray(x, y), size = Number(element('size').value);
    const near = this.camera.orthographic ? 100 * this.camera.distance - this.camera.distance : Math.min(2 * size + 0.3, 0.4 * this.camera.distance);
    this.tell('throw', { shape: element('missile').value, size, position: add(from, scaled(along, near)), velocity: scaled(along, Number(element('pace').value)) });
    this.say(`a ${SHAPES[element('missile').value].one.toLowerCase()} flies`);
    if (!this.playing) this.setPlaying(true);
  }
  select(place) {
    this.selected = place;
    if (place >= 0) {
      const body = this.scene.bodies[place];
      this.say(`${body.label} chosen: ${body.shape}, ${numberText(body.mass)} kg`);
    }
    this.change();
  }
  selectNext(way) {
    const { bodies } = this.scene, count = bodies.length;
    for (let k = 1, place = this.selected; k <= count; ++k) {
      place = (place + way + count + (place < 0 && way < 0 ? 1 : 0)) % count;
      if (this.pose.exists[place] && !bodies[place].plane && bodies[place].motion === DYNAMIC) return this.select(place);
    }
  }
  grab(hand, from, along) {
    if (this.grabs) this.drop();
    this.grabs = { hand, place: -1, target: null };
    this.tell('grab', { hand, from, along });
    if (!this.playing) this.setPlaying(true);
  }
  drop() {
    if (!this.grabs) return;
    this.tell('drop', { hand: this.grabs.hand });
    this.grabs = null;
    this.canvas.classList.remove('grabs');
    this.say('let go');
    this.change();
  }
  moveHand(target) {
    if (!this.grabs || this.grabs.place < 0) return;
    this.grabs.target = target;
    this.tell('move', { hand: this.grabs.hand, target });
    this.change();
  }
  // In the plane through what was grabbed, across the line of sight.
  pullTo(x, y) {
    if (!this.grabs?.point) return;
    const { from, along } = this.ray(x, y), { back } = this.camera.axes(), dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const way = dot(sub(this.grabs.point, from), back) / dot(along, back);
    if (Number.isFinite(way) && way > 0) this.moveHand(add(from, scaled(along, way)));
  }
  grabChosen() {
    if (this.grabs) return this.drop();
    if (this.selected < 0) this.selectNext(1);
    if (this.selected < 0) return;
    // From just outside, since others may stand in the way of the eye.
    const at = this.positionOf(this.selected), out = unit(sub(this.camera.eye, at)), radius = this.renderer.bodyRadius?.[this.selected] ?? 1;
    this.grab(KEYS, add(at, scaled(out, 1.01 * radius)), scaled(out, -1));
  }

  // ---- pictures
  tick(now) {
    requestAnimationFrame((time) => this.tick(time));
    if (!this.dirty || !this.frame || this.frame.count !== this.scene.bodies.length) return;  // bodies come before the frame that has them
    this.dirty = false;
    const { renderer, pose, scene, palette, frame } = this;
    pose.shown = 0;
    for (let i = 0; i < frame.count; ++i) pose.shown += pose.exists[i];
    pose.paint(palette, scene, null, null, 1, null, 1);
    this.keepFollowing();
    this.lines.clear();
    this.jointLines.clear();
    const { touching, joints } = frame;
    if (this.shows.contacts && touching) this.marks.addContacts(this.lines, touching, (i) => touching.force[i]);
    if (this.shows.joints && joints?.length === scene.joints.length) this.marks.addJoints(this.jointLines, (i) => joints[i] < 0, (i) => joints[i]);
    if (this.shows.velocities) this.marks.addVelocities(this.lines);
    if (this.grabs?.place >= 0) this.addGrip();
    renderer.draw(this.camera, scene, pose, this.selected, this.lines, this.jointLines, accent());
    if (this.software) renderer.gl.finish();
    ++this.pictures;
    this.governor.drawn(now, this.playing);
    this.tellPace(now);
  }
  addGrip() {
    const { place, target, point } = this.grabs, at = sub(this.positionOf(place), this.camera.eye), to = sub(target ?? point, this.camera.eye);
    this.lines.add(at, to, 1.6, 1, [1, 0.85, 0.2, 1]);
    this.lines.add(to, to, 6, 1, [1, 0.85, 0.2, 1]);
  }
  tellPace(now) {
    const { frame, rates } = this;
    rates.push([now, frame.steps]);
    while (rates.length > 2 && now - rates[0][0] > 1500) rates.shift();
    if (this.told && now - this.told < 200) return;
    this.told = now;
    const seconds = (now - rates[0][0]) / 1000;
    this.stepsPerSecond = this.playing && seconds > 0.3 ? Math.max(0, frame.steps - rates[0][1]) / seconds : 0;
    const bodies = this.pose.shown;
    element('facts').textContent = `${frame.time.toFixed(2)} s · step ${frame.steps.toLocaleString('en')} · ${bodies.toLocaleString('en')} ${bodies === 1 ? 'body' : 'bodies'}`
      + (frame.sleepers ? ` · ${frame.sleepers.toLocaleString('en')} asleep` : '');
    element('pacing').textContent = this.playing ? `${Math.round(this.stepsPerSecond)} steps/s · ${frame.stepMs.toFixed(1)} ms a step · ${this.threads === 1 ? '1 thread' : `${this.threads} threads`}`
      : 'paused';
  }

  // ---- controls
  setUp() {
    const on = (id, event, work) => element(id).addEventListener(event, work);
    on('play', 'click', () => this.setPlaying(!this.playing));
    on('step', 'click', () => this.step());
    on('again', 'click', () => this.open());
    on('throw', 'click', () => this.throwAt());
    on('home', 'click', () => this.goHome());
    on('scene', 'change', () => {
      this.file = null;
      this.ownCount = false;
      if (element('scene').value === '(heap)') element('count').value = 300;
      this.open();
    });
    on('shape', 'change', () => this.open());
    on('count', 'change', () => {
      this.ownCount = true;
      this.open();
    });
    for (const id of ['count', 'gravity', 'friction', 'size', 'pace']) on(id, 'input', () => this.showNumbers());
    for (const id of ['gravity', 'friction'])
      on(id, 'input', () => {
        this.given[id] = Number(element(id).value);
        this.set();
      });
    for (const id of ['missile', 'size', 'pace']) on(id, 'change', () => this.write());
    on('color', 'change', () => this.chooseColor(element('color').value));
    on('sky', 'change', () => {
      this.renderer.sky = element('sky').value || this.scene.head.sky;
      this.write();
      this.change();
    });
    on('speed', 'change', () => {
      this.tell('speed', { value: Number(element('speed').value) });
      this.write();
    });
    const settings = element('settings'), more = element('more');
    const show = (shown) => {
      settings.hidden = !shown;
      more.setAttribute('aria-expanded', shown);
    };
    show(innerWidth > 640);
    more.addEventListener('click', () => {
      show(settings.hidden);
      if (!settings.hidden) element('scene').focus();
    });
    on('ask', 'click', () => element('help').showModal());
    on('paste', 'click', () => element('pasting').showModal());
    on('use', 'click', async () => {
      const before = [this.file, element('scene').value];
      this.file = { name: '', json: element('text').value };
      element('pasting').close();
      if (await this.open()) return;
      [this.file, element('scene').value] = before;
      this.showFile();
    });
    followTheme(() => this.change());
    followPointers(this.canvas, this);
    this.canvas.addEventListener('dblclick', (event) => this.throwAt(event.offsetX, event.offsetY));
    document.addEventListener('keydown', (event) => this.key(event));
    addEventListener('resize', () => {
      if (this.palette) drawLegend(this.palette);
      this.change();
    });
    for (const name of SHOWN) on(`show-${name}`, 'change', () => this.show());
  }
  // A drag that begins on a body that moves pulls it.
  beginDrag(event) {
    const { offsetX: x, offsetY: y } = event, place = event.button === 0 && !event.shiftKey && this.frame ? this.renderer.pick(this.camera, x, y) : -1;
    this.change();
    if (place < 0 || this.scene.bodies[place].motion !== DYNAMIC) return false;
    const { from, along } = this.ray(x, y);
    this.canvas.classList.add('grabs');
    this.grab(HAND, from, along);
    return true;
  }
  drag(event) { this.pullTo(event.offsetX, event.offsetY); }
  endDrag() { if (this.grabs?.hand === HAND) this.drop(); }

  key(event) {
    const on = event.target, inView = on === this.canvas || on === document.body, { camera } = this;
    if (event.ctrlKey || event.metaKey || event.altKey || element('help').open || element('pasting').open || !this.scene) return;
    if (on.matches?.('select, textarea')) return;
    const takes = (work) => {
      event.preventDefault();
      work();
      this.change();
    };
    const arrows = { ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0], PageUp: [0, 0, 1], PageDown: [0, 0, -1] }[event.key];
    if (inView && arrows && this.grabs?.place >= 0) {
      const [right, up, away] = arrows;
      return takes(() => {
        const axes = camera.axes(), size = 0.02 * camera.distance;
        let target = add(this.grabs.target ?? this.grabs.point, add(scaled(axes.right, right * size), scaled(axes.up, up * size)));
        target = add(target, scaled(axes.back, -away * size));
        this.moveHand(target);
      });
    }
    const moves = cameraKey(event, inView, this);
    if (moves) return takes(moves);
    if (inView && event.key === 'Home') return takes(() => this.goHome());
    if (on.matches?.('input[type="range"]') && /^(Arrow|Page|Home|End)/.test(event.key)) return;
    if (event.key === ' ' && !on.matches?.('button, input[type="checkbox"]')) return takes(() => this.setPlaying(!this.playing));
    const work = {
      '.': () => this.step(), '?': () => element('help').showModal(),
      escape: () => {
        this.drop();
        this.select(-1);
      },
      f: () => this.toggleFollow(), n: () => this.selectNext(1), p: () => this.selectNext(-1), g: () => this.grabChosen(), t: () => this.throwAt(), r: () => this.open(),
      k: () => this.toggle('contacts'), j: () => this.toggle('joints'), v: () => this.toggle('velocities'),
      c: () => {
        const { options, selectedIndex } = element('color');
        this.chooseColor(options[(selectedIndex + 1) % options.length].value);
      },
    }[event.key.toLowerCase()];
    if (work) takes(work);
  }

  // For tests and for pages around this one.
  state() {
    const body = this.scene?.bodies[this.selected];
    return { ready: Boolean(this.frame), pictures: this.pictures, frames: this.frames, steps: this.frame?.steps ?? 0, time: this.frame?.time ?? 0,
      bodies: this.pose.shown ?? 0, sleepers: this.frame?.sleepers ?? 0, playing: this.playing, threads: this.threads, checked: this.checked,
      picked: body ? body.label : null, grabs: this.grabs?.place ?? -1, follows: this.follows ?? -1, source: this.source, given: { ...this.given }, eye: [...this.camera.eye],
      stepMs: this.frame?.stepMs ?? 0, late: this.frame?.late ?? 0, stepsPerSecond: this.stepsPerSecond ?? 0, quality: this.renderer.quality,
      color: this.palette?.by, troubles: this.troubles, shown: { ...this.shows }, touching: this.frame?.touching?.count ?? 0,
      lines: this.lines.count, jointLines: this.jointLines.count };
  }
  async hash() {
    this.tell('hash');
    return this.answer('hash');
  }
  async measure(count) {
    this.tell('measure', { count });
    return (await this.answer('measured')).times;
  }
}

try {
  const playground = new Playground();
  window.scree = playground;
  requestAnimationFrame((time) => playground.tick(time));
  playground.begin().catch((error) => playground.trouble(error.message));
} catch (error) {
  const box = element('trouble');
  box.textContent = `The playground cannot run here: ${error.message}`;
  box.hidden = false;
  console.error(error);
}

