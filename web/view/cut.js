// A plane that takes away what lies before it.
import { DoubleSide, FrontSide, Plane, Vector3 } from 'three';

const AXIS = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };

export function makeCut() {
  return { axis: 'none', place: 0.5, normal: new Vector3(), plane: new Plane(), cap: { value: new Vector3(0, 0, 1) } };
}

/// Cuts across an axis, or across the line of sight, and takes the half nearer to the viewer.
export function setCut(view, axis) {
  const { cut, camera, controls } = view;
  const sight = new Vector3().subVectors(camera.position, controls.target).normalize();
  cut.axis = axis;
  if (axis === 'view') cut.normal.copy(sight);
  else if (axis !== 'none') cut.normal.copy(AXIS[axis]).multiplyScalar(AXIS[axis].dot(sight) < 0 ? -1 : 1);
  moveCut(view, cut.place);
  const planes = axis === 'none' ? null : [cut.plane];
  for (const mesh of view.meshes) {
    const { material } = mesh;
    const isOn = planes !== null;
    if (isOn !== (material.side === DoubleSide)) material.needsUpdate = true;
    material.side = isOn ? DoubleSide : FrontSide;
    material.clippingPlanes = planes;
  }
  if (view.chains) view.chains.material.clippingPlanes = planes;
  view.renderer.localClippingEnabled = planes !== null;
}

/// place: 0 at the far end of the assembly, 1 at the viewer's.
export function moveCut(view, place) {
  const { cut, radius } = view;
  cut.place = place;
  cut.plane.normal.copy(cut.normal).negate();
  cut.plane.constant = (2 * place - 1) * radius * 1.001;
}

/// Called before each drawing.
export function turnCap(view) {
  if (view.cut.axis !== 'none') view.cut.cap.value.copy(view.cut.normal).transformDirection(view.camera.matrixWorldInverse);
}

export function isCutAway(view, point) {
  return view.cut.axis !== 'none' && view.cut.plane.distanceToPoint(point) < 0;
}
