// The page: its rooms, one shown at a time, and what is loaded into it.
const rooms = { grow: new GrowRoom(), pour: new PourRoom(), split: splitRoom };
let shown = 'grow';

/// A module of one function in SIMD128: where it is not valid, clast is not either.
const SIMD = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11);

/// The shown room's worker, once clast is compiled; those of the other rooms would delay its first picture.
function startEngine() {
  const { engine } = rooms[shown];
  if (program && !engine.worker) engine.start();
}

function showRoom(name) {
  shown = name;
  for (const one of Object.keys(rooms)) {
    $(`room-${one}`).hidden = one !== name;
    $(`to-${one}`).setAttribute('aria-selected', String(one === name));
    $(`to-${one}`).tabIndex = one === name ? 0 : -1;
  }
  rooms[name].shown?.();
  startEngine();
  document.title = `clast live: ${$(`to-${name}`).textContent.toLowerCase()}`;
}

/// #grow=WORD: a room and all that it holds; #grow: the room alone.
function openAddress(fragment) {
  const match = /^#(grow|pour|split)(?:=([\w-]+))?$/.exec(fragment);
  if (!match) return false;
  showRoom(match[1]);
  if (match[2] === undefined) return true;
  const room = rooms[match[1]];
  try {
    room.open(unpacked(match[2]));
    room.word = match[2];
  } catch (fault) {
    room.fail(`the address of this page is damaged: ${fault.message}`);
  }
  return true;
}

function listenPage() {
  const names = Object.keys(rooms);
  for (const name of names) {
    const button = $(`to-${name}`);
    button.addEventListener('click', () => { showRoom(name); history.replaceState(null, '', `#${name}${rooms[name].word ? `=${rooms[name].word}` : ''}`); });
    button.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const next = names[(names.indexOf(name) + step + names.length) % names.length];
      $(`to-${next}`).focus();
      $(`to-${next}`).click();
    });
    rooms[name].listen();
  }
  for (const kind of ['dragover', 'dragleave', 'drop']) {
    document.addEventListener(kind, (event) => {
      event.preventDefault();
      document.querySelectorAll('.drop').forEach((box) => box.classList.toggle('over', kind === 'dragover'));
      if (kind === 'drop' && event.dataTransfer.files.length > 0) rooms[shown].take([...event.dataTransfer.files]);
    });
  }
  document.addEventListener('keydown', (event) => { // Enter that is held would go from Run to Cancel
    if (event.repeat && event.key === 'Enter' && event.target.matches('button')) event.preventDefault();
  });
  window.addEventListener('beforeunload', (event) => { if (rooms.grow.holds() || rooms.pour.holds()) event.preventDefault(); });
  window.addEventListener('hashchange', () => openAddress(location.hash));
}

/// The viewer of reports, which draws in 3-D.
async function loadViewer() {
  const script = document.createElement('script');
  script.src = URL.createObjectURL(new Blob([await bundled($('clast-view'))], { type: 'text/javascript' }));
  await new Promise((done, fail) => { script.onload = done; script.onerror = () => fail(new Error('the 3-D view did not load')); document.head.append(script); });
  URL.revokeObjectURL(script.src);
}

async function begin() {
  if (typeof WebAssembly !== 'object' || !WebAssembly.validate(SIMD) || typeof BigInt !== 'function' || typeof DecompressionStream !== 'function') return; // old.js says so
  window.clastRuns = true;
  for (const one of document.querySelectorAll('script[data-grain]')) GRAINS.set(one.dataset.grain, await bundled(one));
  listenPage();
  draw();
  showRoom('grow');
  const isGiven = openAddress(location.hash);
  const failAll = (text) => Object.values(rooms).forEach((room) => { room.say(''); room.fail(text); });
  try {
    const viewer = loadViewer();
    program = { worker: new TextDecoder().decode(await bundled($('clast-worker'))), code: await WebAssembly.compile(await bundled($('clast-wasm'))) };
    await viewer;
    startEngine();
    if (!isGiven) rooms.grow.go();
  } catch (fault) {
    failAll(`clast could not be loaded: ${fault.message}`);
  }
}

begin();
