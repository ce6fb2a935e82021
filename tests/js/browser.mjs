// Serves the package and asks a headless browser for the hash of a demo: node browser.mjs PACKAGE BROWSER DEMO STEPS THREADS.
// Prints the hash, or fails.
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { promisify } from 'node:util';

const [folder, browser, demo, steps, threads] = process.argv.slice(2);
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.json': 'application/json' };
// Pages that share memory among threads are isolated by these.
const headers = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

const server = createServer(async (request, response) => {
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
try {
  const { stdout } = await promisify(execFile)(browser, ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage',
    `--user-data-dir=${home}`, '--virtual-time-budget=120000', '--timeout=240000', '--dump-dom',
    `http://127.0.0.1:${server.address().port}/?demo=${demo}&steps=${steps}&threads=${threads}`], { timeout: 300000, maxBuffer: 1 << 26 });
  const [, hash, isolated] = /hash ([0-9a-f]{16}) isolated (\w+)/.exec(stdout) ?? [];
  if (!hash || isolated !== 'true') throw new Error(`the page says: ${stdout.slice(0, 2000)}`);
  console.log(hash);
} catch (error) {
  console.error(String(error.message).slice(0, 3000));
  process.exitCode = 1;
} finally {
  server.closeAllConnections();
  server.close();
  await rm(home, { recursive: true, force: true, maxRetries: 5 });
}
