"""clast-live.html, one file that opens from disk: make_live.py BUILD writes BUILD/clast-live.html from web/live, the report's style and BUILD/npm.

The script that runs is named by its digest in the page's policy; the worker's script and clast.wasm stand in it compressed; nothing is fetched."""
import base64
import gzip
import hashlib
import html
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIMIT = 3_000_000
SCRIPTS = ("common", "chart", "state", "room", "grow", "pour", "split", "main")  # one after the other
LAST = "old"  # a script of its own: an old browser reads it though it cannot read the others
GRAINS = ("grain00.ply", "grain12.ply", "grain31.ply", "grain47.ply")  # of data/standin63
ICON = "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E%3Ccircle cx='6' cy='9' r='5' fill='%230072b2'/%3E%3Ccircle cx='12' cy='4' r='3' fill='%23e69f00'/%3E%3C/svg%3E"


def inside(text):
    """A script's text as an element of the page may hold it."""
    if "</script" in text.lower() or "<!--" in text:
        sys.exit("make_live: a script holds the end of its own element")
    return text


def bare(script):
    """A script without indentation and lines of comment, which this repository keeps."""
    return re.sub(r"^ *(//.*\n)?", "", script, flags=re.M)


def packed(data):
    """In base 85, a sixteenth shorter than base 64, with "," for "<", which could end the element."""
    return base64.b85encode(gzip.compress(data, 9, mtime=0)).decode().replace("<", ",")


def page(build):
    web = ROOT / "web"
    scripts = ["\n" + inside(bare("\n".join((web / f"live/{name}.js").read_text() for name in names))) for names in (SCRIPTS, (LAST,))]
    digests = " ".join(f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'" for script in scripts)
    policy = (f"default-src 'none'; script-src {digests} blob: 'wasm-unsafe-eval'; worker-src blob:; style-src 'unsafe-inline'; "
              "img-src data: blob:; connect-src blob:; base-uri 'none'; form-action 'none'")
    program = packed((build / "npm/clast.wasm").read_bytes())
    worker = (build / "clast-core.js").read_text() + "\n" + bare((web / "wasm/command.js").read_text() + (web / "live/worker.js").read_text())
    viewer = packed((web / "dist/view.js").read_bytes())
    grains = [f'<script type="text/plain" data-grain="{name}">{packed((ROOT / "data/standin63" / name).read_bytes())}</script>' for name in GRAINS]
    version = json.loads((build / "npm/package.json").read_text())["version"]
    style = (web / "page.css").read_text() + (web / "live/live.css").read_text()
    body = (web / "live/page.html").read_text().replace("{version}", html.escape(version))
    notice = (build / "npm/NOTICE.txt").read_text()
    return "\n".join([
        '<!doctype html>', '<html lang="en">', '<head>', '<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">', '<meta name="color-scheme" content="light dark">',
        '<title>clast live</title>', f'<link rel="icon" href="{ICON}">', f"<style>\n{style}</style>", '</head>', '<body>', body,
        f'<footer><details><summary>Licences</summary><pre>{html.escape((ROOT / "LICENSE").read_text() + chr(10) + (web / "dist/LICENSE-three.txt").read_text() + chr(10) + notice)}</pre></details></footer>',
        f'<script type="text/plain" id="clast-worker">{packed(worker.encode())}</script>',
        f'<script type="text/plain" id="clast-view">{viewer}</script>', *grains,
        f'<script type="text/plain" id="clast-wasm">{program}</script>', *(f"<script>{script}</script>" for script in scripts), '</body>', '</html>', ''])


def main():
    build = pathlib.Path(sys.argv[1])
    made = page(build).encode()
    (build / "clast-live.html").write_bytes(made)
    print(f"{build / 'clast-live.html'}: {len(made) / 1e3:.0f} kB")
    if len(made) > LIMIT:
        sys.exit(f"make_live: the page has {len(made)} bytes, more than {LIMIT}")


if __name__ == "__main__":
    main()
