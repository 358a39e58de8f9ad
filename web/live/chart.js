// Lines in a chart, as SVG: axes with round marks, a legend by name, a moving mark.
const SVG = 'http://www.w3.org/2000/svg';
const BOX = { width: 460, height: 240, left: 58, right: 14, top: 12, foot: 42 };

function part(name, attributes, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/// Round marks that hold all values: [low, high, step].
function marksOf(values, from) {
  const finite = values.filter(Number.isFinite);
  let low = Math.min(...finite, from ?? Infinity);
  let high = Math.max(...finite, from ?? -Infinity);
  if (!(high > low)) { low = Number.isFinite(low) ? low - Math.abs(low || 1) / 2 : 0; high = low + Math.abs(low || 1); }
  const rough = (high - low) / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((k) => k * power >= rough * (1 - 1e-9));
  return [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step, step];
}

const round = (v) => String(Number(v.toPrecision(6)));

/// Draws {title, x: {title, values}, y: {title, from}, lines: [{name, values, marks}], mark}: mark, the x of a vertical line.
function drawChart(host, { title, x, y, lines, mark }) {
  const drawn = lines.filter((line) => line.values.some(Number.isFinite));
  const all = drawn.flatMap((line) => Array.from(line.values));
  if (x.values.length === 0 || all.length === 0) { host.replaceChildren(tag('p', 'nothing yet', 'note')); return; }
  const [x0, x1, dx] = marksOf(Array.from(x.values), x.from);
  const [y0, y1, dy] = marksOf(all, y.from);
  const px = (v) => BOX.left + ((v - x0) / (x1 - x0)) * (BOX.width - BOX.left - BOX.right);
  const py = (v) => BOX.height - BOX.foot - ((v - y0) / (y1 - y0)) * (BOX.height - BOX.top - BOX.foot);
  const svg = part('svg', { viewBox: `0 0 ${BOX.width} ${BOX.height}`, role: 'img', 'aria-label': `${title}: ${y.title} over ${x.title}` });
  for (let v = x0; v <= x1 + dx / 2; v += dx) {
    svg.append(part('line', { x1: px(v), x2: px(v), y1: py(y0), y2: py(y1), class: 'grid' }), part('text', { x: px(v), y: py(y0) + 15, 'text-anchor': 'middle' }, round(v)));
  }
  for (let v = y0; v <= y1 + dy / 2; v += dy) {
    svg.append(part('line', { x1: px(x0), x2: px(x1), y1: py(v), y2: py(v), class: 'grid' }), part('text', { x: px(x0) - 6, y: py(v) + 4, 'text-anchor': 'end' }, round(v)));
  }
  svg.append(part('text', { x: (px(x0) + px(x1)) / 2, y: BOX.height - 8, 'text-anchor': 'middle', class: 'axis' }, x.title),
    part('text', { x: 0, y: 0, transform: `translate(13 ${(py(y0) + py(y1)) / 2}) rotate(-90)`, 'text-anchor': 'middle', class: 'axis' }, y.title));
  drawn.forEach((line, k) => {
    const points = [];
    line.values.forEach((v, i) => { if (Number.isFinite(v)) points.push(`${px(x.values[i]).toFixed(1)},${py(v).toFixed(1)}`); });
    svg.append(points.length > 1 ? part('polyline', { points: points.join(' '), fill: 'none', stroke: LABELS[k % LABELS.length], 'stroke-width': 2 })
      : part('circle', { cx: points[0].split(',')[0], cy: points[0].split(',')[1], r: 3, fill: LABELS[k % LABELS.length] }));
  });
  if (Number.isFinite(mark)) svg.append(part('line', { x1: px(mark), x2: px(mark), y1: py(y0), y2: py(y1), class: 'now' }));
  const names = tag('p', '', 'names');
  if (drawn.length > 1) {
    names.append(...drawn.map((line, k) => {
      const one = tag('span', line.name);
      const dot = tag('i', '', 'view-dot');
      dot.style.background = LABELS[k % LABELS.length];
      one.prepend(dot);
      return one;
    }));
  }
  host.replaceChildren(tag('h2', title), svg, names);
}
