// Runs command lines with clast.wasm under node: run.mjs PACKAGE < jobs.json, [{words, files: {name: path}}] -> [{status, stdout, stderr, files: {name: sha256}}].
import { createHash } from 'node:crypto';
import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';

const { load } = await import(pathToFileURL(`${process.argv[2]}/clast.mjs`).href);
let text = '';
for await (const part of process.stdin) text += part;
const clast = await load();
const results = [];
for (const { words, files } of JSON.parse(text)) {
  const given = {};
  for (const [name, path] of Object.entries(files)) given[name] = await readFile(path);
  const result = await clast.run(words, { files: given });
  const digests = Object.entries(result.files).map(([name, bytes]) => [name, createHash('sha256').update(bytes).digest('hex')]);
  results.push({ ...result, files: Object.fromEntries(digests) });
}
process.stdout.write(JSON.stringify(results));
