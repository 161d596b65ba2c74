# A recipe for Spack, of the checkout that it is in:
#   spack repo create own && ln -s "$PWD/cmake/spack" own/packages/peperite && spack repo add own && spack install peperite
# The tests are for Debian: Spack has no RapidCheck.
#
# SPDX-License-Identifier: BSD-3-Clause

from pathlib import Path

from spack.package import *


class Peperite(CMakePackage):
    """SPH and DEM for melt, rock, gas and grains, with the same bits on any number of ranks."""

    homepage = git = (Path(__file__).resolve().parents[2]).as_uri()

    license("BSD-3-Clause")

    version("main", branch="main")

    variant("python", default=True, description="The package of Python: pictures, reports, peperite.Simulation")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("git", type="build")  # what a run was made with is in its files

    depends_on("mpi")
    depends_on("hdf5@1.10.5:+mpi")
    depends_on("zlib-api")
    depends_on("eigen@3.4:3")
    depends_on("tomlplusplus")
    depends_on("cli11")
    depends_on("fmt@9:")
    depends_on("nlohmann-json")
    depends_on("xxhash")
    depends_on("sleef@3.5.1")  # another may have other bits: every program checks them when it begins
    depends_on("assimp@5:")

    extends("python@3.11:", when="+python")
    depends_on("py-pybind11", type="build", when="+python")
    with default_args(type="run", when="+python"):
        depends_on("py-h5py")
        depends_on("py-jinja2")
        depends_on("py-matplotlib")
        depends_on("py-mpi4py")
        depends_on("py-numpy")
        depends_on("py-pillow")

    generator("ninja")
    conflicts("%gcc@:11")

    def cmake_args(self):
        options = [
            self.define("PEPERITE_ARCH", ""),  # Spack's compilers say it for the target
            self.define("PEPERITE_TESTS", False),
            self.define("PEPERITE_BENCHMARKS", False),
            self.define("PEPERITE_METIS", False),
            self.define_from_variant("PEPERITE_PYTHON", "python"),
        ]
        if self.spec.satisfies("+python"):
            options.append(self.define("Python_EXECUTABLE", python.path))
            options.append(self.define("PEPERITE_PYTHON_DIR", str(Path(python_platlib).relative_to(self.prefix))))
        return options
