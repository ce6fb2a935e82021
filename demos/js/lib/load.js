// Loads the module: in Node from the package's files, in browsers by fetch().
import { Library } from './library.js';

const isNode = typeof process === 'object' && typeof process.versions?.node === 'string';

async function bytesOf(url) {
  if (isNode && url.protocol === 'file:') {
    const { readFile } = await import('node:fs/promises');
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`scree: ${url} cannot be loaded: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

function canHaveThreads() {
  return typeof SharedArrayBuffer === 'function' && (isNode || globalThis.crossOriginIsolated === true);
}

// threads: at most so many in a loop; 1: the form without threads.
export async function loadLibrary({ threads = 1, print, printError, folder } = {}) {
  if (!Number.isInteger(threads) || threads < 1 || threads > 64)
    throw new RangeError(`threads: ${threads} is no whole number from 1 to 64`);
  if (threads > 1 && !canHaveThreads())
    throw new Error(
      'threads: this page may share no memory. Serve it with the headers Cross-Origin-Opener-Policy: same-origin and ' +
        'Cross-Origin-Embedder-Policy: require-corp, or load scree with one thread'
    );
  const name = threads > 1 ? 'scree-threads' : 'scree';
  const base = new URL(folder ?? '../module/', import.meta.url);
  const pathOf = (file) => {
    const url = new URL(file, base);
    return isNode && url.protocol === 'file:' ? decodeURIComponent(url.pathname) : url.href;
  };
  const given = {
    wasmBinary: await bytesOf(new URL(`${name}.wasm`, base)),
    locateFile: pathOf,
    mainScriptUrlOrBlob: pathOf(`${name}.js`),
    poolSize: threads - 1,
    print: print ?? ((line) => console.log(line)),
    printErr: printError ?? ((line) => console.error(line)),
  };
  if (threads > 1) given.wasmMemory = new WebAssembly.Memory({ initial: 1024, maximum: 65536, shared: true });
  const { default: make } = await import(new URL(`${name}.mjs`, base).href);
  const module = await make(given);
  // In Node the process ends without waiting for them.
  for (const worker of module.PThread?.unusedWorkers ?? []) worker.unref?.();
  // Without threads emscripten keeps its own views in step as memory grows.
  return new Library(module, given.wasmMemory ?? { get buffer() { return module.HEAPU8.buffer; } }, threads);
}
