// The viewer in a notebook: cells run by nbconvert, their HTML in a headless browser, and the picture where no script runs.
// SCREE_PYTHON_FOLDER=build/release/python node --test tests/viewer/notebook_test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import test, { after, before } from 'node:test';
import { pathToFileURL } from 'node:url';
import { Browser } from './browser.mjs';

const folder = resolve(process.env.SCREE_PYTHON_FOLDER ?? 'build/release/python');
const place = mkdtempSync(join(tmpdir(), 'scree-notebook-'));
const CELLS = [
  `import scree
world = scree.World(scree.demo("pile", bodies=60), backend="cpu")
with world.record(title="a <pile>") as recording:
    world.step(60)
recording.view(height=400)`,
  `view = world.view(height=300)
view`,
  'world.step(30)',
  'world.step(30)',
  'view.close()\nworld.step(30)',
];
let browser, executed;

before(async () => {
  browser = await Browser.start();
  const notebook = { nbformat: 4, nbformat_minor: 5, metadata: { kernelspec: { name: 'python3', display_name: 'Python 3', language: 'python' } },
    cells: CELLS.map((source, i) => ({ cell_type: 'code', id: `c${i}`, execution_count: null, metadata: {}, outputs: [], source })) };
  writeFileSync(join(place, 'given.ipynb'), JSON.stringify(notebook));
  const env = { ...process.env, PYTHONPATH: folder, IPYTHONDIR: join(place, 'ipython'), JUPYTER_CONFIG_DIR: join(place, 'config'), JUPYTER_RUNTIME_DIR: join(place, 'runtime') };
  const convert = (...more) => execFileSync('/usr/bin/jupyter-nbconvert', more, { cwd: place, env, stdio: ['ignore', 'ignore', 'pipe'] });
  convert('--execute', '--to', 'notebook', '--output', 'executed.ipynb', 'given.ipynb');
  convert('--to', 'html', 'executed.ipynb');
  convert('--to', 'markdown', 'executed.ipynb');
  executed = JSON.parse(readFileSync(join(place, 'executed.ipynb'), 'utf8'));
});
after(async () => {
  await browser?.stop();
  rmSync(place, { recursive: true, force: true });
});

const textOf = (data) => Array.isArray(data) ? data.join('') : data;
const bundleOf = (cell) => executed.cells[cell].outputs.find(({ data }) => data?.['text/html'])?.data;

test('the output has the page, a picture and a text', () => {
  for (const [cell, frames] of [[0, 31], [1, 31]]) {
    const data = bundleOf(cell);
    assert.ok(data, JSON.stringify(executed.cells[cell].outputs).slice(0, 2000));
    const picture = Buffer.from(textOf(data['image/png']), 'base64');
    assert.equal(picture.toString('latin1', 1, 4), 'PNG');
    assert.deepEqual([picture.readUInt32BE(16), picture.readUInt32BE(20)], [640, 360]);
    // The second view has the steps of later cells, up to its close.
    assert.match(textOf(data['text/plain']), new RegExp(`View of ${frames} frames`));
    assert.match(textOf(data['text/html']), /^<div [^>]*><img [^>]*src="data:image\/png;base64,[^"]*"[^>]*><iframe [^>]*sandbox="allow-scripts"/);
  }
  for (const cell of [2, 3, 4]) assert.deepEqual(executed.cells[cell].outputs.filter(({ output_type }) => output_type !== 'stream'), []);
});

test('where no script runs there is the picture', () => {
  const markdown = readFileSync(join(place, 'executed.md'), 'utf8');
  assert.match(markdown, /!\[png\]\(executed_files\/executed_0_0\.png\)|<img/);
});

test('the viewers play in the page that nbconvert makes', async () => {
  const { targetId } = await browser.send('Target.createTarget', { url: 'about:blank' });
  const { sessionId } = await browser.send('Target.attachToTarget', { targetId, flatten: true });
  const contexts = [], troubles = [];
  browser.listeners.push(({ method, params, sessionId: session }) => {
    if (method === 'Target.attachedToTarget') {
      for (const domain of ['Runtime', 'Log']) browser.send(`${domain}.enable`, {}, params.sessionId);
      browser.send('Runtime.runIfWaitingForDebugger', {}, params.sessionId);
    }
    if (method === 'Runtime.executionContextCreated') contexts.push({ session, id: params.context.id });
    if (method === 'Runtime.exceptionThrown') troubles.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && params.type === 'error') troubles.push(params.args.map((arg) => arg.value ?? arg.description).join(' '));
    // nbconvert's own page asks for its scripts from elsewhere, where there may be none.
    if (method === 'Log.entryAdded' && params.entry.level === 'error' && !/^https:|\/usr\/share\/javascript\//.test(params.entry.url ?? '')) troubles.push(`${params.entry.text} ${params.entry.url}`);
  });
  await browser.send('Target.setAutoAttach', { autoAttach: true, waitForDebuggerOnStart: true, flatten: true }, sessionId);
  for (const domain of ['Page', 'Runtime', 'Log']) await browser.send(`${domain}.enable`, {}, sessionId);
  // Tall enough for both: what is out of sight does not play.
  await browser.send('Emulation.setDeviceMetricsOverride', { width: 1100, height: 1500, deviceScaleFactor: 1, mobile: false }, sessionId);
  await browser.send('Page.navigate', { url: pathToFileURL(join(place, 'executed.html')).href }, sessionId);
  const evaluate = async ({ session, id }, expression) => {
    try {
      return (await browser.send('Runtime.evaluate', { expression, contextId: id, returnByValue: true }, session)).result.value;
    } catch {
      return undefined;  // of a page before
    }
  };
  let states = [];
  const end = Date.now() + 120000;
  const playing = () => states.length === 2 && states.every((state) => state.playing && state.pictures > 3);
  while (!playing() && Date.now() < end) {
    await new Promise((done) => setTimeout(done, 200));
    states = (await Promise.all(contexts.map((context) => evaluate(context, 'window.scree?.state()')))).filter((state) => state?.ready);
  }
  assert.ok(playing(), `${JSON.stringify(states)} ${troubles.join('; ')}`);
  assert.deepEqual(states.map(({ frames }) => frames), [31, 31]);
  assert.ok(states.every(({ bodies }) => bodies > 60));
  if (process.env.SCREE_PICTURES) {
    await new Promise((done) => setTimeout(done, 1500));
    const { data } = await browser.send('Page.captureScreenshot', { format: 'png' }, sessionId);
    writeFileSync(process.env.SCREE_PICTURES, Buffer.from(data, 'base64'));
  }
  assert.deepEqual(troubles, []);
});
