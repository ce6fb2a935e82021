// Starts scree serve, and speaks to it as a browser would, or as nobody should: a small WebSocket client with its hands on the bytes.
import { spawn } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { once } from 'node:events';
import { connect } from 'node:net';

export const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const program = process.env.SCREE_PROGRAM ?? 'build/release/demos/scree';

export class Server {
  static async start(args) {
    const server = new Server();
    server.child = spawn(program, ['serve', ...args, '--backend', 'cpu', '--port', '0'], { stdio: ['ignore', 'pipe', 'pipe'] });
    server.errors = '';
    server.child.stderr.on('data', (bytes) => (server.errors += bytes));
    server.ended = new Promise((done) => server.child.once('exit', (status, signal) => done({ status, signal })));
    const address = await Promise.race([once(server.child.stdout, 'data'), server.ended.then(() => null)]);
    if (!address) throw new Error(`scree serve ended: ${server.errors}`);
    server.address = String(address[0]).trim();
    server.url = new URL(server.address);
    return server;
  }
  get token() { return this.url.searchParams.get('token'); }
  // A request as text; the whole answer.
  async request(text) {
    const socket = connect(Number(this.url.port), this.url.hostname);
    let answer = '';
    socket.on('data', (bytes) => (answer += bytes.toString('latin1')));
    socket.on('error', () => {});
    socket.write(text, 'latin1');
    await Promise.race([once(socket, 'close').catch(() => {}), once(socket, 'end').catch(() => {}), pause(15000)]);
    socket.destroy();
    return { status: Number(answer.split(' ')[1] ?? 0), text: answer };
  }
  get(path, headers = {}) {
    const lines = Object.entries({ Host: this.url.host, ...headers }).map(([name, value]) => `${name}: ${value}\r\n`).join('');
    return this.request(`GET ${path} HTTP/1.1\r\n${lines}\r\n`);
  }
  viewer(options) { return Viewer.open(this, options); }
  async stop(signal = 'SIGINT') {
    const begun = Date.now();
    this.child.kill(signal);
    const end = await this.ended;
    return { ...end, ms: Date.now() - begun };
  }
}

export class Viewer {
  // `origin` null: none is told; `follows`: frames are acknowledged.
  static async open(server, { origin = undefined, token = server.token, follows = true, headers = {} } = {}) {
    const viewer = new Viewer();
    Object.assign(viewer, { follows, texts: [], blocks: 0, frames: 0, bytes: 0, state: null, hello: null, closed: null, rest: Buffer.alloc(0), head: null, waiting: [], look: null });
    const socket = (viewer.socket = connect(Number(server.url.port), server.url.hostname));
    socket.on('error', () => {});
    viewer.ended = new Promise((done) => socket.once('close', done));
    const told = origin === undefined ? { Origin: server.url.origin } : origin === null ? {} : { Origin: origin };
    const lines = Object.entries({ Host: server.url.host, Upgrade: 'websocket', Connection: 'Upgrade', 'Sec-WebSocket-Version': '13',
      'Sec-WebSocket-Key': randomBytes(16).toString('base64'), ...told, ...headers }).map(([name, value]) => `${name}: ${value}\r\n`).join('');
    socket.write(`GET /stream?token=${token} HTTP/1.1\r\n${lines}\r\n`);
    socket.on('data', (bytes) => viewer.read(bytes));
    while (viewer.head === null && !socket.destroyed) await pause(5);
    viewer.status = Number(viewer.head?.split(' ')[1] ?? 0);
    return viewer;
  }
  read(bytes) {
    this.rest = Buffer.concat([this.rest, bytes]);
    if (this.head === null) {
      const end = this.rest.indexOf('\r\n\r\n');
      if (end < 0) return;
      this.head = this.rest.toString('latin1', 0, end);
      this.rest = this.rest.subarray(end + 4);
    }
    while (this.rest.length >= 2) {
      let length = this.rest[1] & 127, at = 2;
      if (length === 126) [length, at] = [this.rest.length < 4 ? Infinity : this.rest.readUInt16BE(2), 4];
      else if (length === 127) [length, at] = [this.rest.length < 10 ? Infinity : Number(this.rest.readBigUInt64BE(2)), 10];
      if (this.rest.length < at + length) return;
      const final = (this.rest[0] & 128) !== 0, kind = this.rest[0] & 15, body = this.rest.subarray(at, at + length);
      this.rest = this.rest.subarray(at + length);
      if (kind === 8) this.closed = body.length >= 2 ? body.readUInt16BE(0) : 1005;
      else if (kind === 9) this.send(body, 10);
      else this.gather(final, kind, body);
    }
  }
  gather(final, kind, body) {
    if (kind !== 0) this.parts = { kind, bodies: [] };
    this.parts.bodies.push(body);
    if (!final) return;
    const whole = Buffer.concat(this.parts.bodies);
    if (this.parts.kind === 1) {
      const message = JSON.parse(whole.toString('utf8'));
      this.texts.push(message);
      if (message.type === 'state') this.state = message;
      if (message.type === 'hello') this.hello = message;
      if (message.type === 'bye') this.bye = message.reason;
    } else {
      ++this.blocks;
      this.bytes += whole.length;
      this.waiting.push(whole);
      this.hand();
    }
  }
  // Blocks go to `look`, those that came before it as well.
  set onBlock(look) {
    this.look = look;
    this.hand();
  }
  hand() { while (this.look && this.waiting.length > 0) this.look(this.waiting.shift()); }

  // A frame of the protocol. `lie`: another length than it has.
  send(body, kind = 1, { final = true, masked = true, reserved = 0, lie = null } = {}) {
    const bytes = Buffer.from(body), length = lie ?? bytes.length, mask = randomBytes(4);
    const head = [(final ? 128 : 0) | reserved << 4 | kind];
    const bit = masked ? 128 : 0;
    if (length < 126) head.push(bit | length);
    else if (length < 65536) head.push(bit | 126, length >> 8, length & 255);
    else head.push(bit | 127, 0, 0, 0, 0, length / 2 ** 24 & 255, length >> 16 & 255, length >> 8 & 255, length & 255);
    const masking = masked ? bytes.map((byte, i) => byte ^ mask[i & 3]) : bytes;
    if (!this.socket.destroyed) this.socket.write(Buffer.concat([Buffer.from(head), masked ? mask : Buffer.alloc(0), masking]));
  }
  tell(message) { this.send(JSON.stringify(message)); }
  seen(frames) { this.tell({ do: 'seen', frames }); }
  async until(check, what, limit = 10000) {
    const end = Date.now() + limit;
    while (!check(this)) {
      if (Date.now() > end) throw new Error(`not within ${limit} ms: ${what}; ${this.bye ?? ''} ${JSON.stringify(this.state)}`);
      await pause(10);
    }
  }
  get drives() { return this.hello !== null && this.state !== null && this.hello.you === this.state.driver; }
  close() { this.socket.destroy(); }
}
