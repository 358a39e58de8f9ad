#!/usr/bin/env python3
"""The report's 3-D view used as a person would, in headless Chromium: tools/check_view.py [--clast FILE] [--pictures FOLDER] [--renew]

Two small beds are poured and reported on one page. Looked at: a cut through a ball is a disc of the radius that geometry gives, in the
ball's colour; the grain under a point is the nearest one that the cut left, its numbers are those of grains.csv; bars of contacts are
as many as summary.json says, each grain's too; a PNG has the size that was asked for and shows what the stage shows; linked cameras
agree; every key does its thing; the time slider puts each grain where the frame for ParaView has it, and grains that the end does not have are
neither counted nor coloured as its own; colours are told apart by people who lack a kind of cone; dots, the coarse level of detail, cover
the pixels of the surfaces in their colours; what is framed stays so on a phone; pictures are those of tests/view within a tolerance (--renew makes them anew); memory after six second views is what it was; a page without WebGL keeps its words; no message on the
console, nothing fetched, no serious finding of axe-core (where it is at hand).
"""
import argparse
import base64
import csv
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

from browser import AXE, CHROMIUM, NO_WEBGL, WEBGL, Browser, axe_source, told
from picture import difference, pixel, read_png

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEDS = {"ellipsoids": ["--shapes", "ellipsoid:1,0.7,0.5"], "spheres": ["--shapes", "sphere"]}
VIEW = "clastViews.open[0]"
AXE_RUN = """axe.run(document).then(r => r.violations.filter(v => ["serious", "critical"].includes(v.impact))
    .map(v => `${v.id}: ${v.nodes[0].html.slice(0, 160)}`))"""


class Page:
    def __init__(self, browser):
        self.browser, self.faults = browser, []

    def ask(self, expression):
        return self.browser.value(expression)

    def settle(self):
        """Two frames later."""
        self.ask("new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))")

    def rest(self):
        """Until the camera has come to rest and surfaces are drawn, a minute at the most."""
        until = time.monotonic() + 60
        while self.ask(f"{VIEW}.level !== 'surfaces' || {VIEW}.isMoving === true") and time.monotonic() < until:
            self.settle()

    def press(self, key, shift=False):
        self.ask(f"{VIEW}.stage.dispatchEvent(new KeyboardEvent('keydown', {{key: {json.dumps(key)}, shiftKey: {json.dumps(shift)}, bubbles: true}}))")
        self.settle()

    def hold(self, said, what):
        if not said:
            self.faults.append(what)

    def equal(self, got, wanted, what):
        self.hold(got == wanted, f"{what}: {got}, not {wanted}")

    def close_to(self, got, wanted, tolerance, what):
        self.hold(abs(got - wanted) <= tolerance * abs(wanted), f"{what}: {got:.6g}, not {wanted:.6g} within {tolerance:.1%}")

    def picture(self, width=1200):
        """PNG of the view as rows of (r, g, b)."""
        text = self.ask(f"clastViews.drawPicture({VIEW}, {width}).toDataURL('image/png')")
        return read_png(base64.b64decode(text.split(",")[1]))


def pour(clast, folder):
    for name, arguments in BEDS.items():
        subprocess.run([clast, "pack", "--curve", "U1", *arguments, "--mass", "30g", "--width", "40mm", "--shaking-time", "0.05s", "--frame-time", "20ms",
                        "-o", folder / name, "-q"],
                       check=True, stdout=subprocess.DEVNULL)
    subprocess.run([clast, "report", folder / "ellipsoids", folder / "spheres", "-o", folder / "page.html"], check=True, stdout=subprocess.DEVNULL)


def check_pick(page, folder):
    """The grain in the middle of the picture, its numbers, and what lies behind it after a cut."""
    rows = list(csv.DictReader(open(folder / "ellipsoids/grains.csv")))
    middle = f"{VIEW}.stage.clientWidth / 2, {VIEW}.stage.clientHeight / 2"
    page.ask(f"{VIEW}.frame()")
    before = page.ask(f"clastViews.grainAt({VIEW}, {middle})")
    page.hold(before >= 0, "no grain in the middle of the picture")
    page.ask(f"clastViews.pick({VIEW}, {before}); {VIEW}.paint()")
    facts = dict(page.ask(f"[...{VIEW}.facts.querySelectorAll('tr')].map(r => [...r.children].map(c => c.textContent))"))
    row = rows[before]
    page.equal(facts["grain"], str(before), "name of the picked grain")
    page.equal(facts["shape"], row["shape"], "shape of the picked grain")
    page.equal(facts["density"], "2650 kg/m\u00b3", "density of the picked grain")
    place = [float(x) for x in facts["centroid x, y, z"].replace(" mm", "").split(", ")]
    for k, axis in enumerate("xyz"):
        page.hold(abs(place[k] * 1e-3 - float(row[f"{axis}_m"])) < 6e-6, f"{axis} of the picked grain: {place[k]} mm, not {row[f'{axis}_m']} m")
    page.press("Escape")
    page.hold(page.ask(f"{VIEW}.facts.hidden && {VIEW}.picked === -1"), "Escape does not let the grain go")
    page.press("v")
    after = page.ask(f"clastViews.grainAt({VIEW}, {middle})")
    page.hold(after != before and page.ask(f"{VIEW}.cut.axis") == "view", f"behind the cut lies grain {after} as before")
    page.press("v")


def check_contacts(page, folder):
    summary = json.loads((folder / "ellipsoids/summary.json").read_text())
    count = page.ask(f"[...{VIEW}.data.contacts.count]")
    pairs = page.ask(f"{VIEW}.data.contacts.n")
    walls = page.ask(f"[...{VIEW}.data.contacts.pair].filter(g => g === 0xffffffff).length")
    page.equal(sum(count), 2 * pairs - walls, "ends of contacts")
    page.equal([pairs - walls, walls], [summary["n_contact"], summary["n_wall_contact"]], "contacts between grains, with walls")
    page.press("f")
    page.equal(page.ask(f"[{VIEW}.chains.visible, {VIEW}.chains.count, {VIEW}.meshes[0].visible]"), [True, pairs, False], "bars of contacts")
    page.hold("N" in page.ask(f"{VIEW}.legend.textContent"), "the bar of forces has no unit")
    page.press("f")
    page.equal(page.ask(f"[{VIEW}.chains.visible, {VIEW}.meshes[0].visible]"), [False, True], "F a second time")


def check_cut(page):
    """A ball cut through at distance d from its middle is a disc of radius sqrt(R^2 - d^2)."""
    page.ask("""(() => { const v = clastViews.open[0]; window.kept = v.meshes.map(m => m.count);
        v.meshes.forEach((m, k) => { m.count = k === 0 ? 1 : 0; }); })()""")
    ball = page.ask("""(() => { const v = clastViews.open[0], p = v.meshes[0].userData.pose; const at = v.meshes[0].position.clone().set(p[0], p[1], p[2]);
        v.controls.target.copy(at); v.camera.position.copy(at).addScaledVector(at.clone().set(0.3, -0.9, 0.3).normalize(), 8 * p[8]); v.controls.update();
        return [p[0], p[1], p[2], p[8] / 2]; })()""")
    page.press("v")
    radius = page.ask(f"{VIEW}.radius")
    seen = page.ask(f"(() => {{ const n = {VIEW}.cut.normal; return {ball[0]} * n.x + {ball[1]} * n.y + {ball[2]} * n.z; }})()")
    depth = 0.5 * ball[3]
    page.ask(f"{VIEW}.parts.place.step = 'any'; {VIEW}.parts.place.value = {((seen + depth) / (radius * 1.001) + 1) / 2}; {VIEW}.parts.place.dispatchEvent(new Event('input'))")
    page.settle()
    width, height, rows = page.picture(800)
    flat = pixel(rows, width // 2, height // 2)
    across = sum(1 for x in range(width) if max(abs(a - b) for a, b in zip(pixel(rows, x, height // 2), flat)) <= 2)
    distance = 8 * 2 * ball[3]
    per_pixel = 2 * (distance - depth) * math.tan(math.radians(16)) / height
    page.close_to(across * per_pixel / 2, math.sqrt(ball[3] ** 2 - depth ** 2), 0.02, "radius of a ball's cut")
    page.press("v")
    page.ask(f"{VIEW}.meshes.forEach((m, k) => {{ m.count = kept[k]; }}); {VIEW}.frame()")


def check_keys(page):
    place = lambda: page.ask(f"{VIEW}.camera.position.toArray()")
    for key, shift in (("ArrowLeft", False), ("ArrowUp", False), ("ArrowLeft", True), ("+", False), ("-", False)):
        before = place()
        page.press(key, shift)
        page.hold(place() != before, f"key {key} does nothing")
    page.ask(f"{VIEW}.frame()")
    framed = place()
    page.press("ArrowRight")
    page.press("0")
    page.equal(place(), framed, "key 0")
    colours = set()
    for _ in range(4):
        page.press("c")
        colours.add(page.ask(f"{VIEW}.by"))
    page.equal(sorted(colours), ["coordination", "order", "shape", "size"], "colours by C")
    for axis in "xyz":
        page.press(axis)
        page.equal(page.ask(f"{VIEW}.cut.axis"), axis, f"key {axis}")
        page.press(axis)
    page.equal(page.ask(f"{VIEW}.cut.axis"), "none", "key z a second time")


def check_growth(page):
    n = page.ask(f"{VIEW}.data.n_grain")
    page.ask(f"{VIEW}.parts.grow.value = 7; {VIEW}.parts.grow.dispatchEvent(new Event('input'))")
    page.equal(page.ask(f"{VIEW}.meshes.reduce((s, m) => s + m.count, 0)"), 7, "grains shown by the slider")
    page.hold(page.ask(f"{VIEW}.note.textContent").startswith("7 of "), "the note says how many are shown")
    page.ask(f"{VIEW}.parts.grow.value = {n}; {VIEW}.parts.grow.dispatchEvent(new Event('input'))")


def field_array(text, name, kind):
    """Numbers of an array of a frame's field data."""
    packed = re.search(rf'<DataArray type="\w+" Name="{name}"[^>]*NumberOfTuples[^>]*>\s*([^<\s]+)', text).group(1)
    n = struct.unpack("<Q", base64.b64decode(packed[:12])[:8])[0]
    head_size = (3 + n) * 8
    letters = -(-head_size // 3) * 4
    sizes = struct.unpack(f"<{3 + n}Q", base64.b64decode(packed[:letters])[:head_size])[3:]
    blocks, raw = base64.b64decode(packed[letters:]), b""
    for size in sizes:
        raw, blocks = raw + zlib.decompress(blocks[:size]), blocks[size:]
    return struct.unpack(f"<{len(raw) // struct.calcsize(kind)}{kind}", raw)


def check_time(page, folder, pictures):
    frames = re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', (folder / "ellipsoids/frames.pvd").read_text())
    last = page.ask(f"Number({VIEW}.parts.time.max)")
    page.equal(last, len(frames), "moments before the end")
    end = page.ask(f"[...{VIEW}.meshes[0].userData.pose.subarray(0, 3)]")
    for k in (0, len(frames) // 2):
        page.ask(f"{VIEW}.parts.time.value = {k}; {VIEW}.parts.time.dispatchEvent(new Event('input'))")
        text = (folder / "ellipsoids" / frames[k][1]).read_text()
        place, turn = field_array(text, "position", "d"), field_array(text, "orientation_wxyz", "d")
        grain, pose = page.ask(f"[[...{VIEW}.meshes[0].userData.grain], [...{VIEW}.meshes[0].userData.pose]]")
        page.equal(grain, list(field_array(text, "grain", "q")), f"grains of frame {k}")
        unit, centre, step = page.ask(f"[{VIEW}.data.length, {VIEW}.data.centre, Math.max(...{VIEW}.data.frames.step)]")
        off = max(abs(pose[10 * i + j] - (place[3 * i + j] - centre[j]) / unit) for i in range(len(grain)) for j in range(3))
        page.hold(off < 0.6 * step + 1e-6, f"grains of frame {k} are {off:.2g} from their places")
        off = max(abs(pose[10 * i + 3 + j] - turn[4 * i + j]) for i in range(len(grain)) for j in range(4))
        page.hold(off < 0.01, f"grains of frame {k} are turned by {off:.2g} from their frame's")
        page.close_to(float(page.ask(f"{VIEW}.parts.when.textContent").split()[0]), float(frames[k][0]) * 1e3, 1e-3, "time in ms")
        page.hold(page.ask(f"{VIEW}.parts.chains.disabled"), "force chains of a moment that has none")
        page.press("0")
        page.hold(covered(page.picture(240))[0] > 0.02, f"frame {k} is not in sight after key 0")
        page.settle()
        if pictures:
            page.browser.picture(pictures / f"time-{k}.png")
    page.press(".")
    page.equal(page.ask(f"{VIEW}.moment"), len(frames) // 2 + 1, "moment after a full stop")
    page.ask(f"{VIEW}.parts.time.value = {last}; {VIEW}.parts.time.dispatchEvent(new Event('input'))")
    page.equal(page.ask(f"[...{VIEW}.meshes[0].userData.pose.subarray(0, 3)]"), end, "the first grain at the end again")
    page.hold("end" in page.ask(f"{VIEW}.parts.when.textContent"), "the last moment is not called the end")


def check_strangers(page):
    """A moment in which every third grain is none of the end's, and the others stand in another order: the sliders, colours and words keep them apart."""
    page.ask("""(() => { const v = clastViews.open[0], frame = v.data.frames.frame[0], n = v.data.n_shown;
        const text = (a) => btoa(Array.from(new Uint8Array(a.buffer), (c) => String.fromCharCode(c)).join(''));
        const number = new Uint32Array(n), shape = new Uint32Array(n), scale = new Float32Array(n);
        for (let i = 0; i < n; i += 1) { number[i] = i % 3 === 1 ? 0xffffffff : n - 1 - i; shape[i] = v.data.shapes[0].number; scale[i] = 1; }
        window.keptFrame = {...frame};
        Object.assign(frame, {place: text(Uint16Array.from({length: 3 * n}, (_, i) => 257 * i % 65536)), turn: undefined, grain: text(number), shape: text(shape), scale: text(scale)}); })()""")
    n = page.ask(f"{VIEW}.data.n_shown")
    known = [n - 1 - i for i in range(n) if i % 3 != 1]
    put = lambda name, value: page.ask(f"{VIEW}.parts.{name}.value = {value}; {VIEW}.parts.{name}.dispatchEvent(new Event('input'))")
    page.ask(f"{VIEW}.parts.colour.value = 'order'; {VIEW}.parts.colour.dispatchEvent(new Event('change'))")
    put("time", 0)
    page.equal(page.ask(f"[{VIEW}.meshes[0].count, {VIEW}.note.textContent]"), [n, f"{n} grains"], "grains of a moment")
    page.equal(page.ask(f"[...{VIEW}.meshes[0].userData.grain].filter(g => g !== 0xffffffff)"), sorted(known), "grains of a moment in order of growth")
    place = page.ask(f"(() => {{ const {{ grain, pose }} = {VIEW}.meshes[0].userData, i = grain.indexOf({known[5]}), {{ low, step }} = {VIEW}.data.frames; return (pose[10 * i] - low[0]) / step[0]; }})()")
    page.hold(abs(place - 257 * 3 * (n - 1 - known[5]) % 65536) < 0.6, f"a grain that was sorted has another's place: {place}")
    grey = page.ask(f"(() => {{ const m = {VIEW}.meshes[0], c = [...m.instanceColor.array.slice(-3)]; return c.map(x => Math.round(100 * x)); }})()")
    page.equal(grey, [26, 30, 34], "colour of a grain that the end does not have")  # #8b949d, linear
    page.hold("not among the grains of the end" in page.ask(f"{VIEW}.legend.textContent"), "the legend does not say what is grey")
    put("grow", 10)
    page.equal(page.ask(f"{VIEW}.meshes[0].count"), sum(g < 10 for g in known), "grains shown by the slider at a moment with strangers")
    put("grow", n)
    page.ask("(() => { const v = clastViews.open[0]; v.data.frames.frame[0].grain = btoa('\\xff'.repeat(4 * v.data.n_shown)); })()")
    put("time", 1)
    put("grow", 10)
    put("time", 0)
    page.equal(page.ask(f"[{VIEW}.meshes[0].count, {VIEW}.parts.grow.disabled, {VIEW}.parts.growing.disabled]"), [n, True, True], "a moment of strangers alone")
    put("time", f"{VIEW}.data.frames.frame.length")
    page.equal(page.ask(f"[{VIEW}.meshes[0].count, {VIEW}.parts.grow.disabled]"), [10, False], "the slider of growth after such a moment")
    put("grow", n)
    page.ask(f"Object.assign({VIEW}.data.frames.frame[0], keptFrame); {VIEW}.parts.colour.value = 'size'; {VIEW}.parts.colour.dispatchEvent(new Event('change'))")


# What people without one kind of cone see of linear red, green, blue: protan, deutan, tritan.       [Machado2009, severity 1]
CONES = {"protan": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
         "deutan": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
         "tritan": ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900))}


def seen_lab(colour, cones):
    """CIE L*a*b* of a colour #rrggbb as such a person sees it."""
    part = [int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in part]
    rgb = [min(max(sum(m * c for m, c in zip(row, linear)), 0), 1) for row in cones] if cones else linear
    xyz = [sum(m * c for m, c in zip(row, rgb)) for row in ((0.4339, 0.3762, 0.1899), (0.2126, 0.7152, 0.0722), (0.0178, 0.1096, 0.8727))]
    f = [c ** (1 / 3) if c > 216 / 24389 else (24389 / 27 * c + 16) / 116 for c in xyz]
    return 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])


def check_colours(page):
    """The bar grows lighter all the way for everyone, and the colours of shapes are told apart (CIE76 distance above 10)."""
    bar = page.ask(f"{VIEW}.data.bar")
    shapes = re.findall("#[0-9a-f]{6}", re.search(r"LABELS = .*", (ROOT / "web/live/common.js").read_text())[0])
    for name, cones in {"all cones": None, **CONES}.items():
        light = [seen_lab(colour, cones)[0] for colour in bar]
        page.hold(min(b - a for a, b in zip(light, light[1:])) > 1, f"the colour bar does not grow lighter all the way ({name})")
        seen = [seen_lab(colour, cones) for colour in shapes]
        near = min(math.dist(a, b) for k, a in enumerate(seen) for b in seen[:k])
        page.hold(near > 10, f"two colours of shapes are {near:.1f} apart ({name})")


def covered(picture):
    """Share of the picture that is not its corner's colour, and the mean colour there."""
    width, height, rows = picture
    back, n, total = pixel(rows, 2, 2), 0, [0, 0, 0]
    for y in range(0, height, 2):
        for x in range(0, width, 2):
            colour = pixel(rows, x, y)
            if max(abs(a - b) for a, b in zip(colour, back)) > 12:
                n += 1
                total = [a + b for a, b in zip(total, colour)]
    return 4 * n / (width * height), [c / n for c in total]


def check_levels(page):
    """Dots while the camera moves where surfaces are slow, surfaces when it rests; both look alike."""
    shot = lambda: read_png(base64.b64decode(page.ask(f"(() => {{ const v = {VIEW}; v.render(); return v.renderer.domElement.toDataURL('image/png').split(',')[1]; }})()")))
    page.ask(f"{VIEW}.frame()")
    page.rest()
    page.equal(page.ask(f"{VIEW}.level"), "surfaces", "level of detail at rest")
    surfaces = covered(shot())
    page.ask(f"{VIEW}.isSlow = true; {VIEW}.controls.dispatchEvent({{type: 'change'}}); clearTimeout({VIEW}.resting)")  # it never rests
    page.settle()
    page.equal(page.ask(f"{VIEW}.level"), "dots", "level of detail in motion")
    dots = covered(shot())
    page.close_to(dots[0], surfaces[0], 0.12, "share of the picture that dots cover")
    for k, colour in enumerate(("red", "green", "blue")):
        page.hold(abs(dots[1][k] - surfaces[1][k]) < 24, f"dots' mean {colour}: {dots[1][k]:.0f}, surfaces' {surfaces[1][k]:.0f}")
    page.ask(f"{VIEW}.draw()")
    page.rest()
    page.equal(page.ask(f"{VIEW}.level"), "surfaces", "level of detail after a rest")
    page.ask(f"{VIEW}.isSlow = false")


def check_likeness(page, name, renew):
    """The picture is that of tests/view: few pixels differ much, and all by little in the mean."""
    kept = ROOT / f"tests/view/{name}.png"
    data = base64.b64decode(page.ask(f"clastViews.drawPicture({VIEW}, 480).toDataURL('image/png')").split(",")[1])
    if renew:
        kept.parent.mkdir(exist_ok=True)
        kept.write_bytes(data)
    mean, far = difference(data, kept.read_bytes())
    page.hold(mean < 3, f"picture {name} differs from tests/view by {mean:.1f} of 255 in the mean")
    page.hold(far < 0.02, f"picture {name}: {far:.1%} of its pixels differ from tests/view")


def check_beside(page, pictures):
    choose = lambda value: page.ask(f"""(() => {{ const s = {VIEW}.box.querySelector('select[aria-label=Beside]'); s.value = {json.dumps(value)};
        s.dispatchEvent(new Event('change')); }})()""")
    n = page.ask("clastViews.open.length")
    choose("0")
    page.settle()
    page.equal(page.ask("clastViews.open.length"), n + 1, "views with a second run beside")
    page.press("ArrowLeft")
    ratio = page.ask("""(() => { const [a, b] = [clastViews.open[0], clastViews.open[0].second];
        return Math.abs(a.camera.position.distanceTo(b.camera.position.clone().multiplyScalar(a.radius / b.radius)) / a.camera.position.length()); })()""")
    page.hold(ratio < 1e-6, f"linked cameras differ by {ratio:.2g}")
    if pictures:
        page.browser.picture(pictures / "beside.png")
    choose("")
    heap = []
    for _ in range(6):
        choose("0")
        page.settle()
        choose("")
        page.settle()
        page.browser.call("HeapProfiler.collectGarbage")
        heap.append(page.ask("performance.memory.usedJSHeapSize"))
    page.equal(page.ask("clastViews.open.length"), n, "views after six second ones")
    page.hold(heap[-1] < 1.1 * heap[1] + 2e6, f"memory grows: {heap[1] / 1e6:.1f} to {heap[-1] / 1e6:.1f} MB")


def check_picture(page, pictures):
    for width in (300, 2500):
        wide, high, _ = page.picture(width) if width < 1000 else (*page.ask(f"(() => {{ const c = clastViews.drawPicture({VIEW}, {width}); return [c.width, c.height]; }})()"), 0)
        page.equal(wide, width, "width of the picture")
        page.close_to(high / wide, page.ask(f"{VIEW}.stage.clientHeight / {VIEW}.stage.clientWidth"), 0.01, "shape of the picture")
    page.ask(f"{VIEW}.parts.width.value = 99999; {VIEW}.stage.dispatchEvent(new KeyboardEvent('keydown', {{key: 'p'}}))")
    page.hold(page.ask(f"!{VIEW}.parts.width.validity.valid"), "a picture of 99999 pixels is not refused")
    page.ask(f"{VIEW}.parts.width.value = 2400")
    if pictures:
        page.browser.picture(pictures / "view.png")


def check_axe(page, axe):
    if axe:
        page.ask(axe + "\n0")
        for found in page.ask(AXE_RUN):
            page.faults.append(f"axe: {found}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clast", default=ROOT / "build/release/clast")
    parser.add_argument("--pictures", type=pathlib.Path)
    parser.add_argument("--renew", action="store_true")
    asked = parser.parse_args()
    if not shutil.which(CHROMIUM):
        print("SKIPPED LOUDLY: no chromium here, the 3-D view was not looked at (tools/setup.sh site)")
        return 0
    began, axe, faults = time.monotonic(), axe_source(), []
    if asked.pictures:
        asked.pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        pour(asked.clast, folder)
        address = (folder / "page.html").as_uri()
        browser = Browser(WEBGL)
        page = Page(browser)
        browser.call("HeapProfiler.enable")
        browser.screen(1200, 900, False)
        browser.open(address)
        page.ask("document.querySelector('.view').scrollIntoView()")
        while page.ask("clastViews.open.length") == 0:
            page.settle()
        check_pick(page, folder)
        check_contacts(page, folder)
        check_keys(page)
        check_growth(page)
        check_likeness(page, "ellipsoids", asked.renew)
        check_time(page, folder, asked.pictures)
        check_strangers(page)
        check_colours(page)
        check_levels(page)
        check_phone(page)
        check_picture(page, asked.pictures)
        check_beside(page, asked.pictures)
        check_axe(page, axe)
        faults += page.faults + list(told(browser.events))
        browser.open(address)
        page = Page(browser)
        check_ball(page)
        faults += page.faults
        browser.close()
        faults += check_without(address)
    for fault in faults:
        print(f"view: {fault}")
    print(f"view: used in {time.monotonic() - began:.0f} s ({AXE if axe else 'no axe-core here'}), {len(faults)} faults")
    return 1 if faults else 0


def check_phone(page):
    """What was framed stays in sight where the window becomes as narrow as a phone, and its size comes back."""
    reach = f"""(() => {{ const v = {VIEW}, from = v.camera.position.clone().sub(v.controls.target).length();
        return [from * Math.min(1, v.camera.aspect) * Math.tan(v.camera.fov * Math.PI / 360) / v.radius, v.camera.aspect, from]; }})()"""
    page.ask(f"{VIEW}.frame()")
    wide = page.ask(reach)
    page.browser.screen(400, 1200, False)
    page.settle()
    narrow = page.ask(reach)
    page.hold(narrow[1] < 0.9 and narrow[0] > 1, f"a phone sees {narrow[0]:.2f} of the radius of the grains (sides {narrow[1]:.2f})")
    page.browser.screen(1200, 900, False)
    page.settle()
    page.close_to(page.ask(reach)[2], wide[2], 1e-6, "distance of the camera after the window is wide again")


def check_ball(page):
    """The spheres' view, first on its page."""
    page.ask("document.querySelectorAll('.view')[1].scrollIntoView()")
    while page.ask("clastViews.open.findIndex(v => v.data.shapes[0].smooth && v.name === 'spheres')") < 0:
        page.settle()
    page.ask("clastViews.open.unshift(...clastViews.open.splice(clastViews.open.findIndex(v => v.name === 'spheres'), 1))")
    check_cut(page)


def check_without(address):
    """The same page in a browser without WebGL."""
    browser = Browser(NO_WEBGL)
    browser.open(address)
    page = Page(browser)
    page.hold("needs a browser with WebGL" in page.ask("document.querySelector('.view').innerText"), "without WebGL the page does not say what is missing")
    page.hold(page.ask("document.querySelectorAll('table').length") > 3, "without WebGL the tables are gone")
    page.faults += list(told(browser.events))
    browser.close()
    return page.faults


sys.exit(main())
