// What Grow and Pour are made of: a form of options that becomes a command line, files beside it, undo, link, zip, the 3-D view.
const UNDO = 60; // states of the form that are kept
const LONG = 30; // s of work that are not lost without a question
const CONFIGURATION = /\.ya?ml$/i;

const GRAINS = new Map(); // bundled surfaces by name

class Room {
  constructor(name) {
    Object.assign(this, { name, files: new Map(), names: new Map(), past: [], turn: 0, inputs: {}, view: null, fixed: null, words: null, result: null });
    this.engine = new Engine(() => { if (!this.running) this.say('ready'); this.setReady(); }, (text) => { this.say(''); this.setReady(); this.fail(text); });
  }

  $(id) { return $(`${this.name}-${id}`); }

  say(text) { this.$('state').textContent = text; }

  fail(text) { this.$('error').textContent = text; }

  fields() { return [...this.$('form').querySelectorAll('input:not([type=file]):not([type=range]), select')]; }

  values() {
    return Object.fromEntries(this.fields().map((f) => [f.id.slice(this.name.length + 1), f.type === 'checkbox' ? f.checked : f.value]));
  }

  isTable(name) { return /\.(csv|tsv|txt)$/i.test(name); }

  isSurface(name) { return !this.isTable(name) && !CONFIGURATION.test(name); }

  /// Options of a list; what is chosen stays chosen.
  setOptions(id, options) {
    const list = this.$(id);
    const chosen = list.value;
    list.replaceChildren(...options.map(([value, text]) => new Option(text, value)));
    if (options.some(([value]) => value === chosen)) list.value = chosen;
  }

  value(id) { return this.$(id).value.trim(); }

  /// All that the address and undo keep: what is typed, and the user's own files.
  snapshot() { return { values: this.values(), files: new Map(this.files) }; }

  restore({ values, files }) {
    this.files = new Map(files);
    this.listFiles();
    for (const field of this.fields()) {
      const value = values[field.id.slice(this.name.length + 1)];
      if (value === undefined) continue;
      if (field.type === 'checkbox') field.checked = value === true;
      else field.value = String(value);
    }
    this.turnSliders();
    this.last = this.snapshot();
    this.changed?.();
  }

  /// Notes a change of the form, so that it can be undone.
  note() {
    const now = this.snapshot();
    const hasFiles = ({ files }) => files.size === now.files.size && [...files].every(([name, bytes]) => now.files.get(name) === bytes);
    if (this.last && JSON.stringify(now.values) === JSON.stringify(this.last.values) && hasFiles(this.last)) return;
    if (this.last) this.past.push(this.last);
    if (this.past.length > UNDO) this.past.shift();
    this.last = now;
    this.$('undo').disabled = this.past.length === 0;
    this.changed?.();
  }

  undo() {
    const before = this.past.pop();
    if (before) this.restore(before);
    setUndo(this.$('undo'), this.past.length > 0, this.$('run'));
    this.say('undone');
  }

  setReady() {
    setButtons(this.$('run'), this.$('cancel'), this.engine.isReady && !this.running, this.running);
  }

  // Sliders: each writes into the text beside it, with its unit; what is typed turns the slider.

  turnSliders() {
    for (const slider of this.$('form').querySelectorAll('input[type=range]')) {
      slider.setAttribute('aria-label', `${slider.previousSibling.textContent.trim()}, slider`);
      const text = $(slider.dataset.of).value;
      const number = Number.parseFloat(text);
      if (Number.isFinite(number)) slider.value = slider.dataset.log ? Math.log10(number) : number;
      slider.setAttribute('aria-valuetext', text);
    }
  }

  slide(slider) {
    const { unit = '', log } = slider.dataset;
    const number = log ? 10 ** Number(slider.value) : Number(slider.value);
    $(slider.dataset.of).value = `${Number(number.toPrecision(log ? 2 : 6))}${unit}`;
    slider.setAttribute('aria-valuetext', $(slider.dataset.of).value);
  }

  // Files.

  /// The name here of a file; where another file's has become the same, with a number.
  nameOf(file) {
    const plain = plainName(file.name, 'file');
    let name = plain;
    for (let k = 2; this.files.has(name) && (this.names.get(name) ?? name) !== file.name; k += 1) name = plain.replace(/(\.[^.]*)?$/, `_${k}$1`);
    return name;
  }

  async take(list) {
    this.fail('');
    for (const file of list) {
      const name = this.nameOf(file);
      try {
        this.files.set(name, await bytesOfFile(file, this.command));
        this.names.set(name, file.name);
        this.listFiles();
        if (CONFIGURATION.test(name)) this.fail(`${name} is a configuration: name it in More options; what stands in a field counts more`);
        else this.given(name);
      } catch (fault) {
        this.fail(fault.message);
      }
    }
    this.turnSliders();
    this.note();
  }

  /// Files and bundled grains that the words name.
  filesOf(words) {
    const named = (name) => words.some((w) => w === name || w.endsWith(`=${name}`) || w.endsWith(`:${name}`));
    return Object.fromEntries([...GRAINS, ...this.files].filter(([name]) => named(name)));
  }

  more() { return moreWords(this.value('more')); }

  /// Values that more options give to --NAME, where the last counts.
  givenIn(words, name) {
    const is = (word) => word.split('=')[0].replaceAll('_', '-') === `--${name}`;
    return words.flatMap((word, k) => (is(word) ? [word.includes('=') ? word.slice(word.indexOf('=') + 1) : words[k + 1] ?? ''] : []));
  }

  // The 3-D view.

  /// Draws a state; in a room that is not shown, once it is.
  draw(state) {
    this.$('seen').style.visibility = '';
    this.waiting = $(`room-${this.name}`).hidden ? state : null;
    if (this.waiting) return;
    const data = viewData(state, this.fixed);
    const text = { textContent: JSON.stringify(data) };
    if (data.n_grain === 0) return;
    if (this.view?.renderer) window.clastViews.replace(this.view, text);
    else {
      this.view = window.clastViews.show(this.$('view'), text, `clast ${this.name}`);
      if (!this.view) this.noView();
      else if (this.colour) {
        this.view.by = this.colour;
        this.view.parts.colour.value = this.colour;
        this.view.paint();
      }
    }
  }

  shown() { if (this.waiting) this.draw(this.waiting); }

  noView() {
    this.$('view').replaceChildren(tag('p', 'The 3-D view needs WebGL, which this browser does not give; charts, tables and files do not.', 'note'));
  }

  // Running.

  async go() {
    if (this.running) return;
    this.fail('');
    this.note();
    this.running = true;
    this.turn += 1;
    const { turn } = this;
    this.result = null;
    this.$('result').hidden = true;
    this.$('seen').style.visibility = 'hidden'; // until it is this run's
    this.$('moment').disabled = true;
    this.setReady();
    this.say('computing');
    this.begun = performance.now();
    const refusal = await this.told(this.begin());
    if (turn === this.turn) this.ended(refusal, this.seconds());
  }

  async begin() {
    this.words = this.wordsNow();
    this.inputs = this.filesOf(this.words);
    const n = this.estimate();
    return this.tooLarge(typeof n === 'number' ? n : await n) ?? this.compute();
  }

  seconds() { return (performance.now() - this.begun) / 1000; }

  /// Whether half a minute's work or more would be lost with the page.
  holds() { return this.running ? this.seconds() > LONG : Boolean(this.result) && this.spent > LONG; }

  /// What a run comes to; of one whose answer this page cannot show (to `--help`, say) the command for a terminal.
  async told(run) {
    try {
      return await run;
    } catch (fault) {
      return `this page cannot show what clast answered (${fault.message}); in a terminal: ${commandOf(this.words)}`;
    }
  }

  ended(refusal, seconds) {
    this.running = false;
    this.spent = seconds;
    this.setReady();
    this.say(refusal ? '' : `done after ${seconds.toFixed(2)} s${warned(this.result)}`);
    if (refusal) this.refuse(refusal);
  }

  /// Why a page does not begin with the scene, or null.
  tooLarge(n) {
    if (!(n > this.most && n < Infinity)) return null;
    return `about ${Number(n.toPrecision(2)).toLocaleString('en')} grains are more than the ${this.most.toLocaleString('en')} of this page (one thread, 2 GB); in a terminal: ${commandOf(this.words)}`;
  }

  /// The command's own line; of a scene that a page cannot hold, also how large it is and where it runs.
  refuse(line) {
    const isLarge = /memory|ended by WebAssembly/.test(line);
    this.fail(isLarge ? `${line}${line.includes('terminal') ? '' : `; a page has 2 GB at the most, a terminal all of the machine: ${commandOf(this.words)}`}` : line);
  }

  cancel() {
    if (!this.running) return;
    this.engine.cancel();
    this.turn += 1;
    this.running = false;
    this.cancelled?.();
    this.setReady();
    this.say('cancelled');
  }

  showCommand(hashName, hash) {
    this.$('command').textContent = commandOf(this.words);
    this.$('hashname').textContent = hashName;
    this.$('hash').textContent = hash;
    this.$('said').textContent = this.result.said;
    this.$('result').hidden = false;
  }

  /// The run's folder, the inputs as they were when it began, and the command.
  outFiles() { return withCommand({ ...this.inputs, ...this.result.files }, this.words, `${this.$('hashname').textContent}: ${this.$('hash').textContent}`); }

  share() {
    const { values, files } = this.snapshot();
    const kept = { values, files: Object.fromEntries([...files].map(([name, bytes]) => [name, base64Of(bytes)])) };
    const word = packed(kept);
    if (word.length > MOST_SHARED) { this.say('these files are too large for an address; take the zip'); return; }
    shareWord(this, word);
  }

  open(kept) {
    this.note();
    const files = new Map(Object.entries(kept.files ?? {}).map(([name, text]) => [plainName(name, 'file'), bytesOf(text)]));
    const before = this.last;
    this.restore({ values: kept.values ?? {}, files });
    this.last = before;
    this.note();
  }

  listen() {
    const form = this.$('form');
    form.addEventListener('submit', (event) => { event.preventDefault(); if (!this.$('run').disabled) this.go(); });
    form.addEventListener('input', (event) => { if (event.target.type === 'range') this.slide(event.target); });
    form.addEventListener('change', (event) => {
      if (event.target.type === 'file') return;
      if (event.target.type !== 'range') this.turnSliders();
      this.note();
    });
    for (const input of form.querySelectorAll('input[type=file]')) input.addEventListener('change', () => { this.take([...input.files]); input.value = ''; });
    this.$('cancel').addEventListener('click', () => this.cancel());
    this.$('undo').addEventListener('click', () => this.undo());
    this.$('copy').addEventListener('click', () => copy(plainCommandOf(this.words), 'copied', (text) => this.say(text)));
    this.$('zip').addEventListener('click', () => { this.spent = 0; save(zipOf(this.outFiles()), `${this.name}.zip`); });
    this.$('share').addEventListener('click', () => this.share());
    this.listFiles();
    this.turnSliders();
    this.last = this.snapshot();
  }
}
