"""CLI: every format of points gives the decomposition of the same points as text. Files are written here by hand."""
import base64
import struct
import unittest
import zlib

from clitest import ROOT, Case, clast, shared

CSV = ROOT / "data/d2sd/points_b3_n500.csv"
ROWS = [[float(c) for c in line.split(",")] for line in CSV.read_text().split()[1:]]
CUBE = "box:0,0,0,1,1,1"
FLAT = [c for row in ROWS for c in row]
N = len(ROWS)


def legacy(binary):
    head = f"# vtk DataFile Version 3.0\npoints\n{'BINARY' if binary else 'ASCII'}\nDATASET POLYDATA\n"
    parts = [head.encode(), f"POINTS {N} double\n".encode()]
    cells = [k for i in range(N) for k in (1, i)]
    if binary:
        parts += [struct.pack(f">{3 * N}d", *FLAT), f"\nVERTICES {N} {2 * N}\n".encode(), struct.pack(f">{2 * N}i", *cells)]
        parts += [f"\nPOINT_DATA {N}\nSCALARS size float 1\nLOOKUP_TABLE default\n".encode(),
                  struct.pack(f">{N}f", *range(N)), f"\nFIELD more 1\nspeed 3 {N} double\n".encode(),
                  struct.pack(f">{3 * N}d", *FLAT), b"\n"]
    else:
        parts += ["\n".join(" ".join(map(repr, row)) for row in ROWS).encode(),
                  f"\nVERTICES {N} {2 * N}\n{' '.join(map(str, cells))}\n".encode(),
                  f"POINT_DATA {N}\nSCALARS size float\nLOOKUP_TABLE default\n{' '.join(map(str, range(N)))}\n".encode(),
                  f"VECTORS speed double\n{' '.join(map(repr, FLAT))}\n".encode()]
    return b"".join(parts)


def packed(raw, header, compress, block=4096):
    """Header and data as VTK stores them."""
    code = "<" + {"UInt32": "I", "UInt64": "Q"}[header]
    if not compress:
        return struct.pack(code, len(raw)), raw
    blocks = [raw[i:i + block] for i in range(0, len(raw), block)]
    done = [zlib.compress(b) for b in blocks]
    numbers = [len(blocks), block, len(raw) % block] + [len(b) for b in done]
    return struct.pack(code[0] + str(len(numbers)) + code[1], *numbers), b"".join(done)


def xml(kind, fmt, header="UInt32", compress=False):
    points = struct.pack(f"<{3 * N}d", *FLAT)
    size = struct.pack(f"<{N}f", *range(N))
    appended, tags = b"", []
    for name, raw, typ, width, texts in (("size", size, "Float32", 1, range(N)), ("Points", points, "Float64", 3, FLAT)):
        first, data = packed(raw, header, compress)
        start = f'<DataArray type="{typ}" Name="{name}" NumberOfComponents="{width}" format='
        if fmt == "ascii":
            tags.append(f'{start}"ascii">\n{" ".join(map(repr, texts))}\n</DataArray>')
        elif fmt == "binary":
            text = (base64.b64encode(first) + base64.b64encode(data)) if compress else base64.b64encode(first + data)
            tags.append(f'{start}"binary">\n{text.decode()}\n</DataArray>')
        else:
            tags.append(f'{start}"appended" offset="{len(appended)}"/>')
            appended += first + data if fmt == "raw" else base64.b64encode(first) + base64.b64encode(data)
    compressor = ' compressor="vtkZLibDataCompressor"' if compress else ""
    out = (f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="{header}"'
           f'{compressor}>\n<{kind}>\n<Piece NumberOfPoints="{N}" NumberOfVerts="0">\n<PointData Scalars="size">\n{tags[0]}\n'
           f'</PointData>\n<Points>\n{tags[1]}\n</Points>\n</Piece>\n</{kind}>\n').encode()
    if fmt in ("raw", "base64"):
        out += f'<AppendedData encoding="{fmt}">\n_'.encode() + appended + b"\n</AppendedData>\n"
    return out + b"</VTKFile>\n"


def dump(names, row, frames=1):
    out = []
    for step in range(frames):
        out.append(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{N}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0.0 1.0\n0 1\n"
                   f"ITEM: ATOMS {names}\n")
        out += [" ".join(map(str, row(i, ROWS[i] if step == frames - 1 else [0.5, 0.5, 0.5]))) + "\n" for i in range(N)]
    return "".join(out).encode()


class Points(Case):
    def answer(self, path, *options):
        r = clast("decompose", path, "--domain", CUBE, "--test-only", "--json", *options)
        self.assertEqual(r.code, 1, f"{path}: {r.err}")  # b3 is rejected
        got = r.json
        del got["wall_s"]
        return got

    def test_all_formats_hold_the_same_points(self):
        wanted = self.answer(CSV)
        files = {"ascii.vtk": legacy(False), "binary.vtk": legacy(True),
                 "tab.tsv": CSV.read_bytes().replace(b",", b"\t"),
                 "plain.dump": dump("id type x y z", lambda i, p: [i + 1, 1, *map(repr, p)]),
                 "words.dump": dump("id element x y z", lambda i, p: [i + 1, "Fe", *map(repr, p)])}
        for kind, end in (("PolyData", "vtp"), ("UnstructuredGrid", "vtu")):
            for fmt in ("ascii", "binary", "raw", "base64"):
                for header in ("UInt32", "UInt64"):
                    for compress in (False, True):
                        files[f"{fmt}{header}{compress}.{end}"] = xml(kind, fmt, header, compress)
        for name, content in files.items():
            path = self.folder / name
            path.write_bytes(content)
            self.assertEqual(self.answer(path), wanted, name)

    def test_later_snapshots_of_a_dump_are_chosen_by_number(self):
        path = self.folder / "several.dump"
        path.write_bytes(dump("id xs ys zs", lambda i, p: [i + 1, *map(repr, p)], frames=3))
        wanted = self.answer(CSV)
        self.assertNotEqual(self.answer(path)["score"], wanted["score"])
        for frame in ("2", "-1"):
            self.assertEqual(self.answer(path, "--frame", frame), {**wanted, "snapshot": 3, "n_snapshot": 3, "step": 2})
        self.assert_fails(3, "decompose", path, "--domain", CUBE, "--frame", "3", says=["no snapshot 3 among 3"])
        self.assert_fails(3, "decompose", path, "--domain", CUBE, "--frame", "-4", says=["no snapshot -4 among 3"])

    def test_which_of_several_snapshots_was_read_is_told(self):
        """The first of a dump or .xyz stood for all without a word, and an .xyz had no other."""
        sizes = (40, 30, 20)
        rows = [[[(7 * k + 3 * j + n) % 41 / 41 for j in range(3)] for k in range(n)] for n in sizes]
        dump, xyz, one = (self.folder / name for name in ("a.dump", "a.xyz", "one.xyz"))
        dump.write_text("".join(f"ITEM: TIMESTEP\n{7 * n}\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS x y z\n"
                                + "".join("{} {} {}\n".format(*p) for p in part) for n, part in zip(sizes, rows)))
        xyz.write_text("".join(f"{n}\nstep {n}\n" + "".join("A {} {} {}\n".format(*p) for p in part) for n, part in zip(sizes, rows)))
        one.write_text(xyz.read_text().split("30\nstep")[0])
        cube = ("--domain", "box:0,0,0,1,1,1")
        for file, step in ((dump, True), (xyz, False)):
            for frame, k in ((None, 0), (0, 0), (1, 1), (-1, 2)):
                r = clast("decompose", file, *cube, "--json", *(() if frame is None else ("--frame", frame)))
                self.assertEqual((r.code, r.json["n"], r.json["snapshot"], r.json["n_snapshot"]), (0, sizes[k], k + 1, 3), r.err)
                self.assertEqual(r.json.get("step"), 7 * sizes[k] if step else None)
                self.assertIn(f"snapshot {k + 1} of 3{f', TIMESTEP {7 * sizes[k]}' if step else ''}\n", r.err)
            self.assertIn("snapshot 1 of 3", clast("agglomerate", file, *cube, "--constant", 0).err)
            self.assert_fails(3, "decompose", file, *cube, "--frame", 3, says=["no snapshot 3 among 3"])
        r = clast("decompose", one, *cube, "--json")
        self.assertEqual((r.json["n"], "snapshot" in r.json, "snapshot" in r.err), (40, False, False))

    def test_pieces_of_a_file_are_joined(self):
        def piece(rows, kind, extra=""):
            zero = "".join(f' NumberOf{k}="0"' for k in (["Cells"] if kind == "UnstructuredGrid" else ["Verts", "Lines", "Polys"]))
            numbers = " ".join(repr(c) for row in rows for c in row)
            size = " ".join(repr(row[0] + 1) for row in rows)
            return (f'<Piece NumberOfPoints="{len(rows)}"{zero}><PointData><DataArray type="Float64" Name="size" format="ascii">'
                    f'{size}</DataArray>{extra}</PointData><Points><DataArray type="Float64" NumberOfComponents="3" '
                    f'format="ascii">{numbers}</DataArray></Points></Piece>')
        other = f'<DataArray type="Int32" Name="id" format="ascii">{" ".join("7" for _ in ROWS[200:])}</DataArray>'
        plain = clast("decompose", CSV, "--domain", CUBE, "--json").json
        for kind, name in (("PolyData", "p.vtp"), ("UnstructuredGrid", "u.vtu")):
            for last, code in (("", 0), (other, 3)):
                path = self.folder / name
                path.write_text(f'<?xml version="1.0"?><VTKFile type="{kind}" version="0.1" byte_order="LittleEndian"><{kind}>'
                                + piece(ROWS[:200], kind) + '<Piece NumberOfPoints="0"></Piece>' + piece(ROWS[200:], kind, last)
                                + f"</{kind}></VTKFile>")
                r = clast("decompose", path, "--domain", CUBE, "--radius-column", "size", "--json")
                self.assertEqual(r.code, code, r.err)
                if code == 0:
                    self.assertEqual(r.json["pair_integral"], plain["pair_integral"])
                else:
                    self.assertIn("a piece has 5 columns of data, the first has 4", r.err)

    def test_columns_of_any_name_are_mapped(self):
        path = self.folder / "names.csv"
        path.write_text("a;b;c\n" + "\n".join(";".join(map(repr, [p[2], p[0], p[1]])) for p in ROWS) + "\n")
        self.assertEqual(self.answer(path, "--columns", "b,c,a"), self.answer(CSV))

    def test_points_outside_are_counted_or_dropped(self):
        r = clast("decompose", CSV, "--domain", "box:0,0,0,1,1,0.5", "--outside", "drop", "--json").json
        self.assertEqual(r["n"] + r["n_outside"], N)
        self.assertEqual(r["n"], sum(1 for p in ROWS if p[2] <= 0.5))

    def test_damaged_files_are_refused_in_one_line(self):
        bad = {"cut.vtk": legacy(True)[:-3000], "word.vtk": legacy(False).replace(b"POINTS 500", b"POINTS 50000000"),
               "cut.vtp": xml("PolyData", "raw")[:9000], "zlib.vtp": xml("PolyData", "raw", compress=True).replace(b"x\x9c", b"y\x9c"),
               "lz4.vtu": xml("PolyData", "raw", compress=True).replace(b"vtkZLib", b"vtkLZ4x"),
               "grid.vti": xml("ImageData", "raw"), "many.vtp": xml("PolyData", "ascii").replace(b'"500"', b'"900000000"'),
               "short.dump": dump("id x y z", lambda i, p: [i, *p])[:-2000],
               "text.dump": dump("id x y z", lambda i, p: [i, "far", *p[1:]]),
               "ragged.csv": b"x,y,z\n1,2,3\n1,2\n", "none.csv": b""}
        for name, content in bad.items():
            path = self.folder / name
            path.write_bytes(content)
            self.assert_fails(3, "decompose", path, "--domain", CUBE, says=[name])

    def test_mock_galaxies_are_far_from_uniform(self):
        """84383 mock galaxies (MIT licence, Manodeep Sinha), on the sky: ra, dec, cz."""
        path = shared("clouds/galaxies/Mr19_mock_northonly.csv")
        if path is None:
            self.skipTest("no galaxies")
        head = path.read_text().split("\n", 1)[0]
        names = head.split(",")
        r = clast("decompose", path, "--columns", ",".join(names[:2]), "--domain", "box:90,-90,270,90", "--outside", "drop",
                  "--mesh", "tree", "--json")
        self.assertEqual(r.code, 0, r.err)
        self.assertTrue(r.json["reject"])
        self.assertGreater(r.json["n_cell"], 100)
        self.assertEqual(r.json["n"] + r.json["n_outside"], 84383)


if __name__ == "__main__":
    unittest.main()
