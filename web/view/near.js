// The fine level of detail: the grains nearest to the camera with finer surfaces, where those of all grains are coarse.
import { Color, Frustum, InstancedMesh, Matrix4, Sphere } from 'three';
import { POSE } from './data.js';
import { geometryOf } from './grains.js';

const LEAST = 36; // px: grains below this are not looked at closely
const MOST = 500; // grains of the fine level

function makeNear(view) {
  return view.meshes.map((mesh) => {
    if (!mesh.userData.shape.near) return null;
    const near = new InstancedMesh(geometryOf({ ...mesh.userData.shape, ...mesh.userData.shape.near }), mesh.material, MOST);
    near.frustumCulled = false;
    near.count = 0;
    near.userData = { grain: [], pose: mesh.userData.pose, shape: mesh.userData.shape };
    view.scene.add(near);
    return near;
  });
}

/// Grains that are seen large, the nearest first: [[distance, mesh, instance]].
function closeGrains(view) {
  const { camera } = view;
  const seen = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
  const perLength = view.stage.clientHeight / (2 * Math.tan((camera.fov * Math.PI) / 360));
  const ball = new Sphere();
  const found = [];
  view.meshes.forEach((mesh, k) => {
    if (!view.near[k]) return;
    const { pose } = mesh.userData;
    for (let i = 0; i < mesh.count; i += 1) {
      const p = POSE * i;
      const distance = Math.hypot(pose[p] - camera.position.x, pose[p + 1] - camera.position.y, pose[p + 2] - camera.position.z);
      if (pose[p + 8] * perLength < LEAST * distance) continue;
      ball.center.set(pose[p], pose[p + 1], pose[p + 2]);
      ball.radius = pose[p + 8];
      if (seen.intersectsSphere(ball)) found.push([distance, k, i]);
    }
  });
  return found.sort((a, b) => a[0] - b[0]).slice(0, MOST);
}

/// Gives all grains back to the coarse surfaces.
export function dropNear(view) {
  for (const { mesh, i, matrix } of view.fine ?? []) matrix.toArray(mesh.instanceMatrix.array, 16 * i);
  for (const { mesh } of view.fine ?? []) mesh.instanceMatrix.needsUpdate = true;
  view.fine = [];
  for (const near of view.near ?? []) {
    if (near) Object.assign(near, { count: 0, boundingSphere: null });
  }
}

/// Chooses the fine grains anew, for a camera that rests; false where there are none to choose from.
export function setNear(view) {
  if (!view.data.shapes.some((shape) => shape.near)) return false;
  view.near ??= makeNear(view);
  dropNear(view);
  const none = new Matrix4().makeScale(0, 0, 0);
  const colour = new Color();
  for (const [, k, i] of closeGrains(view)) {
    const mesh = view.meshes[k];
    const near = view.near[k];
    const matrix = new Matrix4();
    mesh.getMatrixAt(i, matrix);
    view.fine.push({ mesh, i, matrix });
    near.setMatrixAt(near.count, matrix);
    near.userData.grain[near.count] = mesh.userData.grain[i];
    mesh.getColorAt(i, colour);
    near.setColorAt(near.count, colour);
    near.count += 1;
    mesh.setMatrixAt(i, none);
    mesh.instanceMatrix.needsUpdate = true;
  }
  for (const near of view.near) {
    if (near?.count) {
      near.instanceMatrix.needsUpdate = true;
      near.instanceColor.needsUpdate = true;
    }
  }
  return true;
}

export function freeNear(view) {
  for (const near of view.near ?? []) {
    near?.geometry.dispose();
    near?.dispose();
  }
}
