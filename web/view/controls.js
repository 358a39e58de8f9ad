// What the user can press, turn and type.
import { moveCut, setCut } from './cut.js';
import { isEnd, UNKNOWN } from './data.js';
import { makeChains } from './chains.js';
import { showFirst } from './grains.js';
import { drawLegend, tag } from './legend.js';
import { setMoment, timeOf } from './moments.js';
import { dropNear } from './near.js';
import { grainAt, pick } from './pick.js';
import { MAX_WIDTH, MIN_WIDTH, savePicture } from './picture.js';

const COLOURS = [['size', 'Colour by size'], ['order', 'Colour by order'], ['shape', 'Colour by shape'],
  ['coordination', 'Colour by contacts'], ['speed', 'Colour by speed'], ['force', 'Colour by force']];
const CUTS = [['none', 'No cut'], ['view', 'Cut in view'], ['x', 'Cut across x'], ['y', 'Cut across y'], ['z', 'Cut across z']];
const KEYS = 'Arrow keys rotate, Shift and arrow keys move, + and - zoom, 0 frames all, C changes colours, X Y Z V cut, F shows contacts, '
  + 'P saves a picture, comma and full stop step in time, Escape lets a grain go.';
const TURN = Math.PI / 24; // rad a key
const CLICK = 4; // px that a click may move

function button(text, title, action) {
  const made = tag('button', '', text);
  made.type = 'button';
  made.title = title;
  made.addEventListener('click', action);
  return made;
}

function choice(title, options, action) {
  const made = tag('select');
  made.title = title;
  made.setAttribute('aria-label', title);
  for (const [value, text] of options) {
    const option = tag('option', '', text);
    option.value = value;
    made.append(option);
  }
  made.addEventListener('change', () => action(made.value));
  return made;
}

function range(title, low, high, step, value, action) {
  const made = tag('input');
  Object.assign(made, { type: 'range', min: low, max: high, step, value, title });
  made.setAttribute('aria-label', title);
  made.addEventListener('input', () => action(Number(made.value)));
  return made;
}

function grow(view, n) {
  view.shown = n;
  dropNear(view);
  showFirst(view.chains ? [...view.meshes, view.chains] : view.meshes, n === view.data.n_shown ? Infinity : n);
  const drawn = view.meshes.reduce((sum, mesh) => sum + mesh.count, 0);
  const all = isEnd(view) ? view.data.n_grain : view.meshes.reduce((sum, mesh) => sum + mesh.userData.grain.length, 0);
  const share = drawn === all ? '' : `${drawn.toLocaleString('en')} of `;
  view.note.textContent = `${share}${all.toLocaleString('en')} ${all === 1 ? 'grain' : 'grains'}`;
  view.stage.setAttribute('aria-label', `3-D view of ${view.note.textContent}. ${KEYS}`);
  view.draw();
}

/// Shows the run at its k-th moment.
function go(view, k) {
  const { parts } = view;
  const last = Number(parts.time.max);
  const to = Math.min(Math.max(k, 0), last);
  if (to !== last && view.chains?.visible) showChains(view, false);
  setMoment(view, to);
  parts.time.value = to;
  parts.when.textContent = timeOf(view, to);
  parts.time.setAttribute('aria-valuetext', parts.when.textContent);
  parts.chains.disabled = !isEnd(view);
  const hasOrder = view.meshes.some(({ userData: { grain } }) => grain.length > 0 && grain[0] !== UNKNOWN);
  parts.grow.disabled = !hasOrder;
  parts.growing.disabled = !hasOrder;
  grow(view, hasOrder ? Number(parts.grow.value) : view.data.n_shown);
  view.paint();
}

/// Runs a slider from its begin to its end in about six seconds.
function play(view, slider, set) {
  const start = performance.now();
  view.playing = !view.playing;
  const step = (now) => {
    const t = Math.min(Math.max(now - start, 0) / 6000, 1);
    if (!view.playing || !view.renderer) return;
    const to = Math.round(Number(slider.min) + t * (Number(slider.max) - Number(slider.min)));
    if (to !== Number(slider.value)) {
      slider.value = to;
      set(to);
    }
    if (t < 1) requestAnimationFrame(step);
    else view.playing = false;
  };
  requestAnimationFrame(step);
}

/// Slider of the run's moments, where it has frames.
function timeControls(view) {
  const { frames } = view.data;
  if (!frames) return [];
  const last = frames.frame.length;
  view.parts.time = range('Time', 0, last, 1, last, (k) => go(view, k));
  view.parts.when = tag('span', 'view-note', timeOf(view, last));
  view.parts.time.setAttribute('aria-valuetext', view.parts.when.textContent);
  return [button('\u25b6 Time', 'Play the run', () => play(view, view.parts.time, (k) => go(view, k))), view.parts.time, view.parts.when];
}

function colour(view, by) {
  view.by = by;
  if (view.chains?.visible) showChains(view, false);
  view.parts.colour.value = by;
  view.paint();
}

function cut(view, axis) {
  setCut(view, axis);
  view.parts.cut.value = axis;
  view.parts.place.hidden = axis === 'none';
  view.draw();
}

/// Contacts in place of the grains' surfaces.
function showChains(view, isOn) {
  if (isOn && !view.chains) {
    view.chains = makeChains(view);
    view.scene.add(view.chains);
    showFirst([view.chains], view.shown);
  }
  if (view.chains) view.chains.visible = isOn;
  if (isOn) pick(view, -1);
  view.parts.chains.setAttribute('aria-pressed', String(isOn));
  drawLegend(view);
  view.draw();
}

function toggleChains(view) {
  if (view.data.contacts && isEnd(view)) showChains(view, !view.chains?.visible);
}

function dark(view, isDark) {
  view.dark = isDark;
  view.stage.classList.toggle('dark', isDark);
  view.background();
  view.draw();
}

/// Width in pixels and the button that saves.
function pictureControls(view) {
  const width = tag('input');
  Object.assign(width, { type: 'number', min: MIN_WIDTH, max: MAX_WIDTH, value: 2400, step: 1, title: `Width of the picture in pixels, ${MIN_WIDTH} to ${MAX_WIDTH}`, required: true });
  width.setAttribute('aria-label', width.title);
  view.parts.width = width;
  return [button('Save PNG', 'Save this view as a PNG', () => savePicture(view)), width, tag('span', 'view-note', 'px wide')];
}

function linkControls(view, others) {
  if (others.length === 0) return [];
  const box = tag('input');
  const label = tag('label', 'view-key', 'Same camera in all views');
  box.type = 'checkbox';
  box.addEventListener('change', () => { view.isLinked = box.checked; view.share(); });
  label.prepend(box);
  view.parts.link = box;
  view.parts.beside = choice('Beside', [['', 'Beside it \u2026'], ...others.map((o, k) => [String(k), o.name])],
    (value) => view.beside(value === '' ? null : others[Number(value)]));
  return [label, view.parts.beside];
}

export function makeControls(view, others) {
  const { data } = view;
  const bar = tag('div', 'view-controls');
  const parts = {
    colour: choice('Colour', COLOURS.filter(([key]) => data[key]), (by) => colour(view, by)),
    grow: range('Growth: grains in order of placement', 1, data.n_shown, 1, data.n_shown, (n) => grow(view, n)),
    cut: choice('Cut', CUTS, (axis) => cut(view, axis)),
    place: range('Position of the cut', 0, 1, 0.002, 0.5, (place) => { moveCut(view, place); view.draw(); }),
    chains: button(data.contacts?.force ? 'Force chains' : 'Contacts', 'Show contacts in place of the grains', () => toggleChains(view)),
  };
  parts.growing = button('\u25b6 Grow', 'Play the growth', () => play(view, parts.grow, (n) => grow(view, n)));
  view.parts = parts;
  parts.colour.value = view.by;
  parts.place.hidden = true;
  parts.chains.setAttribute('aria-pressed', 'false');
  bar.append(parts.colour, ...timeControls(view), parts.growing, parts.grow, view.note, parts.cut, parts.place);
  if (data.contacts) bar.append(parts.chains);
  bar.append(button('Reset view', 'Frame everything', () => { view.frame(); view.draw(); }),
    button('Light / dark', 'Change the background', () => dark(view, !view.dark)), ...pictureControls(view), ...linkControls(view, others));
  return bar;
}

/// Turns, moves or zooms by a key; false for other keys.
function moveByKey(view, key, isShifted) {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const arrow = arrows[key];
  if (arrow && isShifted) view.pan(0.08 * arrow[0], 0.08 * arrow[1]);
  else if (arrow) view.turn(TURN * arrow[0], TURN * arrow[1]);
  else if (key === '+' || key === '=') view.zoom(1 / 1.15);
  else if (key === '-') view.zoom(1.15);
  else if (key === '0' || key === 'Home') view.frame();
  else return false;
  return true;
}

function actByKey(view, key) {
  const { data } = view;
  const colours = COLOURS.map(([name]) => name).filter((name) => data[name]);
  const axis = { x: 'x', y: 'y', z: 'z', v: 'view' }[key];
  if (axis) cut(view, view.cut.axis === axis ? 'none' : axis);
  else if (key === 'c') colour(view, colours[(colours.indexOf(view.by) + 1) % colours.length]);
  else if (key === 'f') toggleChains(view);
  else if (key === 'p') savePicture(view);
  else if ((key === ',' || key === '.') && view.parts.time) go(view, view.moment + (key === '.' ? 1 : -1));
  else if (key === 'escape') pick(view, -1);
  else return false;
  view.paint();
  return true;
}

/// Keys and clicks on the stage.
export function listen(view) {
  const { stage } = view;
  let down = null;
  stage.tabIndex = 0;
  stage.setAttribute('role', 'application');
  stage.title = '';
  stage.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (moveByKey(view, event.key, event.shiftKey) || actByKey(view, event.key.toLowerCase())) {
      event.preventDefault();
      view.draw();
    }
  });
  stage.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
  stage.addEventListener('pointerup', (event) => {
    if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > CLICK || view.chains?.visible) return;
    const box = stage.getBoundingClientRect();
    pick(view, grainAt(view, event.clientX - box.left, event.clientY - box.top));
    view.paint();
    view.draw();
  });
}

export { dark, grow, showChains };
