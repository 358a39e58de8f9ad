// Grains: one instanced mesh a shape, coloured, grown to a number, cut through.
import {
  BufferAttribute, BufferGeometry, Color, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, ShaderChunk, Vector3,
} from 'three';
import { toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { floats, POSE, UNKNOWN, words } from './data.js';

const CREASE = 0.6; // rad: sharper edges stay edges
const TINT = new Color('#c9b79c'); // grains of one size, as in pictures
const PICKED = new Color('#d55e00');
export const NOT_KNOWN = '#8b949d'; // of a moment's grains that the end does not have, where colours stand for what only the end tells

export function geometryOf(shape) {
  const plain = new BufferGeometry();
  plain.setAttribute('position', new BufferAttribute(floats(shape.position), 3));
  plain.setIndex(new BufferAttribute(words(shape.index), 1));
  if (!shape.smooth) return toCreasedNormals(plain, CREASE);
  plain.computeVertexNormals();
  return plain;
}

/// A chunk of three's with its place of clipping taken inside the triangle: at a pixel that a triangle on edge half covers, the place
/// of the pixel's middle may lie far beyond the plane.
function inside(shader, name) {
  return shader.replace(`#include <${name}>`, ShaderChunk[name].replace('varying vec3', 'centroid varying vec3'));
}

/// What is seen of a cut grain from inside is the back of its surface; where a ray meets that first, the plane has cut a solid there.
/// Lit as the plane it is, it is the cut's face, exact for grains that do not overlap.
function materialOf(cap) {
  const material = new MeshStandardMaterial({ roughness: 0.72, metalness: 0.02 });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.capNormal = cap;
    shader.vertexShader = inside(shader.vertexShader, 'clipping_planes_pars_vertex');
    const fragment = inside(shader.fragmentShader, 'clipping_planes_pars_fragment');
    shader.fragmentShader = `uniform vec3 capNormal;\n${fragment}`.replace('#include <normal_fragment_maps>',
      '#include <normal_fragment_maps>\nif (!gl_FrontFacing) normal = capNormal;');
  };
  return material;
}

/// Gives a mesh its grains: their numbers, and poses [n][POSE].
export function setGrains(mesh, grain, pose) {
  const matrix = new Matrix4();
  const at = new Vector3();
  const turn = new Quaternion();
  const scale = new Vector3();
  for (let i = 0; i < grain.length; i += 1) {
    const p = POSE * i;
    at.set(pose[p], pose[p + 1], pose[p + 2]);
    turn.set(pose[p + 4], pose[p + 5], pose[p + 6], pose[p + 3]);
    scale.setScalar(pose[p + 7]);
    matrix.compose(at, turn, scale).toArray(mesh.instanceMatrix.array, 16 * i);
  }
  mesh.instanceMatrix.needsUpdate = true;
  mesh.boundingSphere = null;
  mesh.count = grain.length;
  Object.assign(mesh.userData, { grain, pose });
}

function meshOf(shape, room, cap) {
  const mesh = new InstancedMesh(geometryOf(shape), materialOf(cap), room);
  const end = { grain: words(shape.grain), pose: floats(shape.pose) };
  mesh.frustumCulled = false;
  mesh.geometry.computeBoundingSphere();
  mesh.userData = { shape, end };
  setGrains(mesh, end.grain, end.pose);
  return mesh;
}

/// Meshes of all shapes, each with room for so many grains; `cap` {value: Vector3} is the cut's normal as the camera sees it.
export function makeGrains(data, room, cap) {
  return data.shapes.map((shape, s) => meshOf(shape, room[s], cap));
}

/// Mean diameter of the grains.
export function meanOf(meshes) {
  let sum = 0;
  let n = 0;
  for (const { userData: { grain, pose } } of meshes) {
    for (let i = 0; i < grain.length; i += 1) sum += pose[POSE * i + 8];
    n += grain.length;
  }
  return sum / Math.max(n, 1);
}

/// Middle and radius of a ball that holds all grains where they are now.
export function extentOf(meshes) {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = low.clone().negate();
  const at = new Vector3();
  for (const { geometry, userData: { grain, pose } } of meshes) {
    const own = geometry.boundingSphere.radius + geometry.boundingSphere.center.length();
    for (let i = 0; i < grain.length; i += 1) {
      at.fromArray(pose, POSE * i);
      low.min(at.subScalar(own * pose[POSE * i + 7]));
      high.max(at.addScalar(2 * own * pose[POSE * i + 7]));
    }
  }
  if (!(high.x >= low.x)) return { middle: new Vector3(), radius: 1 };
  return { middle: low.clone().add(high).multiplyScalar(0.5), radius: 0.5 * low.distanceTo(high) };
}

/// Radius about the origin that holds all grains.
export function radiusOf(meshes) {
  let r = 0;
  for (const mesh of meshes) {
    const own = mesh.geometry.boundingSphere.radius + mesh.geometry.boundingSphere.center.length();
    const { pose, grain } = mesh.userData;
    for (let i = 0; i < grain.length; i += 1) {
      const p = POSE * i;
      r = Math.max(r, Math.hypot(pose[p], pose[p + 1], pose[p + 2]) + own * pose[p + 7]);
    }
  }
  return r || 1;
}

export function isWide(bar) {
  return bar.high > 1.01 * bar.low;
}

/// Place of a value on a colour bar.
export function placeOf(bar, value) {
  return bar.log ? Math.log(value / bar.low) / Math.log(bar.high / bar.low) : (value - bar.low) / (bar.high - bar.low);
}

export function colourAt(colours, t, out) {
  const x = Math.min(Math.max(t, 0), 1) * (colours.length - 1);
  const i = Math.min(Math.floor(x), colours.length - 2);
  return out.copy(colours[i]).lerp(colours[i + 1], x - i);
}

/// Grains that are drawn without a value on the bar: those that the end does not have, unless colours stand for size or shape.
export function lacksValues(view) {
  return view.by !== 'shape' && view.by !== 'size' && view.meshes.some(({ userData: { grain } }) => grain[grain.length - 1] === UNKNOWN);
}

/// What a colour stands for: a grain's value on the bar `by`.
function valueOf(data, by, mesh, i) {
  const g = mesh.userData.grain[i];
  if (by === 'order') return g + 1;
  if (data[by].values) return data[by].values[g];
  if (by === 'coordination') return data.contacts.count[g];
  return mesh.userData.pose[POSE * i + 8] * data.size.unit;
}

export function paintGrains(view) {
  const { meshes, data, by } = view;
  const colour = new Color();
  const single = by !== 'shape' && !isWide(data[by]);
  const isBare = lacksValues(view);
  for (const mesh of meshes) {
    const { grain, shape } = mesh.userData;
    for (let i = 0; i < grain.length; i += 1) {
      if (grain[i] === view.picked) colour.copy(PICKED);
      else if (isBare && grain[i] === UNKNOWN) colour.set(NOT_KNOWN);
      else if (by === 'shape') colour.set(data.shape[shape.colour]);
      else if (single) colour.copy(TINT);
      else colourAt(data.colours, placeOf(data[by], valueOf(data, by, mesh, i)), colour);
      mesh.setColorAt(i, colour);
    }
    mesh.instanceColor.needsUpdate = true;
  }
}

/// Shows the grains placed before `n`; Infinity: all, those too that the end does not have.
export function showFirst(meshes, n) {
  for (const mesh of meshes) {
    const { grain } = mesh.userData;
    let low = 0;
    let high = grain.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (grain[middle] < n) low = middle + 1;
      else high = middle;
    }
    mesh.count = low;
  }
}

/// A grain's numbers.
export function findGrain(meshes, g) {
  for (const mesh of meshes) {
    const i = mesh.userData.grain.indexOf(g);
    if (i >= 0) return { shape: mesh.userData.shape, pose: mesh.userData.pose.subarray(POSE * i, POSE * (i + 1)) };
  }
  return null;
}
