#!/usr/bin/python3
"""The same bits of random scenes from every build: fingerprints on one rank of build/bin/fuzz_ranks, of g++ and clang++
builds with and without optimisation and vectors (those of tests/compilers/compare.py), and with the processor's
features masked from glibc.

    benchmarks/fuzz_builds.py [--seed 1] [--cases 500] [--work build/fuzz_builds] [--only NAME...]
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "compilers"))
from compare import BUILDS, MASKED


def build(name, work):
    """Folder of its programs; the tree is kept."""
    cxx, cc, optimise, arch = BUILDS[name]
    tree = work / name.replace(" ", "_")
    subprocess.run(["cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={cxx}",
                    f"-DCMAKE_C_COMPILER={cc}", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={optimise} -DNDEBUG",
                    f"-DPEPERITE_ARCH={arch}", "-DPEPERITE_TESTS=ON"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", tree, "--target", "fuzz_ranks", "peperite"], check=True, stdout=subprocess.DEVNULL)
    return tree / "bin"


def prints(programs, options, **environment):
    fuzz = [sys.executable, "-B", ROOT / "tests" / "fuzz" / "bit_fuzz.py", "--print", "--programs", programs,
            "--seed", str(options.seed), "--cases", str(options.cases)]
    out = subprocess.run(fuzz, check=True, capture_output=True, text=True, env={**os.environ, **environment}).stdout
    return dict(line.split(" ", 1) for line in out.splitlines())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=500)
    parser.add_argument("--work", type=Path, default=ROOT / "build" / "fuzz_builds")
    parser.add_argument("--programs", type=Path, default=ROOT / "build" / "bin")
    parser.add_argument("--only", nargs="+", default=["masked", *BUILDS], help=", ".join(["masked", *BUILDS]))
    options = parser.parse_args()
    wanted, bad = prints(options.programs, options), 0
    ran = sum(text.startswith("0 ") for text in wanted.values())
    for name in options.only:
        got = (prints(options.programs, options, GLIBC_TUNABLES=MASKED) if name == "masked"
               else prints(build(name, options.work), options))
        differ = [case for case in wanted if got.get(case) != wanted[case]]
        bad += len(differ)
        print(f"{name}: {len(differ)} of {len(wanted)} cases differ, {ran} of which run to their end", flush=True)
        for case in differ[:10]:
            print(f"  {case}: {got.get(case)}\n    instead of {wanted[case]}")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
