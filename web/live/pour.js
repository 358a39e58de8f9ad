// The tab Pour: `clast pack` in short runs, each gone on with from the state of the one before, which changes no bit of the end.
const SLICE = 0.35; // s of computing between two pictures
const SLOW_STEPS = 200;
const SLOW_PAUSE = 125; // ms
const MAX_STEPS = /^--max[-_]steps(=|$)/;
const KEPT = { frames: 240, bytes: 96e6 }; // pictures that can be gone back to
const FROM_UNIT = new Map(Object.entries({ nm: 1e-9, um: 1e-6, '\u00b5m': 1e-6, mm: 1e-3, cm: 1e-2, m: 1, mg: 1e-6, g: 1e-3, kg: 1, t: 1e3, 'kg/m^3': 1, 'g/cm^3': 1e3 }));

/// A value with its unit in SI, or NaN: for estimates alone, clast reads the text itself.
function siOf(text) {
  const match = /^([\d.eE+-]+)\s*([^\d\s]\S*)?$/.exec(text.trim());
  return match ? Number(match[1]) * (match[2] === undefined ? 1 : FROM_UNIT.get(match[2]) ?? NaN) : NaN;
}

class PourRoom extends Room {
  constructor() {
    super('pour');
    this.command = 'pack';
    this.most = 50000;
    this.frames = [];
    this.colour = 'speed';
  }

  listFiles() {
    const own = [...this.files.keys()];
    this.setOptions('curve', [['one', 'one size'], ['uniform', 'uniform between two sizes'], ['lognormal', 'lognormal'],
      ...['U1', 'U3', 'U5', 'U7', 'B30', 'B50', 'B70'].map((name) => [name, `published curve ${name}`]), ...own.filter((name) => this.isTable(name)).map((name) => [name, `${name}: sieve curve`])]);
    this.setOptions('shape', [['sphere', 'spheres'], ['ellipsoid', 'ellipsoids'], ...[...GRAINS.keys()].map((name) => [name, `${GRAIN_NAMES[name]}, convex hull (${name})`]),
      ...own.filter((name) => this.isSurface(name)).map((name) => [name, `${name}, convex hull`])]);
    this.$('given').textContent = own.length > 0 ? `own files: ${own.join(', ')}` : '';
  }

  given(name) {
    this.$(this.isTable(name) ? 'curve' : 'shape').value = name;
  }

  changed() {
    const curve = this.value('curve');
    this.$('size_row').hidden = !['one', 'uniform', 'lognormal'].includes(curve);
    this.$('spread_row').hidden = !['uniform', 'lognormal'].includes(curve);
    for (const id of ['flatness_row', 'elongation_row']) this.$(id).hidden = this.value('shape') !== 'ellipsoid';
    this.$('unit_row').hidden = ['sphere', 'ellipsoid'].includes(this.value('shape'));
  }

  /// The curve as the command takes it; sizes with the unit that is typed.
  curve() {
    const kind = this.value('curve');
    const size = this.value('size');
    const [, number, unit] = /^([\d.eE+-]+)\s*(\S*)$/.exec(size) ?? [null, size, ''];
    const with_ = (factor) => `${Number((Number(number) * factor).toPrecision(6))}${unit}`;
    const spread = Number(this.value('spread')) / 100;
    if (kind === 'one') return size;
    if (kind === 'uniform') return `uniform:${with_(1 - spread)},${with_(1 + spread)}`;
    if (kind === 'lognormal') return `lognormal:${size},${with_(spread)}`;
    return kind;
  }

  shape() {
    if (this.value('shape') !== 'ellipsoid') return this.value('shape');
    const elongation = Number(this.value('elongation'));
    return `ellipsoid:1,${Number(elongation.toPrecision(4))},${Number((elongation * Number(this.value('flatness'))).toPrecision(4))}`;
  }

  wordsNow() {
    const words = ['pack', '--curve', this.curve(), '--shapes', this.shape()];
    const add = (option, value) => { if (value !== '') words.push(option, value); };
    if (!this.$('unit_row').hidden) add('--unit', this.value('unit'));
    for (const name of ['density', 'mass', 'domain', 'width', 'height', 'friction', 'restitution', 'shake_amplitude', 'shaking_time', 'seed']) {
      add(`--${name.replace('_', '-')}`, this.value(name));
    }
    return [...words, ...this.more(), '-o', 'bed'];
  }

  /// About how many grains the form asks for; of a curve that has no one size clast is asked. NaN: not known.
  estimate() {
    const [mass, density] = [this.value('mass'), this.value('density')];
    if (this.$('size_row').hidden) {
      return this.engine.run(['grading', this.curve(), '--mass', mass, '--density', density, '--json'], this.inputs)
        .then(({ result }) => (result?.status === 0 ? JSON.parse(result.stdout).n_expected : NaN));
    }
    const size = siOf(this.value('size'));
    return siOf(mass) / (siOf(density) * (Math.PI / 6) * size ** 3);
  }

  /// More options without --max-steps, which each slice has of its own.
  more() {
    const words = super.more();
    return words.filter((word, k) => !MAX_STEPS.test(word) && !/^--max[-_]steps$/.test(words[k - 1] ?? ''));
  }

  /// Reads how many steps are wanted, in a configuration, their field or among more options, where the last counts, as in a terminal; 0: no limit.
  /// A refusal is the command's own.
  async readLimit() {
    const configuration = this.words.find((word) => CONFIGURATION.test(word) && this.inputs[word]);
    this.configured = configuration && /^max_steps\s*:\s*["']?([^\s"'#]+)/m.exec(textOf(this.inputs[configuration]))?.[1];
    const text = [this.value('max_steps') || this.configured || '0', ...this.givenIn(super.more(), 'max-steps')].pop();
    this.limit = Number(text) || Infinity;
    if (/^\+?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) && Number.isInteger(Number(text)) && Number(text) <= 9e15) return null;
    const ended = await this.engine.run([...this.words, `--max-steps=${text}`], this.inputs);
    return refusalOf(ended) ?? `--max-steps ${text}: a whole number of steps is wanted`;
  }

  async compute() {
    this.frames = [];
    this.every = 1;
    this.seen = 0;
    this.fixed = null;
    this.slice = SLOW_STEPS;
    return await this.readLimit() ?? this.pour(this.words);
  }

  /// Goes on from the bed that stopped.
  async goOn() {
    if (this.running || !this.result) return;
    this.fail('');
    this.running = true;
    this.begun = performance.now() - 1e3 * this.spent;
    this.setReady();
    this.say('computing');
    const refusal = await this.told((async () => await this.readLimit() ?? this.pour(['pack', '--resume', 'bed']))());
    this.ended(refusal);
  }

  ended(refusal) {
    this.running = false;
    this.spent = this.seconds();
    this.setReady();
    const { json } = this.result ?? {};
    this.say(refusal ? '' : (json?.phase !== 'done' ? 'stopped' : json.still_moving ? 'the bed is level, its grains still move' : 'the bed is at rest') + (json ? warned(this.result) : ''));
    if (refusal) this.refuse(refusal);
  }

  /// Slice after slice, until the bed is at rest, the steps are done or it is stopped.
  async pour(first) {
    let words = first;
    this.stopped = false;
    for (;;) {
      const done = this.result?.json.n_step ?? 0;
      const to = Math.min(done + this.slice, this.limit);
      const begun = performance.now();
      const given = { ...this.inputs, ...this.result?.files };
      const ended = await this.engine.run([...words, '--max-steps', String(to)], given);
      const refusal = refusalOf(ended);
      if (refusal) return refusal;
      const { stderr } = ended.result;
      if (!this.result) this.heard = stderr; // what is told at the beginning alone
      else if (!this.heard.includes(stderr)) this.heard += stderr;
      this.result = foundOf({ ...ended.result, stderr: this.heard, files: { ...this.result?.files, ...ended.result.files } }, 'bed');
      const seconds = (performance.now() - begun) / 1000;
      const { json } = this.result;
      this.rate = (json.n_step - done) / seconds;
      this.watch();
      if (json.phase === 'done' || json.n_step >= this.limit || this.stopped) { this.showEnd(); return null; }
      await this.pause();
      if (this.stopped) { this.showEnd(); return null; }
      this.slice = this.nextSlice(this.result);
      words = ['pack', '--resume', 'bed'];
    }
  }

  /// Steps that take SLICE, by what a step of a grain took; at most four times as many as before.
  nextSlice({ json, said }) {
    if (this.value('pace') !== 'fast') return SLOW_STEPS;
    const step = Number(/(\S+) ns a grain-step/.exec(said)?.[1]) * 1e-9 * Math.max(json.n_grain, 1);
    return Math.round(Math.min(4 * this.slice, Math.max(SLOW_STEPS, step > 0 ? SLICE / step : 0)));
  }

  /// Between two pictures: nothing, a while, or until Step is pressed.
  async pause() {
    const pace = this.value('pace');
    if (pace === 'fast') return;
    this.$('step').disabled = pace !== 'step';
    if (pace === 'step') this.say('waiting for Step');
    await new Promise((done) => {
      this.proceed = done;
      if (pace === 'slow') setTimeout(done, SLOW_PAUSE);
    });
    this.proceed = null;
    this.$('step').disabled = true;
    if (!this.stopped) this.say('computing');
  }

  /// Ends at once: what was poured by the last picture is the result.
  cancel() {
    if (!this.running) return;
    this.stopped = true;
    if (this.proceed) { this.proceed(); return; }
    this.engine.cancel();
    if (this.result) this.showEnd();
    this.ended(null);
    if (!this.result) this.say('cancelled');
  }

  setReady() {
    super.setReady();
    this.$('goon').disabled = Boolean(this.running) || !this.engine.isReady || !this.result || this.result.json.phase === 'done';
    if (!this.running) this.$('step').disabled = true;
  }

  /// Keeps the picture, every second one where they become many.
  keep(state) {
    if (this.seen % this.every === 0) this.frames.push(state);
    this.seen += 1;
    if (this.frames.length > KEPT.frames || this.frames.length * state.bytes.length > KEPT.bytes) {
      this.frames = this.frames.filter((_, k) => k % 2 === 0);
      this.every *= 2;
    }
  }

  watch() {
    const state = new State(this.result.files['bed/state.h5']);
    const { json } = this.result;
    if (!this.fixed && json.n_grain > 0) {
      const { position, reach, n } = grainsOf(state);
      let [top, side] = [0, 0];
      for (let i = 0; i < n; i += 1) {
        top = Math.max(top, position[3 * i + 2] + reach[i]);
        side = Math.max(side, Math.abs(position[3 * i]) + reach[i], Math.abs(position[3 * i + 1]) + reach[i]);
      }
      this.fixed = { centre: [0, 0, top / 2], length: Math.max(top / 2, side) };
    }
    this.keep({ bytes: this.result.files['bed/state.h5'], time: json.time });
    this.draw(state);
    const last = this.frames.length - 1;
    Object.assign(this.$('moment'), { max: last, value: last, disabled: false });
    this.showTime(json.time);
    this.showNumbers();
  }

  showTime(time) {
    this.$('when').textContent = `at ${withUnit(time, 's')} of the simulation`;
    this.$('moment').setAttribute('aria-valuetext', this.$('when').textContent);
  }

  back(k) {
    this.draw(new State(this.frames[k].bytes));
    this.showTime(this.frames[k].time);
  }

  showNumbers() {
    const { json, files } = this.result;
    const text = (name) => new TextDecoder().decode(files[name]);
    const phases = { generate: 'filling', shake: 'shaking', damp: 'damping', done: json.still_moving ? 'level' : 'at rest' };
    this.$('figures').replaceChildren(
      figure(json.n_grain.toLocaleString('en'), json.n_grain === 1 ? 'grain' : 'grains'),
      figure(withUnit(json.time, 's'), `${phases[json.phase] ?? json.phase}, step ${json.n_step.toLocaleString('en')}`),
      figure(json.porosity_bulk === null ? 'no bed yet' : json.porosity_bulk.toFixed(4), 'bulk porosity'),
      figure(short(Number(json.coordination.toPrecision(3))), 'touching grains a grain'),
      figure(withUnit(json.max_speed, 'm/s', 3), 'fastest grain'),
      figure(Math.round(this.rate).toLocaleString('en'), 'steps a second here'));
    if (files['bed/profile.csv']) {
      const profile = columnsOf(text('bed/profile.csv'));
      drawChart(this.$('profile'), { title: 'Porosity over the height', x: { title: 'porosity (-)', values: profile.porosity ?? [], from: 0 }, y: { title: 'height (mm)', from: 0 },
        lines: [{ name: 'height', values: (profile.z_low_m ?? []).map((z, i) => 500 * (z + profile.z_high_m[i])) }] });
    }
    const series = columnsOf(text('bed/series.csv'));
    const x = { title: 'time (s)', values: series.time_s ?? [], from: 0 };
    drawChart(this.$('level'), { title: 'Height of the bed', x, y: { title: 'height (mm)', from: 0 },
      lines: [{ name: 'highest grain', values: (series.top_m ?? []).map((z) => 1e3 * z) }, { name: 'mean of the grains', values: (series.mean_height_m ?? []).map((z) => 1e3 * z) }] });
    drawChart(this.$('energy'), { title: 'Motion', x, y: { title: 'kinetic energy (log\u2081\u2080 J)' },
      lines: [{ name: 'kinetic energy', values: (series.kinetic_energy_J ?? []).map((e) => (e > 0 ? Math.log10(e) : NaN)) }] });
  }

  showEnd() {
    const { json } = this.result;
    const isWhole = json.phase === 'done';
    if (isWhole && this.view?.renderer) {
      this.fixed = null;
      this.draw(new State(this.result.files['bed/state.h5']));
      this.view.frame();
      this.view.draw();
    }
    this.words = [...this.wordsOfRun(), ...(isWhole && !this.configured ? [] : ['--max-steps', isWhole ? '0' : String(json.n_step)])];
    fillTable(this.$('numbers'), ['of the bed', ''], [['grains', short(json.n_grain)], ['mass', withUnit(json.mass * 1e3, 'g')], ['bulk porosity', short(json.porosity_bulk)],
      ['porosity with nothing left out', short(json.porosity_untrimmed)], ['touching grains a grain', short(json.coordination)], ['contacts of grains', short(json.n_contact)],
      ['contacts with walls', short(json.n_wall_contact)], ['deepest overlap', withUnit(json.max_overlap, 'm')], ['fastest grain', withUnit(json.max_speed, 'm/s')],
      ['converged', json.converged ? 'yes' : 'no']]);
    this.showCommand('the state hash that it prints', json.state_hash);
  }

  /// The words of the run, without a limit of steps.
  wordsOfRun() {
    const at = this.words.indexOf('--max-steps');
    return at < 0 ? this.words : [...this.words.slice(0, at), ...this.words.slice(at + 2)];
  }

  listen() {
    super.listen();
    this.$('goon').addEventListener('click', () => this.goOn());
    this.$('step').addEventListener('click', () => this.proceed?.());
    this.$('pace').addEventListener('change', () => { if (this.proceed && this.value('pace') !== 'step') this.proceed(); });
    this.$('moment').addEventListener('input', () => { if (!this.running) this.back(Number(this.$('moment').value)); });
    this.changed();
  }
}
