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


def lzw(data):
    """TIFF's Lempel-Ziv-Welch: codes of 9 to 12 bits, the first bit highest, widths one code early."""
    table, width, word = {bytes([k]): k for k in range(256)}, 9, b""
    stream = [format(256, "09b")]
    for byte in data:
        longer = word + bytes([byte])
        if longer in table:
            word = longer
            continue
        stream.append(format(table[word], f"0{width}b"))
        table[longer] = len(table) + 2
        word = bytes([byte])
        if len(table) + 2 in (512, 1024, 2048):
            width += 1
        elif len(table) + 2 == 4095:
            stream.append(format(256, "012b"))
            table, width = {bytes([k]): k for k in range(256)}, 9
    stream += [format(table[word], f"0{width}b"), format(257, f"0{width}b")]
    bits = "".join(stream)
    bits += "0" * (-len(bits) % 8)
    return int(bits, 2).to_bytes(len(bits) // 8, "big")


def runs(data):
    """PackBits: every byte a run of literals of one, or a run of equal ones."""
    out = bytearray()
    k = 0
    while k < len(data):
        n = 1
        while n < 128 and data[k + n:k + n + 1] == data[k:k + 1]:
            n += 1
        out += bytes([(257 - n) % 256 if n > 1 else 0, data[k]])
        k += n
    return bytes(out)


def differences(data, n_byte, order):
    """Predictor 2: each value less the one to its left."""
    values = struct.unpack(f"{order}{len(data) // n_byte}{'_BH_I'[n_byte]}", data)
    width, most = SIZE[0], 256**n_byte
    less = [(v - (values[k - 1] if k % width else 0)) % most for k, v in enumerate(values)]
    return struct.pack(f"{order}{len(less)}{'_BH_I'[n_byte]}", *less)


PACKINGS = {1: bytes, 5: lzw, 8: zlib.compress, 32773: runs}


def tiff(order, data, n_byte, packing, text=b"ImageJ=1.54\nimages=20\nslices=20\n\0", big=False, predictor=1, tile=None, resolution=0):
    """A page a slice, two strips a page or tiles of a size; classic or BigTIFF."""
    mark, link, entry = (43, 8, "Q") if big else (42, 4, "I")
    out = bytearray((b"II" if order == "<" else b"MM") + struct.pack(order + "H", mark))
    out += struct.pack(order + "HHQ", 8, 0, 0) if big else struct.pack(order + "I", 0)
    where = len(out)
    out += text + b"\0" * (len(text) % 2)
    page = SIZE[0] * SIZE[1] * n_byte
    for k in range(SIZE[2]):
        rows = data[k * page:(k + 1) * page]
        if predictor == 2:
            rows = differences(rows, n_byte, order)
        parts = [rows[s * page // 2:(s + 1) * page // 2] for s in range(2)]
        if tile:
            line, (tx, ty) = SIZE[0] * n_byte, tile
            padded = [rows[j * line:(j + 1) * line].ljust(-(-SIZE[0] // tx) * tx * n_byte, b"\0") for j in range(SIZE[1])]
            padded += [b"\0" * len(padded[0])] * (-SIZE[1] % ty)
            parts = [b"".join(r[i * n_byte:(i + tx) * n_byte] for r in padded[j:j + ty])
                     for j in range(0, SIZE[1], ty) for i in range(0, SIZE[0], tx)]
        parts = [PACKINGS[packing](part) for part in parts]
        offsets = []
        for part in parts:
            offsets.append(len(out))
            out += part
        out += b"\0" * (len(out) % 2)
        lists = len(out)
        out += struct.pack(f"{order}{2 * len(parts)}I", *offsets, *map(len, parts))
        out += struct.pack(order + "2I", 10 * resolution, 10)
        struct.pack_into(order + entry, out, link, len(out))
        n = len(parts)
        entries = [(256, 3, 1, SIZE[0]), (257, 3, 1, SIZE[1]), (258, 3, 1, 8 * n_byte), (259, 3, 1, packing), (262, 3, 1, 1),
                   (270, 2, len(text), where), (277, 3, 1, 1), (317, 3, 1, predictor)]
        entries += [(322, 3, 1, tile[0]), (323, 3, 1, tile[1]), (324, 4, n, lists), (325, 4, n, lists + 4 * n)] if tile else \
            [(273, 4, n, lists), (278, 3, 1, SIZE[1] // 2), (279, 4, n, lists + 4 * n)]
        if resolution:
            rational = struct.pack(order + "2I", 10 * resolution, 10)
            entries += [(k, 5, 1, int.from_bytes(rational, "little" if order == "<" else "big") if big else len(out) - 8) for k in (282, 283)]
        out += struct.pack(order + ("Q" if big else "H"), len(entries))
        for tag, kind, count, value in sorted(entries):
            out += struct.pack(order + "HH" + entry, tag, kind, count)
            small = struct.pack(order + "H", value) if kind == 3 else struct.pack(order + entry, value)
            if big and kind == 4 and count == 2:  # what fits into an entry lies there
                small = bytes(out[value:value + 8])
            out += small.ljust(8 if big else 4, b"\0")
        link = len(out)
        out += struct.pack(order + entry, 0)
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
        }
        wide = {"<": struct.pack(f"<{len(VALUES)}H", *(257 * v for v in VALUES)), ">": U16BE}
        for packing in PACKINGS:
            for order, predictor, big, tile in (("<", 1, False, None), (">", 2, False, None), ("<", 2, True, (16, 32)), (">", 1, True, None),
                                                (">", 1, False, (32, 16))):
                if predictor == 2 and packing not in (5, 8):
                    continue  # only these know one
                name = f"tiff {packing} {order} {predictor} {big} {tile}"
                stack = tiff(order, wide[order], 2, packing, big=big, predictor=predictor if tile is None else 1, tile=tile)
                found[name] = self.grains(self.file("d.tif", stack), "--voxel-edge", "0.5,0.5,0.8", "--threshold", "25700")
        found["bytes"] = self.grains(self.file("c.tif", tiff("<", U8, 1, 5)), "--voxel-edge", "0.5,0.5,0.8", "--threshold", "100")
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

    def test_tiff_knows_its_edges_and_unit(self):
        """Edges of ImageJ and OME were dropped without a word: a stack of slices 0.8 apart, pixels 0.5, read as cubes of edge 1."""
        imagej = b"ImageJ=1.54\nimages=20\nslices=20\nunit=%s\nspacing=0.8\n\0"
        ome = (b'<?xml version="1.0"?><OME><Image><Pixels SizeX="40" SizeY="28" SizeZ="20" SizeC="1" SizeT="1" PhysicalSizeX="0.5" '
               b'PhysicalSizeXUnit="mm" PhysicalSizeY="500" PhysicalSizeZ="0.8" PhysicalSizeZUnit="mm"/></Image></OME>\0')
        for text, unit in ((imagej % b"mm", 1e-3), (imagej % b"micron", 1e-6), (imagej % b"\\u00B5m", 1e-6), (imagej % b"pixel", 0), (ome, 1e-3)):
            for big in (False, True):
                path = self.file("e.tif", tiff("<", U8, 1, 5, text, big=big, resolution=(0 if text is ome else 2)))
                out = self.grains(path, "--threshold", "100")
                self.assertEqual(out["unit"], "m" if unit else "model", text)
                self.check_sizes(out["grains"], unit or 1.0)
        given = self.grains(path, "--threshold", "100", "--voxel-edge", "1,1,1.6")
        self.check_sizes(given["grains"], 2e-3)
        for text in (b"ImageJ=1.54\nimages=20\nslices=10\nframes=2\n\0", b"ImageJ=1.54\nimages=20\nchannels=2\n\0",
                     ome.replace(b'SizeT="1"', b'SizeT="2"').replace(b'SizeZ="20"', b'SizeZ="10"')):
            # two times were one grain of both volumes
            self.assert_fails(3, "shape", self.file("t.tif", tiff("<", U8, 1, 5, text)), "--threshold", "100", says=("2 channels or times",))

    def test_units_of_volumes(self):
        for word, metre in (("micron", 1e-6), ("microns", 1e-6), ("millimeter", 1e-3)):
            data = nrrd("raw", U8).replace(b'"mm" "mm" "mm"', b'"%s" ' % word.encode() * 3)
            self.check_sizes(self.grains(self.file("u.nrrd", data), "--threshold", "100")["grains"], metre)  # were of no unit
        mixed = nrrd("raw", U8).replace(b'"mm" "mm" "mm"', b'"mm" "mm" "um"')  # was mm
        self.assert_fails(3, "shape", self.file("m.nrrd", mixed), says=('different units: "mm" "mm" "um"',))
        for edge in (b"0", b"-0.8"):  # was CLAST_E_USAGE of a function's argument
            data = nrrd("raw", U8).replace(b"space directions: (0.5,0,0) (0,0.5,0) (0,0,0.8)", b"spacings: 0.5 0.5 " + edge)
            self.assert_fails(3, "shape", self.file("z.nrrd", data), "--threshold", "100", says=("a voxel's edge of " + edge.decode(),))

    def test_surfaces_of_volumes_say_their_unit(self):
        for name, data, unit, arguments in (("own", nrrd("raw", U8), b"unit mm", ()), ("given", nrrd("raw", U8).replace(b'"mm"', b'""'), b"unit um",
                                                                                    ("--unit", "um"))):
            (self.folder / name).mkdir()
            self.grains(self.file("s.nrrd", data), "--threshold", "100", "--surfaces", self.folder / name, *arguments)
            self.assertIn(unit, (self.folder / name / "s#1.ply").read_bytes()[:80])  # was none

    def test_what_the_border_may_cut_and_what_hangs_apart_is_said(self):
        labels = bytearray(1 if v > 100 else 0 for v in VALUES)
        out = self.grains(self.file("apart.nrrd", nrrd("raw", bytes(labels))))
        self.assertEqual([w["text"].split(": ", 1)[1] for w in out["warnings"]],
                         ["1 of 1 grains are several bodies that do not hang together, each measured as one: #1"])
        cut = b"".join(U8[i * 40 + 12:i * 40 + 40] for i in range(560))  # through the middle of one of two
        out = self.grains(self.file("cut.raw", cut), "--voxels", "28,28,20", "--threshold", "100")
        self.assertEqual([w["text"].split(": ", 1)[1] for w in out["warnings"]], ["the border of the volume may cut 1 of 2 grains: #2"])
        box = self.grains(self.file("box.raw", bytes([1]) * 1000), "--voxels", "10,10,10")  # cropped to it
        self.assertEqual(box["warnings"], [])

    def test_a_mask_is_smoothed_as_labels(self):
        # The cookbook's own mask of an ellipsoid had 24 % too much area, at any resolution, and a roundness of 0.187 or 0.366 by
        # the unit of its edge.
        mask = bytes(255 if (x - 12) ** 2 / 100 + (y - 12) ** 2 / 64 + (z - 12) ** 2 / 49 < 1 else 0
                     for z in range(24) for y in range(24) for x in range(24))
        bare = ["--kind", "voxels", "--voxels", "24,24,24", "--voxel-edge"]
        path = self.file("mask.raw", mask)
        out = clast("shape", path, *bare, "10", "--unit", "um", "--threshold", "128", "--json")
        grain = out.json["grains"][0]
        self.assertAlmostEqual(grain["area"] / 8.683e-8, 1.0, delta=0.03)
        self.assertTrue(grain["is_smoothed"])
        self.assertIn("1 of 1 grains are of a mask", out.err)
        labels = self.grains(path, *bare, "10", "--unit", "um")["grains"][0]
        self.assertEqual([labels[k] for k in ("area", "roundness")], [grain[k] for k in ("area", "roundness")])
        round_by_edge = [self.grains(path, *bare, str(e), "--threshold", "128")["grains"][0] for e in (1, 3, 7, 10, 100)]
        for one in round_by_edge:
            self.assertAlmostEqual(one["roundness"], grain["roundness"], delta=0.02)
            self.assertLess(one["roundness_deviation"], 0.05)
        terraced = bytearray(mask)
        terraced[(12 * 24 + 12) * 24 + 22 - 1] = 254  # one grey brick: no mask, and terraces
        path_of_terraces = self.file("terraced.raw", bytes(terraced))
        rough = [self.grains(path_of_terraces, *bare, str(e), "--threshold", "128")["grains"][0]["roundness"] for e in (1, 3, 5, 7, 10)]
        self.assertLess(max(rough) - min(rough), 0.08)  # from one start of the search 0.18
        words = clast("shape", path, *bare, "1", "--threshold", "128").out
        self.assertRegex(words, r"roundness +0\.\d{3} \+- 0\.\d{3} .*below 80 voxels across read up to 0\.3 low")
        grey = self.grains(self.file("grey.raw", U8), "--voxels", "40,28,20", "--voxel-edge", "0.5,0.5,0.8", "--threshold", "100")
        self.assertFalse(grey["grains"][0]["is_smoothed"])

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
        self.assert_fails(3, "shape", self.file("long.nrrd", whole + bytes(1120)), says=("22400 bytes", "23520", "sizes or type are wrong"))
        self.assert_fails(3, "shape", self.file("hex.nrrd", whole.replace(b"raw", b"hex")), says=("encoding 'hex'",))
        self.assert_fails(3, "shape", self.file("bad.nrrd", nrrd("gzip", gzip.compress(U8)[:-100])), says=("damaged",))
        self.assert_fails(3, "shape", self.file("cut.nrrd", nrrd("gzip", gzip.compress(U8)[:-4])), says=("damaged",))
        self.assert_fails(3, "shape", self.file("more.nrrd", nrrd("gzip", gzip.compress(U8 + b"x"))), says=("more than the",))
        stack = tiff("<", U8, 1, 1)
        self.assert_fails(3, "shape", self.file("short.tif", stack[:-30]), says=("TIFF: page 20",))
        self.assert_fails(3, "shape", self.file("strip.tif", tiff("<", U8, 1, 5).replace(lzw(U8[:560])[:40], bytes(40))), says=("TIFF: page 1,",))
        jpeg = stack.replace(struct.pack("<HHIHH", 259, 3, 1, 1, 0), struct.pack("<HHIHH", 259, 3, 1, 7, 0))
        self.assert_fails(3, "shape", self.file("jpeg.tif", jpeg), says=("method 7", "tiffcp -c lzw"))
        rgb = stack.replace(struct.pack("<HHIHH", 277, 3, 1, 1, 0), struct.pack("<HHIHH", 277, 3, 1, 3, 0))
        self.assert_fails(3, "shape", self.file("rgb.tif", rgb), says=("3 samples a pixel",))
        one = tiff("<", U8, 1, 1, b"ImageJ=1.54\nimages=2000\nslices=2000\n\0")
        self.assert_fails(3, "shape", self.file("imagej.tif", one), says=("2000 slices are promised and 20",))
        self.assert_fails(3, "shape", self.file("no.h5", U8), "--dataset", "volume", says=("no.h5",))
        floats = self.file("f.raw", struct.pack("<8f", *[0.5] * 8))
        self.assert_fails(3, "shape", floats, "--voxels", "2,2,2", "--voxel-type", "f32", says=("0.5, no label", "threshold"))

    def test_a_closed_pore_is_no_form(self):
        """Sphericity 0.88 for 1.00, angularity 0.13 for 0: the walls of pores in grey values counted, without a word."""
        n, made = 32, []
        for has_pore in (False, True):
            values = bytearray()
            for z, y, x in ((z - 15.5, y - 15.5, x - 15.5) for z in range(n) for y in range(n) for x in range(n)):
                grey = 127.5 - 40 * (math.sqrt(x * x + y * y + z * z) - 12)
                pore = 127.5 + 40 * (math.sqrt((x - 4) ** 2 + y * y + z * z) - 4)
                values.append(int(min(max(min(grey, pore) if has_pore else grey, 0), 255)))
            path = self.folder / f"{has_pore}.raw"
            path.write_bytes(values)
            made.append(clast("shape", path, "--kind", "voxels", "--voxels", f"{n},{n},{n}", "--threshold", 127, "--json").json["grains"][0])
        ball, grain = made
        for key in ("area", "sphericity", "convexity", "roundness", "normal_roundness", "angularity"):
            self.assertAlmostEqual(grain[key], ball[key], 9, key)
        self.assertAlmostEqual(grain["volume"] + grain["pore_volume"], ball["volume"], 6)
        self.assertAlmostEqual(grain["pore_volume"] / (4 / 3 * math.pi * 4 ** 3), 1, delta=0.04)


if __name__ == "__main__":
    unittest.main()
