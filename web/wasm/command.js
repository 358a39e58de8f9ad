// clast as a class: the same command lines, messages, files and numbers as the command itself. createClast (emscripten's loader of clast.wasm) stands
// above this text, which has nothing of modules: it is a part of clast.mjs, and of the live page's worker, a script.
const HOME = '/work'; // where a command line runs; its files live in memory
const PROGRESS = /^([a-z][a-z ]*?) (\d+)(?:\/(\d+))?/;

/// A command line that ended with another exit code than 0 and 1; the message is the command's own line.
class ClastError extends Error {
  constructor(words, result) {
    super(result.stderr.trim().split('\n').pop() || `clast ${words[0]} ended with code ${result.status}`);
    this.name = 'ClastError';
    this.words = words;
    this.status = result.status;
    this.result = result;
  }
}

/// Options as the words of a command line: beta_dt: 1e-3 -> --beta-dt=0.001; true -> --NAME, false -> --no-NAME; lists repeat.
function wordsOf(options = {}) {
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
function commandLine(words) {
  return ['clast', ...words].map((w) => (/^[\w@%+=:,./-]+$/.test(w) ? w : `'${w.replaceAll("'", "'\\''")}'`)).join(' ');
}

/// Columns of coordinates (x, y, z: arrays of one length) as a table that `clast decompose` reads; a text is one already.
function tableOf(points) {
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
function columnsOf(text) {
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

class Clast {
  /// The compiled program; load() makes it.
  constructor(program) { this.program = program; }

  /// Runs one command line: words after `clast`, files by path (texts or bytes). Never throws for what the command refuses: status
  /// is its exit code. files of the result: what it wrote or changed; onFile(path, bytes) has each while the run goes on. Runs on the calling thread: a page calls it in a worker, and cancels by
  /// ending that worker.
  async run(words, { files = {}, onProgress, onFile } = {}) {
    const out = new Bytes();
    const err = new Bytes();
    const module = await createClast({
      thisProgram: 'clast',
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

  /// The same for a command with --json: its object, also of a check that answered no (1), with `messages`, the lines that the command warns by; a ClastError
  /// for any other exit code but 0.
  async json(words, how) {
    const whole = [...words, '--json'];
    const result = await this.run(whole, how);
    if (result.status > 1) throw new ClastError(whole, result);
    return { ...JSON.parse(result.stdout), files: result.files, command: commandLine(whole), messages: result.stderr.split('\n').filter(Boolean) };
  }

  /// Grows virtual aggregates (clast aggregate).
  aggregate(options, how) { return this.json(['aggregate', ...wordsOf(options)], how); }

  /// Pours, shakes and damps a bed (clast pack): state_hash is that of the command.
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
