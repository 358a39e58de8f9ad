// Contacts as bars from centroid to centroid; those that carry more are thicker.
import { Color, CylinderGeometry, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, Vector3 } from 'three';
import { POSE, WALL } from './data.js';
import { colourAt, placeOf } from './grains.js';
import { logTicks } from './units.js';

const UP = new Vector3(0, 1, 0);
const DECADES = 3; // of force that colours tell apart, below the greatest

function sizeByGrain(view) {
  const size = new Float32Array(view.data.n_shown);
  const centre = new Float32Array(3 * view.data.n_shown);
  for (const mesh of view.meshes) {
    const { grain, pose } = mesh.userData;
    for (let i = 0; i < grain.length; i += 1) {
      size[grain[i]] = pose[POSE * i + 8];
      centre.set(pose.subarray(POSE * i, POSE * i + 3), 3 * grain[i]);
    }
  }
  return { size, centre };
}

/// Colour bar of forces, or null when none are known.
export function forceBar(contacts) {
  if (!contacts.force) return null;
  const high = contacts.force.reduce((a, b) => Math.max(a, b), 0);
  if (!(high > 0)) return null;
  const low = high / 10 ** DECADES;
  return { title: 'force of a contact', log: true, low, high, unit: 1, ticks: logTicks(low, high, 'N') };
}

export function makeChains(view) {
  const { contacts, colours } = view.data;
  const { size, centre } = sizeByGrain(view);
  const bar = forceBar(contacts);
  const mesh = new InstancedMesh(new CylinderGeometry(1, 1, 1, 6, 1), new MeshStandardMaterial({ roughness: 0.6 }), contacts.n);
  const matrix = new Matrix4();
  const from = new Vector3();
  const along = new Vector3();
  const turn = new Quaternion();
  const scale = new Vector3();
  const colour = new Color('#56646f');
  const mean = size.reduce((a, b) => a + b, 0) / Math.max(size.length, 1);
  for (let c = 0; c < contacts.n; c += 1) {
    const [a, b] = [contacts.pair[2 * c], contacts.pair[2 * c + 1]];
    const thin = 0.06 * (b === WALL ? size[a] : Math.min(size[a], size[b])) || 0.06 * mean;
    along.fromArray(contacts.branch, 3 * c);
    from.fromArray(centre, 3 * a).addScaledVector(along, 0.5);
    const long = along.length();
    const share = bar ? Math.sqrt(contacts.force[c] / bar.high) : 0.3;
    scale.set(thin + 0.22 * mean * share, long, thin + 0.22 * mean * share);
    turn.setFromUnitVectors(UP, along.divideScalar(long || 1));
    mesh.setMatrixAt(c, matrix.compose(from, turn, scale));
    if (bar) colourAt(colours, placeOf(bar, Math.max(contacts.force[c], bar.low)), colour);
    mesh.setColorAt(c, colour);
  }
  mesh.frustumCulled = false;
  mesh.material.clippingPlanes = view.meshes[0].material.clippingPlanes;
  mesh.userData = { grain: contacts.later, bar };
  return mesh;
}
