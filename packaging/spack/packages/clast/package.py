# spack repo add packaging/spack, then in the folder of clast-VERSION.tar.gz (make dist): spack install --no-checksum clast
import os

from spack.package import *


class Clast(CMakePackage):
    """Particles that stick, settle and cluster: virtual aggregates of volcanic ash, packings of sediment grains and their porosity, clouds of particles
    split into cells in which they are uniform. One C17 library, one command, and Python."""

    manual_download = True
    url = f"file://{os.getcwd()}/clast-0.2.0.tar.gz"

    license("BSD-3-Clause")

    version("0.2.0")

    variant("view", default=True, description="libclast_view (charts, pictures, reports) and the command")
    variant("hdf5", default=True, description="states and checkpoints")
    variant("threads", default=True, description="work on several threads")
    variant("tiff", default=True, description="TIFF stacks of scanners")
    variant("sundials", default=True, description="the sectional solver of spectra")
    variant("mpi", default=False, description="libclast_mpi and clast-mpi")
    variant("python", default=False, when="+view", description="import clast")

    requires("platform=linux", msg="clast is for Linux")

    depends_on("c", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("random123")
    depends_on("qhull")
    depends_on("netlib-lapack+lapacke")
    depends_on("libyaml")
    depends_on("jansson")
    depends_on("zlib-api")
    depends_on("cairo+ft+fc+pdf+png+svg", when="+view")
    depends_on("libpng", when="+view")
    depends_on("hdf5~mpi", when="+hdf5")
    depends_on("libtiff@4.5:", when="+tiff")
    depends_on("sundials@6:7+cvode", when="+sundials")
    depends_on("mpi", when="+mpi")
    extends("python@3.10:", when="+python")
    depends_on("py-numpy@1.21:", when="+python", type="run")

    generator("ninja")

    def cmake_args(self):
        parts = ("view", "hdf5", "threads", "tiff", "sundials", "mpi")
        return [self.define_from_variant(f"CLAST_{part.upper()}", part) for part in parts] + [
            self.define("BUILD_TESTING", False),
            self.define("CLAST_BENCH", False),
            self.define("RANDOM123_INCLUDE", self.spec["random123"].prefix.include),
        ]

    @run_after("install")
    def install_python(self):
        if self.spec.satisfies("+python"):
            install_tree("python/clast", join_path(python_platlib, "clast"))

    def setup_run_environment(self, env):
        if self.spec.satisfies("+python"):
            env.set("CLAST_LIBRARY", join_path(self.prefix.lib, "libclast_view.so"))

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def answers(self):
        if self.spec.satisfies("+view"):
            Executable(join_path(self.prefix.bin, "clast"))("mesh", "check", "data/standin63/grain00.ply")
