// The view as a PNG of any size, in tiles that every graphics card can draw.
import { setLevel } from './dots.js';
import { labelledTicks, barOf, keysOf, scaleBar, single, titleOf } from './legend.js';

const TILE = 2048; // px
export const MIN_WIDTH = 64;
export const MAX_WIDTH = 16384;

function drawTiles(view, canvas) {
  const { renderer, camera, stage } = view;
  const context = canvas.getContext('2d');
  const { width, height } = canvas;
  const ratio = renderer.getPixelRatio();
  renderer.setPixelRatio(1);
  setLevel(view, true);
  for (let y = 0; y < height; y += TILE) {
    for (let x = 0; x < width; x += TILE) {
      const w = Math.min(TILE, width - x);
      const h = Math.min(TILE, height - y);
      renderer.setSize(w, h, false);
      camera.setViewOffset(width, height, x, y, w, h);
      view.render();
      context.drawImage(renderer.domElement, x, y);
    }
  }
  camera.clearViewOffset();
  renderer.setPixelRatio(ratio);
  renderer.setSize(stage.clientWidth, stage.clientHeight, false);
}

/// Legend and scale bar, as on the stage, `k` times as large.
function drawMarks(view, canvas, k) {
  const c = canvas.getContext('2d');
  const bar = barOf(view);
  const ink = view.dark ? '#e8ecf0' : '#1d2733';
  c.scale(k, k);
  c.font = '12.5px system-ui, sans-serif';
  c.fillStyle = ink;
  c.textBaseline = 'top';
  const height = canvas.height / k;
  const width = canvas.width / k;
  const keys = keysOf(view);
  const foot = height - (!bar ? 24 : single(bar) ? 66 : 82);
  keys.forEach(([colour, name], i) => {
    const y = foot - 18 * (keys.length - 1 - i);
    c.fillStyle = colour;
    c.fillRect(20, y, 10, 10);
    c.fillStyle = ink;
    c.fillText(name, 36, y - 2);
  });
  if (bar && single(bar)) {
    c.fillText(titleOf(bar), 20, height - 46);
    c.fillText(single(bar), 20, height - 28);
  } else if (bar) {
    const strip = c.createLinearGradient(20, 0, 280, 0);
    view.data.bar.forEach((colour, i) => strip.addColorStop(i / (view.data.bar.length - 1), colour));
    c.fillText(titleOf(bar), 20, height - 62);
    c.fillStyle = strip;
    c.fillRect(20, height - 42, 260, 10);
    c.fillStyle = ink;
    c.textAlign = 'center';
    for (const [place, text] of labelledTicks(bar)) {
      c.fillRect(20 + 260 * place - 0.5, height - 34, 1, 5);
      c.fillText(text, 20 + 260 * place, height - 26);
    }
  }
  const { text, pixels } = scaleBar(view, height);
  c.fillRect(width - 20 - pixels, height - 16, pixels, 3);
  c.textAlign = 'center';
  c.fillText(text, width - 20 - pixels / 2, height - 34);
}

/// Canvas of the view with its legend, `width` pixels wide, of the stage's shape.
export function drawPicture(view, width) {
  const { clientWidth: w, clientHeight: h } = view.stage;
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(Math.min(Math.max(width, MIN_WIDTH), MAX_WIDTH));
  canvas.height = Math.max(1, Math.round((canvas.width * h) / w));
  drawTiles(view, canvas);
  drawMarks(view, canvas, canvas.width / w);
  return canvas;
}

/// Saves the view as wide as its field says; a width that is none is told at the field.
export function savePicture(view) {
  const { width } = view.parts;
  width.max = Math.floor(MAX_WIDTH * Math.min(1, view.stage.clientWidth / view.stage.clientHeight)); // no side longer than MAX_WIDTH
  width.setCustomValidity('');
  if (!width.reportValidity()) return;
  drawPicture(view, Number(width.value)).toBlob((blob) => {
    if (!blob) {
      width.setCustomValidity('The browser has no memory for a picture as wide.');
      width.reportValidity();
      return;
    }
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `${view.name}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }, 'image/png');
}
