"""Who may include whom: only downwards, and third-party headers only where they are hidden."""

import re

from source_files import at, code, cpp

STANDARD = re.compile(r"^[a-z_0-9]+$")
OPERATING_SYSTEM = {"fcntl.h", "unistd.h", "signal.h", "sys/stat.h", "sys/types.h", "sys/wait.h", "sys/statvfs.h",
                    "sys/resource.h", "sys/mman.h", "sys/file.h", "sys/prctl.h", "malloc.h", "stdlib.h", "time.h"}

# header: files that may include it
HIDDEN = {
    r"metis\.h": r"libdecomp/src/metis\.cpp",
    r"hdf5\.h": r"libsph/src/output/(hdf5_file|memory_file)\.cpp|benchmarks/scale_sim/check\.cpp",
    r"toml\+\+/.*": r"libsph/src/scene/toml_tree\.cpp",
    r"nlohmann/.*": r"libsph/src/.*\.cpp|benchmarks/.*\.cpp",
    r"sleef\.h": r"libsph/src/physics/exact_math\.cpp",
    r"xxhash\.h": r"libsph/src/(output/fingerprint|output/content_hash|run/self_check)\.cpp",
    r"CLI/.*": r"(libsph/src|apps|benchmarks)/.*\.cpp",
    r"fmt/.*": r"(libsph/src|apps|benchmarks)/.*\.cpp",
    r"mpi\.h": r"libdecomp/.*|libsph/src/.*|apps/.*|benchmarks/.*",
    r"immintrin\.h": r"libsph/include/sph/simd\.hpp|benchmarks/.*",
    r"Eigen/.*": r"libsph/.*|apps/.*|benchmarks/.*|tests/accuracy/.*",
    r"benchmark/.*": r"benchmarks/.*",
}
# folder, longest first: what else it may include
LAYERS = [
    (r"libsph/include/sph/terms/", r"sph/(pair_values|kernels)\.hpp|sph/(materials|terms)/\w+\.hpp"),
    (r"libsph/include/sph/eos/", r"sph/(law_key|scene|exact_math|error)\.hpp|sph/eos/\w+\.hpp"),
    (r"libsph/include/sph/drag/", r"sph/exact_math\.hpp|sph/drag/\w+\.hpp"),
    (r"libsph/include/", r"(decomp|sph)/.*"),
    (r"libsph/src/", r"(decomp|sph|scene|start|pairs|physics|plan|models|grains|output|checkpoint|run)/.*"),
    (r"libdecomp/", r"decomp/.*"),
    (r"apps/", r"(decomp|sph)/.*"),
    (r"benchmarks/", r"(decomp|sph)/.*"),
]
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)


def check(root):
    for path in cpp(root, "libdecomp", "libsph", "apps", "benchmarks"):
        name = str(path.relative_to(root))
        own = next(allowed for folder, allowed in LAYERS if name.startswith(folder))
        source = code(path)
        for match in INCLUDE.finditer(source):
            bracket, header = match[1], match[2]
            if not _allowed(path, name, own, bracket, header):
                yield f"{at(root, path, source, match.start())}: may not include {header}"


def _allowed(path, name, own, bracket, header):
    for hidden, users in HIDDEN.items():
        if re.fullmatch(hidden, header):
            return re.fullmatch(users, name) is not None
    if header in ("random", "complex", "regex"):  # distributions and complex functions call libm; regex is slow
        return not name.startswith("lib")
    if bracket == "<":
        return STANDARD.match(header) is not None or (header in OPERATING_SYSTEM and "/include/" not in name)
    if re.fullmatch(own, header):
        return True
    # A private header is beside its users.
    return "/include/" not in name and (path.parent / header).is_file()
