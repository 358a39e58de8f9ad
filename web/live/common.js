// What the rooms share: clast in a worker made of a text of this page, tables, texts, files out, the address.
const $ = (id) => document.getElementById(id);
const MOST_SHARED = 60000; // letters of an address that browsers keep
const COLOURS = ['#440154', '#472d7b', '#3b528b', '#2c728e', '#21918c', '#28ae80', '#5ec962', '#addc30', '#fde725'];
const LABELS = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#f0e442', '#737373'];
let program = null; // clast: its worker's script, and its code compiled

function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
}

function base64Of(bytes) {
  let text = '';
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text);
}

/// Bytes of base 85 as tools/make_live.py writes it: five letters for four bytes, a letter more than bytes at the end.
function bytesOf85(text) {
  const digit = new Uint8Array(128);
  [...'0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;,=>?@^_`{|}~'].forEach((c, k) => { digit[c.charCodeAt(0)] = k; });
  const bytes = new Uint8Array(Math.floor(text.length * 4 / 5));
  for (let i = 0, at = 0; at < bytes.length; i += 5) {
    let word = 0;
    for (let k = i; k < i + 5; ++k) word = word * 85 + (k < text.length ? digit[text.charCodeAt(k)] : 84);
    for (let shift = 24; shift >= 0 && at < bytes.length; shift -= 8) bytes[at++] = word >>> shift;
  }
  return bytes;
}

/// What an element of the page holds compressed.
async function bundled(element) {
  const bytes = bytesOf85(element.textContent.trim());
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
}

/// clast in a worker of its own. A run that is cancelled ends with the worker, and its promise is never kept.
class Engine {
  constructor(onReady, onFault) { Object.assign(this, { onReady, onFault, number: 0, pending: null, onFile: null }); }

  start() {
    const address = URL.createObjectURL(new Blob([program.worker], { type: 'text/javascript' }));
    this.fault = null;
    this.worker = new Worker(address);
    this.worker.onmessage = ({ data }) => this.hear(data);
    this.worker.onerror = (event) => this.end(event.message ? `the worker ended: ${event.message}` : 'the worker in which clast computes was not started by this browser');
    this.worker.postMessage({ program: program.code });
    this.address = address;
  }

  /// A worker has ended, or never began: the run that waits for it is told why. In place of one that had begun comes another; where none begins, each run after is told, too.
  end(text) {
    const { pending, isReady } = this;
    if (isReady) this.cancel();
    else { this.worker.terminate(); this.fault = text; }
    this.pending = null;
    this.onFault(text);
    pending?.({ fault: text });
  }

  hear(data) {
    if (data.ready) { URL.revokeObjectURL(this.address); this.isReady = true; this.onReady(); return; }
    if (data.id !== this.number) return;
    if (data.file) { this.onFile?.(data.file.name, data.file.bytes); return; }
    this.pending?.(data);
    this.pending = null;
  }

  /// {result} or {fault}; onFile(name, bytes): files as the run finishes them.
  run(words, files, onFile) {
    if (this.fault) return Promise.resolve({ fault: this.fault });
    this.number += 1;
    this.onFile = onFile;
    return new Promise((done) => {
      this.pending = done;
      this.worker.postMessage({ id: this.number, words, files, watch: Boolean(onFile) });
    });
  }

  cancel() {
    this.worker.terminate();
    this.number += 1;
    this.pending = null;
    this.isReady = false;
    this.start();
  }
}

const textOf = (bytes) => new TextDecoder().decode(bytes);

/// The command's own line of a run that failed, or null.
function refusalOf({ result, fault }) {
  if (fault) return fault;
  if (result.status <= 1 && result.stdout) return null;
  return result.stderr.trim().split('\n').pop() || `clast ended with code ${result.status}`;
}

/// What a run found: its summary, its files, all that the command said.
function foundOf({ stdout, stderr, files }, folder) {
  return { json: JSON.parse(textOf(files[`${folder}/summary.json`])), files, said: `${stderr}${stdout}`.trim() };
}

/// For the line of the state, where a run has warned.
function warned({ said }) { return /\bwarning\b/.test(said) ? ', with a warning of the command below' : ''; }

/// The run's files, what it read, and its command.
function withCommand(files, words, hash) { return { ...files, 'command.txt': `${plainCommandOf(words)}\n# ${hash}\n` }; }

function columnsOf(text) {
  const lines = text.split('\n').filter((line) => line && !line.startsWith('#'));
  const names = (lines[0] ?? '').split(',');
  const rows = lines.slice(1).map((line) => line.split(',').map(Number));
  return Object.fromEntries(names.map((name, k) => [name, rows.map((row) => row[k])]));
}

function tag(name, text, className) {
  return Object.assign(document.createElement(name), { textContent: text, className: className ?? '' });
}

function fillTable(table, heads, rows) {
  const head = tag('tr', '');
  head.append(...heads.map((h, k) => Object.assign(tag('th', h, k > 0 ? 'n' : ''), { scope: 'col' })));
  table.replaceChildren(head, ...rows.map((row) => {
    const line = tag('tr', '');
    line.append(...row.map((cell, k) => tag('td', cell, k > 0 ? 'n' : '')));
    return line;
  }));
}

/// Which of two buttons can be pressed; one that rests hands the keyboard's focus to the other, as soon as that can.
function setButtons(run, cancel, canRun, canCancel) {
  const held = document.activeElement;
  run.disabled = !canRun;
  cancel.disabled = !canCancel && (canRun || held !== cancel);
  if (held === run && canCancel) cancel.focus();
  if (held === cancel && canRun) run.focus();
}

/// Whether undo can be pressed; when it no more can, the keyboard's focus goes on.
function setUndo(undo, can, next) {
  const isHeld = document.activeElement === undo;
  undo.disabled = !can;
  if (isHeld && !can) next.focus();
}

function figure(value, name) {
  const box = tag('div', '', 'figure');
  box.append(tag('b', value), tag('span', name));
  return box;
}

function short(v) { return v === null || v === undefined ? '-' : typeof v === 'number' ? Number(v.toPrecision(5)).toString() : String(v); }

/// A value of an SI unit as people write it: 0.00027, 'm' -> 270 um.
function withUnit(v, unit, digits = 4) {
  if (v === null || v === undefined || !Number.isFinite(v)) return '-';
  if (v !== 0 && Math.abs(v) < 0.9995e-12) return `below 1 p${unit}`; // what rounding leaves of nothing
  const [factor, prefix] = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, '\u00b5'], [1e-9, 'n'], [1e-12, 'p']]
    .find(([f]) => Math.abs(v) >= 0.9995 * f) ?? [1, ''];
  return `${Number((v / factor).toPrecision(digits))} ${prefix}${unit}`;
}

function commandOf(words) {
  const quote = (w) => (/^[\w@%+=:,./-]+$/.test(w) ? w : `'${w.replaceAll("'", "'\\''")}'`);
  return ['clast', ...words].map(quote).join(' ');
}

/// The command as it gives the same bytes on any processor.
function plainCommandOf(words) { return `GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 ${commandOf(words)}`; }

/// Words of a text as a shell cuts it, with quotes and backslashes.
function shellWords(text) {
  return (text.match(/([^\s'"\\]|\\.|'[^']*'|"(\\.|[^"\\])*"|['"\\])+/g) ?? []).map((word) => word
    .replace(/'([^']*)'|"((?:\\.|[^"\\])*)"|\\(.)/g, (_, single, double, one) => single ?? double?.replace(/\\([\\"$`])/g, '$1') ?? one));
}

/// Words of more options; `--set KEY=VALUE` is the same as `--KEY=VALUE`.
function moreWords(text) {
  const words = shellWords(text).map((word) => word.replace(/^--set=/, '--'));
  return words.flatMap((word, k) => (word === '--set' && words[k + 1]?.includes('=') ? [] : [words[k - 1] === '--set' && word.includes('=') ? `--${word}` : word]));
}

async function digestOf(bytes) {
  const digest = globalThis.crypto?.subtle ? await crypto.subtle.digest('SHA-256', bytes) : null;
  return digest ? [...new Uint8Array(digest)].map((b) => b.toString(16).padStart(2, '0')).join('') : 'not known to this browser';
}

const TAKEN = ['sphere', 'ellipsoid', 'bed', 'aggregate', 'cells']; // words of the commands, and the folders that they write
const MOST_BYTES = 64e6; // of a file

/// A dropped file's name as one that a command line may hold, and that means nothing else there.
function plainName(name, otherwise) {
  const plain = name.trim().replace(/^[-/\\]+|[/\\\0:]/g, '_').replace(/^[.\s]+$/, '') || otherwise;
  return TAKEN.includes(plain) || GRAINS.has(plain) ? `_${plain}` : plain;
}

/// Bytes of a dropped file; an Error whose message is a line for the reader.
async function bytesOfFile(file, command) {
  if (file.size > MOST_BYTES) throw new Error(`${file.name} has ${(file.size / 1e6).toFixed(0)} MB; this page takes 64 MB a file, a terminal takes more: clast ${command} --help`);
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch {
    throw new Error(`${file.name} cannot be read: a folder, or a file that is gone`);
  }
}

// Files out.

const CRC = Uint32Array.from({ length: 256 }, (_, n) => {
  let crc = n;
  for (let k = 0; k < 8; k += 1) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  return crc;
});

function crc32(bytes) {
  let crc = -1;
  for (const byte of bytes) crc = (crc >>> 8) ^ CRC[(crc ^ byte) & 255];
  return ~crc >>> 0;
}

/// A zip of stored files [APPNOTE 6.3.9]; its times are those of 1980.
function zipOf(files) {
  const parts = [];
  const list = [];
  let at = 0;
  for (const [name, content] of Object.entries(files)) {
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    const path = new TextEncoder().encode(name);
    const common = new DataView(new ArrayBuffer(26));
    [[0, 20, 2], [2, 0x800, 2], [4, 0, 2], [6, 0, 2], [8, 33, 2], [10, crc32(bytes), 4], [14, bytes.length, 4], [18, bytes.length, 4], [22, path.length, 2]]
      .forEach(([place, value, size]) => (size === 2 ? common.setUint16(place, value, true) : common.setUint32(place, value, true)));
    const place = new DataView(new ArrayBuffer(16));
    place.setUint32(12, at, true);
    parts.push(new Uint8Array([80, 75, 3, 4]), new Uint8Array(common.buffer), path, bytes);
    list.push(new Uint8Array([80, 75, 1, 2, 20, 0]), new Uint8Array(common.buffer), new Uint8Array(place.buffer).subarray(2), path);
    at += 30 + path.length + bytes.length;
  }
  const size = list.reduce((n, part) => n + part.length, 0);
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true);
  end.setUint16(8, Object.keys(files).length, true);
  end.setUint16(10, Object.keys(files).length, true);
  end.setUint32(12, size, true);
  end.setUint32(16, at, true);
  return new Blob([...parts, ...list, end.buffer], { type: 'application/zip' });
}

function save(blob, name) {
  const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// An object as letters of an address, and back.
function packed(object) {
  return base64Of(new TextEncoder().encode(JSON.stringify(object))).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function unpacked(word) {
  return JSON.parse(new TextDecoder().decode(bytesOf(word.replaceAll('-', '+').replaceAll('_', '/'))));
}

/// The address holds a room's word, and has it again when the room is shown again.
function shareWord(room, word) {
  room.word = word;
  history.replaceState(null, '', `#${room.name}=${word}`);
  copy(location.href, 'copied', (text) => room.say(text));
}

async function copy(text, done, say) {
  try { await navigator.clipboard.writeText(text); say(done); } catch { say('the browser did not let it be copied'); }
}
