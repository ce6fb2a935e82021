// The page: opens the recording that it holds, and plays it.
import { Camera } from './camera.js';
import { Palette } from './colors.js';
import { Controls } from './controls.js';
import { BodyHistory } from './graphs.js';
import { openLive } from './live.js';
import { Marks } from './marks.js';
import { add, length, scaled, sub } from './math.js';
import { Pose } from './pose.js';
import { Governor } from './quality.js';
import { isSoftware, Lines, Renderer } from './renderer.js';
import { FIXED } from './scene.js';
import { RecordedSource } from './source.js';
import { accent } from './theme.js';

const HIT = [1.0, 0.85, 0.2], BROKE = [1.0, 0.2, 0.1];
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
    this.marks = new Marks(this);
    this.governor = new Governor(this.renderer);
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
    this.drawnFrames = 0;
    this.takeScene();
    source.onReady = () => this.change();
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => location.reload());
  }
  // Light, colours and marks as the scene's head tells them.
  takeScene() {
    this.scene = this.source.scene;
    const { head } = this.scene;
    this.renderer.sky = this.renderer.ownSky = head.sky;
    this.renderer.sun = head.sun;
    this.palette = new Palette(head);
    this.shows = { contacts: false, joints: false, velocities: false, hits: false, sleep: false };
    for (const name of head.show) if (name in this.shows) this.shows[name] = true;
    this.applyShown();
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
    this.governor.forget();
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
  positionOf(place) { return this.marks.positionOf(place); }

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
  tapped({ offsetX, offsetY }) {
    this.select(this.renderer.pick(this.camera, offsetX, offsetY));
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
    const { decoder } = source;
    if (this.shows.contacts && near.contacts) this.marks.addContacts(this.lines, near.contacts, (i) => decoder.forceOf(near.contacts.level[i]));
    this.jointLines.clear();
    if (this.shows.joints) this.marks.addJoints(this.jointLines, (i) => near.jointBroken[i], (i) => decoder.forceOf(near.jointForce[i] ?? 0));
    if (this.shows.velocities) this.marks.addVelocities(this.lines);
    if (this.shows.hits) this.addHits();
    this.addMore();
    renderer.draw(this.camera, scene, pose, this.selected, this.lines, this.jointLines, accent());
    ++this.drawnFrames;
    this.controls.update();
    if (this.software) renderer.gl.finish();
    this.governor.drawn(now, this.playing && this.quality === 'auto');
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

  fromEye(point) { return this.marks.fromEye(point); }

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
