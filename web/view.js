// The report's 3-D view: starts the views that come into sight, and holds each one's camera. Its parts are in view/.
import {
  AmbientLight, Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Spherical, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { dark, grow, listen, makeControls, showChains } from './view/controls.js';
import { makeCut, setCut, turnCap } from './view/cut.js';
import { isEnd, readData } from './view/data.js';
import { dropDots, measureSpeed, setLevel, settle, timeDrawing, touch } from './view/dots.js';
import { extentOf, makeGrains, meanOf, paintGrains, radiusOf } from './view/grains.js';
import { drawLegend, drawScale, tag } from './view/legend.js';
import { roomOf } from './view/moments.js';
import { dropNear, freeNear } from './view/near.js';
import { drawPicture } from './view/picture.js';
import { grainAt, pick } from './view/pick.js';

const MAX_VIEWS = 6; // browsers allow about 16 WebGL contexts
const BACKGROUND = { light: '#f4f6f8', dark: '#12161b' };
const SIGHT = new Vector3(0.52, -0.742, 0.423); // as `clast render` looks: z is up
const MARGIN = 200; // px beyond the window at which a view starts
const PAPER = { width: 718, height: 416 }; // px: a stage on A4, as in page.css

const sources = []; // {host, element, name}: every view of the page
const open = []; // views that hold a WebGL context, oldest first
const waiting = []; // what starts each view that nobody has scrolled to

function addLights(scene, camera) {
  const key = new DirectionalLight('#ffffff', 2.1);
  const fill = new DirectionalLight('#cfe2ff', 0.55);
  key.position.set(-1.2, 1.6, 1.4);
  fill.position.set(1.6, -0.4, 0.6);
  camera.add(key, fill);
  const sky = new HemisphereLight('#ffffff', '#8c8478', 0.95);
  sky.position.set(0, 0, 1);
  scene.add(camera, sky, new AmbientLight('#ffffff', 0.15));
}

/// What a view can do with its camera.
const camera = {
  /// Sine of half the angle that is seen, of the narrower side.
  reach(aspect) {
    return Math.sin(((this.camera.fov * Math.PI) / 360) * Math.min(1, aspect));
  },
  /// Shows all grains where they are at this moment.
  frame() {
    const { middle, radius } = isEnd(this) ? { middle: new Vector3(), radius: this.radius } : extentOf(this.meshes);
    this.camera.position.copy(SIGHT).setLength((1.04 * radius) / this.reach(this.camera.aspect)).add(middle);
    this.controls.target.copy(middle);
    this.controls.update();
  },
  turn(right, up) {
    const from = new Vector3().subVectors(this.camera.position, this.controls.target);
    const at = new Spherical().setFromVector3(new Vector3(from.x, from.z, -from.y));
    at.theta += right;
    at.phi -= up;
    at.makeSafe();
    const to = new Vector3().setFromSpherical(at);
    this.camera.position.set(to.x, -to.z, to.y).add(this.controls.target);
    this.controls.update();
  },
  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
  },
  pan(right, up) {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const by = new Vector3(right * distance, up * distance, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.controls.update();
  },
  /// Gives the camera to all views that are linked with this one, each in proportion to its size.
  share() {
    for (const other of open) {
      if (other === this || !this.isLinked || !other.isLinked) continue;
      const k = other.radius / this.radius;
      other.camera.position.copy(this.camera.position).multiplyScalar(k);
      other.controls.target.copy(this.controls.target).multiplyScalar(k);
      other.camera.lookAt(other.controls.target);
      touch(other);
      other.draw();
    }
  },
};

const drawing = {
  background() {
    this.scene.background = new Color(this.dark ? BACKGROUND.dark : BACKGROUND.light);
  },
  paint() {
    dropNear(this);
    dropDots(this);
    paintGrains(this);
    drawLegend(this);
    this.draw();
  },
  /// Draws at once.
  render() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = distance / 200;
    this.camera.far = distance * 20 + 4 * this.radius;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    turnCap(this);
    this.renderer.render(this.scene, this.camera);
  },
  /// Draws with the next frame, once, and again when the camera rests.
  draw() {
    settle(this);
    this.drawOnce();
  },
  drawOnce() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!this.renderer) return;
      setLevel(this, false);
      this.render();
      drawScale(this);
    });
  },
  /// Takes the stage's size; what was seen whole in a wider one stays so.
  fit() {
    const { clientWidth: w, clientHeight: h } = this.stage;
    const aspect = w / Math.max(h, 1);
    this.renderer.setSize(w, h, false);
    this.camera.aspect = aspect;
    if (aspect > 0 && this.aspect > 0) this.zoom(this.reach(this.aspect) / this.reach(aspect));
    this.aspect = aspect > 0 ? aspect : this.aspect;
    this.draw();
  },
};

function makeStage(view, others) {
  view.stage = tag('div', 'view-stage');
  view.legend = tag('div', 'view-legend');
  view.scale = tag('div', 'view-length');
  view.facts = tag('div', 'view-facts');
  view.facts.hidden = true;
  view.facts.setAttribute('aria-live', 'polite');
  view.note = tag('span', 'view-note');
  view.stage.append(view.renderer.domElement, view.legend, view.scale, view.facts);
  view.box = tag('div', 'view-pane');
  view.box.append(view.stage, makeControls(view, others));
}

/// A view of the source's assembly, not yet on the page.
function makeView(source, renderer) {
  const data = readData(source.element);
  const cut = makeCut();
  const view = {
    ...camera, ...drawing, source, data, renderer, cut, name: source.name, by: data.size ? 'size' : 'order', picked: -1, isLinked: false,
    dark: window.matchMedia('(prefers-color-scheme: dark)').matches,
  };
  view.scene = new Scene();
  view.camera = new PerspectiveCamera(32, 1, 0.01, 100);
  view.camera.up.set(0, 0, 1);
  view.meshes = makeGrains(data, roomOf(data), cut.cap);
  view.moment = data.frames?.frame.length ?? 0;
  view.mean = meanOf(view.meshes);
  view.scene.add(...view.meshes);
  view.radius = radiusOf(view.meshes);
  addLights(view.scene, view.camera);
  makeStage(view, sources.filter((s) => s !== source));
  view.stage.classList.toggle('dark', view.dark);
  view.background();
  view.controls = new OrbitControls(view.camera, renderer.domElement);
  view.controls.enableDamping = false;
  view.controls.addEventListener('change', () => { touch(view); view.draw(); view.share(); });
  view.observer = new ResizeObserver(() => view.fit());
  view.observer.observe(view.stage);
  view.beside = (other) => showBeside(view, other);
  listen(view);
  return view;
}

function begin(view) {
  open.push(view);
  view.fit();
  view.frame();
  view.paint();
  grow(view, view.data.n_shown);
  measureSpeed(view);
}

function newRenderer() {
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('webgl2', { antialias: true, powerPreference: 'low-power' });
  if (!context) return null; // three.js would write so on the console
  try {
    const made = new WebGLRenderer({ canvas, context });
    made.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    return made;
  } catch {
    return null;
  }
}

function release(view) {
  if (view.second) release(view.second);
  open.splice(open.indexOf(view), 1);
  view.observer.disconnect();
  view.controls.dispose();
  clearTimeout(view.resting);
  dropDots(view);
  freeNear(view);
  view.dotMaterial?.dispose();
  for (const mesh of view.chains ? [...view.meshes, view.chains] : view.meshes) {
    mesh.geometry.dispose();
    mesh.material.dispose();
    mesh.dispose();
  }
  view.renderer.dispose();
  view.renderer.forceContextLoss();
  view.renderer = null;
  view.box.remove();
}

/// Makes room for one more beside a view that is kept; where a view of the page was, a button brings it back.
function makeRoom(kept) {
  if (open.length < MAX_VIEWS) return;
  const oldest = open.find((view) => view !== kept);
  if (oldest.first) oldest.first.second = null;
  release(oldest);
  if (!oldest.first) offer(oldest.source);
}

/// The other run to the right of this one, with the same camera; null takes it away.
function showBeside(view, other) {
  if (view.second) release(view.second);
  view.second = null;
  view.source.host.classList.toggle('two', other !== null);
  if (other !== null) {
    makeRoom(view);
    const renderer = newRenderer();
    if (!renderer) {
      view.source.host.classList.remove('two');
      return;
    }
    const second = makeView(other, renderer);
    second.first = view;
    second.parts.beside.hidden = true;
    view.second = second;
    view.source.host.append(second.box);
    begin(second);
    for (const one of [view, second]) {
      one.isLinked = true;
      one.parts.link.checked = true;
      one.caption ??= one.stage.appendChild(tag('div', 'view-name', one.name));
    }
    view.share();
  }
  view.fit();
}

function start(source) {
  const { host } = source;
  makeRoom();
  const renderer = newRenderer();
  if (!renderer) {
    host.classList.add('no-webgl');
    return;
  }
  const view = makeView(source, renderer);
  host.replaceChildren(view.box);
  begin(view);
}

function offer(source) {
  const made = tag('button', '', 'Show the 3-D view');
  made.type = 'button';
  made.addEventListener('click', () => start(source));
  source.host.replaceChildren(made);
}

/// Name of the run whose section holds the view.
function nameOf(host) {
  return host.closest('section')?.querySelector('h2')?.textContent || document.title || 'clast';
}

for (const host of document.querySelectorAll('.view')) {
  sources.push({ host, element: host.parentElement.querySelector('.view-data'), name: nameOf(host) });
}
for (const source of sources) {
  const box = source.host.getBoundingClientRect();
  if (box.top < window.innerHeight + MARGIN && box.bottom > -MARGIN) {
    start(source);
  } else {
    const first = () => {
      seen.disconnect();
      waiting.splice(waiting.indexOf(first), 1);
      start(source);
    };
    const seen = new IntersectionObserver((entries) => { if (entries.some((e) => e.isIntersecting)) first(); }, { rootMargin: `${MARGIN}px` });
    seen.observe(source.host);
    waiting.push(first);
  }
}

/// For the live page: a view in `host` of the data that an element holds, or null without WebGL.
function show(host, element, name) {
  start({ host, element, name });
  return open.find((view) => view.source.host === host) ?? null;
}

/// For the live page: other grains in an open view; its camera, colours and cut stay. Growth goes on at its end.
function replace(view, element) {
  const hasChains = Boolean(view.chains?.visible);
  dropDots(view);
  freeNear(view);
  for (const near of view.near ?? []) if (near) view.scene.remove(near);
  Object.assign(view, { near: null, fine: [], base: null });
  for (const mesh of view.chains ? [...view.meshes, view.chains] : view.meshes) {
    view.scene.remove(mesh);
    mesh.geometry.dispose();
    mesh.material.dispose();
    mesh.dispose();
  }
  view.chains = null;
  view.data = readData(element);
  view.meshes = makeGrains(view.data, roomOf(view.data), view.cut.cap);
  view.moment = view.data.frames?.frame.length ?? 0;
  view.mean = meanOf(view.meshes);
  view.scene.add(...view.meshes);
  view.radius = radiusOf(view.meshes);
  setCut(view, view.cut.axis);
  Object.assign(view.parts.grow, { max: view.data.n_shown, value: view.data.n_shown });
  if (view.picked >= view.data.n_shown) pick(view, -1);
  view.parts.chains.textContent = view.data.contacts?.force ? 'Force chains' : 'Contacts';
  grow(view, view.data.n_shown);
  if (hasChains && view.data.contacts) showChains(view, true);
  view.paint();
}

/// A copy for paper, which is white, in the shape that page.css gives it there: stretched, spheres would be ellipsoids.
function print(view) {
  const paper = tag('canvas', 'view-paper');
  const ratio = view.renderer.getPixelRatio();
  const width = PAPER.width / (view.stage.closest('.two') ? 2 : 1);
  view.stage.classList.remove('dark');
  view.scene.background = new Color('#ffffff');
  view.renderer.setPixelRatio(2);
  view.renderer.setSize(width, PAPER.height, false);
  view.camera.aspect = width / PAPER.height;
  setLevel(view, true);
  view.render();
  Object.assign(paper, { width: view.renderer.domElement.width, height: view.renderer.domElement.height });
  paper.getContext('2d').drawImage(view.renderer.domElement, 0, 0);
  view.stage.append(paper);
  view.renderer.setPixelRatio(ratio);
  drawScale(view, PAPER.height);
}

window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', ({ matches }) => open.forEach((view) => dark(view, matches)));

window.addEventListener('beforeprint', () => {
  waiting.slice(0, Math.max(0, MAX_VIEWS - open.length)).forEach((first) => first());
  open.forEach(print);
});
window.addEventListener('afterprint', () => open.forEach((view) => {
  view.stage.querySelector('.view-paper')?.remove();
  view.stage.classList.toggle('dark', view.dark);
  view.background();
  view.fit();
}));

/// For tests and for people at the browser's console: what the page shows, and what it can draw.
window.clastViews = { open, drawPicture, grainAt, pick, setLevel, timeDrawing, show, replace };
