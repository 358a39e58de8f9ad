// A run's state (state.h5 as clast writes it without HDF5, docs/theory/state-file.md) read, and as the viewer's data (web/view/data.js).

/// Arrays and attributes of a file by their paths.
class State {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.arrays = new Map();
    this.attributes = new Map();
    this.members = new Map();
    this.node(Number(this.view.getBigUint64(36, true)), '');
  }

  /// Header of an array or folder: its messages.
  node(address, path) {
    const { view } = this;
    if (view.getUint32(address, false) !== 0x4f484452 || view.getUint8(address + 5) !== 2) throw new Error(`${path || '/'} is no header`);
    const end = address + 10 + view.getUint32(address + 6, true);
    const array = { shape: [], type: 0, size: 0, at: 0, length: 0 };
    this.members.set(path, []);
    for (let at = address + 10; at < end;) {
      const kind = view.getUint8(at);
      const size = view.getUint16(at + 1, true);
      this.message(kind, at + 4, path, array);
      at += 4 + size;
    }
    if (array.isArray) { this.arrays.set(path, array); this.members.delete(path); }
  }

  message(kind, at, path, array) {
    const { view } = this;
    if (kind === 1) {
      for (let d = 0; d < view.getUint8(at + 1); d += 1) array.shape.push(Number(view.getBigUint64(at + 4 + 8 * d, true)));
    } else if (kind === 3) {
      Object.assign(array, { type: view.getUint8(at), signed: (view.getUint8(at + 1) & 8) !== 0, size: view.getUint32(at + 4, true) });
    } else if (kind === 8) {
      const place = view.getBigInt64(at + 2, true); // -1: none
      Object.assign(array, { isArray: true, at: place < 0 ? 0 : Number(place), length: Number(view.getBigUint64(at + 10, true)) });
    } else if (kind === 6) {
      const n = view.getUint16(at + 3, true);
      const name = this.text(at + 5, n);
      this.members.get(path).push(name);
      this.node(Number(view.getBigUint64(at + 5 + n, true)), `${path}/${name}`);
    } else if (kind === 12) this.attribute(at, path);
  }

  text(at, n) {
    return new TextDecoder().decode(this.bytes.subarray(at, at + n)).replace(/\0.*$/s, '');
  }

  attribute(at, path) {
    const { view } = this;
    const n = view.getUint16(at + 2, true);
    const type = at + 9 + n;
    const value = type + view.getUint16(at + 4, true) + view.getUint16(at + 6, true);
    const size = view.getUint32(type + 4, true);
    const number = () => (view.getUint8(type) === 0x11 ? view.getFloat64(value, true) : size === 8 ? Number(view.getBigInt64(value, true)) : view.getInt32(value, true));
    this.attributes.set(`${path} ${this.text(at + 9, n)}`, view.getUint8(type) === 0x13 ? this.text(value, size) : number());
  }

  has(path) { return this.arrays.has(path) || this.members.has(path); }

  of(path, name) { return this.attributes.get(`${path} ${name}`); }

  /// Numbers of an array, as the file has them.
  numbers(path) {
    const array = this.arrays.get(path);
    if (!array) return null;
    const kinds = array.type === 0x11 ? Float64Array : array.size === 1 ? Uint8Array : array.size === 4 ? Int32Array : BigInt64Array;
    return new kinds(this.bytes.slice(array.at, array.at + array.length).buffer);
  }

  /// Columns of numbers of a table: {name: Float64Array}.
  table(name) {
    const paths = (this.members.get(`/table/${name}`) ?? []).map((member) => `/table/${name}/${member}`);
    return Object.fromEntries(paths.filter((path) => this.arrays.get(path)?.type === 0x11).map((path) => [this.of(path, 'name'), this.numbers(path)]));
  }
}

const BALL_LEVELS = 4;
const balls = []; // unit spheres, finer and finer

/// A ball of triangles: an icosahedron, each triangle cut in four and pushed outwards `level` times.
function ball(level) {
  if (balls[level]) return balls[level];
  if (level === 0) {
    const g = (1 + Math.sqrt(5)) / 2;
    const corners = [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]];
    balls[0] = {
      position: Float32Array.from(corners.flatMap((p) => p.map((c) => c / Math.hypot(...p)))),
      index: Uint32Array.from([0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9,
        4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1]),
    };
    return balls[0];
  }
  const { position, index } = ball(level - 1);
  const points = Array.from(position);
  const middles = new Map();
  const middle = (a, b) => {
    const key = Math.min(a, b) * 65536 + Math.max(a, b);
    if (!middles.has(key)) {
      const p = [0, 1, 2].map((k) => points[3 * a + k] + points[3 * b + k]);
      middles.set(key, points.length / 3);
      points.push(...p.map((c) => c / Math.hypot(...p)));
    }
    return middles.get(key);
  };
  const triangles = [];
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = index.subarray(t, t + 3);
    const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    triangles.push(a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca);
  }
  balls[level] = { position: Float32Array.from(points), index: Uint32Array.from(triangles) };
  return balls[level];
}

/// Vertices of a surface joined on a grid of n cells a side, until it has at most `most` triangles.
function coarser(surface, most) {
  let made = surface;
  for (let n = 96; made.index.length > 3 * most && n >= 4; n = Math.floor(0.75 * n)) {
    const { position, index } = surface;
    const reach = position.reduce((a, b) => Math.max(a, Math.abs(b)), 0) || 1;
    const cells = new Map();
    const number = new Uint32Array(position.length / 3);
    const sums = [];
    for (let i = 0; i < number.length; i += 1) {
      const p = position.subarray(3 * i, 3 * i + 3);
      const key = p.reduce((k, c) => k * n + Math.min(n - 1, Math.floor((n * (c + reach)) / (2 * reach))), 0);
      if (!cells.has(key)) { cells.set(key, sums.length); sums.push([0, 0, 0, 0]); }
      number[i] = cells.get(key);
      const sum = sums[number[i]];
      p.forEach((c, k) => { sum[k] += c; });
      sum[3] += 1;
    }
    const kept = [];
    for (let t = 0; t < index.length; t += 3) {
      const [a, b, c] = [number[index[t]], number[index[t + 1]], number[index[t + 2]]];
      if (a !== b && b !== c && c !== a) kept.push(a, b, c);
    }
    made = { position: Float32Array.from(sums.flatMap(([x, y, z, m]) => [x / m, y / m, z / m])), index: Uint32Array.from(kept) };
  }
  return made;
}

/// Surface of a shape in its own frame, of about `budget` triangles.
function surfaceOf(state, path, budget) {
  const kind = state.of(path, 'kind');
  const finest = (n) => { let level = BALL_LEVELS; while (level > 0 && n * 20 * 4 ** level > budget) level -= 1; return ball(level); };
  if (kind === 'mesh') {
    return coarser({ position: Float32Array.from(state.numbers(`${path}/vert`)), index: Uint32Array.from(state.numbers(`${path}/tri`)) }, budget);
  }
  if (kind === 'clump' && state.has(`${path}/centre`)) {
    const centre = state.numbers(`${path}/centre`);
    const radius = state.numbers(`${path}/radius`);
    const one = finest(radius.length);
    const position = new Float32Array(radius.length * one.position.length);
    const index = new Uint32Array(radius.length * one.index.length);
    radius.forEach((r, s) => {
      one.position.forEach((c, i) => { position[s * one.position.length + i] = centre[3 * s + (i % 3)] + r * c; });
      one.index.forEach((v, i) => { index[s * one.index.length + i] = v + (s * one.position.length) / 3; });
    });
    return { position, index };
  }
  const axes = state.numbers(`${path}/semi_axes`);
  const one = finest(1);
  return { position: one.position.map((c, i) => c * axes[i % 3]), index: one.index };
}

// Colours and marks are those of src/render/legend.c, so that a grain looks as in the picture and the report of the same run.
const BAR = ['#5a3a82', '#574a8d', '#525994', '#4c6898', '#467599', '#418199', '#3c8e99', '#379b98', '#36a894', '#3ab48e', '#48c084', '#5fcb75', '#7ad564', '#99dd52', '#bbe33f',
  '#dde733', '#fde93b'];
const SHAPES = ['#e69f00', '#56b4e9', '#009e73', '#d55e00', '#cc79a7', '#0072b2', '#f0e442', '#737373'];
const MOST_TICKS = 12;
const WIDE = 4; // a bar whose high end is more than so many times the low one is logarithmic

/// A bar with its marks: 1, 2, 5 times powers of ten.
function barOf(title, low, high, scale, mayBeLog) {
  const bar = { title, log: mayBeLog && low > 0 && high > WIDE * low, low, high, unit: scale, ticks: [] };
  const place = (v) => (bar.log ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));
  const add = (v) => {
    const t = high > low ? place(v) : 0.5;
    if (bar.ticks.length < MOST_TICKS && t > -1e-9 && t < 1 + 1e-9) bar.ticks.push([Math.min(Math.max(t, 0), 1), String(Number(v.toPrecision(10)))]);
  };
  if (!(high > low * (1 + 1e-9))) { add(low); return bar; }
  if (bar.log) {
    const decades = Math.log10(high / low);
    const stride = Math.max(1, Math.ceil(decades / 8));
    for (let p = Math.floor(Math.log10(low)); p <= Math.ceil(Math.log10(high)); p += 1) {
      if (p % stride === 0) (decades < 4 ? [1, 2, 5] : [1]).forEach((k) => add(k * 10 ** p));
    }
    if (bar.ticks.length >= 3) return bar;
    bar.ticks = []; // less than a decade: round numbers evenly spaced in value
  }
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (rough / power > 3.5 ? 5 : rough / power > 1.5 ? 2 : 1);
  for (let k = Math.ceil(low / step - 1e-9), i = 0; i < MOST_TICKS; i += 1) add((k + i) * step);
  return bar;
}

/// The bar of the order of arrival: its ends are named, marks too close to them give way.
function orderBar(n) {
  const bar = barOf('order of arrival', 1, n, 0, false);
  const ends = n > 1 ? [[0, '1'], [1, String(n)]] : [[0.5, '1']];
  return { ...bar, ticks: [...bar.ticks.filter(([place]) => place > 0.09 && place < 0.91).slice(0, MOST_TICKS - 2), ...ends] };
}

const metre = (size) => [[1e3, 'km'], [1, 'm'], [1e-3, 'mm'], [1e-6, '\u00b5m']].find(([f]) => size >= 0.9995 * f) ?? [1e-9, 'nm'];

/// Poses, sizes and bounds of the grains.
function grainsOf(state) {
  const shapes = (state.members.get('/assembly/shape') ?? []).map((name) => `/assembly/shape/${name}`);
  const grains = {
    shapes,
    shape: state.numbers('/assembly/shape_id'),
    position: state.numbers('/assembly/position'),
    turn: state.numbers('/assembly/orientation'),
    scale: state.numbers('/assembly/scale'),
    density: state.numbers('/assembly/density'),
  };
  const diameter = shapes.map((path) => Math.cbrt((6 * state.of(path, 'volume')) / Math.PI));
  const reach = shapes.map((path) => state.of(path, 'bounding_radius'));
  grains.n = grains.shape.length;
  grains.size = Float64Array.from(grains.shape, (s, i) => grains.scale[i] * diameter[s]);
  grains.reach = Float64Array.from(grains.shape, (s, i) => grains.scale[i] * reach[s]);
  return grains;
}

/// Middle and half of the longest side of the box around all grains.
function boundsOf(grains) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < grains.n; i += 1) {
    for (let k = 0; k < 3; k += 1) {
      low[k] = Math.min(low[k], grains.position[3 * i + k] - grains.reach[i]);
      high[k] = Math.max(high[k], grains.position[3 * i + k] + grains.reach[i]);
    }
  }
  return { centre: low.map((l, k) => (l + high[k]) / 2), length: Math.max(...low.map((l, k) => (high[k] - l) / 2)) };
}

const coded = (array) => base64Of(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));

/// Pairs that touch: with forces where the run knows them.
function contactsOf(state, length) {
  const table = state.table('contacts');
  if (table.a) {
    const n = table.a.length;
    const pair = Uint32Array.from({ length: 2 * n }, (_, i) => { const g = table[i % 2 ? 'b' : 'a'][i >> 1]; return g < 0 ? 0xffffffff : g; });
    const branch = Float32Array.from({ length: 3 * n }, (_, i) => table[`branch_${'xyz'[i % 3]}_m`][Math.floor(i / 3)] / length);
    const force = Float32Array.from({ length: n }, (_, c) => Math.hypot(...['x', 'y', 'z'].map((k) => table[`force_${k}_N`][c])));
    return { pair, branch, force };
  }
  const given = state.numbers('/assembly/contact');
  if (!given || given.length === 0) return null;
  const at = state.numbers('/assembly/position');
  const pair = Uint32Array.from(given);
  const branch = new Float32Array(1.5 * pair.length);
  branch.forEach((_, i) => { const c = Math.floor(i / 3); branch[i] = (at[3 * pair[2 * c + 1] + (i % 3)] - at[3 * pair[2 * c] + (i % 3)]) / length; });
  return { pair, branch, force: null };
}

/// Bars of speed, force and whatever else is known of each grain beside its size.
function valuesOfGrains(state, grains, contacts) {
  const values = {};
  const saved = state.numbers('/pack/grain');
  if (saved) {
    const wide = saved.length / grains.n;
    const speed = Float32Array.from({ length: grains.n }, (_, i) => Math.hypot(saved[wide * i + 3], saved[wide * i + 4], saved[wide * i + 5]));
    values.speed = { bar: barOf('speed (m/s)', 0, Math.max(1e-9, speed.reduce((a, b) => Math.max(a, b), 0)), 1, false), of: coded(speed) };
  }
  if (contacts?.force) {
    const most = new Float32Array(grains.n);
    contacts.pair.forEach((g, i) => { if (g !== 0xffffffff) most[g] = Math.max(most[g], contacts.force[i >> 1]); });
    const high = most.reduce((a, b) => Math.max(a, b), 0);
    if (high === 0) values.force = { bar: barOf('greatest force of a contact (N)', 0, 1, 1, false), of: coded(most) };
    else {
      const [factor, prefix] = [[1, ''], [1e-3, 'm'], [1e-6, '\u00b5'], [1e-9, 'n']].find(([f]) => high >= 0.9995 * f) ?? [1e-9, 'n'];
      values.force = { bar: barOf(`greatest force of a contact (${prefix}N)`, 1e-3 * high / factor, high / factor, 1, true), of: coded(most.map((f) => Math.max(f, 1e-3 * high) / factor)) };
    }
  }
  return values;
}

/// What the viewer draws of a state. fixed {centre, length}: of the picture, else of the grains.
function viewData(state, fixed) {
  const grains = grainsOf(state);
  const { centre, length } = fixed ?? boundsOf(grains);
  const [factor, unit] = metre(grains.size.reduce((a, b) => Math.max(a, b), 0));
  const contacts = contactsOf(state, length);
  const sizes = Array.from(grains.size, (s) => s / factor);
  const least = sizes.reduce((a, b) => Math.min(a, b), Infinity);
  const most = sizes.reduce((a, b) => Math.max(a, b), 0);
  const budget = Math.max(20, Math.min(1280, Math.floor(120000 / grains.n)));
  const shapes = grains.shapes.map((path, s) => {
    const mine = [];
    for (let i = 0; i < grains.n; i += 1) if (grains.shape[i] === s) mine.push(i);
    if (mine.length === 0) return null;
    const { position, index } = surfaceOf(state, path, budget);
    const pose = new Float32Array(10 * mine.length);
    mine.forEach((i, m) => {
      for (let k = 0; k < 3; k += 1) pose[10 * m + k] = (grains.position[3 * i + k] - centre[k]) / length;
      for (let k = 0; k < 4; k += 1) pose[10 * m + 3 + k] = grains.turn[4 * i + k];
      pose.set([grains.scale[i], grains.size[i] / length, grains.density[i]], 10 * m + 7);
    });
    return {
      name: state.of(path, 'name'), number: s, colour: Math.min(s, SHAPES.length - 1), smooth: state.of(path, 'kind') !== 'mesh',
      position: coded(position.map((c) => c / length)), index: coded(index), grain: coded(Uint32Array.from(mine)), pose: coded(pose),
      diameter: Math.cbrt((6 * state.of(path, 'volume')) / Math.PI) / length,
    };
  }).filter(Boolean);
  const names = grains.shapes.map((path) => state.of(path, 'name'));
  const shown = names.slice(0, SHAPES.length).map((name, k) => (k === SHAPES.length - 1 && names.length > SHAPES.length ? `${names.length - k} others` : name));
  return {
    unit: 'm', length, n_grain: grains.n, n_shown: grains.n, centre, bar: BAR,
    size: barOf(`equivalent diameter (${unit})`, least, most, length / factor, true),
    order: orderBar(grains.n),
    shape: SHAPES.slice(0, names.length), shape_name: shown,
    contact: contacts ? { pair: coded(contacts.pair), branch: coded(contacts.branch), force: contacts.force && coded(contacts.force) } : undefined,
    values: valuesOfGrains(state, grains, contacts),
    shapes,
  };
}
