// The tab Split: a table of positions, its cells and events.
const SIZE = 640; // of the picture, in its own pixels
const EDGE = 14;
const FIELDS = ['domain', 'variant', 'mesh', 'beta_dt', 'more'];
const PAINTED = 'painted.csv';
const FLAT = 'box:0,0,1,1'; // domain of what is painted
const under = new OffscreenCanvas(SIZE, SIZE).getContext('2d'); // the picture without marks
const HINT = $('picked').textContent;
const state = {
  name: null, text: null, columns: [], names: '', unit: '', // the table and what the picture shows of it
  strokes: [], painting: false, brush: [0.5, 0.5], result: null, picked: -1, running: false,
  turn: 0, arrival: 0, past: [], last: null, // runs and tables so far: the newest counts; what undo goes back to
};

function say(text) { $('state').textContent = text; }
function fail(text) { $('error').textContent = text; }

function setReady() {
  setButtons($('run'), $('cancel'), state.text !== null && splitter.isReady && !state.running, state.running);
}

// Points.

/// Of a table, for the picture: its columns x, y, z or else the first ones, their names for --columns where clast does not look for them
/// by itself (X, x_um; one that ends in a word that is no unit is left to the reader), and the unit in them. clast reads the table itself.
function glance(text) {
  const lines = text.replace(/^\ufeff/, '').split(/\r?\n/).filter((line) => line.trim() && !/^\s*#/.test(line));
  const by = [';', '\t', ','].find((c) => lines[0]?.includes(c)) ?? /\s+/;
  const cut = (line) => line.trim().split(by);
  let names = cut(lines[0] ?? '').map((name) => name.trim().replace(/^"(.*)"$/, '$1'));
  const isBare = names.every((name) => name !== '' && Number.isFinite(Number(name)));
  if (isBare) names = names.map((_, k) => `column_${k + 1}`);
  else lines.shift();
  const wanted = ['x', 'y', 'z'].map((axis) => names.findIndex((name) => name.toLowerCase().split(/[_ ([]/)[0] === axis)).filter((k) => k >= 0);
  const isKnown = wanted.length > 1 || (isBare && names.length < 4);
  let from = wanted.length > 1 ? wanted : names.slice(0, 3).map((_, k) => k);
  let columns = from.map(() => new Float64Array(lines.length));
  lines.forEach((line, i) => {
    const cells = cut(line);
    from.forEach((k, axis) => { columns[axis][i] = Number(cells[k]?.trim() || NaN); });
  });
  if (columns.length < 2 || !columns.every((c) => c.some(Number.isFinite))) return { columns: [], names: '', unit: '' };
  const isWide = (k) => columns[k].some((v) => v !== columns[k][0]);
  if (isKnown && columns.length === 3 && isWide(0) && isWide(1) && !isWide(2)) [from, columns] = [from.slice(0, 2), columns.slice(0, 2)]; // flat
  const chosen = from.map((k) => names[k]);
  const units = chosen.map((name) => /[_ ([]+(.*?)[)\]]?$/.exec(name)?.[1]);
  const unit = isKnown && FROM_UNIT.has(units[0]) && units.every((u) => u === units[0]) ? units[0] : '';
  const isFound = !isKnown || (!isBare && units.some((u) => u && !FROM_UNIT.has(u))) || chosen.join() === ['x', 'y', 'z'].filter((axis, k) => k < chosen.length || names.includes(axis)).join();
  return { columns, names: isFound ? '' : chosen.join(), unit };
}

/// A box around the points, its corners rounded outwards to two digits of its size: what the picture shows until the domain is given, which no points tell.
function boxAround(columns) {
  const low = [];
  const high = [];
  for (const column of columns) {
    const least = column.reduce((a, b) => (b < a ? b : a), Infinity);
    const most = column.reduce((a, b) => (b > a ? b : a), -Infinity);
    const unit = 10 ** (Math.floor(Math.log10(most - least || Math.abs(most) || 1)) - 1);
    const digits = Math.max(0, -Math.round(Math.log10(unit)));
    low.push(Number((Math.floor(least / unit) * unit).toFixed(digits)));
    high.push(Number((Math.ceil(most / unit) * unit).toFixed(digits)));
  }
  return { low, high };
}

/// Metres of a number that is typed without a unit, where More options say; of one in the table.
function bare() { return FROM_UNIT.get(/--unit[= ]+(\S+)/.exec($('more').value)?.[1]); }
function metres() { return bare() ?? FROM_UNIT.get(state.unit) ?? 1; }

/// Other points, or none.
function setPoints(name, text, domain) {
  if (state.running) cancel();
  else if (splitter.isReady) say('');
  state.arrival += 1;
  Object.assign(state, { name, text, columns: [], names: '', unit: '', result: null, picked: -1 }, typeof text === 'string' ? glance(text) : {});
  setPainting(state.painting && (text === null || name === PAINTED));
  $('result').hidden = true;
  fail('');
  const d = state.columns.length;
  const n = d > 0 ? state.columns[0].length : 0;
  const { low, high } = boxAround(state.columns);
  const isBox = n > 0 && low.every((v, k) => v < high[k]);
  if (text !== null) $('domain').value = domain ?? '';
  $('domain').placeholder = isBox ? `points: box:${[...low, ...high].map((v) => v + state.unit)}` : '';
  $('given').textContent = text === null ? 'no points yet' : `${name}: ${n > 0 ? `${n} point${n === 1 ? '' : 's'} in ${d} dimensions` : 'not drawn here; clast reads it'}${domain ? '' : ', its domain is to be given'}`;
  const pairs = d > 2 ? [[0, 1], [0, 2], [1, 2]] : [[0, 1]];
  $('axes').replaceChildren(...pairs.map(([a, b]) => new Option(`${'xyz'[a]}, ${'xyz'[b]}`, `${a},${b}`)));
  setReady();
  draw();
}

/// Draws that anyone can repeat: a linear congruence modulo 2^32 [Knuth1997 sec. 3.3.4, line 16].
function draws(seed) {
  let word = seed >>> 0;
  return () => { word = (Math.imul(1664525, word) + 1013904223) >>> 0; return word / 2 ** 32; };
}

function normal(draw) { return Math.sqrt(-2 * Math.log(1 - draw())) * Math.cos(2 * Math.PI * draw()); }

function make(kind) {
  const draw_ = draws(7);
  const d = kind === 'cube' ? 3 : 2;
  const rows = [];
  while (rows.length < 1200) {
    const u = Array.from({ length: d }, draw_);
    if (kind === 'gradient') u[0] = Math.sqrt(u[0]);
    if (kind !== 'even' && kind !== 'gradient' && rows.length % 3 > 0) {
      const centre = rows.length % 3 === 1 || kind === 'cube' ? 0.3 : 0.72;
      for (let k = 0; k < d; k += 1) u[k] = centre + 0.06 * normal(draw_);
    }
    if (u.every((c) => c > 0 && c < 1)) rows.push(u.map((c) => c.toFixed(5)).join(','));
  }
  setPoints(`${kind}.csv`, `${'x,y,z'.slice(0, 2 * d - 1)}\n${rows.join('\n')}\n`, d === 3 ? 'box:0,0,0,1,1,1' : FLAT);
  note();
}

function paintedText() {
  return `x,y\n${state.strokes.flat().join('\n')}\n`;
}

/// Sets the painted points, in the domain that they have.
function setPainted() { setPoints(PAINTED, paintedText(), state.name === PAINTED ? $('domain').value : FLAT); }

function usePainted() {
  if (state.strokes.length > 0) setPainted();
  else noPoints();
  note();
}

function noPoints() { setPoints(null, null); }

function setPainting(isOn) {
  state.painting = isOn;
  $('paint').setAttribute('aria-pressed', String(isOn));
  const hint = isOn ? 'Paint with the pointer, or in the picture by arrow keys and Space.' : HINT;
  if ($('picked').textContent !== hint) $('picked').textContent = hint; // it is read aloud when it changes
}

// Undo: of points, strokes and options.

function snapshot() {
  return { name: state.name, text: state.text, strokes: [...state.strokes], fields: FIELDS.map((key) => $(key).value) };
}

function note() {
  const now = snapshot();
  if (state.last?.name === now.name && state.last.text === now.text && now.fields.every((value, k) => value === state.last.fields[k])) return;
  if (state.last) state.past.push(state.last);
  if (state.past.length > UNDO) state.past.shift();
  state.last = now;
  $('undo').disabled = state.past.length === 0;
}

function undo() {
  note();
  const before = state.past.pop();
  if (!before) return;
  state.strokes = [...before.strokes];
  if (before.text === null) noPoints();
  else if (before.text !== state.text || before.name !== state.name) setPoints(before.name, before.text, before.fields[0]);
  FIELDS.forEach((key, k) => { $(key).value = before.fields[k]; });
  state.last = before;
  setUndo($('undo'), state.past.length > 0, $('run'));
  draw();
  say('undone');
}

// The picture.

function domainBox() {
  const axes = $('axes').value.split(',').map(Number);
  const d = state.columns.length || 2;
  const words = /^box:(.*)$/.exec($('domain').value.trim());
  const numbers = words ? words[1].split(',').map((word) => siOf(word) * (/[a-z\u00b5]\s*$/i.test(word) ? 1 : bare() ?? 1)) : [];
  if (numbers.length === 2 * d && numbers.every(Number.isFinite)) return axes.map((a) => [numbers[a], numbers[d + a]]);
  if (d > 0 && state.columns.length > 0) { const box = boxAround(state.columns); return axes.map((a) => [metres() * box.low[a], metres() * box.high[a]]); }
  return [[0, 1], [0, 1]];
}

/// Pixels of a place: one scale for both axes, y upwards.
function scaleOf() {
  const [[x0, x1], [y0, y1]] = domainBox();
  const scale = (SIZE - 2 * EDGE) / Math.max(x1 - x0, y1 - y0, Number.MIN_VALUE);
  const left = (SIZE - scale * (x1 - x0)) / 2;
  const foot = (SIZE + scale * (y1 - y0)) / 2;
  return { x: (v) => left + scale * (v - x0), y: (v) => foot - scale * (v - y0), inverse: (px, py) => [x0 + (px - left) / scale, y0 + (foot - py) / scale] };
}

function mix(place) {
  const at = Math.min(Math.max(place, 0), 1) * (COLOURS.length - 1);
  const k = Math.min(Math.floor(at), COLOURS.length - 2);
  const part = (word, i) => parseInt(word.slice(1 + 2 * i, 3 + 2 * i), 16);
  return `rgb(${[0, 1, 2].map((i) => Math.round(part(COLOURS[k], i) + (at - k) * (part(COLOURS[k + 1], i) - part(COLOURS[k], i)))).join(' ')})`;
}

function valuesOf(cells, by) {
  if (by === 'value') return cells.events ?? cells.pair_integral;
  return cells[by];
}

/// Colour of each cell, and the legend's two ends: a logarithmic scale where all values are above 0.
function colouring(cells) {
  const by = $('colour').value;
  const values = valuesOf(cells, by);
  if (by === 'label') return { of: (i) => LABELS[values[i] % LABELS.length], ends: null };
  const isLog = values.every((v) => v > 0);
  const f = isLog ? Math.log : (v) => v;
  const low = values.reduce((a, b) => Math.min(a, b), Infinity);
  const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  const place = (v) => (f(high) > f(low) ? (f(v) - f(low)) / (f(high) - f(low)) : 0.5);
  return { of: (i) => mix(place(values[i])), ends: [low, high, isLog] };
}

function isFlat(cells) { return !('z_low_m' in cells); }

function nameOfColour(cells) {
  const by = $('colour').value;
  if (by === 'count' || (by === 'value' && cells.events)) return $('colour').selectedOptions[0].text;
  return `${by === 'value' ? 'pair integral' : by} (1/m^${isFlat(cells) ? 2 : 3})`;
}

/// Many points, pixel by pixel: a rectangle for each takes seconds.
function drawMany(c, x, y, ink) {
  const image = new ImageData(SIZE, SIZE);
  const wide = x.length > 20000 ? 1 : 2;
  for (let i = 0; i < x.length; i += 1) {
    for (let k = 0; k < wide * wide; k += 1) {
      const px = Math.floor(x[i] + (k >> 1));
      const py = Math.floor(y[i] + (k & 1));
      const at = 4 * (py * SIZE + px) + 3;
      if (px >= 0 && px < SIZE && py >= 0 && py < SIZE) image.data[at] += (255 - image.data[at]) * (wide === 1 ? 0.5 : 0.85);
    }
  }
  const layer = new OffscreenCanvas(SIZE, SIZE);
  const over = layer.getContext('2d');
  over.putImageData(image, 0, 0);
  over.globalCompositeOperation = 'source-in';
  over.fillStyle = ink;
  over.fillRect(0, 0, SIZE, SIZE);
  c.drawImage(layer, 0, 0);
}

function cornersOf(cells) {
  const axes = $('axes').value.split(',').map(Number).map((a) => 'xyz'[a]);
  const at = axes.map((a) => [cells[`${a}_low_m`], cells[`${a}_high_m`]]);
  return at.every(([low]) => low) ? at : null;
}

/// A cell's place in the picture: x, y, width, height.
function boxOf([[x0, x1], [y0, y1]], i, s) { return [s.x(x0[i]), s.y(y1[i]), s.x(x1[i]) - s.x(x0[i]), s.y(y0[i]) - s.y(y1[i])]; }

function drawCells(c, s) {
  const { cells } = state.result;
  const at = cornersOf(cells);
  if (!at) return;
  const paint = colouring(cells);
  for (let i = 0; i < at[0][0].length; i += 1) {
    const box = boxOf(at, i, s);
    c.globalAlpha = isFlat(cells) ? 0.75 : 0.12;
    c.fillStyle = paint.of(i);
    c.fillRect(...box);
    c.globalAlpha = 1;
    c.strokeStyle = '#80808080';
    c.lineWidth = 1;
    c.strokeRect(...box);
  }
  const number = (v) => Number(v.toPrecision(3)).toString();
  $('legend').style.backgroundImage = paint.ends ? `linear-gradient(90deg, ${COLOURS.join(',')})` : 'none';
  $('legend').replaceChildren(...(paint.ends
    ? [number(paint.ends[0]), `${nameOfColour(cells)}${paint.ends[2] ? ', logarithmic' : ''}`, number(paint.ends[1])]
    : ['label 0 to 7, one colour each']).map((t) => Object.assign(document.createElement('span'), { textContent: t })));
}

function draw() {
  const canvas = $('picture');
  const c = canvas.getContext('2d');
  const style = getComputedStyle(document.documentElement);
  const s = scaleOf();
  const axes = $('axes').value.split(',').map(Number);
  c.clearRect(0, 0, SIZE, SIZE);
  $('legend').replaceChildren();
  $('legend').style.backgroundImage = 'none';
  if (state.result) drawCells(c, s);
  const [[x0, x1], [y0, y1]] = domainBox();
  c.strokeStyle = style.getPropertyValue('--soft');
  c.lineWidth = 1.5;
  c.strokeRect(s.x(x0), s.y(y1), s.x(x1) - s.x(x0), s.y(y0) - s.y(y1));
  const keys = state.painting ? ': arrow keys move the brush, Space paints' : state.result?.cells.count ? ': arrow keys go through the cells' : '';
  let told = 'no points yet';
  if (state.columns.length > 0) {
    const n = state.columns[0].length;
    const [x, y] = [s.x, s.y].map((to, k) => state.columns[axes[k]].map((v) => to(metres() * v)));
    c.fillStyle = style.getPropertyValue('--ink');
    if (n > 3000) drawMany(c, x, y, c.fillStyle);
    else {
      c.globalAlpha = 0.85;
      for (let i = 0; i < n; i += 1) c.fillRect(x[i] - 1.6, y[i] - 1.6, 3.2, 3.2);
      c.globalAlpha = 1;
    }
    told = `${n} points${state.result?.json.n_cell ? ` in ${state.result.json.n_cell} cells` : ''}`;
  }
  canvas.setAttribute('aria-label', told + keys);
  under.clearRect(0, 0, SIZE, SIZE);
  under.drawImage(canvas, 0, 0);
  mark();
}

/// What moves over the picture, which is kept: to draw a million points or cells anew takes long.
function mark() {
  const c = $('picture').getContext('2d');
  c.clearRect(0, 0, SIZE, SIZE);
  c.drawImage(under.canvas, 0, 0);
  const at = state.result && state.picked >= 0 && cornersOf(state.result.cells);
  c.strokeStyle = '#d55e00';
  c.lineWidth = 4;
  if (at) c.strokeRect(...boxOf(at, state.picked, scaleOf()));
  if (!state.painting) return;
  c.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue('--accent');
  c.lineWidth = 2;
  c.beginPath();
  c.arc(SIZE * state.brush[0], SIZE * state.brush[1], 20, 0, 7);
  c.stroke();
}

function pick(i) {
  const { cells } = state.result;
  const n = cells.count.length;
  state.picked = ((i % n) + n) % n;
  const k = state.picked;
  const name = cells.events ? 'events' : 'pair integral';
  $('picked').textContent = `cell ${k} of ${n}: ${cells.count[k]} points, density ${cells.density[k].toPrecision(4)} 1/m^${isFlat(cells) ? 2 : 3}, `
    + `${name} ${(cells.events ?? cells.pair_integral)[k].toPrecision(4)}${cells.label ? `, label ${cells.label[k]} of pass ${cells.pass[k]}` : ''}`;
  mark();
}

function pointAt(event) {
  const box = $('picture').getBoundingClientRect();
  return scaleOf().inverse((event.clientX - box.left) * SIZE / box.width, (event.clientY - box.top) * SIZE / box.height);
}

function pickAt(event) {
  const at = state.result && cornersOf(state.result.cells);
  if (!at) return;
  const [x, y] = pointAt(event);
  let best = -1;
  let least = Infinity;
  for (let i = 0; i < at[0][0].length; i += 1) {
    const inside = x >= at[0][0][i] && x < at[0][1][i] && y >= at[1][0][i] && y < at[1][1][i];
    const area = (at[0][1][i] - at[0][0][i]) * (at[1][1][i] - at[1][0][i]);
    if (inside && area < least) { best = i; least = area; }
  }
  if (best >= 0 && best !== state.picked) pick(best);
}

function spray(event) {
  if (state.name !== PAINTED) setPainted();
  const unit = bare() ?? 1;
  const [x, y] = pointAt(event).map((v) => v / unit);
  const box = $('picture').getBoundingClientRect();
  state.brush = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  const stroke = state.strokes[state.strokes.length - 1];
  const ends = domainBox();
  for (let k = 0; k < 6; k += 1) {
    const p = [x + 0.03 * normal(Math.random), y + 0.03 * normal(Math.random)];
    if (p.every((c, k_) => c > ends[k_][0] / unit && c < ends[k_][1] / unit)) stroke.push(p.map((c) => c.toFixed(4)).join(','));
  }
  $('undo').disabled = false;
  setPainted();
}

/// Arrow keys move the brush, Space paints where it is.
function paintByKey(key, step) {
  if (step) {
    state.brush = state.brush.map((place, k) => Math.min(1, Math.max(0, place + 0.04 * step[k])));
    mark();
    return;
  }
  const box = $('picture').getBoundingClientRect();
  state.strokes.push([]);
  spray({ clientX: box.left + state.brush[0] * box.width, clientY: box.top + state.brush[1] * box.height });
  note();
}

// Running.

function wordsNow() {
  const words = ['decompose', state.name];
  if (state.names && !$('more').value.includes('--columns')) words.push(`--columns=${state.names}`);
  for (const key of ['domain', 'variant', 'mesh', 'beta_dt']) {
    const value = $(key).value.trim();
    if (value) words.push(`--${key.replace('_', '-')}=${value}`);
  }
  return [...words, ...moreWords($('more').value), '-o', 'cells'];
}

const splitter = new Engine(() => { say('ready'); setReady(); }, (text) => { say(''); setReady(); fail(text); });

async function start() {
  fail('');
  note();
  state.turn += 1;
  const { turn } = state;
  state.words = wordsNow();
  state.begun = performance.now();
  say('computing');
  $('result').hidden = true;
  state.result = null;
  state.running = true;
  setReady();
  draw();
  try {
    await finish(await splitter.run(state.words, { [state.name]: state.text }), turn);
  } catch (fault) {
    if (turn !== state.turn) return;
    state.running = false;
    setReady();
    say('');
    fail(`this page cannot show what clast answered (${fault.message}); in a terminal: ${commandOf(state.words)}`);
  }
}

function cancel() {
  if (!state.running) return;
  state.turn += 1;
  state.running = false;
  splitter.cancel();
  setReady();
  say('cancelled');
}

/// Shows an answer, if nothing has come since that ended its run.
async function finish(ended, turn) {
  const { result } = ended;
  const refusal = refusalOf(ended);
  const seconds = (performance.now() - state.begun) / 1000;
  const hash = refusal ? null : await digestOf(result.files['cells/cells.csv']);
  if (turn !== state.turn) return;
  state.running = false;
  setReady();
  if (refusal) {
    say('');
    fail(refusal);
    return;
  }
  const found = foundOf(result, 'cells');
  say(`done in ${seconds.toFixed(2)} s${warned(found)}`);
  state.result = { ...found, hash, cells: found.json.n_cell === null ? {} : columnsOf(textOf(result.files['cells/cells.csv'])) };
  state.picked = -1;
  setPainting(state.painting);
  $('colour').querySelector('[value=label]').disabled = !state.result.cells.label;
  if (!state.result.cells.label && $('colour').value === 'label') $('colour').value = 'density';
  show();
  draw();
}

function show() {
  const r = state.result.json;
  const key = r.events === null ? 'pair_integral' : 'events';
  const unit = r.events === null ? ` ${r.pair_integral_unit}` : '';
  $('figures').replaceChildren(
    figure(short(r.n), `points in ${r.dimension} dimensions`), figure(r.reject === null ? 'not tested' : { 'less even': 'clustered', 'more even': 'regular' }[r.evenness] ?? r.evenness, 'tests of uniformity'),
    ...(r.n_cell === null ? [] : [figure(short(r.n_cell), r.n_cell === 1 ? 'cell' : 'cells'), figure(`${short(r[key])}${unit}`, unit ? 'pair integral: events per kernel times time step' : 'events'),
      figure(r.resolved ? `${short(r[`${key}_low`])} to ${short(r[`${key}_high`])}${unit}` : `above ${short(r[`${key}_low`])}${unit}`,
      r.resolved ? '95 % interval' : r.keeps_apart ? 'the points keep apart: lower bound of large cells alone, 97.5 %' : 'the points do not show all of their structure: lower bound alone, 97.5 %')]));
  fillTable($('tests'), ['test', 'statistic', 'p', ''], (r.tests ?? []).map((t) => [t.name, short(t.statistic), t.p === 0 ? '< 1e-300' : short(t.p), t.reject ? 'rejects' : '']));
  $('stop').textContent = r.stop ?? '';
  $('passes_card').hidden = !(r.passes?.length > 0);
  fillTable($('passes'), ['bins', 'threshold', 'score', 'expected'], (r.passes ?? []).map((p) => [p.bins.join(' x '), short(p.lambda), short(p.score), short(p.ideal_score)]));
  $('command').textContent = commandOf(state.words);
  $('said').textContent = state.result.said;
  $('hash').textContent = state.result.hash;
  $('result').hidden = false;
}

// Files out.

function shared() {
  return packed({ name: state.name, text: state.text, ...Object.fromEntries(FIELDS.map((key) => [key, $(key).value])) });
}

function openSplit(kept) {
  const { text } = kept;
  if (typeof text !== 'string') throw new Error('it holds no points');
  note();
  setPoints(plainName(String(kept.name), 'points'), text, String(kept.domain));
  for (const key of FIELDS) $(key).value = String(kept[key] ?? '');
  state.strokes = state.name === PAINTED ? [text.trim().split('\n').slice(1)] : [];
  note();
  draw();
}

/// A table as text, where that is its bytes in UTF-8: others go to clast as they are, undrawn.
function textIfUtf8(bytes) {
  try { return new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(bytes); } catch { return bytes; }
}

async function take(file) {
  if (!file) return;
  if (/\.(stl|obj|off)$/i.test(file.name)) { fail(`${file.name} is a surface; the tabs Grow and Pour take it`); return; }
  const isText = /\.(csv|tsv|txt|xyz)$/i.test(file.name);
  state.arrival += 1;
  const { arrival } = state;
  try {
    const bytes = await bytesOfFile(file, 'decompose');
    if (arrival !== state.arrival) return; // other points came while it was read
    setPoints(plainName(file.name, 'points'), isText ? textIfUtf8(bytes) : bytes);
    note();
  } catch (fault) {
    fail(fault.message);
  }
}

function listenSplit() {
  $('form').addEventListener('submit', (event) => { event.preventDefault(); if (!$('run').disabled) start(); });
  $('cancel').addEventListener('click', cancel);
  $('file').addEventListener('change', () => { take($('file').files[0]); $('file').value = ''; });
  document.querySelectorAll('[data-make]').forEach((b) => b.addEventListener('click', () => make(b.dataset.make)));
  $('paint').addEventListener('click', () => {
    setPainting(!state.painting);
    if (state.painting) usePainted();
    else draw();
  });
  $('undo').addEventListener('click', undo);
  $('clear').addEventListener('click', () => { state.strokes = []; usePainted(); });
  const picture = $('picture');
  picture.addEventListener('pointerdown', (event) => {
    if (!state.painting) return;
    picture.setPointerCapture(event.pointerId);
    state.strokes.push([]);
    spray(event);
  });
  for (const kind of ['pointerup', 'pointercancel']) picture.addEventListener(kind, () => { if (state.painting) note(); });
  picture.addEventListener('pointermove', (event) => {
    if (!state.painting) pickAt(event);
    else if (event.buttons > 0) spray(event);
  });
  picture.addEventListener('keydown', (event) => {
    const step = { ArrowRight: [1, 0], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowUp: [0, -1] }[event.key];
    const isPaint = state.painting && (step || event.key === ' ');
    if (!isPaint && !(step && state.result?.cells.count)) return;
    event.preventDefault();
    if (isPaint) paintByKey(event.key, step);
    else pick(state.picked + step[0] + step[1]);
  });
  for (const id of ['colour', 'axes', 'domain', 'more']) $(id).addEventListener('change', draw);
  for (const key of FIELDS) $(key).addEventListener('change', note);
  state.last = snapshot();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
  $('copy').addEventListener('click', () => copy(plainCommandOf(state.words), 'copied', say));
  $('zip').addEventListener('click', () => save(zipOf(splitRoom.outFiles()), 'cells.zip'));
  $('share').addEventListener('click', () => {
    const word = typeof state.text === 'string' && state.text.length < MOST_SHARED ? shared() : '';
    if (!word || word.length > MOST_SHARED) { say('these points do not fit into an address; take the zip'); return; }
    shareWord(splitRoom, word);
  });
}

const splitRoom = {
  name: 'split',
  engine: splitter,
  say,
  fail,
  listen: listenSplit,
  open: openSplit,
  take: async (files) => {
    await take(files[0]);
    if (files[1]) fail(`one table at a time: ${files[1].name} is left out`);
  },
  shown: draw,
  outFiles: () => withCommand({ [state.name]: state.text, ...state.result.files }, state.words, `SHA-256 of cells/cells.csv: ${state.result.hash}`),
};
