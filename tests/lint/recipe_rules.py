"""The recipe of Spack asks for all that CMake looks for."""

import re

from source_files import at, files, text

RECIPE = "cmake/spack/package.py"
BUILDS = ("", "libdecomp", "libsph", "apps")  # what is installed; tests and benchmarks are for Debian
LOOKED_FOR = re.compile(r"find_package\((\w+)|pkg_check_modules\(\w+ REQUIRED IMPORTED_TARGET ([\w-]+)\)")


def plain(name):
    """What Eigen3, libxxhash, zlib-api and py-pybind11 are called without their attire."""
    return re.sub(r"^(lib|py-)|-api$|\d+$", "", name.lower().replace("_", "-"))


def recipe(root):
    if not (root / RECIPE).exists():
        return
    wanted = {plain(name) for name in re.findall(r'(?:depends_on|extends)\("([\w-]+)', text(root / RECIPE))}
    for path in files(root, "CMakeLists.txt"):
        if str(path.parent.relative_to(root)).strip(".") not in BUILDS:
            continue
        source = text(path)
        for match in LOOKED_FOR.finditer(source):
            name = match[1] or match[2]
            if plain(name) not in wanted:
                yield f"{at(root, path, source, match.start())}: {name}: {RECIPE} does not depend on it"
