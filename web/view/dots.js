// The coarse level of detail: a lit dot a grain, of the grain's size and colour. It is drawn where grains are a few pixels wide, and while
// the camera moves where the surfaces take longer than a frame may.
import { BufferAttribute, BufferGeometry, Points, ShaderMaterial, Vector3, Vector4 } from 'three';
import { POSE } from './data.js';
import { setNear } from './near.js';

const LEAST = 4; // px: mean grains below this are drawn as dots at rest too
const FRAME = 33; // ms that a frame may take
const REST = 200; // ms after which a camera is at rest
const MANY = 20000; // triangles below which nothing is measured
const KEY = new Vector3(-1.2, 1.6, 1.4); // the lights of view.js, at the camera
const FILL = new Vector3(1.6, -0.4, 0.6);

// Lambert's law under the lights of view.js: their strengths over pi.
const LIT = `
  uniform vec3 key, fill, sky;
  varying vec3 tone;
  void main() {
    vec2 p = 2.0 * gl_PointCoord - 1.0;
    float r = dot(p, p);
    if (r > 1.0) discard;
    vec3 n = vec3(p.x, -p.y, sqrt(1.0 - r));
    vec3 light = 0.668 * max(dot(n, key), 0.0) + 0.175 * vec3(0.61, 0.76, 1.0) * max(dot(n, fill), 0.0)
      + 0.302 * mix(vec3(0.26, 0.23, 0.19), vec3(1.0), 0.5 + 0.5 * dot(n, sky)) + 0.048;
    float gleam = 0.03 * pow(max(dot(n, normalize(key + vec3(0.0, 0.0, 1.0))), 0.0), 6.0);
    gl_FragColor = vec4(tone * light + gleam, 1.0);
    #include <colorspace_fragment>
  }`;
const PLACED = `
  uniform float pixels;
  uniform vec4 cut;
  attribute float diameter;
  attribute vec3 tint;
  varying vec3 tone;
  void main() {
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    tone = tint;
    gl_Position = projectionMatrix * seen;
    gl_PointSize = max(diameter * pixels / -seen.z, 1.0);
    if (dot(cut.xyz, position) + cut.w < 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

function dotsOf(mesh, material) {
  const { grain, pose } = mesh.userData;
  const n = mesh.instanceColor.count;
  const place = new Float32Array(3 * n);
  const size = new Float32Array(n);
  for (let i = 0; i < grain.length; i += 1) {
    place.set(pose.subarray(POSE * i, POSE * i + 3), 3 * i);
    size[i] = pose[POSE * i + 8] || 2 * pose[POSE * i + 7] * mesh.geometry.boundingSphere.radius;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(place, 3));
  geometry.setAttribute('diameter', new BufferAttribute(size, 1));
  geometry.setAttribute('tint', new BufferAttribute(mesh.instanceColor.array, 3));
  const dots = new Points(geometry, material);
  dots.frustumCulled = false;
  return dots;
}

function makeMaterial() {
  return new ShaderMaterial({
    vertexShader: PLACED,
    fragmentShader: LIT,
    uniforms: { pixels: { value: 1 }, cut: { value: new Vector4() }, key: { value: new Vector3() }, fill: { value: new Vector3() }, sky: { value: new Vector3() } },
  });
}

/// The dots' grains have moved or changed their colours: they are made anew when they are drawn next.
export function dropDots(view) {
  for (const dots of view.dots ?? []) {
    view.scene.remove(dots);
    dots.geometry.dispose();
  }
  view.dots = null;
}

function setUniforms(view, height) {
  const { camera, cut } = view;
  const { uniforms } = view.dotMaterial;
  const eye = camera.position.clone().applyQuaternion(camera.quaternion.clone().invert());
  uniforms.pixels.value = height / (2 * Math.tan((camera.fov * Math.PI) / 360));
  uniforms.key.value.copy(KEY).add(eye).normalize();
  uniforms.fill.value.copy(FILL).add(eye).normalize();
  uniforms.sky.value.set(0, 0, 1).transformDirection(camera.matrixWorldInverse);
  if (cut.axis === 'none') uniforms.cut.value.set(0, 0, 0, 0);
  else uniforms.cut.value.set(cut.plane.normal.x, cut.plane.normal.y, cut.plane.normal.z, cut.plane.constant);
}

/// Pixels of a mean grain at the point about which the view turns.
function grainPixels(view) {
  const distance = view.camera.position.distanceTo(view.controls.target);
  return (view.mean * view.stage.clientHeight * view.renderer.getPixelRatio()) / (2 * distance * Math.tan((view.camera.fov * Math.PI) / 360));
}

/// Takes dots or surfaces for the next drawing; `isWhole`: surfaces whatever they cost.
export function setLevel(view, isWhole) {
  const isChains = view.chains?.visible ?? false;
  const far = view.cut.axis === 'none' && grainPixels(view) < LEAST && view.data.n_shown > 1000;
  const isCoarse = !isWhole && !isChains && (far || view.isMoving);
  if (isCoarse && !view.dots) {
    view.dotMaterial ??= makeMaterial();
    view.dots = view.meshes.map((mesh) => dotsOf(mesh, view.dotMaterial));
    view.scene.add(...view.dots);
  }
  view.level = isCoarse ? 'dots' : 'surfaces';
  for (const near of view.near ?? []) if (near) near.visible = !isCoarse && !isChains;
  view.meshes.forEach((mesh, k) => {
    mesh.visible = !isCoarse && !isChains;
    if (view.dots) {
      view.dots[k].visible = isCoarse;
      view.dots[k].geometry.setDrawRange(0, mesh.count);
    }
  });
  if (isCoarse) setUniforms(view, view.stage.clientHeight * view.renderer.getPixelRatio());
}

/// Milliseconds of a whole drawing; waits for the last pixel.
export function timeDrawing(view) {
  const gl = view.renderer.getContext();
  const pixel = new Uint8Array(4);
  const began = performance.now();
  view.render();
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return performance.now() - began;
}

/// Many surfaces: dots are the first picture, and whether surfaces are too slow to turn is asked after it.
export function measureSpeed(view) {
  const triangles = view.meshes.reduce((sum, mesh) => sum + mesh.count * (mesh.geometry.index ?? mesh.geometry.attributes.position).count / 3, 0);
  if (triangles < MANY) return;
  view.isMoving = true;
  requestAnimationFrame(() => setTimeout(() => {
    if (!view.renderer) return;
    setLevel(view, true);
    const first = timeDrawing(view); // with the making of the shaders
    view.isMoving = false;
    view.isSlow = first > FRAME && timeDrawing(view) > FRAME;
    view.draw();
  }, REST));
}

/// The camera moves: dots until it rests, where surfaces are slow.
export function touch(view) {
  view.isMoving ||= view.isSlow ?? false;
}

/// Some time after the last drawing: surfaces again, and fine ones nearby.
export function settle(view) {
  clearTimeout(view.resting);
  view.resting = setTimeout(() => {
    if (!view.renderer) return;
    const was = view.isMoving;
    if (was && view.isSlow === undefined) return; // not asked yet
    view.isMoving = false;
    if (setNear(view) || was) view.drawOnce();
  }, REST);
}
