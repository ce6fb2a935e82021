// The page live: frames from scree serve over a WebSocket, and what the driver does over the same.
import { chunksOf, unpacked } from './bytes.js';
import { Controls } from './controls.js';
import { FrameDecoder } from './frames.js';
import { drivingKeys, LivePanel } from './live_panel.js';
import { add, dot, scaled, sub, unit } from './math.js';
import { DYNAMIC, Scene } from './scene.js';

const DELAY = 1.5;         // frames that are shown later than they come, so that they are at hand
const MOST_BEHIND = 5;     // frames
const HISTORY = 300;       // frames of graphs
const EVENTS_KEPT = 1500;
const PULL = [1, 0.85, 0.2, 0.95];

// Frames as they come. `count` grows; those before are forgotten.
export class LiveSource {
  constructor(address) {
    this.live = true;
    this.scene = null;
    this.count = 0;
    this.waiting = [];  // frames that are not decoded yet
    this.seen = 0;
    this.pace = 30;     // frames a second, as they come
    this.bytes = 0;
    this.received = 0;
    this.state = null;
    this.listeners = {};
    this.chain = Promise.resolve();
    this.socket = new WebSocket(address);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onmessage = ({ data }) => {
      this.chain = this.chain.then(() => this.take(data)).catch((error) => this.fail(error));
    };
    this.socket.onclose = () => this.chain.then(() => this.end('The connection has ended.'));
  }
  tell(message) { if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message)); }
  fail(error) {
    console.error(error);
    this.end(`The stream cannot be read: ${error.message}`);
    this.socket.close();
  }
  end(reason) {
    if (this.ended) return;
    this.ended = true;
    this.onEnd?.(reason);
  }

  async take(data) {
    if (typeof data === 'string') return this.hear(JSON.parse(data));
    this.bytes += data.byteLength;
    for (const chunk of chunksOf(await unpacked(new Uint8Array(data)))) this.takeChunk(chunk);
    this.onNews?.();
  }
  hear(message) {
    if (message.type === 'hello') this.hello = message;
    if (message.type === 'state') this.state = message;
    if (message.type === 'bye') this.end(`${message.reason[0].toUpperCase()}${message.reason.slice(1)}.`);
    if (message.type === 'begin') this.fresh = new Scene();
    this.onMessage?.(message);
  }
  takeChunk(chunk) {
    const scene = this.fresh ?? this.scene;
    if (chunk.name === 'fram') {
      if (this.fresh) this.begin();
      this.measure();
      this.waiting.push(chunk.bytes);
      ++this.count;
      ++this.received;
    } else if (chunk.name === 'evnt') {
      const { version } = scene;
      scene.take(chunk);
      scene.version = version;
      scene.events.splice(0, scene.events.length - EVENTS_KEPT);
    } else {
      if (chunk.name === 'head' && !this.fresh) this.decodeAll();
      scene.take(chunk);
      if (chunk.name === 'head' && !this.fresh) this.newDecoder();
      if (chunk.name === 'body' && !this.fresh) this.decoder.planes = scene.bodies.map((body) => body.plane !== null);
    }
  }
  // The first frame of another scene, or of the same from its start.
  begin() {
    this.seen += this.waiting.length;
    this.waiting = [];
    this.count = 0;
    this.fresh.version += (this.scene?.version ?? 0) + 1;
    this.scene = this.fresh;
    this.fresh = null;
    this.newDecoder();
    this.onBegin?.();
  }
  newDecoder() {
    this.decoder = new FrameDecoder(this.scene.head.units);
    this.decoder.planes = this.scene.bodies.map((body) => body.plane !== null);
    this.pace = 1 / this.scene.head.seconds;
  }
  measure() {
    const now = performance.now(), gap = now - this.cameAt;
    this.cameAt = now;
    if (gap < 1000) this.pace += (Math.min(1000 / Math.max(gap, 4), 60) - this.pace) * 0.06;
  }

  get before() { return this.decoder.before; }
  get now() { return this.decoder.now; }
  // From the moment before to now, which may be a single step.
  get seconds() {
    const apart = this.now.index > 0 ? this.now.time - this.before.time : 0;
    return apart > 0 ? apart : this.scene.head.seconds;
  }
  show(frame) {
    const last = Math.max(0, Math.min(frame + 1, this.count - 1));
    while (this.waiting.length > 0 && this.now.index < last) this.decodeNext();
    this.acknowledge();
    return this.now.index >= 0;
  }
  decodeNext() {
    this.decoder.decode(this.waiting.shift(), this.count - this.waiting.length - 1);
    ++this.seen;
    this.onDecoded?.();
  }
  decodeAll() {
    while (this.waiting.length > 0) this.decodeNext();
    this.acknowledge();
  }
  acknowledge() {
    if (this.seen === this.told) return;
    this.told = this.seen;
    this.tell({ do: 'seen', frames: this.seen });
  }
}

// The graphs of a body over the last frames.
class LiveHistory {
  constructor(source, place) {
    const series = (title, unitName) => ({ title, unit: unitName, values: new Float32Array(HISTORY).fill(NaN) });
    this.place = place;
    this.source = source;
    this.done = 0;
    this.all = [series('Momentum', 'kg m/s'), series('Speed', 'm/s'), series('Contact force', 'N'), series('Net force', 'N')];
    this.all[3].about = 'change of momentum per time';
  }
  get series() { return this.all; }
  get cursor() { return Math.max(0, this.done - 1); }
  stop() {}
  add() {
    const { source, place } = this, { now, decoder, scene } = source, { mass } = scene.bodies[place];
    if (this.done === HISTORY) for (const { values } of this.all) values.copyWithin(0, 1);
    const at = Math.min(this.done, HISTORY - 1);
    this.done = at + 1;
    for (const { values } of this.all) values[at] = NaN;
    if (place >= now.count || !now.exists[place]) {
      this.last = null;
      return;
    }
    const v = [0, 1, 2].map((k) => now.velocity[3 * place + k] * scene.head.units.velocity), speed = Math.hypot(...v);
    this.all[0].values[at] = mass * speed;
    this.all[1].values[at] = speed;
    this.all[2].values[at] = decoder.forceOf(now.force[place]);
    if (this.last) this.all[3].values[at] = mass * Math.hypot(...sub(v, this.last)) / source.seconds;
    this.last = v;
  }
}

const livePlayer = (Player) => class extends Player {
  constructor(source, canvas) {
    super(source, canvas);
    this.pointer = null;  // pixels of the page, from the canvas's upper left
    this.held = null;
    source.onBegin = () => this.begin();
    source.onNews = () => this.change();
    source.onDecoded = () => this.history?.add();
    this.shownScene = source.scene.head.title;
  }
  get drives() { return !this.source.ended && this.source.state !== null && this.source.hello.you === this.source.state.driver; }
  get time() { return this.source.now.time; }
  tell(message) { this.source.tell(message); }
  newHistory(place) { return new LiveHistory(this.source, place); }

  begin() {
    const { scene } = this.source, same = scene.head.title === this.shownScene, { by } = this.palette, { shows } = this;
    const id = this.scene.bodies[this.selected]?.id;
    this.letGo();
    this.renderer.forgetScene();
    this.pose.fixed = null;
    this.frame = 0;
    this.takeScene();
    if (same) {
      this.shows = shows;
      this.applyShown();
      if (this.palette.scales[by] || !this.scene.head.colors.scales[by]) this.palette.choose(by);
    } else {
      this.ownCamera = true;
    }
    this.shownScene = scene.head.title;
    this.select(-1);
    if (same && id !== undefined) this.select(scene.bodies.findIndex((body) => body.id === id));
    this.controls?.fillSettings();
    this.change();
  }

  // Shows frames a little later than they come, at the pace at which they come.
  tick(now) {
    requestAnimationFrame((time) => this.tick(time));
    const { source } = this, newest = source.count - 1, passed = Math.min((now - (this.last ?? now)) / 1000, 0.25), before = this.frame;
    this.last = now;
    this.playing = source.state !== null && !source.state.paused && !source.ended;
    const behind = newest - this.frame;
    if (behind > MOST_BEHIND) this.frame = newest - DELAY;
    else if (this.playing) this.frame += passed * source.pace * Math.max(0, Math.min(2, 1 + 0.25 * (behind - DELAY)));
    else this.frame += passed * Math.max(source.pace, 10);
    this.frame = Math.max(0, Math.min(this.frame, newest));
    this.flushPointer();
    if (this.frame !== before) this.change();
    if (!this.dirty) return;
    this.dirty = false;
    this.draw(now);
  }

  setPlaying(on) { this.tell({ do: 'pause', on: !on }); }
  seek() {}
  select(place, looks = false) {
    const changed = place !== this.selected;
    super.select(place, looks);
    if (changed && this.drives) this.tell(place < 0 ? { do: 'select' } : { do: 'select', body: this.scene.bodies[place].id });
  }

  // ---- what the driver does with the pointer
  at() {
    const { camera, renderer: { canvas } } = this, [x, y] = this.pointer ?? [canvas.clientWidth / 2, canvas.clientHeight / 2];
    return { eye: [...camera.eye], target: [...camera.target], fov: Math.min(170, 2 * Math.atan(camera.slope) * 180 / Math.PI),
      width: canvas.clientWidth, height: canvas.clientHeight, x, y };
  }
  pointAt(x, y) {
    this.pointer = [x, y];
    if (this.held) this.pointerMoved = true;
  }
  flushPointer() {
    if (!this.pointerMoved) return;
    this.pointerMoved = false;
    this.tell({ do: 'move', at: this.at() });
  }
  // Takes hold of a body that is under the pointer; whether there is one.
  grab(x, y) {
    if (!this.drives) return false;
    const place = this.renderer.pick(this.camera, x, y), body = this.scene.bodies[place];
    this.pointer = [x, y];
    if (!body || body.motion !== DYNAMIC) return false;
    const { back } = this.camera.axes();
    this.held = { place, depth: Math.max(1e-3, -dot(sub(this.positionOf(place), this.camera.eye), back)) };
    this.tell({ do: 'press', body: body.id, at: this.at() });
    return true;
  }
  pull(clicks) {
    this.held.depth *= 1.1 ** clicks;
    this.tell({ do: 'wheel', clicks });
  }
  letGo() {
    if (!this.held) return;
    this.flushPointer();
    this.held = null;
    this.tell({ do: 'release' });
    this.change();
  }
  addMore() {
    if (!this.held || !this.pose.exists[this.held.place]) return;
    const { camera, renderer: { canvas } } = this, ratio = canvas.width / canvas.clientWidth, frame = camera.frame();
    const [x, y] = [this.pointer[0] * ratio, canvas.height - this.pointer[1] * ratio];
    const along = unit(add(frame.corner, add(scaled(frame.stepX, x), scaled(frame.stepY, y))));
    const to = scaled(along, this.held.depth / Math.max(0.05, -dot(along, frame.back)));
    const radius = this.renderer.bodyRadius?.[this.held.place] ?? 0.5;
    this.lines.add(this.fromEye(this.positionOf(this.held.place)), to, 1.6, radius, PULL);
    this.lines.add(to, to, 4, radius, PULL);
  }

  state() {
    const { source } = this, { state } = source;
    return { ...super.state(), time: source.now.time, step: source.now.index < 0 ? -1 : source.now.step, live: !source.ended, drives: this.drives, server: state, held: this.held?.place ?? -1,
      bytes: source.bytes, received: source.received, pace: source.pace, ready: source.now.index >= 0 };
  }
};

class LiveControls extends Controls {
  setUpBar() { this.panel = new LivePanel(this.player, this); }
  drawMarks() {}
  tellErrors() {
    super.tellErrors();
    const text = document.getElementById('errors');
    text.textContent = text.textContent.replace('Recorded', 'Sent').replaceAll('recorded', 'sent');
  }

  // Before the camera's: what begins on a body that moves is a grab.
  setUpView() {
    const { player } = this, view = document.getElementById('view');
    let pointer = null, from = null;
    const down = new Set();
    const only = (event, work) => {
      if (event.pointerId !== pointer) return;
      event.stopImmediatePropagation();
      work();
    };
    view.addEventListener('pointerdown', (event) => {
      if (pointer !== null) return event.stopImmediatePropagation();
      player.pointAt(event.offsetX, event.offsetY);
      down.add(event.pointerId);
      if (event.button !== 0 || event.shiftKey || down.size > 1 || !player.grab(event.offsetX, event.offsetY)) return;
      pointer = event.pointerId;
      from = [event.offsetX, event.offsetY];
      view.setPointerCapture(pointer);
      event.stopImmediatePropagation();
    });
    view.addEventListener('pointermove', (event) => {
      if (pointer === null) player.pointAt(event.offsetX, event.offsetY);
      only(event, () => player.pointAt(event.offsetX, event.offsetY));
    });
    const release = (event) => down.delete(event.pointerId) && only(event, () => {
      pointer = null;
      const { held } = player, still = Math.hypot(event.offsetX - from[0], event.offsetY - from[1]) < 4;
      player.letGo();
      if (held && still) player.select(held.place);
    });
    view.addEventListener('pointerup', release);
    view.addEventListener('pointercancel', release);
    view.addEventListener('wheel', (event) => {
      if (!player.held) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      player.pull(Math.max(-5, Math.min(5, -event.deltaY / 100)));
    }, { passive: false });
    super.setUpView();
  }

  key(event) {
    if (this.panel.key(event)) return;
    if ([',', '.'].includes(event.key)) return;
    super.key(event);
  }
  update() { this.panel.update(); }
}

export async function openLive(Player) {
  const token = new URLSearchParams(location.search).get('token') ?? '', trouble = document.getElementById('trouble');
  const address = new URL(`stream?token=${encodeURIComponent(token)}`, location.href);
  address.protocol = address.protocol.replace(/^..../, 'ws');
  const source = new LiveSource(address.href);
  const tellEnd = (reason) => {
    const again = document.createElement('button');
    again.type = 'button';
    again.textContent = 'Connect again';
    again.addEventListener('click', () => location.reload());
    trouble.replaceChildren(`${reason} `, again);
    trouble.hidden = false;
  };
  source.onEnd = tellEnd;
  await new Promise((done) => (source.onBegin = done));
  const player = new (livePlayer(Player))(source, document.getElementById('view'));
  player.controls = new LiveControls(player);
  source.onMessage = () => {
    player.controls.panel.update();
    player.change();
  };
  source.onEnd = (reason) => {
    tellEnd(reason);
    player.change();
  };
  if (source.ended) player.change();
  document.addEventListener('visibilitychange', () => player.tell({ do: 'watch', on: !document.hidden }));
  window.addEventListener('blur', () => {
    player.letGo();
    drivingKeys.release(player);
  });
  document.documentElement.dataset.live = '';
  window.scree = player;
  requestAnimationFrame((time) => player.tick(time));
}
