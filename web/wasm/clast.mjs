// clast as a module for browsers, workers and node: the same command lines, messages, files and numbers as the command itself.
// tools/make_wasm.py puts createClast (emscripten's loader of clast.wasm) above this text.
const HOME = '/work'; // where a command line runs; its files live in memory
const PROGRESS = /^([a-z][a-z ]*?) (\d+)(?:\/(\d+))?/;

/// A command line that ended with another exit code than 0 and 1; the message is the command's own line.
export class ClastError extends Error {
  constructor(words, result) {
    super(result.stderr.trim().split('\n').pop() || `clast ${words[0]} ended with code ${result.status}`);
    this.name = 'ClastError';
    this.words = words;
    this.status = result.status;
    this.result = result;
  }
}

/// Options as the words of a command line: beta_dt: 1e-3 -> --beta-dt=0.001; true -> --NAME, false -> --no-NAME; lists repeat.
export function wordsOf(options = {}) {
  const words = [];
  for (const [key, value] of Object.entries(options)) {
    const name = key.replaceAll('_', '-');
    if (value === undefined || value === null) continue;
    if (value === true) words.push(`--${name}`);
    else if (value === false) words.push(`--no-${name}`);
    else for (const one of Array.isArray(value) ? value : [value]) words.push(`--${name}=${one}`);
  }
  return words;
}

/// A command line as a shell takes it.
export function commandLine(words) {
  return ['clast', ...words].map((w) => (/^[\w@%+=:,./-]+$/.test(w) ? w : `'${w.replaceAll("'", "'\\''")}'`)).join(' ');
}

/// Columns of coordinates (x, y, z: arrays of one length) as a table that `clast decompose` reads; a text is one already.
export function tableOf(points) {
  if (typeof points === 'string' || points instanceof Uint8Array) return points;
  const names = Object.keys(points);
  const n = names.length > 0 ? points[names[0]].length : 0;
  if (names.length === 0 || names.some((name) => points[name].length !== n)) {
    throw new TypeError('points: columns of one length are wanted, {x, y} or {x, y, z}');
  }
  const lines = [names.join(',')];
  for (let i = 0; i < n; i += 1) lines.push(names.map((name) => points[name][i]).join(','));
  return `${lines.join('\n')}\n`;
}

/// Numbers of a table as clast writes it (lines of # are notes): {column: Float64Array}.
export function columnsOf(text) {
  const lines = text.split('\n').filter((line) => line && !line.startsWith('#'));
  const names = lines.length > 0 ? lines[0].split(',') : [];
  const columns = Object.fromEntries(names.map((name) => [name, new Float64Array(lines.length - 1)]));
  lines.slice(1).forEach((line, i) => line.split(',').forEach((cell, k) => { columns[names[k]][i] = cell === '' ? NaN : Number(cell); }));
  return columns;
}

class Bytes {
  constructor() { this.parts = []; this.length = 0; }

  push(part) { this.parts.push(part); this.length += part.length; }

  text() {
    const all = new Uint8Array(this.length);
    let at = 0;
    for (const part of this.parts) { all.set(part, at); at += part.length; }
    return new TextDecoder().decode(all);
  }
}

/// A folder's names are keys of a plain object in emscripten, which has hasOwnProperty, __proto__, ... of its own: here of one that has none.
function nameAnything(FS) {
  const ops = FS.lookupPath('/').node.node_ops;
  const { mknod } = ops;
  ops.mknod = (...given) => {
    const node = mknod(...given);
    if (FS.isDir(node.mode)) node.contents = Object.create(null);
    return node;
  };
  ops.readdir = (node) => ['.', '..', ...Object.keys(node.contents)];
}

function writeFiles(FS, files) {
  for (const [path, content] of Object.entries(files)) {
    const whole = path.startsWith('/') ? path : `${HOME}/${path}`;
    FS.mkdirTree(whole.slice(0, whole.lastIndexOf('/')) || '/');
    FS.writeFile(whole, content);
  }
}

function isSame(given, bytes) {
  const known = typeof given === 'string' ? new TextEncoder().encode(given) : given;
  return known.length === bytes.length && known.every((byte, i) => byte === bytes[i]);
}

/// What stands under a folder now and was not given so.
function readFiles(FS, folder, prefix, given, found) {
  for (const name of FS.readdir(folder)) {
    if (name === '.' || name === '..') continue;
    const path = `${folder}/${name}`;
    const node = FS.lstat(path);
    if (FS.isDir(node.mode)) readFiles(FS, path, `${prefix}${name}/`, given, found);
    else if (FS.isFile(node.mode)) {
      const bytes = FS.readFile(path);
      if (!Object.hasOwn(given, prefix + name) || !isSame(given[prefix + name], bytes)) found.set(prefix + name, bytes);
    }
  }
}

/// Calls onFile for each file that the run has written whole: such a file is renamed into its place.
function watch(FS, onFile) {
  const { rename } = FS;
  FS.rename = (from, to) => {
    rename.call(FS, from, to);
    const path = to.startsWith('/') ? to : `${FS.cwd()}/${to}`;
    if (path.startsWith(`${HOME}/`) && FS.isFile(FS.stat(path).mode)) onFile(path.slice(HOME.length + 1), FS.readFile(path));
  };
}

/// What is written to a descriptor goes to `take`; it is a terminal where progress is wanted.
function divert(FS, descriptor, take, isTerminal) {
  const stream = FS.streams[descriptor];
  const write = (_, buffer, offset, length) => { take(buffer.slice(offset, offset + length)); return length; };
  stream.stream_ops = { write, close() {}, flush() {} };
  if (!isTerminal) stream.tty = undefined;
}

/// The lines of progress on stderr become calls, all else is kept.
function splitter(err, onProgress) {
  return (part) => {
    const text = new TextDecoder().decode(part);
    if (!onProgress || !text.includes('\x1b[K')) { err.push(part); return; }
    for (const line of text.split('\r\x1b[K')) {
      const match = PROGRESS.exec(line);
      if (match) onProgress({ phase: match[1], done: Number(match[2]), total: match[3] === undefined ? null : Number(match[3]) });
    }
  };
}

export class Clast {
  /// The compiled program; load() makes it.
  constructor(program) { this.program = program; }

  /// Runs one command line: words after `clast`, files by path (texts or bytes). Never throws for what the command refuses: status
  /// is its exit code. files of the result: what it wrote or changed; onFile(path, bytes) has each while the run goes on. Runs on the calling thread: a page calls it in a worker, and cancels by
  /// ending that worker.
  async run(words, { files = {}, onProgress, onFile } = {}) {
    const out = new Bytes();
    const err = new Bytes();
    const module = await createClast({
      instantiateWasm: (imports, done) => {
        WebAssembly.instantiate(this.program, imports).then((instance) => done(instance));
        return {};
      },
    });
    const { FS } = module;
    nameAnything(FS);
    FS.mkdirTree(HOME);
    FS.chdir(HOME);
    writeFiles(FS, files);
    if (onFile) watch(FS, onFile);
    divert(FS, 1, (part) => out.push(part), false);
    divert(FS, 2, splitter(err, onProgress), Boolean(onProgress));
    let status = 0;
    try {
      status = module.callMain(words.map(String));
    } catch (fault) { // the machine's own end: memory of the page, or a fault of clast
      status = 4;
      err.push(new TextEncoder().encode(`clast: ended by WebAssembly: ${fault.message}; the same in a terminal: ${commandLine(words)}\n`));
    }
    const found = new Map();
    readFiles(FS, HOME, '', files, found);
    return { status, stdout: out.text(), stderr: err.text(), files: Object.fromEntries(found) };
  }

  /// The same for a command with --json: its object, also of a check that answered no (1); a ClastError for any other exit code but 0.
  async json(words, how) {
    const whole = [...words, '--json'];
    const result = await this.run(whole, how);
    if (result.status > 1) throw new ClastError(whole, result);
    return { ...JSON.parse(result.stdout), files: result.files, command: commandLine(whole) };
  }

  /// Grows virtual aggregates (clast aggregate).
  aggregate(options, how) { return this.json(['aggregate', ...wordsOf(options)], how); }

  /// Pours, shakes and calms a bed (clast pack): state_hash is that of the command.
  pack(options, how) { return this.json(['pack', ...wordsOf(options)], how); }

  /// Size and form of the surfaces among the files (clast shape): grains[] in the files' order.
  shape(files, options, how = {}) {
    return this.json(['shape', ...Object.keys(files), ...wordsOf(options)], { ...how, files: { ...how.files, ...files } });
  }

  /// Cells, labels and events of a cloud (clast decompose): columns {x, y, z} or a table's text. cells and point_cells are the
  /// columns of the two tables of the run folder, which is among the files.
  async decompose(points, options, how = {}) {
    const words = ['decompose', 'points.csv', ...wordsOf(options), '-o', 'cells'];
    const result = await this.json(words, { ...how, files: { ...how.files, 'points.csv': tableOf(points) } });
    const text = (name) => new TextDecoder().decode(result.files[`cells/${name}`]);
    return { ...result, cells: columnsOf(text('cells.csv')), point_cells: columnsOf(text('point_cells.csv')) };
  }
}

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
    worker.onerror = (event) => onEnd(event.message);
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
