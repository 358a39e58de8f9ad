// clast as a module for browsers, workers and node. tools/make_wasm.py puts createClast (emscripten's loader of clast.wasm) and command.js above this text.
export { Clast, ClastError, wordsOf, commandLine, tableOf, columnsOf };

/// What a worker runs: this module's Clast, fed by messages.
const SERVE = `
const answer = (port) => async ({ program, words, files, wantsProgress, wantsFiles }) => {
  try {
    const onProgress = wantsProgress ? (progress) => port.postMessage({ progress }) : undefined;
    const onFile = wantsFiles ? (path, bytes) => port.postMessage({ path, bytes }, [bytes.buffer]) : undefined;
    port.postMessage({ result: await new Clast(program).run(words, { files, onProgress, onFile }) });
  } catch (fault) { port.postMessage({ fault: String(fault) }); }
};
if (typeof self === 'object') self.onmessage = ({ data }) => answer(self)(data);
else import('node:worker_threads').then(({ parentPort }) => parentPort.on('message', answer(parentPort)));`;

/// A worker of a page or of node, each with postMessage, terminate and one listener for messages and one for its end.
async function newWorker(onMessage, onEnd) {
  const text = `import { Clast } from ${JSON.stringify(import.meta.url)};${SERVE}`;
  if (typeof Worker === 'function') {
    const address = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
    const worker = new Worker(address, { type: 'module' });
    worker.onmessage = ({ data }) => onMessage(data);
    worker.onerror = (event) => onEnd(event.message || 'clast: the worker was not started by this browser');
    return worker;
  }
  const { Worker: NodeWorker } = await import('node:worker_threads');
  const worker = new NodeWorker(new URL(`data:text/javascript,${encodeURIComponent(text)}`));
  worker.on('message', onMessage);
  worker.on('error', (fault) => onEnd(fault.message));
  return worker;
}

/// Clast with each command line in a worker of its own, at most `most` at a time: the calling thread stays free, runs go side by side,
/// and how.signal (an AbortSignal) ends one at once.
export class ClastWorkers extends Clast {
  constructor(program, most) {
    super(program);
    this.most = most;
    this.busy = 0;
    this.waiting = [];
  }

  async run(words, how = {}) {
    how.signal?.throwIfAborted();
    if (this.busy < this.most) this.busy += 1;
    else await this.turn(how.signal);
    try {
      return await this.runAlone(words, how);
    } finally { // the next in the row takes this one's place
      const next = this.waiting.shift();
      if (next) next();
      else this.busy -= 1;
    }
  }

  /// Until a run that ends gives its place; or until the signal, which leaves the row.
  turn(signal) {
    return new Promise((go, fail) => {
      this.waiting.push(go);
      signal?.addEventListener('abort', () => {
        const place = this.waiting.indexOf(go);
        if (place < 0) return;
        this.waiting.splice(place, 1);
        fail(signal.reason);
      }, { once: true });
    });
  }

  async runAlone(words, { files = {}, onProgress, onFile, signal }) {
    signal?.throwIfAborted();
    let worker = null;
    try {
      return await new Promise((done, fail) => {
        const hear = ({ progress, path, bytes, result, fault }) => {
          if (progress) onProgress(progress);
          else if (path !== undefined) onFile(path, bytes);
          else if (fault) fail(new Error(fault));
          else done(result);
        };
        signal?.addEventListener('abort', () => fail(signal.reason), { once: true });
        newWorker(hear, (message) => fail(new Error(message))).then((made) => {
          worker = made;
          if (signal?.aborted) worker.terminate();
          else worker.postMessage({ program: this.program, words: words.map(String), files, wantsProgress: Boolean(onProgress), wantsFiles: Boolean(onFile) });
        }, fail);
      });
    } finally {
      worker?.terminate();
    }
  }
}

/// A module of one function in SIMD128.
const SIMD = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11);

async function compiled(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (!WebAssembly.validate(SIMD)) throw new Error('clast.wasm wants WebAssembly with SIMD: Chromium 91, Firefox 89, Safari 16.4, node 16.4');
  let bytes = source;
  if (bytes === undefined) {
    const url = new URL('./clast.wasm', import.meta.url);
    bytes = url.protocol === 'file:' && typeof process === 'object'
      ? await (await import('node:fs/promises')).readFile(url) : await fetch(url);
  }
  if (typeof Response === 'function' && bytes instanceof Response) bytes = await bytes.arrayBuffer();
  return WebAssembly.compile(bytes);
}

/// clast, ready to run. source: clast.wasm as bytes, a Response, or compiled; none: the file beside this module.
export async function load(source) {
  return new Clast(await compiled(source));
}

/// The same in workers, as many at a time as the machine has cores.
export async function loadWorkers(source, most = globalThis.navigator?.hardwareConcurrency ?? 4) {
  return new ClastWorkers(await compiled(source), most);
}
