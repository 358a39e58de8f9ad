// What colours mean, and how long a length is.
import { isEnd } from './data.js';
import { isWide, lacksValues, NOT_KNOWN } from './grains.js';
import { length, roundBelow } from './units.js';

const BAR = 260; // px: width of the colour bar, as in page.css
const MAX_SCALE = 160; // px: longest scale bar

export function tag(name, className, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

/// Marks of a bar; a label that would touch the one before it is left out, the mark stays.
export function labelledTicks(bar) {
  let free = -1;
  return [...bar.ticks].sort((a, b) => a[0] - b[0]).map(([place, text]) => {
    const half = (4 + 3.6 * text.length) / BAR; // of the label, as a share of the bar
    const isShown = place - half > free;
    if (isShown) free = place + half;
    return [place, isShown ? text : ''];
  });
}

export function titleOf(bar) {
  return bar.title + (bar.log ? ', log scale' : '');
}

/// The bar that is shown: of the force chains, else of the grains' colours; null for shapes.
export function barOf(view) {
  if (view.chains?.visible && view.chains.userData.bar) return view.chains.userData.bar;
  if (view.by === 'shape') return null;
  const bar = view.data[view.by];
  return view.by === 'coordination' && !isEnd(view) ? { ...bar, title: `${bar.title}, at the end of the run` } : bar;
}

export function single(bar) {
  return isWide(bar) ? null : `${Number(bar.low.toPrecision(4))}, all grains`;
}

/// Dots of colours and what they stand for, below or instead of the bar: [[colour, text]].
export function keysOf(view) {
  if (!barOf(view)) return view.data.shape.map((colour, k) => [colour, view.data.shape_name[k]]);
  return lacksValues(view) ? [[NOT_KNOWN, 'not among the grains of the end']] : [];
}

function keyRow([colour, text]) {
  const row = tag('span', 'view-key', text);
  const dot = tag('i', 'view-dot');
  dot.style.background = colour;
  row.prepend(dot);
  return row;
}

export function drawLegend(view) {
  const bar = barOf(view);
  const keys = keysOf(view).map(keyRow);
  if (!bar) {
    view.legend.replaceChildren(...keys);
    return;
  }
  const title = tag('span', 'view-title', titleOf(bar));
  if (single(bar)) {
    view.legend.replaceChildren(...keys, title, tag('span', '', single(bar)));
    return;
  }
  const strip = tag('i', 'view-bar');
  const scale = tag('div', 'view-scale');
  strip.style.background = `linear-gradient(90deg, ${view.data.bar.join(',')})`;
  for (const [place, text] of labelledTicks(bar)) {
    const mark = tag('i', 'view-tick', text);
    mark.style.left = `${100 * place}%`;
    scale.append(mark);
  }
  view.legend.replaceChildren(...keys, title, strip, scale);
}

/// A round length at the distance of the point about which the view turns: its text and its pixels.
export function scaleBar(view, height) {
  const distance = view.camera.position.distanceTo(view.controls.target);
  const perPixel = (2 * distance * Math.tan((view.camera.fov * Math.PI) / 360)) / height;
  const round = roundBelow(MAX_SCALE * perPixel * view.data.length) / view.data.length;
  return { text: length(view.data, round, 3), pixels: round / perPixel };
}

export function drawScale(view, height = view.stage.clientHeight) {
  const { text, pixels } = scaleBar(view, height);
  view.scale.style.width = `${pixels}px`;
  view.scale.textContent = text;
}
