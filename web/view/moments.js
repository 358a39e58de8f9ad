// A run's moments: its grains as its frames place them, and as it ended.
import { bytes, floats, isEnd, POSE, UNKNOWN, words } from './data.js';
import { setGrains } from './grains.js';
import { dropNear } from './near.js';
import { pick } from './pick.js';
import { si } from './units.js';

/// What each grain of the end is: number among the page's shapes, scale, density.
function makeBase(data, meshes) {
  const base = { shape: new Uint16Array(data.n_shown), scale: new Float32Array(data.n_shown), density: new Float32Array(data.n_shown) };
  meshes.forEach((mesh, s) => {
    const { grain, pose } = mesh.userData.end;
    grain.forEach((g, i) => {
      base.shape[g] = s;
      base.scale[g] = pose[POSE * i + 7];
      base.density[g] = pose[POSE * i + 9];
    });
  });
  return base;
}

/// Shapes of a frame's grains by their places among the page's; null: as at the end.
function shapesOf(data, frame) {
  if (!frame.shape) return null;
  const place = new Map(data.shapes.map((shape, s) => [shape.number, s]));
  return words(frame.shape).map((number) => place.get(number));
}

/// Most grains of each shape at any moment.
export function roomOf(data) {
  const room = data.shapes.map((shape) => words(shape.grain).length);
  for (const frame of data.frames?.frame ?? []) {
    const count = room.map(() => 0);
    for (const s of shapesOf(data, frame) ?? []) count[s] += 1;
    count.forEach((n, s) => { room[s] = Math.max(room[s], n); });
  }
  return room;
}

/// Grains of frame k, by shape: [{grain, pose}].
function grainsAt(view, k) {
  const { data } = view;
  const { low, step, frame: all } = data.frames;
  const frame = all[k];
  const place = new Uint16Array(bytes(frame.place));
  const turn = frame.turn && new Int8Array(bytes(frame.turn));
  const n = place.length / 3;
  const grain = frame.grain ? words(frame.grain) : Uint32Array.from({ length: n }, (_, i) => i);
  const scales = frame.scale && floats(frame.scale);
  view.base ??= makeBase(data, view.meshes);
  const { base } = view;
  const shape = shapesOf(data, frame) ?? grain.map((g) => base.shape[g]);
  const count = data.shapes.map(() => 0);
  for (const s of shape) count[s] += 1;
  const parts = count.map((m) => ({ grain: new Uint32Array(m), pose: new Float32Array(POSE * m), n: 0 }));
  for (let i = 0; i < n; i += 1) {
    const g = grain[i];
    const part = parts[shape[i]];
    const at = POSE * part.n;
    const scale = scales ? scales[i] : base.scale[g];
    for (let j = 0; j < 3; j += 1) part.pose[at + j] = low[j] + step[j] * place[3 * i + j];
    if (turn) {
      const q = turn.subarray(4 * i, 4 * i + 4);
      const length = Math.hypot(...q) || 1;
      for (let j = 0; j < 4; j += 1) part.pose[at + 3 + j] = q[j] / length;
    } else part.pose[at + 3] = 1;
    part.pose[at + 7] = scale;
    part.pose[at + 8] = scale * data.shapes[shape[i]].diameter;
    part.pose[at + 9] = g === UNKNOWN ? 0 : base.density[g];
    part.grain[part.n] = g;
    part.n += 1;
  }
  return parts.map(inOrder);
}

/// A part's grains in order of growth, as showFirst counts them; those that the end does not have are last.
function inOrder(part) {
  const { grain, pose } = part;
  if (grain.every((g, i) => i === 0 || grain[i - 1] <= g)) return part;
  const order = Uint32Array.from(grain, (_, i) => i).sort((a, b) => grain[a] - grain[b] || a - b);
  const sorted = new Float32Array(pose.length);
  order.forEach((from, to) => sorted.set(pose.subarray(POSE * from, POSE * (from + 1)), POSE * to));
  return { grain: Uint32Array.from(order, (i) => grain[i]), pose: sorted };
}

/// Text of a moment's time.
export function timeOf(view, k) {
  const { frame, end } = view.data.frames;
  if (k < frame.length) return si(frame[k].time, 's');
  return end === undefined ? 'end' : `${si(end, 's')}, end`;
}

/// Puts the grains where frame k has them; k = number of frames: where the run left them.
export function setMoment(view, k) {
  view.moment = k;
  dropNear(view);
  const parts = isEnd(view) ? view.meshes.map((mesh) => mesh.userData.end) : grainsAt(view, k);
  view.meshes.forEach((mesh, s) => setGrains(mesh, parts[s].grain, parts[s].pose));
  if (view.picked >= 0) pick(view, parts.some((part) => part.grain.includes(view.picked)) ? view.picked : -1);
}
