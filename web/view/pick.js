// The grain under the pointer, and all of its numbers.
import { Raycaster, Vector2 } from 'three';
import { isCutAway } from './cut.js';
import { isEnd, UNKNOWN } from './data.js';
import { findGrain } from './grains.js';
import { tag } from './legend.js';
import { length, lengths, si, volume } from './units.js';

/// Number of the grain at a place of the stage (pixels), or -1; also for one that the end of the run does not have, of which nothing more is known.
export function grainAt(view, x, y) {
  const { clientWidth: w, clientHeight: h } = view.stage;
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2((2 * x) / w - 1, 1 - (2 * y) / h), view.camera);
  const hits = ray.intersectObjects([...view.meshes, ...view.near ?? []].filter((m) => m?.count > 0), false);
  const first = hits.find((hit) => !isCutAway(view, hit.point));
  const grain = first ? first.object.userData.grain[first.instanceId] : UNKNOWN;
  return grain === UNKNOWN ? -1 : grain;
}

function degrees(radian) {
  return `${((radian * 180) / Math.PI).toFixed(1)}\u00b0`;
}

/// Rows of the grain's table.
function rowsOf(view, g) {
  const { data } = view;
  const { shape, pose } = findGrain(view.meshes, g);
  const [x, y, z, qw, qx, qy, qz, scale, size, density] = pose;
  const solid = (Math.PI / 6) * size ** 3;
  const rows = [
    ['grain', String(data.id ? data.id[g] : g)],
    ['order', `${(g + 1).toLocaleString('en')} of ${data.n_grain.toLocaleString('en')}`],
    ['shape', shape.name],
    ['scale of the shape', String(Number(scale.toPrecision(5)))],
  ];
  if (size > 0) rows.push(['diameter, sphere of its volume', length(data, size)], ['volume', volume(data, solid)]);
  if (density > 0 && data.unit === 'm') {
    rows.push(['density', `${Number(density.toPrecision(5))} kg/m\u00b3`]);
    if (size > 0) rows.push(['mass', si(density * solid * data.length ** 3 * 1e3, 'g')]);
  }
  rows.push(['centroid x, y, z', lengths(data, [x, y, z].map((v, k) => v + data.centre[k] / data.length))]);
  rows.push(['rotated by', `${degrees(2 * Math.acos(Math.min(1, Math.abs(qw))))} (quaternion ${[qw, qx, qy, qz].map((q) => q.toFixed(4)).join(', ')})`]);
  if (data.contacts) {
    const when = isEnd(view) ? '' : ', at the end';
    rows.push([`contacts${when}`, String(data.contacts.count[g])]);
    if (data.contacts.force) rows.push([`greatest force${when}`, si(data.contacts.most[g], 'N')]);
  }
  return rows;
}

/// Marks grain g (-1: none) and shows its numbers; the view is to be painted and drawn after.
export function pick(view, g) {
  view.picked = g;
  view.facts.hidden = g < 0;
  if (g < 0) return;
  const table = tag('table');
  for (const [name, value] of rowsOf(view, g)) {
    const row = tag('tr');
    const head = tag('th', '', name);
    head.scope = 'row';
    row.append(head, tag('td', '', value));
    table.append(row);
  }
  view.facts.replaceChildren(table);
}
