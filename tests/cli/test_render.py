"""CLI: clast render draws surfaces and runs, the same bytes every time."""
import os
import struct
import unittest
import zlib

from clitest import ROOT, Case, clast

STL = ROOT / "data/scarlet/stl"
SMALL = ("--width", 200, "--height", 150, "--samples", 2, "--ambient-rays", 1)


def read_png(path):
    """Width, height, channels and the unpacked scan lines (filters left in)."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG"
    at, packed, header = 8, b"", None
    while at < len(data):
        n, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + n]
        assert struct.unpack(">I", data[at + 8 + n:at + 12 + n])[0] == zlib.crc32(kind + body), "bad CRC"
        if kind == b"IHDR":
            header = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += 12 + n
    width, height, depth, colour = header
    channels = {2: 3, 6: 4}[colour]
    lines = zlib.decompress(packed)
    assert depth == 8 and len(lines) == height * (1 + width * channels)
    return width, height, channels


class Render(Case):
    def test_json_has_the_stable_keys(self):
        picture = self.folder / "a.png"
        result = clast("render", STL / "particle.stl", "-o", picture, "--json", *SMALL)
        self.assertEqual(result.code, 0, result.err)
        for key in ["output", "width", "height", "n_triangle", "wall_s"]:
            self.assertIn(key, result.json)
        self.assertEqual(result.json["n_triangle"], 33274)
        self.assertEqual(read_png(picture), (200, 150, 3))

    def test_transparent_background_has_alpha(self):
        picture = self.folder / "a.png"
        result = clast("render", STL / "Menger2.stl", "-o", picture, "--background", "transparent", *SMALL)
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(read_png(picture), (200, 150, 4))

    def test_threads_do_not_change_a_byte(self):
        pictures = []
        for threads in (1, 3):
            pictures.append(self.folder / f"{threads}.png")
            result = clast("render", STL / "Menger2.stl", STL / "L_shaped.stl", "--colour", "shape", "--unit", "um",
                           "-j", threads, "-o", pictures[-1], *SMALL)
            self.assertEqual(result.code, 0, result.err)
        self.assertEqual(pictures[0].read_bytes(), pictures[1].read_bytes())

    def test_fillings_and_runs_are_drawn(self):
        state = self.folder / "fill.h5"
        done = clast("fill", STL / "27sk21_shape_fine.stl", "--spheres", 12, "-o", state, "-q")
        self.assertEqual(done.code, 0, done.err)
        result = clast("render", state, "-o", self.folder / "fill.png", "--json", *SMALL)
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual((result.json["n_grain"], result.json["n_triangle"]), (12, 0))
        run = self.folder / "run"
        done = clast("aggregate", "--core", STL / "27sk21_shape_coarse.stl", "--core-size", "100um", "--coat",
                     STL / "27sk21_shape_fine.stl", "--size", "30um", "--size", "40um", "--unit", "um", "-o", run, "-q")
        self.assertEqual(done.code, 0, done.err)
        result = clast("render", run, "-o", self.folder / "run.png", "--cut", "view", "--json", *SMALL)
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual((result.json["n_grain"], result.json["unit"]), (3, "m"))
        self.assertEqual(result.json["n_triangle"], 578 + 2 * 650)
        self.assertEqual(read_png(self.folder / "run.png"), (200, 150, 3))

    def test_a_picture_needs_no_volume(self):
        """Ended in "clast_shape_copy: shape: its volume is not above 0" and code 2, of which file was not said."""
        corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
        sides = ("0 3 2 1", "4 5 6 7", "0 1 5 4", "1 2 6 5", "2 3 7 6", "3 0 4 7")
        files = {"cube": f"OFF\n8 6 0\n{corners}" + "".join(f"4 {s}\n" for s in sides),
                 "inside_out": f"OFF\n8 6 0\n{corners}" + "".join(f"4 {' '.join(reversed(s.split()))}\n" for s in sides),
                 "mixed": f"OFF\n8 6 0\n{corners}" + "".join(f"4 {' '.join(reversed(s.split())) if k % 2 else s}\n" for k, s in enumerate(sides)),
                 "flat": "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n3 0 2 1\n3 1 2 3\n",
                 "facet": "OFF\n3 1 0\n100 0 0\n101 0 0\n100 1 0\n3 0 1 2\n"}
        for name, text in files.items():
            (self.folder / f"{name}.off").write_text(text)
            done = clast("render", self.folder / f"{name}.off", "-o", self.folder / f"{name}.png", "--shading", "flat", *SMALL)
            self.assertEqual((done.code, done.err), (0, ""), name)
        pictures = {name: (self.folder / f"{name}.png").read_bytes() for name in files}
        self.assertEqual(pictures["inside_out"], pictures["cube"])
        self.assertNotEqual(len(set(zlib.decompress(self.packed(pictures["facet"])))), 1)
        done = clast("render", *(self.folder / f"{name}.off" for name in files), "-o", self.folder / "all.png", "--colour", "size", "--json", *SMALL)
        self.assertEqual((done.code, done.json["n_grain"], done.err), (0, 5, ""))

    def test_names_of_any_letters_are_drawn(self):
        """Ended in "cairo: input string not valid UTF-8; see --max-memory" and code 4: Latin-1, and names cut within a letter."""
        grain = (ROOT / "data/standin63/grain00.ply").read_bytes()
        for name in ("\u041f\u0435\u043c\u0437\u0430 \u0441 \u0432\u0443\u043b\u043a\u0430\u043d\u0430 \u042d\u0442\u043d\u0430.ply".encode(), b"K\xf6rner.ply"):
            path = os.fsencode(self.folder) + b"/" + name
            with open(path, "wb") as file:
                file.write(grain)
            done = clast("render", os.fsdecode(path), "-o", self.folder / "a.png", "--colour", "shape", *SMALL)
            self.assertEqual((done.code, done.err), (0, ""), name)

    def test_options_without_use_are_refused(self):
        """Gave the bytes of a picture without them."""
        line = ("render", STL / "Menger2.stl", "-o", self.folder / "a.png")
        for colour in ("size", "order", "shape"):
            self.assert_fails(2, *line, "--colour", colour, "--tint", "#00ff00", says=["tint does nothing without --colour single"])
        for colour in ("single", "shape"):
            self.assert_fails(2, *line, "--colour", colour, "--scale", "log", says=["scale does nothing without --colour size or order"])
        self.assert_fails(2, *line, "--colour", "single", "--no-colour-bar", says=["does nothing with --colour single"])
        self.assert_fails(2, *line, "--ambient", 0, "--ambient-rays", 4, says=["ambient-rays does nothing with --ambient 0"])
        for sun in ("--sun-azimuth=90deg", "--sun-elevation=0deg", "--sun-radius=9deg"):
            self.assert_fails(2, *line, "--ambient", 1, sun, says=["does nothing with --ambient 1"])
        self.assert_fails(2, line[0], STL / "Menger2.stl", ROOT / "data/standin63/grain00.ply", *line[2:], "--tint", "#00ff00",
                          says=["tint does nothing where colours show sizes"])  # auto: the tint was not seen
        for more in (("--tint", "#00ff00"), ("--colour", "single", "--tint", "#00ff00"), ("--colour", "size", "--scale", "log", "--no-colour-bar")):
            self.assertEqual(clast(*line, *more, *SMALL).code, 0, more)

    def test_ground_without_light_has_no_shadow(self):
        """Was black all over: no light was divided by no light."""
        line = ("render", STL / "Menger2.stl", "--ambient", 0, "--sun-elevation=-60deg", *SMALL)
        for name, more in (("without", ()), ("with", ("--ground",))):
            done = clast(*line, *more, "-o", self.folder / f"{name}.png")
            self.assertEqual((done.code, done.err), (0, ""))
        self.assertEqual((self.folder / "with.png").read_bytes(), (self.folder / "without.png").read_bytes())

    def test_json_names_the_unit_that_is_given(self):
        """Said "model" beside a scale bar in micrometres."""
        made = [clast("render", STL / "Menger2.stl", *more, "-o", self.folder / "a.png", "--json", *SMALL).json for more in ((), ("--unit", "um"))]
        self.assertEqual([m["unit"] for m in made], ["model", "um"])
        self.assertEqual(made[0]["pixel_size"], made[1]["pixel_size"])

    def packed(self, data):
        at = data.index(b"IDAT")
        return data[at + 4:at + 4 + struct.unpack(">I", data[at - 4:at])[0]]

    def test_surfaces_that_say_their_unit_have_it(self):
        mm, um, picture = self.folder / "mm.stl", self.folder / "um.stl", self.folder / "a.png"
        clast("mesh", "convert", STL / "Menger2.stl", "--unit", "mm", "-o", mm)
        said = clast("mesh", "convert", mm, "--out-unit", "um", "-o", um, "--json").json
        self.assertEqual((said["unit"], said["out_unit"]), ("mm", "um"))
        drawn = clast("render", mm, STL / "Menger2.stl", "-o", picture, "--json", *SMALL)
        self.assertEqual(drawn.json["unit"], "mm", drawn.err)
        self.assert_fails(2, "render", mm, um, "-o", picture, says=["um.stl says that it is in um, a surface before it that it is in mm"])
        self.assert_fails(2, "render", mm, "-o", picture, "--unit", "um", says=["says that it is in mm, not in um"])

    def test_what_has_no_triangles_is_named(self):
        points, dot = self.folder / "points.off", self.folder / "dot.off"
        points.write_text("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n")
        dot.write_text("OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n")
        for path, why in ((points, "points.off has no triangles"), (dot, "dot.off is one point")):
            self.assert_fails(3, "render", STL / "Menger2.stl", path, "-o", self.folder / "a.png", *SMALL, says=[why])

    def test_failures_are_one_line(self):
        picture = self.folder / "a.png"
        menger = STL / "Menger2.stl"
        self.assert_fails(2, "render", menger, says=["-o picture.png"])
        for other in ("a.jpg", "a"):  # were PNG files of these names
            self.assert_fails(2, "render", menger, "-o", self.folder / other, *SMALL, says=[other, "written as .png"])
        self.assert_fails(3, "render", self.folder / "none.stl", "-o", picture, says=["none.stl"])
        self.assert_fails(3, "render", self.folder, "-o", picture, says=["state.h5"])
        self.assert_fails(2, "render", menger, self.folder, "-o", picture, says=["alone"])
        self.assert_fails(2, "render", menger, "-o", picture, "--tint", "brown", says=["#rrggbb"])
        self.assert_fails(2, "render", menger, "-o", picture, "--unit", "parsec", says=["parsec"])
        self.assert_fails(2, "render", menger, "-o", picture, "--width", 3, says=["width"])
        self.assert_fails(4, "render", menger, "-o", self.folder / "no/a.png", *SMALL, says=["no/a.png"])
        self.assertFalse(picture.exists())


if __name__ == "__main__":
    unittest.main()
