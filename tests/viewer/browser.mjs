// A headless Chromium driven by its debugging protocol over pipes: no package, no port.
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { existsSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { inflateSync } from 'node:zlib';

export function findBrowser() {
  if (process.env.SCREE_BROWSER) return process.env.SCREE_BROWSER;
  for (const folder of (process.env.PATH ?? '').split(delimiter))
    for (const name of ['chromium', 'chromium-browser', 'google-chrome']) if (existsSync(join(folder, name))) return join(folder, name);
  return null;
}

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

export class Browser {
  static async start(more = []) {
    const browser = new Browser();
    browser.home = await mkdtemp(join(tmpdir(), 'scree-browser-'));
    browser.child = spawn(findBrowser(), ['--headless=new', '--remote-debugging-pipe', '--no-sandbox', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', '--no-first-run', '--hide-scrollbars', `--user-data-dir=${browser.home}`, ...more,
      'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    browser.ended = new Promise((done) => browser.child.once('exit', done));
    browser.waiting = new Map();
    browser.listeners = [];
    browser.last = 0;
    let rest = '';
    browser.child.stdio[4].on('data', (bytes) => {
      const messages = (rest + bytes.toString('utf8')).split('\0');
      rest = messages.pop();
      for (const message of messages) browser.hear(JSON.parse(message));
    });
    return browser;
  }
  hear(message) {
    if (message.id === undefined) return this.listeners.forEach((listen) => listen(message));
    const { done, failed } = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.error) failed(new Error(message.error.message)); else done(message.result);
  }
  send(method, params = {}, sessionId = undefined) {
    const id = ++this.last;
    this.child.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((done, failed) => this.waiting.set(id, { done, failed }));
  }
  async page(url, { width = 1280, height = 720, scale = 1, touch = false, dark = false, still = true,
    ready = 'window.scree && window.scree.state().ready && window.scree.state().pictures > 0' } = {}) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const page = new Page(this, targetId, sessionId);
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await page.send(`${domain}.enable`);
    await page.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: scale, mobile: touch });
    if (touch) await page.send('Emulation.setTouchEmulationEnabled', { enabled: true });
    await page.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }] });
    await page.send('Page.navigate', { url: url + (still ? '#still' : '') });
    await page.until(ready, 120000);
    return page;
  }
  async stop() {
    this.child.kill();
    await this.ended;
    await rm(this.home, { recursive: true, force: true, maxRetries: 5 });
  }
}

class Page {
  constructor(browser, target, session) {
    Object.assign(this, { browser, target, session, troubles: [], requests: [] });
    browser.listeners.push(({ method, params, sessionId }) => {
      if (sessionId !== session) return;
      if (method === 'Runtime.exceptionThrown') this.troubles.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
      if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type))
        this.troubles.push(params.args.map((arg) => arg.value ?? arg.description).join(' '));
      if (method === 'Log.entryAdded' && params.entry.level === 'error') this.troubles.push(params.entry.text);
      if (method === 'Page.javascriptDialogOpening') this.troubles.push(`a dialog opened: ${params.message}`);
      if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url.slice(0, 80));
    });
  }
  send(method, params) { return this.browser.send(method, params, this.session); }
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  state() { return this.evaluate('window.scree.state()'); }
  async until(expression, limit = 20000) {
    const end = Date.now() + limit;
    while (!(await this.evaluate(`Boolean(${expression})`))) {
      if (Date.now() > end) throw new Error(`not within ${limit} ms: ${expression}; ${this.troubles.join('; ')} ${await this.evaluate('document.getElementById("trouble")?.textContent')}`);
      await pause(50);
    }
  }
  // Waits until what was asked for is drawn.
  async drawn() {
    const { pictures } = await this.state();
    await this.evaluate('window.scree.change()');
    await this.until(`window.scree.state().pictures > ${pictures}`);
    await pause(100);
  }
  // "Space", "Shift+ArrowLeft", "n".
  async key(word) {
    const parts = word.split('+').filter(Boolean), key = word.endsWith('+') ? '+' : parts.pop(), modifiers = parts.includes('Shift') ? 8 : 0;
    const known = { Space: [' ', 'Space', 32], Enter: ['Enter', 'Enter', 13], Tab: ['Tab', 'Tab', 9], Escape: ['Escape', 'Escape', 27],
      ArrowLeft: ['ArrowLeft', 'ArrowLeft', 37], ArrowUp: ['ArrowUp', 'ArrowUp', 38], ArrowRight: ['ArrowRight', 'ArrowRight', 39],
      ArrowDown: ['ArrowDown', 'ArrowDown', 40], Home: ['Home', 'Home', 36], End: ['End', 'End', 35] };
    const [name, code, number] = known[key] ?? [key, `Key${key.toUpperCase()}`, key.toUpperCase().charCodeAt(0)];
    const text = name === 'Enter' ? '\r' : name.length === 1 ? name : undefined;
    await this.send('Input.dispatchKeyEvent', { type: text ? 'keyDown' : 'rawKeyDown', key: name, code, windowsVirtualKeyCode: number, modifiers, text });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key: name, code, windowsVirtualKeyCode: number, modifiers });
  }
  async mouse(type, x, y, button = 'left', buttons = 1) {
    await this.send('Input.dispatchMouseEvent', { type, x, y, button: type === 'mouseMoved' && !buttons ? 'none' : button, buttons, clickCount: 1 });
  }
  async click(x, y) {
    await this.mouse('mousePressed', x, y);
    await this.mouse('mouseReleased', x, y, 'left', 0);
  }
  async tap(x, y) {
    await this.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x, y }] });
    await this.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  }
  async screenshot() {
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    return Buffer.from(data, 'base64');
  }
  close() { return this.browser.send('Target.closeTarget', { targetId: this.target }); }
}

// A PNG of 8 bits as { width, height, at(x, y): [red, green, blue] }.
export function pixelsOf(png) {
  const chunks = [];
  let width = 0, height = 0, channels = 0;
  for (let at = 8; at < png.length;) {
    const length = png.readUInt32BE(at), name = png.toString('latin1', at + 4, at + 8), body = png.subarray(at + 8, at + 8 + length);
    if (name === 'IHDR') [width, height, channels] = [body.readUInt32BE(0), body.readUInt32BE(4), { 2: 3, 6: 4 }[body[9]]];
    if (name === 'IDAT') chunks.push(body);
    at += 12 + length;
  }
  const raw = inflateSync(Buffer.concat(chunks)), row = width * channels, out = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (row + 1)];
    for (let x = 0; x < row; ++x) {
      const left = x >= channels ? out[y * row + x - channels] : 0, up = y > 0 ? out[(y - 1) * row + x] : 0;
      const corner = x >= channels && y > 0 ? out[(y - 1) * row + x - channels] : 0;
      const guess = left + up - corner, [a, b, c] = [Math.abs(guess - left), Math.abs(guess - up), Math.abs(guess - corner)];
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      const expected = [0, left, up, (left + up) >> 1, paeth][filter];
      out[y * row + x] = raw[y * (row + 1) + 1 + x] + expected;
    }
  }
  return { width, height, at: (x, y) => [...out.subarray((Math.floor(y) * width + Math.floor(x)) * channels).subarray(0, 3)] };
}
