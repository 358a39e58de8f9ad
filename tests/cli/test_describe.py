"""CLI: describe, the library as data."""
import json
import pathlib
import subprocess
import sys
import unittest

from clitest import ROOT, Case, clast

sys.path.insert(0, str(ROOT / "tools"))
from headers import Headers  # noqa: E402


class Describe(Case):
    def setUp(self):
        super().setUp()
        self.all = json.loads(clast("describe", "--json").out)

    def test_the_committed_tables_are_those_of_the_headers(self):
        new = self.folder / "describe.inc"
        subprocess.run([sys.executable, ROOT / "tools/describe.py", new], check=True)
        self.assertTrue(new.read_text() == (ROOT / "cli/describe.inc").read_text(),
                        "cli/describe.inc is old: python3 tools/describe.py cli/describe.inc")

    def test_everything_public_is_there(self):
        headers = Headers(ROOT / "include")
        self.assertEqual({s["name"] for s in self.all["structs"]}, set(headers.structs))
        self.assertEqual({f["name"] for f in self.all["functions"]}, {name for _, name, _ in headers.functions})
        texts = "".join(p.read_text() for p in pathlib.Path(ROOT / "include/clast").glob("*.h"))
        self.assertEqual(len(self.all["configurations"]), texts.count("const clast_field clast_"))

    def test_members_lie_one_after_the_other(self):
        for one in self.all["structs"]:
            end = 0
            for member in one["fields"]:
                self.assertGreaterEqual(member["offset"], end, (one["name"], member["name"]))
                end = member["offset"] + member["size"]
            self.assertLessEqual(end, one["size"])

    def test_a_key_has_default_unit_range_and_words(self):
        keys = {key["name"]: key for key in self.all["configurations"]["clast_aggregate_fields"]}
        self.assertEqual(keys["cone"]["unit"], "rad")
        self.assertAlmostEqual(keys["cone"]["low"], 0.0)
        self.assertTrue(all(key["doc"] for key in keys.values()))
        values = {value["name"]: value["value"] for value in self.all["enums"]}
        self.assertEqual((values["CLAST_OK"], values["CLAST_AXES_BOX"]), (0, 1))


unittest.main()
