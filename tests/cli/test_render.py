"""CLI: clast render draws surfaces and runs, the same bytes every time."""
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
