// Files of any name go in and come out: names.mjs PACKAGE -> {name: [status, what differs]}.
import { pathToFileURL } from 'node:url';

const { load, columnsOf } = await import(pathToFileURL(`${process.argv[2]}/clast.mjs`).href);
const clast = await load();
const points = new TextEncoder().encode('x,y\n0.1,0.1\n0.4,0.3\n0.7,0.6\n');
const told = new Map([['empty', Object.keys(columnsOf('')).length]]);
for (const name of ['hasOwnProperty', '__proto__', 'constructor', 'toString', 'valueOf']) {
  const files = Object.fromEntries([[name, points]]);
  const read = await clast.run(['decompose', name, '--domain=box:0,0,1,1', '--json', '-o', 'cells'], { files });
  const written = await clast.run(['decompose', 'points.csv', '--domain=box:0,0,1,1', '--json', '-o', name], { files: { 'points.csv': points } });
  const whole = ['decompose', 'p', '--domain=box:0,0,1,1', '-o', 'cells'];
  const plain = await clast.run([...whole, '--json'], { files: { p: points } });
  const cells = (result, folder) => Object.hasOwn(result.files, `${folder}/cells.csv`) && new TextDecoder().decode(result.files[`${folder}/cells.csv`]);
  const same = (text) => text !== false && text === cells(plain, 'cells');
  told.set(name, [read.status, written.status, same(cells(read, 'cells')), same(cells(written, name)), Object.hasOwn(read.files, name)]);
}
process.stdout.write(JSON.stringify(Object.fromEntries(told)));
