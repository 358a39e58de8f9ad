// The tab Grow: `clast aggregate`, watched by the checkpoints that it writes grain by grain.
const MOST_WATCHED = 250; // checkpoints of a run
const GRAIN_NAMES = { 'grain00.ply': 'pebble A', 'grain12.ply': 'pebble B', 'grain31.ply': 'pebble C', 'grain47.ply': 'pebble D' };

class GrowRoom extends Room {
  constructor() {
    super('grow');
    this.command = 'aggregate';
    this.most = 5000;
    this.history = null;
  }

  listFiles() {
    const own = [...this.files.keys()];
    const shapes = [...[...GRAINS.keys()].map((name) => [name, `${GRAIN_NAMES[name]} (${name})`]), ['sphere', 'sphere'],
      ...own.filter((name) => this.isSurface(name)).map((name) => [name, name])];
    this.setOptions('core', [...shapes, ['-', 'none (--mode cluster)']]);
    this.setOptions('sizes', [['', 'one size, by the slider'], ...own.filter((name) => this.isTable(name)).map((name) => [name, name])]);
    const kept = new Map([...this.$('coats').querySelectorAll('input')].map((box) => [box.id, box.checked]));
    this.$('coats').replaceChildren(...shapes.map(([value, text]) => {
      const id = `grow-coat_${value}`;
      const label = tag('label', ` ${text}`, 'check');
      label.prepend(Object.assign(document.createElement('input'), { type: 'checkbox', id, checked: kept.get(id) ?? ['grain12.ply', 'grain31.ply'].includes(value) }));
      return label;
    }));
    this.$('given').textContent = own.length > 0 ? `own files: ${own.join(', ')}` : '';
  }

  given(name) {
    if (this.isTable(name)) this.$('sizes').value = name;
    else this.$('core').value = name;
  }

  changed() { this.$('size_row').hidden = this.value('sizes') !== ''; this.$('unit_row').hidden = this.value('sizes') === ''; }

  coats() {
    return [...this.$('coats').querySelectorAll('input:checked')].map((box) => box.id.slice('grow-coat_'.length));
  }

  wordsNow() {
    const words = ['aggregate'];
    const add = (option, value) => { if (value !== '') words.push(option, value); };
    if (this.value('core') !== '-') {
      add('--core', this.value('core'));
      add('--core-size', this.value('core_size'));
    }
    this.coats().forEach((name) => add('--coat', name));
    if (this.value('sizes') === '') add('--size', this.value('size'));
    else { add('--sizes', this.value('sizes')); add('--size-unit', this.value('size_unit')); }
    add('--replicate', this.value('replicate'));
    if (words.some((w) => GRAINS.has(w) || this.files.has(w))) add('--unit', this.value('unit'));
    for (const name of ['cone', 'rays', 'orientations', 'contact']) add(`--${name}`, this.value(name));
    const envelopes = [...this.$('form').querySelectorAll('[data-envelope]:checked')].map((box) => box.dataset.envelope);
    envelopes.forEach((name) => add('--envelope', name));
    if (envelopes.includes('wrap') || envelopes.includes('alpha')) add('--envelope-length', this.value('envelope_length'));
    add('--seed', this.value('seed'));
    return [...words, '--fall-speed', '--no-picture', ...this.more(), '-o', 'aggregate'];
  }

  /// Grains that the words ask for, as far as it can be told without reading as clast does: counts of a table, or its lines.
  estimate() {
    const [names, ...rows] = textOf(this.files.get(this.value('sizes')) ?? new Uint8Array()).split(/[\r\n]+/).filter((line) => /^[^#]/.test(line))
      .map((line) => line.split(/[;,\t]/).map((cell) => cell.trim().replaceAll('"', '')));
    const at = names?.findIndex((name) => /^(n|counts?|numbers?)\b/i.test(name)) ?? -1;
    const n = at < 0 ? rows.length : rows.reduce((sum, row) => sum + (Number(row[at]) || 0), 0);
    return (Number(this.givenIn(this.words, 'n-particle').pop()) || n || 1) * (Number(this.givenIn(this.words, 'replicate').pop()) || 1);
  }

  async compute() {
    const every = Math.max(1, Math.ceil(this.estimate() / MOST_WATCHED));
    const { turn } = this;
    this.history = null;
    const ended = await this.engine.run([...this.words, '--checkpoint-every', String(every)], this.inputs, (name, bytes) => this.hear(name, bytes));
    const refusal = refusalOf(ended);
    this.latest = null;
    if (refusal) return refusal;
    const hash = await digestOf(ended.result.files['aggregate/history.csv']);
    if (turn !== this.turn) return null; // cancelled meanwhile
    this.result = foundOf(ended.result, 'aggregate');
    this.watch(this.result.files['aggregate/state.h5']);
    this.showEnd();
    this.showCommand('aggregate/history.csv', hash);
    return null;
  }

  /// A checkpoint: the newest is drawn with the next frame.
  hear(name, bytes) {
    if (!/^aggregate\/checkpoint-\d+\.h5$/.test(name)) return;
    const isWaiting = Boolean(this.latest);
    this.latest = bytes;
    if (!isWaiting) requestAnimationFrame(() => { if (this.latest) this.watch(this.latest); this.latest = null; });
  }

  watch(bytes) {
    const state = new State(bytes);
    this.history = state.table('history');
    this.draw(state);
    const last = this.history.n.length - 1;
    Object.assign(this.$('moment'), { max: last, value: last, disabled: false });
    this.showMoment(last);
  }

  /// The aggregate as it was when so many particles were placed.
  show(n) {
    this.$('moment').value = n;
    if (this.view?.renderer && this.view.parts) {
      this.view.parts.grow.value = this.history.n_grain[n];
      this.view.parts.grow.dispatchEvent(new Event('input'));
    }
    this.showMoment(n);
  }

  /// The last row up to n in which an envelope was measured.
  measured(n) {
    let k = n;
    while (k > 0 && !Number.isFinite(this.history.d_agg_m[k])) k -= 1;
    return k;
  }

  showMoment(n) {
    const h = this.history;
    const k = this.measured(n);
    const envelopes = Object.keys(h).filter((name) => name.startsWith('porosity_'));
    const speed = h['settling_velocity_m/s'];
    this.$('figures').replaceChildren(
      figure(String(h.n_grain[n]), `grain${h.n_grain[n] === 1 ? '' : 's'}${this.words.includes('--core') ? ', with the core' : ''}`),
      figure(withUnit(h.d_agg_m[k], 'm'), 'equivalent diameter'),
      figure(h[envelopes[0]][k].toFixed(4), `porosity in its ${envelopes[0].slice(9).replace('_', ' ')}`),
      figure(`${h['density_kg/m^3'][k].toFixed(0)} kg/m\u00b3`, 'density'),
      ...(speed ? [figure(withUnit(speed[k], 'm/s'), 'fall speed in air')] : []));
    this.$('moment').setAttribute('aria-valuetext', `${h.n[n]} of ${h.n[h.n.length - 1]} particles placed`);
    const all = this.result?.json.n_repeat ?? 1;
    this.$('when').textContent = `${h.n[n]} of ${h.n[h.n.length - 1]} placed${all > 1 ? `, the first of ${all} aggregates` : ''}`;
    const x = { title: 'particles placed (-)', values: h.n, from: 0 };
    drawChart(this.$('porosity'), { title: 'Porosity', x, y: { title: 'porosity (-)', from: 0 }, mark: h.n[n],
      lines: envelopes.map((name) => ({ name: name.slice(9).replace('_', ' '), values: h[name].map((v) => v) })) });
    drawChart(this.$('density'), { title: 'Density', x, y: { title: 'density (kg/m\u00b3)' }, mark: h.n[n], lines: [{ name: 'density', values: h['density_kg/m^3'] }] });
    this.$('speed').replaceChildren();
    if (!speed) return;
    const [factor, unit] = speed.some((v) => v >= 1) ? [1, 'm/s'] : [1e3, 'mm/s'];
    drawChart(this.$('speed'), { title: 'Fall speed in air', x, y: { title: `fall speed (${unit})` }, mark: h.n[n], lines: [{ name: 'fall speed', values: Array.from(speed, (v) => factor * v) }] });
  }

  showEnd() {
    const r = this.result.json;
    const { interval } = r;
    const ofMean = interval ? [`${100 * interval.confidence} % interval of the mean`] : [];
    const row = (name, write, value, limits) => [name, write(value), ...ofMean.map(() => (limits ? `${write(limits.low)} to ${write(limits.high)}` : ''))];
    const length = (v) => withUnit(v, 'm', 5);
    fillTable(this.$('envelopes'), ['envelope', 'volume (mm\u00b3)', 'porosity', ...ofMean],
      Object.keys(r.envelope).map((name) => [name.replace('_', ' '), short(r.envelope[name] * 1e9), ...row('', (v) => v.toFixed(5), r.porosity[name], interval?.porosity[name]).slice(1)]));
    fillTable(this.$('numbers'), [interval ? `mean of ${r.n_repeat} aggregates` : 'of the whole aggregate', '', ...ofMean], [
      ['grains', 'n_grain', short], ['mass', 'mass', (v) => withUnit(v * 1e3, 'g')], ['equivalent diameter', 'd_agg', length],
      ['density', 'density', (v) => `${short(v)} kg/m\u00b3`], ['fall speed in air', 'settling_velocity', (v) => withUnit(v, 'm/s', 5)], ['radius of gyration', 'radius_of_gyration', length],
      ['deepest overlap', 'max_overlap', length], ['without a place', 'n_lost', short]].map(([name, key, write]) => row(name, write, r[key], interval?.[key])));
  }

  listen() {
    super.listen();
    this.$('moment').addEventListener('input', () => this.show(Number(this.$('moment').value)));
    this.$('rewind').addEventListener('click', () => this.rewind());
    this.changed();
  }

  /// Grows once more before the eyes, in about six seconds.
  rewind() {
    if (!this.history) return;
    this.replaying = !this.replaying;
    const begun = performance.now();
    const last = this.history.n.length - 1;
    const step = (now) => {
      const share = Math.min(1, Math.max(0, now - begun) / 6000);
      if (!this.replaying || this.running) { this.replaying = false; return; }
      const to = Math.round(share * last);
      if (to !== Number(this.$('moment').value)) this.show(to);
      if (share < 1) requestAnimationFrame(step); else this.replaying = false;
    };
    requestAnimationFrame(step);
  }
}
