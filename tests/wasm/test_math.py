"""The elementary functions of clast.wasm are glibc's, to the last bit of every result: no number can differ where they do not."""
import functools
import os
import pathlib
import subprocess
import tempfile
import unittest

import jobs

# Results that IEEE 754 and C define to the bit, whoever computes them, and what sets their environment, of which wasm has one alone.
EXACT = set("ceil copysign fabs fdim fegetenv fesetenv floor fma fmax fmaxf fmin fminf fmod frexp ilogb ldexp llrint llround logb lrint lround modf nearbyint nextafter nextafterf "
            "remainder remquo rint round scalbln scalbn sqrt trunc".split())
SOURCE = pathlib.Path(__file__).with_name("math_sums.c")
LIBRARIES = jobs.ROOT / "build/portable/wasm/lib"
PORTABLE = ("libqhull_r.a", "liblapacke.a")  # of the others linked in, cairo draws and the rest reads and writes files


def said(*words, **more):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True, timeout=300, **more).stdout


def symbols(nm, *words):
    return {line.split()[-1].split("@")[0] for line in said(nm, *words).splitlines() if line and not line.endswith(":")}


@functools.cache
def compared():
    """{function: (glibc's checksum, clast.wasm's)}."""
    with tempfile.TemporaryDirectory() as folder:
        native, script = pathlib.Path(folder) / "sums", pathlib.Path(folder) / "sums.js"
        said("cc", "-O1", "-fno-builtin", "-ffp-contract=off", SOURCE, "-o", native, "-lm")
        said("emcc", "-O1", "-fno-builtin", "-sWASM_ASYNC_COMPILATION=0", SOURCE, LIBRARIES / "libglibc_math.a", "-o", script, env={**os.environ, "NODE_PATH": "/usr/share/nodejs"})
        here, there = (dict(line.split() for line in said(*words, env=jobs.PLAIN).splitlines()) for words in ([native], ["node", script]))
    return {name: (here[name], there[name]) for name in here}


class Math(unittest.TestCase):
    def test_functions_are_glibcs_to_the_bit(self):
        self.assertEqual({name: sums for name, sums in compared().items() if sums[0] != sums[1]}, {})

    def test_every_function_that_clast_calls_is_compared(self):
        """log10 was not: the fall speed of the live page's own aggregate was another one than in a terminal."""
        known = symbols("nm", "-D", "--defined-only", said("cc", "-print-file-name=libm.so.6").strip())
        build = jobs.PACKAGE.parent
        objects = [*build.glob("*.a"), *build.glob("CMakeFiles/clast_c*.dir/**/*.o"), *(LIBRARIES / name for name in PORTABLE)]
        calls = symbols(pathlib.Path(said("em-config", "LLVM_ROOT").strip()) / "llvm-nm", "--undefined-only", *objects) & known
        self.assertIn("sin", calls)
        calls |= symbols("nm", "-D", "--undefined-only", jobs.CLAST) & known
        self.assertEqual(calls - EXACT - set(compared()), set())


if __name__ == "__main__":
    lacking = jobs.lacking("node", "emcc", "em-config", "cc", "nm")
    if lacking:
        print(f"SKIPPED LOUDLY: {lacking}")
        raise SystemExit(0)
    unittest.main()
