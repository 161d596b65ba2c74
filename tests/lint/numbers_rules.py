"""What would make the bits depend on ranks, compiler or CPU."""

import re

from source_files import at, code, cpp, files, text

INTEGER = re.compile(r"^MPI_(U?INT(8|16|32|64)_T|INT|UNSIGNED|LONG|UNSIGNED_LONG|COUNT|OFFSET)$")
FUNCTIONS = ("sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh sincos exp exp2 exp10 expm1 log log2 "
             "log10 log1p pow cbrt hypot erf erfc tgamma lgamma").split()
# Not after a letter, '.', '->' or a qualification other than std::, so exact_pow(x), a.log(x) and x::log(y) pass.
LIBM = re.compile(r"(?<![\w.>:])(?:(?:std)?\s*::\s*)?(" + "|".join(FUNCTIONS) + r")[fl]?\s*\(")
APPROXIMATE = re.compile(r"\b_mm\w*_(rsqrt|rcp)\w*|\b__builtin_ia32_(rsqrt|rcp)\w*")
FAST = re.compile(r"-ffast-math|-Ofast|-funsafe-math\S*|-fassociative-math|-freciprocal-math|-ffp-contract=(?!off)\w+"
                  r"|-fp-model|pragma\s+STDC\s+FP_CONTRACT\s+ON|pragma\s+(GCC|clang)\s+(optimize|fp)\b"
                  r"|__attribute__\s*\(\(\s*optimize")


def mpi_sum(root):
    """MPI_SUM only as an argument of a call that names an integer datatype."""
    for path in cpp(root, "libdecomp", "libsph", "apps", "benchmarks"):
        source = code(path)
        for match in re.finditer(r"\bMPI_SUM\b", source):
            arguments = _arguments_around(source, match.start())
            if not any(INTEGER.match(a) for a in arguments):
                yield f"{at(root, path, source, match.start())}: MPI_SUM without an integer datatype; use ExactSum"


def _arguments_around(source, position):
    """Arguments of the innermost call around a position, one per text."""
    depth, start = 0, position
    while start > 0 and depth <= 0:
        start -= 1
        depth += {"(": 1, ")": -1}.get(source[start], 0)
        if source[start] == ";":
            return []
    depth, end = 1, start + 1
    while end < len(source) and depth > 0:
        depth += {"(": 1, ")": -1}.get(source[end], 0)
        end += 1
    return [a.strip() for a in source[start + 1 : end - 1].split(",")]


def fast_math(root):
    """No relaxed arithmetic, but for the free-order kernel in benchmarks/ and for tests/compilers, which shows that
    a contracted build is refused."""
    for path in files(root, ".cpp", ".hpp", ".cmake", ".in", ".sh", ".json", ".py", ".txt", "run"):
        name = str(path.relative_to(root))
        if name.startswith(("benchmarks/", "tests/compilers/", "tests/lint/")):
            continue
        source = code(path) if path.suffix in (".cpp", ".hpp") else text(path)
        for match in FAST.finditer(source):
            line = source[source.rfind("\n", 0, match.start()) + 1 : match.start()]
            if "#" in line and path.suffix not in (".cpp", ".hpp"):
                continue  # a comment
            yield f"{at(root, path, source, match.start())}: {match[0]}"


def libm(root):
    """No function of libm whose bits differ between CPUs, and no approximate instruction."""
    for path in cpp(root, "libdecomp", "libsph", "apps"):
        if path.name == "exact_math.cpp":
            continue
        source = code(path)
        for match in LIBM.finditer(source):
            yield f"{at(root, path, source, match.start())}: {match[1]}: use sph/core/exact_math.hpp"
        for match in APPROXIMATE.finditer(source):
            yield f"{at(root, path, source, match.start())}: {match[0]} differs between CPUs"
