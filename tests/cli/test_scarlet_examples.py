"""The published figures of Rossi and Bonadonna as examples: every file under examples/scarlet runs, here with one particle."""
import unittest

from clitest import ROOT, Case, clast

FOLDER = ROOT / "examples/scarlet"
FEW = {"repeats": 1, "n_particle": 1, "fill_spheres": 12, "rays": 2, "orientations": 1}


def is_study(path):
    return "\nrun: aggregate\n" in path.read_text()


class Scarlet(Case):
    def test_each_says_what_was_published(self):
        files = sorted(FOLDER.glob("*.yaml"))
        self.assertEqual({p.name[:5] for p in files}, {f"fig{n:02}" for n in (9, 10, 12, 13, 16, 17, 18)})
        readme = (FOLDER / "README.md").read_text()
        for path in files:
            header = [line for line in path.read_text().splitlines() if line.startswith("#")]
            text = "\n".join(header)
            self.assertIn(f"Fig. {int(path.name[3:5])}", header[0])
            for word in ("Published:", "Ours:", "one core", f"examples/scarlet/{path.name}"):
                self.assertIn(word, text, path.name)
            self.assertIn(f"clast {'study' if is_study(path) else 'aggregate'} examples/scarlet/{path.name} -o ", text)
            self.assertIn(path.name, readme)

    def test_each_run(self):
        words = [w for key, value in FEW.items() for w in (f"--{key.replace('_', '-')}", value)]
        for path in sorted(FOLDER.glob("*.yaml")):
            if not is_study(path):
                done = clast("aggregate", path, *words, "--no-picture", "--json", "--quiet", cwd=ROOT)
                self.assertEqual(done.code, 0, f"{path.name}: {done.err}")
                self.assertEqual(list(done.json["porosity"]), ["sphere_rays"], path.name)
                self.assertGreater(done.json["n_grain"], 1, path.name)

    def test_each_study(self):
        for path in sorted(FOLDER.glob("*.yaml")):
            if is_study(path):
                words = [w for key in ("n_particle", "fill_spheres", "repeats") for w in ("--fix", f"{key}={FEW[key]}")]
                out = self.folder / path.stem
                done = clast("study", path, *words, "--fix", "picture=false", "--shard", "1/1000", "--quiet", "-o", out, cwd=ROOT)
                self.assertEqual(done.code, 0, f"{path.name}: {done.err}")
                header, first = (out / "results.csv").read_text().splitlines()[:2]
                row = dict(zip(header.split(","), first.replace('"', "").split(",")[-len(header.split(",")):]))
                self.assertIn("porosity.sphere_rays", row, path.name)
                self.assertTrue(row["porosity.sphere_rays"], path.name)


if __name__ == "__main__":
    unittest.main()
