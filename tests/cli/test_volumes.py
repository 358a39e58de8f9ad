"""clast shape on volumes of scanners: every format gives the same grains, whose size is known."""
import gzip
import math
import struct
import unittest
import zlib

from clitest import Case, clast

# Two ellipsoids in 40 x 28 x 20 bricks of 0.5 x 0.5 x 0.8; grey falls through 100 at their surface.
SIZE = (40, 28, 20)
EDGE = (0.5, 0.5, 0.8)
# The ball begins in a lower slice, so it is the first grain.
GRAINS = [((14.5, 7.0, 8.0), (3.2, 3.2, 3.2)), ((5.5, 7.0, 8.0), (4.0, 3.0, 2.4))]


def grey(x, y, z):
    """100 at the surface, rising inwards by 12 in one unit of length along an axis, in [0, 255]."""
    best = 0.0
    for centre, axes in GRAINS:
        r = math.sqrt(sum(((p - c) / a) ** 2 for p, c, a in zip((x, y, z), centre, axes)))
        best = max(best, 100.0 + 40.0 * (1.0 - r))
    return min(255.0, max(0.0, best))


def values():
    out = []
    for k in range(SIZE[2]):
        for j in range(SIZE[1]):
            for i in range(SIZE[0]):
                out.append(round(grey(*(e * (n + 0.5) for e, n in zip(EDGE, (i, j, k))))))
    return out


VALUES = values()
U8 = bytes(VALUES)
U16BE = struct.pack(f">{len(VALUES)}H", *(257 * v for v in VALUES))


def nrrd(encoding, data, kind="uchar"):
    head = (f"NRRD0004\n# made by a test\ntype: {kind}\ndimension: 3\nspace: left-posterior-superior\n"
            f"sizes: {SIZE[0]} {SIZE[1]} {SIZE[2]}\nspace directions: ({EDGE[0]},0,0) (0,{EDGE[1]},0) (0,0,{EDGE[2]})\n"
            f'space units: "mm" "mm" "mm"\nendian: big\nencoding: {encoding}\nkey:=value\n\n')
    return head.encode() + data


def tiff(order, data, n_byte, packed, text=b"ImageJ=1.54\nimages=20\nslices=20\n\0"):
    """A page a slice, two strips a page."""
    out = bytearray((b"II*\0" if order == "<" else b"MM\0*") + struct.pack(order + "I", 0))
    link = 4
    where = len(out)
    out += text + b"\0" * (len(text) % 2)
    rows = SIZE[1] // 2
    page = SIZE[0] * SIZE[1] * n_byte
    for k in range(SIZE[2]):
        strips = [data[k * page + s * page // 2:k * page + (s + 1) * page // 2] for s in range(2)]
        strips = [zlib.compress(s) for s in strips] if packed else strips
        offsets = []
        for strip in strips:
            offsets.append(len(out))
            out += strip
        lists = len(out)
        out += struct.pack(order + "4I", *offsets, *map(len, strips))
        out += b"\0" * (len(out) % 2)
        struct.pack_into(order + "I", out, link, len(out))
        entries = [(256, 3, 1, SIZE[0]), (257, 3, 1, SIZE[1]), (258, 3, 1, 8 * n_byte), (259, 3, 1, 8 if packed else 1),
                   (262, 3, 1, 1), (270, 2, len(text), where), (273, 4, 2, lists), (277, 3, 1, 1), (278, 3, 1, rows), (279, 4, 2, lists + 8)]
        out += struct.pack(order + "H", len(entries))
        for tag, kind, count, value in entries:
            out += struct.pack(order + "HHI", tag, kind, count)
            out += struct.pack(order + "HH", value, 0) if kind == 3 else struct.pack(order + "I", value)
        link = len(out)
        out += struct.pack(order + "I", 0)
    return bytes(out)


class Volumes(Case):
    def file(self, name, data):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def grains(self, *arguments):
        out = clast("shape", *arguments, "--json")
        self.assertEqual(out.code, 0, out.err)
        return out.json

    def test_hulls_of_voxels_say_what_they_add(self):
        for g in self.grains(self.file("h.nrrd", nrrd("raw", U8)), "--threshold", "100", "--hull")["grains"]:
            self.assertAlmostEqual(g["hull_volume_added"], g["volume"] / (g["n_voxel"] * 1e-9 * math.prod(EDGE)) - 1.0, delta=1e-9)

    def check_sizes(self, grains, unit=1.0):
        self.assertEqual(len(grains), 2)
        for g, (_, axes) in zip(grains, GRAINS):
            # facets and straight interpolation each cut off up to a sagitta h^2/(8 R): h 0.8, R 3.2: 1.6 % of R together
            for key, axis in zip("LIS", sorted(axes, reverse=True)):
                self.assertAlmostEqual(g[key] / (2.0 * axis * unit), 1.0, delta=0.02)
            self.assertAlmostEqual(g["volume"] / (4.0 / 3.0 * math.pi * math.prod(axes) * unit**3), 1.0, delta=0.05)

    def test_all_formats_hold_the_same_grains(self):
        bare = ["--voxels", "40,28,20", "--voxel-edge", "0.5,0.5,0.8"]
        first = self.grains(self.file("a.raw", U8), *bare, "--threshold", "100")["grains"]
        self.check_sizes(first)
        found = {
            "wide": self.grains(self.file("b.raw", b"head" + U16BE), *bare, "--voxel-type", "u16", "--big-endian", "--skip", 4,
                                "--threshold", "25700"),
            "tiff": self.grains(self.file("c.tif", tiff("<", U8, 1, False)), "--voxel-edge", "0.5,0.5,0.8", "--threshold", "100"),
            "packed": self.grains(self.file("d.tif", tiff(">", U16BE, 2, True)), "--voxel-edge", "0.5,0.5,0.8",
                                  "--threshold", "25700"),
        }
        for name, out in found.items():
            for g, one in zip(out["grains"], first, strict=True):
                self.assertAlmostEqual(g["volume"] / one["volume"], 1.0, delta=1e-6, msg=name)
                self.assertEqual(g["n_voxel"], one["n_voxel"], name)

    def test_nrrd_knows_its_edges_and_unit(self):
        for encoding, data, kind in (("raw", U8, "uchar"), ("gzip", gzip.compress(U16BE), "unsigned short")):
            limit = "100" if kind == "uchar" else "25700"
            out = self.grains(self.file(f"{encoding}.nrrd", nrrd(encoding, data, kind)), "--threshold", limit)
            self.assertEqual(out["unit"], "m")
            self.check_sizes(out["grains"], 1e-3)

    def test_labels_and_specks(self):
        labels = bytearray(1 if v > 100 else 0 for v in VALUES)
        labels[0] = 9  # a speck in a corner
        out = self.grains(self.file("labels.raw", bytes(labels)), "--voxels", "40,28,20", "--voxel-edge", "0.5,0.5,0.8",
                          "--least-voxels", "100", "--hull")
        self.assertEqual(out["n_grain"], 1)  # one label, though two parts
        self.assertIn("1 of 2 grains left out: fewer than 100 voxels", out["left_out"][0]["text"])

    def test_bad_volumes_are_one_line(self):
        grey_file = self.file("a.raw", U8)
        self.assert_fails(3, "shape", grey_file, "--voxels", "40,28,21", says=("23520 bytes", "the file has 22400"))
        self.assert_fails(2, "shape", grey_file, "--voxels", "40,28", says=("NX,NY,NZ",))
        self.assert_fails(2, "shape", grey_file, "--voxels", "40,28,20", "--voxel-edge", "-1", says=("voxel_edge",))
        self.assert_fails(2, "shape", grey_file, "--voxels", "40,28,20", "--threshold", "high", says=("threshold",))
        self.assert_fails(3, "shape", grey_file, "--voxels", "40,28,20", "--threshold", "255", says=("all voxels are 0",))
        whole = nrrd("raw", U8)
        self.assert_fails(3, "shape", self.file("short.nrrd", whole[:-1]), says=("22400 bytes", "22399 after its header"))
        self.assert_fails(3, "shape", self.file("hex.nrrd", whole.replace(b"raw", b"hex")), says=("encoding 'hex'",))
        self.assert_fails(3, "shape", self.file("bad.nrrd", nrrd("gzip", gzip.compress(U8)[:-100])), says=("damaged",))
        stack = tiff("<", U8, 1, False)
        self.assert_fails(3, "shape", self.file("short.tif", stack[:-30]), says=("beyond the end",))
        lzw = stack.replace(struct.pack("<HHIHH", 259, 3, 1, 1, 0), struct.pack("<HHIHH", 259, 3, 1, 5, 0))
        self.assert_fails(3, "shape", self.file("lzw.tif", lzw), says=("method 5 (LZW)", "tiffcp -s -c none"))
        big = b"II+\0" + stack[4:]
        self.assert_fails(3, "shape", self.file("big.tif", big), says=("BigTIFF", "tiffcp -s -c none"))
        # the tag of strips' offsets (273) becomes that of a tile's width (322)
        tiles = stack.replace(struct.pack("<H", 273) + struct.pack("<H", 4), struct.pack("<H", 322) + struct.pack("<H", 4))
        self.assertNotEqual(tiles, stack)
        self.assert_fails(3, "shape", self.file("tiles.tif", tiles), says=("has tiles", "tiffcp -s -c none"))
        one = tiff("<", U8, 1, False, b"ImageJ=1.54\nimages=2000\nslices=2000\n\0")
        self.assert_fails(3, "shape", self.file("imagej.tif", one), says=("2000 slices are promised and 20",))
        self.assert_fails(3, "shape", self.file("no.h5", U8), "--dataset", "volume", says=("no.h5",))
        floats = self.file("f.raw", struct.pack("<8f", *[0.5] * 8))
        self.assert_fails(3, "shape", floats, "--voxels", "2,2,2", "--voxel-type", "f32", says=("0.5, no label", "threshold"))


if __name__ == "__main__":
    unittest.main()
