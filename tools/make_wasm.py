"""The npm package of a WebAssembly build: make_wasm.py BUILD NATIVE writes BUILD/npm from BUILD/clast-core.{js,wasm}, web/wasm and
the options that `NATIVE describe --json` names."""
import gzip
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHOWN = ("aggregate", "pack", "shape", "decompose")
TYPES = {"integer": "number", "flag": "boolean", "text": "string", "texts": "string | string[]"}
ASKED = ("m", "rad")  # units without which the command takes no number
# What is linked in, with the file of its terms in its sources.
LINKED = (("qhull", "COPYING.txt"), ("jansson", "LICENSE"), ("libyaml", "License"), ("zlib", "zlib.h"), ("libpng", "LICENSE"),
          ("pixman", "COPYING"), ("cairo", "COPYING"), ("cairo", "COPYING-MPL-1.1"), ("glibc", "COPYING.LIB"))

HEAD = """// Types of clast.mjs, from `clast describe --json` of clast {version} by tools/make_wasm.py.

/** Files by path, relative to where the command line runs. */
export type Files = Record<string, string | Uint8Array>;

export interface Progress {{ phase: string; done: number; total: number | null }}

export interface How {{
  files?: Files;
  /** Called while the command runs, at most five times a second. */
  onProgress?: (progress: Progress) => void;
  /** Called with each file that the run has written whole while it goes on: checkpoints, tables. */
  onFile?: (path: string, bytes: Uint8Array) => void;
  /** Of ClastWorkers: ends the run at once, which then rejects with the signal's reason. */
  signal?: AbortSignal;
}}

export interface Result {{
  /** Exit code: 0 done, 1 a check answered no, 2 usage, 3 bad input, 4 memory or disk, 5 did not converge. */
  status: number;
  stdout: string;
  stderr: string;
  /** What the command wrote. */
  files: Record<string, Uint8Array>;
}}

/** The object of --json, in SI; files, the command line that repeats it in a terminal, and the lines that it warns by. */
export type Json = Record<string, any> & {{ files: Record<string, Uint8Array>; command: string; messages: string[] }};

export class ClastError extends Error {{
  words: string[];
  status: number;
  result: Result;
}}

export interface Columns {{ [name: string]: Float64Array }}
export type Points = string | Uint8Array | Record<string, ArrayLike<number>>;

/** A length or an angle as it is typed in a terminal, with its unit: '30um', '45deg'. */
export type Quantity = string;
"""

TAIL = """
export class Clast {{
  constructor(program: WebAssembly.Module);
  run(words: string[], how?: How): Promise<Result>;
  json(words: string[], how?: How): Promise<Json>;
  aggregate(options?: AggregateOptions, how?: How): Promise<Json>;
  pack(options?: PackOptions, how?: How): Promise<Json & {{ state_hash: string }}>;
  shape(files: Files, options?: ShapeOptions, how?: How): Promise<Json & {{ grains: Record<string, any>[] }}>;
  decompose(points: Points, options?: DecomposeOptions, how?: How): Promise<Json & {{ cells: Columns; point_cells: Columns }}>;
}}

/** Each command line in a worker of its own, at most `most` at a time. */
export class ClastWorkers extends Clast {{
  constructor(program: WebAssembly.Module, most: number);
}}

export function load(source?: BufferSource | Response | WebAssembly.Module): Promise<Clast>;
export function loadWorkers(source?: BufferSource | Response | WebAssembly.Module, most?: number): Promise<ClastWorkers>;
export function wordsOf(options?: object): string[];
export function commandLine(words: string[]): string;
export function tableOf(points: Points): string | Uint8Array;
export function columnsOf(text: string): Columns;
"""


def type_of(field):
    if field["choices"] is not None:
        return " | ".join(f"'{choice}'" for choice in field["choices"].split("|"))
    if field["type"] in TYPES:
        return TYPES[field["type"]]
    one = "Quantity" if field["unit"] in ASKED else "number" if field["unit"] == "-" else "number | string"
    return f"{one} | ({one})[]" if field["type"] == "numbers" else one


def options_of(command):
    name = command["name"].title().replace(" ", "")
    lines = [f"\n/** Options of `clast {command['name']}`: {command['doc']}. */", f"export interface {name}Options {{"]
    for field in command["fields"]:
        unit = "" if field["unit"] == "-" else f" [{field['unit']}]"
        text = f"{field['doc']}{unit}".replace("*/", "* /")
        lines.append(f"  /** {text} */\n  {field['name']}?: {type_of(field)};")
    return "\n".join([*lines, "}"]) + "\n"


def declarations(described):
    commands = {command["name"]: command for command in described["commands"]}
    return HEAD.format(version=described["version"]) + "".join(options_of(commands[name]) for name in SHOWN) + TAIL.format()


def package(version):
    return {"name": "clast", "version": version, "description": "Particles that stick, settle and cluster: clast in WebAssembly",
            "license": "BSD-3-Clause", "type": "module", "main": "clast.mjs", "types": "clast.d.ts",
            "exports": {".": {"types": "./clast.d.ts", "default": "./clast.mjs"}, "./clast.wasm": "./clast.wasm"},
            "files": ["clast.mjs", "clast.d.ts", "clast.wasm", "LICENSE", "NOTICE.txt"], "private": True}


def notice(sources):
    """The terms of what is linked in; zlib's and Random123's stand in their headers' first comments."""
    parts = ["clast.wasm holds, beside clast and the C library of emscripten (MIT), the libraries below as Debian's source packages have them."]
    for name, file in LINKED:
        text = (sources / name / file).read_text(encoding="utf-8", errors="replace")
        parts.append(f"== {name}: {file}\n\n" + (text.split("*/")[0] if file.endswith(".h") else text))
    philox = (sources.parent / "wasm/include/Random123/philox.h").read_text()
    parts.append("== Random123: philox.h\n\n" + philox.split("*/")[0])
    return "\n\n".join(parts) + "\n"


def main():
    build, native = map(pathlib.Path, sys.argv[1:3])
    described = json.loads(subprocess.run([native, "describe", "--json"], capture_output=True, text=True, check=True).stdout)
    folder = build / "npm"
    folder.mkdir(exist_ok=True)
    module = "\n".join(path.read_text() for path in (build / "clast-core.js", ROOT / "web/wasm/command.js", ROOT / "web/wasm/clast.mjs"))
    (folder / "clast.mjs").write_text(module)
    (folder / "clast.d.ts").write_text(declarations(described))
    (folder / "package.json").write_text(json.dumps(package(described["version"]), indent=2) + "\n")
    shutil.copy(build / "clast-core.wasm", folder / "clast.wasm")
    shutil.copy(ROOT / "LICENSE", folder / "LICENSE")
    (folder / "NOTICE.txt").write_text(notice(ROOT / "build/portable/sources"))
    for name in ("clast.wasm", "clast.mjs"):
        data = (folder / name).read_bytes()
        print(f"{folder / name}: {len(data) / 1e3:.0f} kB, {len(gzip.compress(data, 9)) / 1e3:.0f} kB compressed")


if __name__ == "__main__":
    main()
