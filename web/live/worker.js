// clast's worker, below createClast and web/wasm/command.js. A script, no module: Chromium starts none from a blob of a page that lies on a disk.
const made = {};

onmessage = async ({ data }) => {
  if (data.program) {
    made.clast = new Clast(data.program);
    postMessage({ ready: true });
    return;
  }
  const onFile = data.watch ? (name, bytes) => postMessage({ id: data.id, file: { name, bytes } }, [bytes.buffer]) : undefined;
  try {
    postMessage({ id: data.id, result: await made.clast.run(data.words, { files: data.files, onFile }) });
  } catch (fault) {
    postMessage({ id: data.id, fault: String(fault) });
  }
};
