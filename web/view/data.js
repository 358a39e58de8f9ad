// What the page holds of an assembly, decoded.
//
// Per run a <script type="application/json" class="view-data"> with
//   {unit, length, n_grain, n_shown, bar, size, order, shape, shape_name, id, shapes: [{name, number, diameter, colour, smooth, position,
//    index, near: {n, position, index}, grain, pose}], contact, frames}
// bar: colours from low to high; size, order: {title, log, low, high, unit, ticks: [[place, text]]}, the colour bars of a picture of
// the same run (size times unit is on its scale; no `size`: grains without volume); shape: colours, shapes[].colour says which;
// id: names of the grains where they are not 0, 1, 2 ..; position: base64 of float32 [n][3] in the shape's frame; index: base64 of
// uint32 [n][3]; near: a finer surface, where that is coarse; grain: base64 of uint32 [m], the grain's place in the order of growth;
// pose: base64 of float32 [m][10]: position[3], quaternion w x y z [4], scale, size, density [kg/m3];
// contact: {pair: base64 of uint32 [c][2] (second 0xffffffff: a wall), branch: base64 of float32 [c][3] from the first grain's centroid
// to the second's or to the wall, force: base64 of float32 [c] in N, or null}. Lengths are in `length` units.
// frames: {n_file, low[3], step[3], end [s], frame: [{time [s], place, turn, grain, shape, scale}]}; place: base64 of uint16 [n][3], steps
// from low; turn: base64 of int8 [n][4], quaternion w x y z (none: balls only); grain: base64 of uint32 [n], 0xffffffff for a grain that the
// end does not have (none: 0 .. n-1); shape, scale: base64 of uint32 and float32 [n], a shape's `number` (none: as at the end).
// values: {speed, force: {bar, of: base64 of float32 [n_shown]}}, what else is known of each grain while it moves (the live page).
import { Color } from 'three';

export const POSE = 10;
export const WALL = 0xffffffff;
export const UNKNOWN = 0xffffffff; // a moment's grain that the end does not have

export function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i += 1) out[i] = raw.charCodeAt(i);
  return out.buffer;
}

export const floats = (text) => new Float32Array(bytes(text));
export const words = (text) => new Uint32Array(bytes(text));

/// Does the view show what the run left, not a moment before?
export function isEnd(view) {
  return !view.data.frames || view.moment === view.data.frames.frame.length;
}

/// When a contact came to be in the order of growth: with its later grain.
function laterGrain(pair, c) {
  return pair[2 * c + 1] === WALL ? pair[2 * c] : Math.max(pair[2 * c], pair[2 * c + 1]);
}

/// Contacts in order of growth, and each grain's number of them and greatest force.
function readContacts(data) {
  if (!data.contact) return null;
  const given = { pair: words(data.contact.pair), branch: floats(data.contact.branch), force: data.contact.force && floats(data.contact.force) };
  const n = given.pair.length / 2;
  const made = Uint32Array.from({ length: n }, (_, c) => laterGrain(given.pair, c));
  const order = Uint32Array.from({ length: n }, (_, c) => c).sort((a, b) => made[a] - made[b] || a - b);
  const pair = new Uint32Array(2 * n);
  const branch = new Float32Array(3 * n);
  order.forEach((c, i) => {
    pair.set(given.pair.subarray(2 * c, 2 * c + 2), 2 * i);
    branch.set(given.branch.subarray(3 * c, 3 * c + 3), 3 * i);
  });
  const force = given.force && Float32Array.from(order, (c) => given.force[c]);
  const later = Uint32Array.from(order, (c) => made[c]);
  const count = new Uint32Array(data.n_shown);
  const most = new Float32Array(data.n_shown);
  for (let c = 0; c < n; c += 1) {
    for (const g of [pair[2 * c], pair[2 * c + 1]]) {
      if (g === WALL) continue;
      count[g] += 1;
      if (force) most[g] = Math.max(most[g], force[c]);
    }
  }
  return { pair, branch, force, later, count, most, n };
}

/// A bar of whole numbers from 0 on.
function countBar(title, most) {
  const step = Math.max(1, Math.ceil(most / 8));
  const ticks = [];
  for (let k = 0; k <= most; k += step) ticks.push([k / Math.max(most, 1), String(k)]);
  return { title, log: false, low: 0, high: Math.max(most, 1), unit: 1, ticks };
}

export function readData(element) {
  const data = JSON.parse(element.textContent);
  data.colours = data.bar.map((c) => new Color(c));
  data.contacts = readContacts(data);
  if (data.contacts) data.coordination = countBar('contacts of a grain', data.contacts.count.reduce((a, b) => Math.max(a, b), 0));
  for (const [name, { bar, of }] of Object.entries(data.values ?? {})) Object.assign(data, { [name]: { ...bar, values: floats(of) } });
  return data;
}
