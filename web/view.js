// The report's 3-D view: one instanced mesh per shape, coloured by size, order or shape, with a growth slider.
//
// The page holds, per run, a <script type="application/json" class="view-data"> with
//   {unit, length, n_grain, n_shown, shapes: [{name, position, index, grain, pose}]}
// position: base64 of float32 [n][3] in the shape's frame; index: base64 of uint32 [n][3];
// grain: base64 of uint32 [m], the grain's place in the order of growth;
// pose: base64 of float32 [m][9]: position[3], quaternion w x y z [4], scale, size; lengths in `length` metres.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, HemisphereLight, InstancedMesh, Matrix4,
  MeshStandardMaterial, PerspectiveCamera, Quaternion, Scene, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

const CREASE = 0.6; // rad: sharper edges stay edges
const MAX_VIEWS = 6; // browsers allow about 16 WebGL contexts
const CATEGORY = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#f0e442', '#8c8c8c'];
const SEQUENCE = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b',
  '#fde725'].map((c) => new Color(c));
const BACKGROUND = { light: '#f4f6f8', dark: '#12161b' };

function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i += 1) out[i] = raw.charCodeAt(i);
  return out.buffer;
}

function sequence(t, out) {
  const x = Math.min(Math.max(t, 0), 1) * (SEQUENCE.length - 1);
  const i = Math.min(Math.floor(x), SEQUENCE.length - 2);
  return out.copy(SEQUENCE[i]).lerp(SEQUENCE[i + 1], x - i);
}

function geometryOf(shape) {
  const plain = new BufferGeometry();
  plain.setAttribute('position', new BufferAttribute(new Float32Array(bytes(shape.position)), 3));
  plain.setIndex(new BufferAttribute(new Uint32Array(bytes(shape.index)), 1));
  if (!shape.smooth) return toCreasedNormals(plain, CREASE);
  plain.computeVertexNormals();
  return plain;
}

/// Grains of one shape, in order of growth, so that showing the first k is a matter of .count.
function meshOf(shape) {
  const pose = new Float32Array(bytes(shape.pose));
  const grain = new Uint32Array(bytes(shape.grain));
  const material = new MeshStandardMaterial({ roughness: 0.72, metalness: 0.02 });
  const mesh = new InstancedMesh(geometryOf(shape), material, grain.length);
  const matrix = new Matrix4();
  const at = new Vector3();
  const turn = new Quaternion();
  const scale = new Vector3();
  for (let i = 0; i < grain.length; i += 1) {
    const p = pose.subarray(9 * i, 9 * i + 9);
    at.set(p[0], p[1], p[2]);
    turn.set(p[4], p[5], p[6], p[3]);
    scale.setScalar(p[7]);
    mesh.setMatrixAt(i, matrix.compose(at, turn, scale));
  }
  mesh.frustumCulled = false;
  mesh.userData = { grain, size: Float32Array.from(grain, (_, i) => pose[9 * i + 8]) };
  return mesh;
}

function lights(scene, camera) {
  const key = new DirectionalLight('#ffffff', 2.1);
  const fill = new DirectionalLight('#cfe2ff', 0.55);
  key.position.set(-1.2, 1.6, 1.4);
  fill.position.set(1.6, -0.4, 0.6);
  camera.add(key, fill);
  scene.add(camera, new HemisphereLight('#ffffff', '#8c8478', 0.95), new AmbientLight('#ffffff', 0.15));
}

function radiusOf(meshes) {
  let r = 0;
  const matrix = new Matrix4();
  const at = new Vector3();
  for (const mesh of meshes) {
    mesh.geometry.computeBoundingSphere();
    const own = mesh.geometry.boundingSphere.radius + mesh.geometry.boundingSphere.center.length();
    for (let i = 0; i < mesh.userData.grain.length; i += 1) {
      mesh.getMatrixAt(i, matrix);
      at.setFromMatrixPosition(matrix);
      r = Math.max(r, at.length() + own * matrix.getMaxScaleOnAxis());
    }
  }
  return r || 1;
}

function sizeRange(meshes) {
  let low = Infinity;
  let high = 0;
  for (const mesh of meshes) {
    for (const s of mesh.userData.size) {
      low = Math.min(low, s);
      high = Math.max(high, s);
    }
  }
  return [low, high];
}

function lengthText(metres, unit) {
  if (unit !== 'm') return `${Number(metres.toPrecision(3))}`;
  const [factor, name] = metres < 1e-6 ? [1e9, 'nm'] : metres < 1e-3 ? [1e6, 'µm'] : metres < 1 ? [1e3, 'mm'] : [1, 'm'];
  return `${Number((metres * factor).toPrecision(3))} ${name}`;
}

function paint(view) {
  const { meshes, data, range } = view;
  const colour = new Color();
  const wide = range[1] > 1.01 * range[0];
  const log = range[1] > 8 * range[0];
  const part = (s) => (log ? Math.log(s / range[0]) / Math.log(range[1] / range[0])
    : (s - range[0]) / (range[1] - range[0]));
  meshes.forEach((mesh, s) => {
    mesh.userData.grain.forEach((g, i) => {
      if (view.by === 'shape') colour.set(CATEGORY[s % CATEGORY.length]);
      else if (view.by === 'order') sequence(g / Math.max(data.n_grain - 1, 1), colour);
      else sequence(wide ? part(mesh.userData.size[i]) : 0.55, colour);
      mesh.setColorAt(i, colour);
    });
    mesh.instanceColor.needsUpdate = true;
  });
  view.legend.replaceChildren(...legendOf(view, log));
}

function tag(name, className, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

function legendOf(view, log) {
  if (view.by === 'shape') {
    return view.data.shapes.slice(0, 16).map((shape, s) => {
      const row = tag('span', 'view-key', shape.name);
      const dot = tag('i', 'view-dot');
      dot.style.background = CATEGORY[s % CATEGORY.length];
      row.prepend(dot);
      return row;
    });
  }
  const metres = view.data.length;
  const ends = view.by === 'order' ? ['first', 'last']
    : view.range.map((s) => lengthText(s * metres, view.data.unit));
  const bar = tag('i', 'view-bar');
  bar.style.background = `linear-gradient(90deg, ${SEQUENCE.map((c) => `#${c.getHexString()}`).join(',')})`;
  const what = view.by === 'order' ? 'order of placement' : `grain size${log ? ', log scale' : ''}`;
  return [tag('span', '', what), tag('span', '', ends[0]), bar, tag('span', '', ends[1])];
}

/// Shows the grains placed before `n`.
function grow(view, n) {
  for (const mesh of view.meshes) {
    let count = 0;
    while (count < mesh.userData.grain.length && mesh.userData.grain[count] < n) count += 1;
    mesh.count = count;
    mesh.visible = count > 0;
  }
  view.note.textContent = `${n.toLocaleString('en')} of ${view.data.n_grain.toLocaleString('en')} grains`;
}

function frame(view) {
  const distance = (1.04 * view.radius) / Math.sin((view.camera.fov * Math.PI) / 360 * Math.min(1, view.camera.aspect));
  view.camera.position.set(0.62, 0.42, 0.66).setLength(distance);
  view.camera.near = distance / 200;
  view.camera.far = distance * 20;
  view.camera.updateProjectionMatrix();
  view.controls.target.set(0, 0, 0);
  view.controls.update();
}

function draw(view) {
  if (!view.waiting) {
    view.waiting = true;
    requestAnimationFrame(() => {
      view.waiting = false;
      if (view.renderer) view.renderer.render(view.scene, view.camera);
    });
  }
}

function fit(view) {
  const { clientWidth: w, clientHeight: h } = view.stage;
  view.renderer.setSize(w, h, false);
  view.camera.aspect = w / Math.max(h, 1);
  view.camera.updateProjectionMatrix();
  draw(view);
}

function button(text, title, action) {
  const made = tag('button', '', text);
  made.type = 'button';
  made.title = title;
  made.addEventListener('click', action);
  return made;
}

function colourChoice(view) {
  const made = tag('select');
  made.title = 'Colour';
  for (const [value, text] of [['size', 'Colour by size'], ['order', 'Colour by order'], ['shape', 'Colour by shape']]) {
    const option = tag('option', '', text);
    option.value = value;
    made.append(option);
  }
  made.addEventListener('change', () => {
    view.by = made.value;
    paint(view);
    draw(view);
  });
  return made;
}

function slider(view) {
  const made = tag('input');
  made.type = 'range';
  made.min = 1;
  made.max = view.data.n_shown;
  made.value = view.data.n_shown;
  made.title = 'Growth: grains in order of placement';
  made.setAttribute('aria-label', made.title);
  made.addEventListener('input', () => {
    grow(view, Number(made.value));
    draw(view);
  });
  return made;
}

/// Runs the slider from the first grain to the last in about six seconds.
function play(view, range) {
  const last = Number(range.max);
  const start = performance.now();
  view.playing = !view.playing;
  const step = (now) => {
    const t = Math.min((now - start) / 6000, 1);
    if (!view.playing || !view.renderer) return;
    range.value = Math.max(1, Math.round(t * last));
    grow(view, Number(range.value));
    draw(view);
    if (t < 1) requestAnimationFrame(step);
    else view.playing = false;
  };
  requestAnimationFrame(step);
}

function controlsOf(view) {
  const bar = tag('div', 'view-controls');
  const range = slider(view);
  bar.append(colourChoice(view), button('▶ Grow', 'Play the growth', () => play(view, range)), range, view.note,
    button('Reset view', 'Frame everything', () => { frame(view); draw(view); }),
    button('Light / dark', 'Change the background', () => {
      view.dark = !view.dark;
      view.stage.classList.toggle('dark', view.dark);
      view.scene.background = new Color(view.dark ? BACKGROUND.dark : BACKGROUND.light);
      draw(view);
    }));
  return bar;
}

const open = [];

function close(view) {
  view.observer.disconnect();
  view.controls.dispose();
  view.meshes.forEach((mesh) => { mesh.geometry.dispose(); mesh.material.dispose(); mesh.dispose(); });
  view.renderer.dispose();
  view.renderer.forceContextLoss();
  view.renderer = null;
  view.host.replaceChildren(...view.before);
  offer(view.host, view.data);
}

function build(host, data, renderer) {
  const view = { host, data, renderer, by: 'size', before: [...host.childNodes].filter((n) => !n.dataset?.offer) };
  view.scene = new Scene();
  view.scene.background = new Color(BACKGROUND.light);
  view.camera = new PerspectiveCamera(32, 1, 0.01, 100);
  view.meshes = data.shapes.map(meshOf);
  view.scene.add(...view.meshes);
  view.radius = radiusOf(view.meshes);
  view.range = sizeRange(view.meshes);
  lights(view.scene, view.camera);
  view.stage = tag('div', 'view-stage');
  view.legend = tag('div', 'view-legend');
  view.note = tag('span', 'view-note');
  view.stage.append(renderer.domElement, view.legend);
  host.replaceChildren(view.stage, controlsOf(view));
  view.controls = new OrbitControls(view.camera, renderer.domElement);
  view.controls.enableDamping = false;
  view.controls.addEventListener('change', () => draw(view));
  view.observer = new ResizeObserver(() => fit(view));
  view.observer.observe(view.stage);
  return view;
}

function start(host, data) {
  let renderer;
  try {
    renderer = new WebGLRenderer({ antialias: true, powerPreference: 'low-power' });
  } catch {
    host.classList.add('no-webgl');
    return;
  }
  if (open.length >= MAX_VIEWS) close(open.shift());
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  const view = build(host, data, renderer);
  open.push(view);
  fit(view);
  frame(view);
  paint(view);
  grow(view, data.n_shown);
  draw(view);
}

/// A button in place of a view that was closed to stay within the browser's limit.
function offer(host, data) {
  const made = button('Show the 3-D view', 'Interactive view', () => start(host, data));
  made.dataset.offer = 'yes';
  host.append(made);
}

const MARGIN = 200; // px beyond the window at which a view starts

for (const host of document.querySelectorAll('.view')) {
  const data = JSON.parse(host.parentElement.querySelector('.view-data').textContent);
  const box = host.getBoundingClientRect();
  if (box.top < window.innerHeight + MARGIN && box.bottom > -MARGIN) {
    start(host, data);
  } else {
    const seen = new IntersectionObserver((entries) => {
      if (entries.some((e) => e.isIntersecting)) {
        seen.disconnect();
        start(host, data);
      }
    }, { rootMargin: `${MARGIN}px` });
    seen.observe(host);
  }
}
