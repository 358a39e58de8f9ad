// ClastWorkers under node: workers.mjs PACKAGE CORES -> {one, many, same, ...}: seconds of runs one after the other and side by side; what aborted ones say, the files they tell of, a check's no.
import { pathToFileURL } from 'node:url';

const { load, loadWorkers } = await import(pathToFileURL(`${process.argv[2]}/clast.mjs`).href);
const bed = { curve: '4mm', mass: '1g', width: '20mm', height: '30mm', shaking_time: '0.01s', max_steps: 12000 };
const seeds = [1, 2];
const clast = await load();
const workers = await loadWorkers(undefined, Number(process.argv[3]));
const alone = [];
let begun = performance.now();
for (const seed of seeds) alone.push((await clast.pack({ ...bed, seed })).state_hash);
const one = (performance.now() - begun) / 1e3;
begun = performance.now();
let heard = 0;
const beside = await Promise.all(seeds.map((seed) => workers.pack({ ...bed, seed }, { onProgress: () => { heard += 1; } })));
const many = (performance.now() - begun) / 1e3;
const stop = new AbortController();
const long = (signal) => workers.pack({ ...bed, max_steps: 1000000, shaking_time: '5s' }, { signal }).then(() => 'done', (fault) => fault.name);
const stopped = long(stop.signal);
await new Promise((go) => { setTimeout(go, 300); });
stop.abort();
const aborted = await Promise.race([stopped, new Promise((done) => { setTimeout(done, 0, 'a turn later'); })]); // what is told at once comes before any timer
const [all, last] = [new AbortController(), new AbortController()];
const order = [];
const row = [...Array(workers.most).fill(all.signal), last.signal].map((signal, k) => long(signal).then((name) => { order.push(k); return name; }));
last.abort(); // it waits for a worker yet, and ends before those that have one
await row[workers.most];
all.abort();
const waiting = [order[0] === workers.most, ...new Set(await Promise.all(row)), workers.busy];
const named = async (runner) => {
  const names = [];
  const { status, files } = await runner.run(['pack', '--curve', '4mm', '--mass', '1g', '--width', '20mm', '--height', '30mm', '--max-steps', '2000', '-o', 'bed'],
    { onFile: (path, bytes) => names.push(`${path} ${bytes.length > 0}`) });
  return [status, Object.keys(files).length, ...names];
};
const files = [await named(clast), await named(workers)];
const no = await workers.json(['decompose', 'p.csv', '--test-only', '--domain=box:0,0,3481,59'], { files: { 'p.csv': `x,y\n${[...Array(60).keys()].map((k) => `${k * k},${k}`).join('\n')}\n` } });
const few = await clast.decompose('x,y\n0.1,0.1\n0.4,0.3\n0.2,0.3\n0.7,0.6\n0.9,0.2\n0.3,0.8\n', { domain: 'box:0,0,5000,5000' });
const warned = [few.messages, JSON.parse(new TextDecoder().decode(few.files['cells/manifest.json']))];
const refused = await workers.pack({ curve: '4' }).then(() => 'done', (fault) => fault.name);
process.stdout.write(JSON.stringify({ one, many, same: alone.every((hash, k) => hash === beside[k].state_hash), heard, aborted, waiting, refused, files, no, warned }));
