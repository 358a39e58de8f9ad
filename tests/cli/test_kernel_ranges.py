"""CLI: kernels end where they hold, or are told to go on; sticking by the impact."""
import json
import re
import unittest

from clitest import Case, clast

CUBE = "box:0,0,0,1,1,1"
AIR = ("--viscosity", "1.8e-5", "--density", "1.2", "--particle-density", "2500")
SLIP = ("--mean-free-path", "66nm")
BOX = ("agglomerate", "--box-model", "--concentration", "1e12", "--duration", "10s", "--n-step", "5", "--particles", "500")


def grains(path, radii):
    rows = [f"{0.1 + 0.8 * k / len(radii)},0.5,0.5,{r}" for k, r in enumerate(radii)]
    path.write_text("x,y,z,r\n" + "\n".join(rows) + "\n")
    return path


class Ranges(Case):
    def test_settling_is_that_of_the_true_drag(self):
        """Ash of 1 mm and 10 um: rate pi R^2 (w1 - w2) / V with w of 6.8 m/s, where Stokes' law says 75.7."""
        file = grains(self.folder / "p.csv", [5e-4, 5e-6])
        common = ("agglomerate", file, "--domain", CUBE, "--kernel", "settling", "--radius-column", "r", *AIR, *SLIP,
                  "--efficiency", "1", "--variant", "test", "--duration", "38000", "--n-step", "1", "--repeats", "400", "--json")
        r = clast(*common)
        self.assertEqual(r.code, 0, r.err)
        self.assertIsNone(r.json["out_of_range"])
        chance = 1 - 2.718281828 ** (-3.14159265 * 5.05e-4**2 * 6.77 * 38000)  # 0.187
        self.assertAlmostEqual(r.json["events"][-1], chance, delta=0.08)
        stokes = clast(*common, "--settling-law", "stokes")
        self.assertEqual(stokes.code, 2, stokes.err)
        self.assertIn("Reynolds number of settling by Stokes' law is 5.04e+03", stokes.err)
        told = clast(*common, "--settling-law", "stokes", "--out-of-range", "extrapolate", "-o", self.folder / "run")
        self.assertEqual(told.code, 0, told.err)
        self.assertGreater(told.json["events"][-1], 0.75)
        self.assertIn("warning: kernel settling: Reynolds number", told.err)
        kept = json.loads((self.folder / "run" / "summary.json").read_text(encoding="utf-8"))["out_of_range"]
        self.assertEqual((kept["owner"], kept["high"], kept["from_time"]), ("kernel settling", 0.1, 0))
        self.assertEqual(kept["share_of_start"], 0.5)
        self.assertEqual(kept["share_of_collisions"], 1.0)
        self.assertEqual(clast("report", self.folder / "run").code, 0)
        page = (self.folder / "run" / "report.html").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"<(?:th|h4|summary)[^>]*><code>([^<]*)", page), [])

    def test_a_sink_is_not_called_a_kernel(self):
        box = ("agglomerate", "--box-model", "--concentration", "1e9", "--settling-depth", "1m", "--settling-law", "stokes", "--monomer-radius",
               "1mm", "--particle-density", "2650", "--n-step", "1")
        lines = [clast(*box, "--kernel", kernel, *more) for kernel, more in (("constant", ("--constant", "1e-20")), ("settling", ()))]
        for line, owner in zip(lines, ("sink of --settling-depth", "kernel settling")):
            self.assertEqual(line.code, 2)
            self.assertIn(f"clast agglomerate: {owner}: Reynolds number of settling by Stokes' law is 7.16e+03", line.err)

    def test_fine_ash_without_a_mean_free_path_is_refused(self):
        file = grains(self.folder / "p.csv", [1e-7, 1e-7])
        common = ("agglomerate", file, "--domain", CUBE, "--radius-column", "r", *AIR, "--variant", "test")
        self.assert_fails(2, *common, "--kernel", "brownian_transition", says=["0.648", "Davies 1945", "--mean-free-path"])
        self.assert_fails(2, *common, *SLIP, "--kernel", "brownian", says=["0.66", "up to 0.1", "take brownian_transition"])
        self.assertEqual(clast(*common, *SLIP, "--kernel", "brownian_transition").code, 0)

    def test_turbulence_holds_below_kolmogorovs_length(self):
        box = (*BOX, "--kernel", "shear_turbulent", "--dissipation", "0.01")
        r = clast(*box, "--monomer-radius", "2um")
        self.assertEqual(r.code, 0, r.err)
        for solver in ("monte-carlo", "sectional"):
            one = [*box, "--monomer-radius", "200um", "--solver", solver]
            if solver == "sectional":
                one.remove("--particles")
                one.remove("500")
            r = clast(*one)
            if "without SUNDIALS" in r.err:
                print("SKIPPED: this build has no SUNDIALS (tools/setup.sh sundials)")
                continue
            self.assertEqual(r.code, 2, r.err)
            self.assertIn("a1 + a2 over Kolmogorov's length is 3.99 at the farthest, where it holds up to 1 [Saffman", r.err)

    def test_a_cloud_that_grows_out_of_the_range_says_when(self):
        file = grains(self.folder / "p.csv", [1e-4] * 300)
        common = ("agglomerate", file, "--domain", CUBE, "--kernel", "shear_laminar", "--shear", "13", "--radius-column", "r",
                  "--variant", "test", "--duration", "2e9", "--n-step", "20")
        self.assert_fails(2, *common, says=["shear Reynolds number", "% of the collisions up to t = "])
        r = clast(*common, "--out-of-range", "extrapolate", "--json")
        self.assertEqual(r.code, 0, r.err)
        told = r.json["out_of_range"]
        self.assertEqual(told["share_of_start"], 0)
        self.assertGreater(told["from_time"], 0)
        self.assertTrue(0.001 < told["share_of_collisions"] < 0.9, told)
        self.assertGreater(told["value"], 1)
        self.assertIn("% of the collisions, over 0.1 % of them from t = ", r.err)

    def test_a_mechanism_is_counted_once(self):
        self.assert_fails(2, *BOX, "--kernel", "brownian+brownian_transition", "--monomer-radius", "1um", "--particle-density",
                          "2500", says=["counts Brownian motion twice"])
        self.assert_fails(2, *BOX, "--kernel", "shear_turbulent+inertial", "--dissipation", "0.01", "--speed-rms", "0.1",
                          "--monomer-radius", "1um", "--particle-density", "2500", says=["counts turbulence twice"])

    def test_a_config_file_has_the_same_keys(self):
        config = self.folder / "c.yaml"
        config.write_text("box_model: true\nconcentration: 1e12\nkernel: brownian_free\nmonomer_radius: 1um\n"
                          "particle_density: 2500\nn_step: 2\nparticles: 100\n")
        self.assert_fails(2, "agglomerate", config, says=["kernel brownian_free", "from 10"])
        config.write_text(config.read_text() + "out_of_range: extrapolate\n")
        r = clast("agglomerate", config, "--json")
        self.assertEqual(r.code, 0, r.err)
        self.assertEqual(r.json["out_of_range"]["share_of_start"], 1.0)

    def test_sticking_by_the_impact(self):
        """Wet ash: events fall by the share of the fit; dry, hard or fast grains stick not at all."""
        file = grains(self.folder / "p.csv", [5e-5, 2e-5] * 20)
        common = ("agglomerate", file, "--domain", CUBE, "--kernel", "settling", "--radius-column", "r", *AIR, *SLIP,
                  "--efficiency", "1", "--variant", "test", "--duration", "1e7", "--n-step", "1", "--repeats", "20", "--json",
                  "--out-of-range", "extrapolate")
        all_stick = clast(*common).json["events"][-1]
        wet = clast(*common, "--sticking", "liquid", "--film-viscosity", "1e-2").json["events"][-1]
        self.assertGreater(all_stick, 8)
        self.assertTrue(0.05 * all_stick < wet < 0.95 * all_stick, (wet, all_stick))
        dry = clast(*common, "--sticking", "contact", "--adhesion", "0.05", "--young", "7e10").json
        self.assertEqual(dry["events"][-1], 0)
        film = ("--sticking", "viscous", "--film-viscosity", "1", "--film-thickness", "1um", "--asperity", "100nm",
                "--restitution", "0.9")
        self.assertAlmostEqual(clast(*common, *film).json["events"][-1], all_stick, delta=0.2 * all_stick)
        self.assert_fails(2, *common, "--sticking", "viscous", says=["sticking viscous needs --film-viscosity"])
        self.assert_fails(2, "agglomerate", file, "--domain", CUBE, "--sticking", "liquid", "--film-viscosity", "1",
                          "--radius-column", "r", "--particle-density", "2500", says=["needs a kernel of a mechanism"])

    def test_a_fractals_radius_is_chosen(self):
        """Shear goes with (a1 + a2)^3; of D_f = 1.8 the collision radius is 1.45 times that of gyration."""
        common = (*BOX, "--kernel", "shear_laminar", "--shear", "1", "--monomer-radius", "1um", "--duration", "1e5s",
                  "--repeats", "10", "--json")
        n = [clast(*common, "--radius-law", law).json["n_particle"][-1] for law in ("fractal-collision", "fractal-gyration")]
        self.assertLess(n[1], 0.95 * n[0])


if __name__ == "__main__":
    unittest.main()
