"""Who may include whom: only downwards, and third-party headers only where they are hidden."""

import re

from source_files import at, code, cpp

STANDARD = re.compile(r"^[a-z_0-9]+$")
OPERATING_SYSTEM = {"fcntl.h", "unistd.h", "signal.h", "sys/stat.h", "sys/types.h", "sys/wait.h", "sys/statvfs.h",
                    "sys/resource.h", "sys/mman.h", "sys/file.h", "sys/prctl.h", "malloc.h", "stdlib.h", "time.h"}

# header: files that may include it
HIDDEN = {
    r"metis\.h": r"libdecomp/src/metis\.cpp",
    r"hdf5\.h": r"libsph/src/files/(hdf5_file|memory_file)\.cpp|benchmarks/scale_sim/check\.cpp",
    r"zlib\.h": r"libsph/src/files/packed_rows\.cpp",
    r"assimp/.*": r"libsph/src/files/mesh_file\.cpp",
    r"toml\+\+/.*": r"libsph/src/keys/toml_tree\.cpp",
    r"nlohmann/.*": r"libsph/src/.*\.cpp|benchmarks/.*\.cpp",
    r"sleef\.h": r"libsph/src/core/exact_math\.cpp",
    r"xxhash\.h": r"libsph/src/(core/fingerprint|files/content_hash|run/self_check)\.cpp",
    r"CLI/.*": r"(libsph/src|apps|benchmarks)/.*\.cpp",
    r"fmt/.*": r"(libsph/src|apps|benchmarks)/.*\.cpp",
    r"pybind11/.*": r"apps/python/.*\.cpp",
    r"mpi\.h": r"libdecomp/.*|libsph/src/.*|apps/.*|benchmarks/.*",
    r"immintrin\.h": r"libsph/include/sph/core/simd\.hpp|benchmarks/.*",
    r"Eigen/.*": r"libsph/.*|apps/.*|benchmarks/.*|tests/accuracy/.*",
    r"benchmark/.*": r"benchmarks/.*",
}
# Folders of libsph (include/sph/X and src/X are one) from the bottom up: what each may include besides itself.
# Every arrow points down; where one is missing here, nobody has needed it yet.
FOLDERS = {
    "stokes": "",  # a library of its own, below
    "core": "",
    "files": "core",
    "scene": "stokes core",
    "pairs": "core scene",
    "terms": "core pairs",
    "laws": "core scene pairs",
    "keys": "stokes core files scene terms laws",
    "plan": "core scene pairs",
    "start": "core files scene pairs laws plan",
    "models": "stokes core scene pairs terms laws plan start",
    "checkpoint": "core files",
    "step": "core scene plan start models checkpoint",
    "output": "core files scene laws step",
    "inspect": "core files scene laws checkpoint output",
    "run": "core files scene pairs laws keys plan start models checkpoint step output inspect",
}
# path, longest first: what it may include
LAYERS = [
    (r"libsph/include/sph/terms/", r"sph/(core/kernels|pairs/pair_values|pairs/fuse)\.hpp|sph/terms/\w+\.hpp"),
    (r"libsph/include/sph/laws/drag/", r"sph/core/exact_math\.hpp|sph/laws/drag/\w+\.hpp"),
    *((rf"libsph/{tree}/{folder}/", rf"decomp/.*|(sph/)?({'|'.join([folder, *below.split()])})/.*")
      for folder, below in FOLDERS.items() for tree in ("include/sph", "src")),
    *((f"libsph/{tree}/stokes/", r"(decomp|stokes)/.*") for tree in ("include", "src")),
    (r"libdecomp/", r"decomp/.*"),
    (r"apps/", r"(decomp|sph)/.*"),
    (r"benchmarks/", r"(decomp|sph|stokes)/.*"),
]
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)


def check(root):
    known = list(FOLDERS)
    for folder, below in FOLDERS.items():
        for other in below.split():
            if known.index(other) >= known.index(folder):
                yield f"lint/includes.py: {folder} may not be above {other}: arrows point down"
    for path in cpp(root, "libdecomp", "libsph", "apps", "benchmarks"):
        name = str(path.relative_to(root))
        own = next((allowed for folder, allowed in LAYERS if name.startswith(folder)), None)
        if own is None:
            yield f"{name}:1: is in none of the folders that lint/includes.py knows"
            continue
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
