// Serves the package and asks a headless browser for the hash of a demo: node browser.mjs PACKAGE BROWSER DEMO STEPS THREADS.
// Prints the hash, or fails.
import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';

const [folder, browser, demo, steps, threads] = process.argv.slice(2);
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.json': 'application/json' };
// Pages that share memory among threads are isolated by these.
const headers = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

// The page tells its result itself: a browser that prints the page does not wait for its workers.
let told;
const result = new Promise((resolve) => (told = resolve));
const server = createServer(async (request, response) => {
  if (request.method === 'POST') {
    let text = '';
    for await (const piece of request) text += piece;
    response.end();
    return told(text);
  }
  const path = normalize(new URL(request.url, 'http://localhost').pathname);
  try {
    const file = path === '/' ? new URL('page.html', import.meta.url) : join(folder, path.replace(/^\/package\//, ''));
    const content = await readFile(file);
    response.writeHead(200, { ...headers, 'Content-Type': types[extname(path)] ?? (path === '/' ? 'text/html' : 'application/octet-stream') });
    response.end(content);
  } catch {
    response.writeHead(404, headers);
    response.end();
  }
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
const home = await mkdtemp(join(tmpdir(), 'scree-browser-'));
const page = `http://127.0.0.1:${server.address().port}/?demo=${demo}&steps=${steps}&threads=${threads}`;
const child = spawn(browser, ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', `--user-data-dir=${home}`, page],
  { stdio: 'ignore' });
const ended = new Promise((resolve) => child.once('exit', resolve));
try {
  child.once('error', (error) => told(String(error)));
  const limit = setTimeout(() => told('nothing within four minutes'), 240000);
  const text = await result;
  clearTimeout(limit);
  const [, hash, isolated] = /hash ([0-9a-f]{16}) isolated (\w+)/.exec(text) ?? [];
  if (!hash || isolated !== 'true') throw new Error(`the page says: ${text}`);
  console.log(hash);
} catch (error) {
  console.error(String(error.message).slice(0, 3000));
  process.exitCode = 1;
} finally {
  child.kill();
  await ended;
  server.closeAllConnections();
  server.close();
  await rm(home, { recursive: true, force: true, maxRetries: 5 });
}
