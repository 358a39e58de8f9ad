// The report's 3-D view: one instanced mesh per shape, coloured by size, order or shape, with a growth slider.
//
// The page holds, per run, a <script type="application/json" class="view-data"> with
//   {unit, length, n_grain, n_shown, bar, size, order, shape, shape_name, shapes: [{name, colour, position, index, grain, pose}]}
// bar: colours from low to high; size, order: {title, log, low, high, unit, ticks: [[place, text]]}, the colour bars of a picture of
// the same run (size times unit is on its scale; no `size`: grains without volume); shape: colours, shapes[].colour says which;
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
const BAR = 260; // px: width of the colour bar, as in page.css
const MAX_VIEWS = 6; // browsers allow about 16 WebGL contexts
const TINT = '#c9b79c'; // grains of one size, as in pictures
const BACKGROUND = { light: '#f4f6f8', dark: '#12161b' };

function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i += 1) out[i] = raw.charCodeAt(i);
  return out.buffer;
}

function sequence(colours, t, out) {
  const x = Math.min(Math.max(t, 0), 1) * (colours.length - 1);
  const i = Math.min(Math.floor(x), colours.length - 2);
  return out.copy(colours[i]).lerp(colours[i + 1], x - i);
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
  const sky = new HemisphereLight('#ffffff', '#8c8478', 0.95);
  sky.position.set(0, 0, 1);
  scene.add(camera, sky, new AmbientLight('#ffffff', 0.15));
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

/// Place of a value on a colour bar.
function placeOf(bar, value) {
  return bar.log ? Math.log(value / bar.low) / Math.log(bar.high / bar.low) : (value - bar.low) / (bar.high - bar.low);
}

function isWide(bar) {
  return bar.high > 1.01 * bar.low;
}

function paint(view) {
  const { meshes, data } = view;
  const colour = new Color();
  meshes.forEach((mesh, s) => {
    mesh.userData.grain.forEach((g, i) => {
      if (view.by === 'shape') colour.set(data.shape[data.shapes[s].colour]);
      else if (!isWide(data[view.by])) colour.set(TINT);
      else if (view.by === 'order') sequence(view.colours, placeOf(data.order, g + 1), colour);
      else sequence(view.colours, placeOf(data.size, mesh.userData.size[i] * data.size.unit), colour);
      mesh.setColorAt(i, colour);
    });
    mesh.instanceColor.needsUpdate = true;
  });
  view.legend.replaceChildren(...legendOf(view));
}

function tag(name, className, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

function shapeLegend(data) {
  return data.shape.map((colour, k) => {
    const row = tag('span', 'view-key', data.shape_name[k]);
    const dot = tag('i', 'view-dot');
    dot.style.background = colour;
    row.prepend(dot);
    return row;
  });
}

/// Ticks of the bar; a label that would touch the one before it is left out, the mark stays.
function ticksOf(bar) {
  const scale = tag('div', 'view-scale');
  let free = -1;
  for (const [place, text] of [...bar.ticks].sort((a, b) => a[0] - b[0])) {
    const half = (4 + 3.6 * text.length) / BAR; // of the label, as a share of the bar
    const mark = tag('i', 'view-tick', place - half > free ? text : '');
    mark.style.left = `${100 * place}%`;
    if (mark.textContent) free = place + half;
    scale.append(mark);
  }
  return scale;
}

function legendOf(view) {
  if (view.by === 'shape') return shapeLegend(view.data);
  const bar = view.data[view.by];
  const title = tag('span', 'view-title', bar.title + (bar.log ? ', log scale' : ''));
  if (!isWide(bar)) return [title, tag('span', '', `${Number(bar.low.toPrecision(4))}, all grains`)];
  const strip = tag('i', 'view-bar');
  strip.style.background = `linear-gradient(90deg, ${view.data.bar.join(',')})`;
  return [title, strip, ticksOf(bar)];
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
  view.camera.position.set(0.52, -0.742, 0.423).setLength(distance); // as `clast render` looks: z is up
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
    if (!view.data[value]) continue;
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
  const view = { host, data, renderer, by: data.size ? 'size' : 'order', before: [...host.childNodes].filter((n) => !n.dataset?.offer) };
  view.scene = new Scene();
  view.scene.background = new Color(BACKGROUND.light);
  view.camera = new PerspectiveCamera(32, 1, 0.01, 100);
  view.camera.up.set(0, 0, 1);
  view.colours = data.bar.map((c) => new Color(c));
  view.meshes = data.shapes.map(meshOf);
  view.scene.add(...view.meshes);
  view.radius = radiusOf(view.meshes);
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
