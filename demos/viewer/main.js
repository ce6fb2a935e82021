// The page: opens the recording that it holds, and plays it.
import { Camera } from './camera.js';
import { Palette } from './colors.js';
import { Controls } from './controls.js';
import { BodyHistory } from './graphs.js';
import { openLive } from './live.js';
import { add, dot, length, rotated, scaled, sub, unit } from './math.js';
import { Pose } from './pose.js';
import { isSoftware, Lines, Renderer, WORST_QUALITY } from './renderer.js';
import { FIXED } from './scene.js';
import { RecordedSource } from './source.js';

const PUSHING = [0.16, 1.0, 0.42, 1], VELOCITY = [0.95, 0.95, 1.0, 0.95], AXIS = [0.95, 0.95, 1.0], HIT = [1.0, 0.85, 0.2], BROKE = [1.0, 0.2, 0.1];
// Colours of joint forces: none, about 10 times and about 100 times the lighter body's weight.
const LIGHT = [0.02, 0.78, 1.0], LADEN = [1.0, 0.80, 0.04], HEAVY = [1.0, 0.03, 0.05], DOUBLINGS = 7;
const SHOWN_FOR = 0.25;  // s, of hits

class Player {
  constructor(source, canvas) {
    this.source = source;
    this.software = isSoftware();
    this.renderer = new Renderer(canvas, this.software);
    this.camera = new Camera();
    this.pose = new Pose();
    this.lines = new Lines();
    this.jointLines = new Lines();
    this.frame = 0;
    this.speed = 1;
    this.loops = true;
    this.playing = false;
    this.selected = -1;
    this.follows = false;
    this.ownCamera = true;  // the scene's, until the user takes it
    this.history = null;
    this.dirty = true;
    this.quality = 'auto';
    this.paces = [];
    this.drawnFrames = 0;
    this.takeScene();
    source.onReady = () => this.change();
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => location.reload());
  }
  // Light, colours and marks as the scene's head tells them.
  takeScene() {
    this.scene = this.source.scene;
    const { head } = this.scene, gravity = length(head.gravity);
    this.renderer.sky = this.renderer.ownSky = head.sky;
    this.renderer.sun = head.sun;
    this.palette = new Palette(head);
    this.shows = { contacts: false, joints: false, velocities: false, hits: false, sleep: false };
    for (const name of head.show) if (name in this.shows) this.shows[name] = true;
    this.applyShown();
    this.pull = gravity > 0 ? gravity : 9.81;
    this.markPush = (gravity > 0 ? gravity : 4) / (head.rate * head.substeps);
  }
  change() { this.dirty = true; }
  get duration() { return this.source.count - 1; }
  get time() { return this.frame * this.source.seconds; }
  newHistory(place) { return new BodyHistory(this.source, place, () => this.change()); }
  addMore() {}  // lines of what a live view has

  setPlaying(on) {
    if (on && !this.loops && this.frame >= this.duration) this.frame = 0;
    this.playing = on && this.duration > 0;
    this.last = null;
    this.change();
  }
  seek(frame) {
    this.frame = Math.max(0, Math.min(frame, this.duration));
    this.change();
  }
  show(name, on) {
    this.shows[name] = on;
    this.applyShown();
    this.change();
  }
  applyShown() {
    this.palette.paler = this.shows.contacts;
    this.palette.dull = this.shows.sleep;
    this.palette.choose(this.palette.by);
  }
  setQuality(word) {
    this.quality = word;
    if (word !== 'auto') this.renderer.quality = Number(word);
    this.paces = [];
    this.change();
  }

  takeCamera() { this.ownCamera = false; }
  pan(right, up) {
    if (this.follows) this.follow(false);
    this.camera.pan(right, up);
  }
  goHome() {
    this.follow(false);
    this.ownCamera = true;
    this.change();
  }
  follow(on) {
    this.follows = on && this.selected >= 0;
    this.followed = null;
    if (this.follows) this.takeCamera();
    this.controls?.showPicked();
    this.change();
  }
  lookAt() {
    if (this.selected < 0 || !this.pose.exists[this.selected]) return;
    this.takeCamera();
    const { camera } = this, at = this.positionOf(this.selected);
    camera.move(sub(at, camera.target));
    const radius = this.renderer.bodyRadius?.[this.selected] || 1;
    camera.zoom(Math.min(1, 5 * radius / (camera.slope * camera.distance)));
    this.change();
  }
  positionOf(place) { return Array.from(this.pose.position.subarray(3 * place, 3 * place + 3)); }

  select(place, looks = false) {
    if (this.selected === place) return;
    this.history?.stop();
    this.history = null;
    this.selected = place;
    if (place < 0) this.follows = false;
    else if (!this.scene.bodies[place].plane) this.history = this.newHistory(place);
    this.controls.showPicked();
    if (looks) this.lookAt();
    this.change();
  }
  // The next body that is there and may move, else any.
  selectNext(way) {
    const { bodies } = this.scene, count = bodies.length;
    for (const anyone of [false, true])
      for (let k = 1, place = this.selected; k <= count; ++k) {
        place = (place + way + count + (place < 0 && way < 0 ? 1 : 0)) % count;
        const body = bodies[place];
        if (this.pose.exists[place] && !body.plane && (anyone || body.motion !== FIXED)) return this.select(place);
      }
  }
  pickAt(x, y) {
    const place = this.renderer.pick(this.camera, x, y);
    this.select(place);
    this.change();
  }

  tick(now) {
    requestAnimationFrame((time) => this.tick(time));
    if (this.playing) {
      const passed = this.last === null || this.last === undefined ? 0 : Math.min((now - this.last) / 1000, 0.25);
      this.last = now;
      this.frame += passed * this.speed / this.source.seconds;
      if (this.frame > this.duration) {
        if (this.loops) {
          this.frame = this.frame % Math.max(this.duration, 1e-9);
        } else {
          this.frame = this.duration;
          this.playing = false;
        }
      }
      this.dirty = true;
    }
    if (!this.dirty) return;
    this.dirty = false;
    this.draw(now);
  }

  draw(now) {
    const { source, scene, pose, palette, renderer } = this, { head } = scene;
    const index = Math.min(Math.floor(this.frame), Math.max(0, this.duration - 1));
    const started = performance.now();
    if (!source.show(index) && source.now.index < 0) return;
    // While a block is unpacked the picture before stays.
    const before = source.now.index > 0 && source.before.index === source.now.index - 1 ? source.before : source.now;
    const part = before === source.now ? 1 : Math.max(0, Math.min(1, this.frame - before.index));
    this.decoded = performance.now() - started;
    pose.set(before, source.now, part, head, source.seconds);
    const near = part < 0.5 ? before : source.now;
    pose.paint(palette, scene, before, source.now, near, source.seconds, (level) => source.decoder.forceOf(level), 1 / (head.rate * head.substeps));
    this.moveCamera(before, source.now, part);
    this.lines.clear();
    if (this.shows.contacts) this.addContacts(near);
    this.jointLines.clear();
    if (this.shows.joints) this.addJoints(near);
    if (this.shows.velocities) this.addVelocities();
    if (this.shows.hits) this.addHits();
    this.addMore();
    const dark = document.documentElement.dataset.theme === 'dark';
    renderer.draw(this.camera, scene, pose, this.selected, this.lines, this.jointLines, dark ? [0.35, 0.75, 1, 1] : [0.02, 0.45, 0.95, 1]);
    ++this.drawnFrames;
    this.controls.update();
    if (this.software) renderer.gl.finish();
    this.govern(now);
  }

  // Lowers the quality while pictures come too slowly.
  govern(now) {
    const pace = this.lastDrawn ? now - this.lastDrawn : 0;
    this.lastDrawn = now;
    if (!this.playing || this.quality !== 'auto' || pace <= 0 || pace > 5000) return;
    this.paces.push(pace);
    const enough = pace > 150 ? 3 : 16;
    if (this.paces.length < enough) return;
    const middle = this.paces.sort((a, b) => a - b)[this.paces.length >> 1];
    this.paces = [];
    if (middle > 45 && this.renderer.quality < WORST_QUALITY) ++this.renderer.quality;
  }

  moveCamera(before, now, part) {
    const { camera } = this, a = before.camera, b = now.camera;
    if (this.ownCamera && a && b) {
      const mix = (x, y) => x.map((v, i) => v + (y[i] - v) * part);
      camera.set({ eye: mix(a.eye, b.eye), target: mix(a.target, b.target), fov: a.fov + (b.fov - a.fov) * part, orthographic: b.orthographic });
    } else if (this.ownCamera) {
      const { low, high } = this.scene.head, middle = scaled(add(low, high), 0.5);
      camera.set({ eye: add(middle, scaled([0.55, 0.4, 0.75], 1.4 * length(sub(high, low)))), target: middle, fov: 45, orthographic: false });
    }
    if (!this.follows || !this.pose.exists[this.selected]) return;
    const at = this.positionOf(this.selected);
    if (this.followed) camera.move(sub(at, this.followed)); else camera.move(sub(at, camera.target));
    this.followed = at;
  }

  fromEye(point) { return sub(point, this.camera.eye); }
  turnedOn(place, v) {
    const q = this.pose.orientation.subarray(4 * place, 4 * place + 4);
    return rotated(q, v);
  }

  addContacts({ contacts }) {
    if (!contacts) return;
    const { decoder } = this.source, { bodies } = this.scene, radius = this.renderer.bodyRadius ?? [];
    const substep = 1 / (this.scene.head.rate * this.scene.head.substeps);
    for (let i = 0; i < contacts.count; ++i) {
      const a = contacts.a[i], b = contacts.b[i];
      if (!this.pose.exists[a] || !this.pose.exists[b]) continue;
      const sizes = [a, b].filter((place) => bodies[place].mass > 0).map((place) => 0.5 * radius[place]);
      const size = Math.min(...sizes, 1e6), masses = [a, b].map((place) => bodies[place].mass).filter((mass) => mass > 0);
      const push = decoder.forceOf(contacts.level[i]) * substep / Math.min(...masses);
      const half = size * Math.min(0.25 * Math.sqrt(push / this.markPush), 0.95);
      const point = this.fromEye(Array.from(contacts.point.subarray(3 * i, 3 * i + 3)));
      const normal = Array.from(contacts.normal.subarray(3 * i, 3 * i + 3)), way = scaled(normal, half);
      this.lines.add(sub(point, way), add(point, way), 1.1, 0.4 * size, PUSHING);
      this.lines.add(point, point, Math.max(1.3, Math.min(0.15 * size / (length(point) * (this.renderer.view?.pixel ?? 1e-3)), 5)), 0.4 * size, PUSHING);
    }
  }

  addJoints(now) {
    const { scene, pose } = this, radius = this.renderer.bodyRadius ?? [], ratio = this.renderer.canvas.height / 720;
    scene.joints.forEach((joint, i) => {
      if (now.jointBroken[i]) return;
      const ends = [[joint.a, joint.anchorA], [joint.b, joint.anchorB]].map(([place, anchor]) => {
        if (place < 0) return { anchor: this.fromEye(anchor), middle: null, reach: 0, mass: 0 };
        const middle = this.fromEye(this.positionOf(place)), { plane, mass } = scene.bodies[place];
        return { anchor: add(middle, this.turnedOn(place, anchor)), middle: plane ? null : middle, gone: !pose.exists[place], reach: radius[place] ?? 0, mass };
      });
      if (ends.some((end) => end.gone)) return;
      const [a, b] = ends, masses = ends.map((end) => end.mass).filter((mass) => mass > 0);
      const reaches = ends.filter((end) => end.mass > 0).map((end) => end.reach), lift = reaches.length ? Math.min(...reaches) : 0;
      const force = this.source.decoder.forceOf(now.jointForce[i] ?? 0);
      const strength = Math.max(0, Math.min(1, Math.log2(1 + force / Math.min(...masses) / this.pull) / DOUBLINGS));
      const mix = (x, y, t) => x.map((v, k) => v + (y[k] - v) * t);
      const color = [...(strength < 0.5 ? mix(LIGHT, LADEN, 2 * strength) : mix(LADEN, HEAVY, 2 * strength - 1)), 1];
      const pixel = this.camera.orthographic ? (this.renderer.view?.pixel ?? 0.01) : length(a.anchor) * (this.renderer.view?.pixel ?? 0.001);
      const dotRadius = Math.max(1.2, Math.min(0.4 * lift / pixel, Math.max(2.2, 3.4 * ratio))), thin = Math.min(Math.max(0.8, 1.2 * ratio), 0.6 * dotRadius);
      for (const end of ends) if (end.middle) this.jointLines.add(end.middle, end.anchor, thin, end.reach, color);
      this.jointLines.add(a.anchor, b.anchor, thin, lift, color);
      if (joint.axis) {
        let x = rotated(joint.frame, [1, 0, 0]);
        if (joint.a >= 0) x = this.turnedOn(joint.a, x);
        const size = Math.max(3 * dotRadius * pixel, Math.min(0.5 * lift, 8 * dotRadius * pixel));
        this.jointLines.add(sub(a.anchor, scaled(x, size)), add(a.anchor, scaled(x, size)), thin, lift, [...AXIS, 1]);
      }
      this.jointLines.add(a.anchor, a.anchor, dotRadius, lift, color);
      this.jointLines.add(b.anchor, b.anchor, dotRadius, lift, color);
    });
  }

  addVelocities() {
    const { pose, scene } = this, radius = this.renderer.bodyRadius ?? [];
    for (let i = 0; i < pose.size; ++i) {
      if (!pose.exists[i] || scene.bodies[i].motion === FIXED) continue;
      const v = [pose.velocity[3 * i], pose.velocity[3 * i + 1], pose.velocity[3 * i + 2]];
      if (dot(v, v) < 1e-4) continue;
      const from = this.fromEye(this.positionOf(i)), to = add(from, scaled(v, 0.2)), along = unit(v), head = Math.min(0.3 * length(v) * 0.2, 0.3 * radius[i]);
      this.lines.add(from, to, 0.9, radius[i], VELOCITY);
      const side = unit([along[1] - along[2], along[2] - along[0], along[0] - along[1]]);
      for (const way of [1, -1]) this.lines.add(to, add(sub(to, scaled(along, head)), scaled(side, 0.5 * way * head)), 0.9, radius[i], VELOCITY);
    }
  }

  addHits() {
    const seconds = this.time, { events } = this.scene;
    let low = 0, high = events.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (events[middle].time < seconds - SHOWN_FOR) low = middle + 1; else high = middle;
    }
    for (let i = low; i < events.length && events[i].time <= seconds; ++i) {
      const event = events[i], age = (seconds - event.time) / SHOWN_FOR;
      const point = event.kind === 'hit' ? event.point : event.a >= 0 ? this.positionOf(event.a) : null;
      if (!point) continue;
      const from = this.fromEye(point), radius = this.renderer.bodyRadius?.[Math.max(event.a, 0)] || 0.5;
      this.lines.add(from, from, 3 + 9 * age, radius, [...(event.kind === 'hit' ? HIT : BROKE), 0.9 * (1 - age)]);
    }
  }

  // For tests and for pages around this one.
  state() {
    const body = this.scene.bodies[this.selected];
    return { time: this.frame * this.source.seconds, frame: this.frame, frames: this.source.count, playing: this.playing, speed: this.speed,
      bodies: this.pose.shown, drawn: this.renderer.total, picked: body ? body.label : null, follows: this.follows, color: this.palette.by,
      quality: this.renderer.quality, pictures: this.drawnFrames, decodeMs: this.decoded, ready: this.source.now.index >= 0,
      eye: [...this.camera.eye], shown: { ...this.shows } };
  }
}

async function begin() {
  const blocks = document.querySelectorAll('script[type="application/x-scree"]');
  if (blocks[0]?.dataset.kind === 'live') return openLive(Player);
  const source = new RecordedSource(blocks);
  await source.open();
  const player = new Player(source, document.getElementById('view'));
  player.controls = new Controls(player);
  player.controls.drawMarks();
  window.scree = player;
  requestAnimationFrame((time) => player.tick(time));
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches && !/[#&]still\b/.test(location.hash)) player.setPlaying(true);
}

begin().catch((error) => {
  const trouble = document.getElementById('trouble');
  trouble.textContent = `This recording cannot be played: ${error.message}`;
  trouble.hidden = false;
  console.error(error);
});
