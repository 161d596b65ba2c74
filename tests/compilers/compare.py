#!/usr/bin/python3
"""Builds tests/compilers in several configurations and compares the fingerprints of its scenes, on 1 and 2 ranks,
with those of the program of this build. Build trees are kept in --work, so a second run is quick."""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent

# Beside the build at hand, g++ -O3 native: the other compiler. --all: -O0 and -O2, both -march.
# name: compiler, C compiler, optimisation, -march (empty: the compiler's baseline)
BUILDS = {
    "clang++ -O3 native": ("clang++", "clang", "-O3", "native"),
}
MORE = {
    "g++ -O0": ("g++", "gcc", "-O0", ""),
    "clang++ -O2 native": ("clang++", "clang", "-O2", "native"),
    "clang++ -O3 baseline": ("clang++", "clang", "-O3", ""),
}
# Without these glibc takes the plain variants of its functions.
MASKED = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F"


def call(command, env=None):
    done = subprocess.run(command, env=env, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nexit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def needed(native):
    """Sources of libsph that went into the program, from its link map: half of them only do input and output."""
    members = re.findall(r"libsph\.a\((\w+)\.cpp\.o\)", pathlib.Path(f"{native}.map").read_text())
    return ";".join(sorted(set(members)))


def build(name, options):
    cxx, cc, optimise, arch = (BUILDS | MORE)[name]
    tree = options.work / name.replace(" ", "_")
    call(["cmake", "-S", HERE, "-B", tree, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={cxx}",
          f"-DCMAKE_C_COMPILER={cc}", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={optimise}",
          f"-DPEPERITE_ARCH={arch}", f"-DNEEDED={needed(options.native)}"])
    call(["cmake", "--build", tree, "-j", str(options.jobs), "--target", "fingerprints"])
    return tree / "fingerprints"


def run(mpiexec, program, ranks, **environment):
    """{"libm": ..., "scene precision": fingerprint}"""
    out = call([*mpiexec, str(ranks), program, HERE / "scenes"], env={**os.environ, **environment})
    return dict(line.rsplit(" ", 1) for line in out.splitlines())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--native", required=True, type=pathlib.Path, help="fingerprints of this build, its link map beside it")
    parser.add_argument("--work", required=True, type=pathlib.Path, help="folder for the build trees")
    parser.add_argument("--mpiexec", type=str.split, default=["mpiexec", "-n"])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--all", action="store_true", help="more builds than the test has time for")
    options = parser.parse_args()

    wanted = run(options.mpiexec, options.native, 1)
    libm = wanted.pop("libm")
    for case, print_ in wanted.items():
        print(f"{case:32} {print_}")
    bad = []

    def compare(what, got):
        for case in wanted:
            if got.get(case) != wanted[case]:
                bad.append(f"{what}: {case}: {got.get(case)} instead of {wanted[case]}")

    compare("this build, 2 ranks", run(options.mpiexec, options.native, 2))
    masked = run(options.mpiexec, options.native, 1, GLIBC_TUNABLES=MASKED)
    compare("this build, AVX2 and FMA masked", masked)
    flags = pathlib.Path("/proc/cpuinfo").read_text() if os.path.exists("/proc/cpuinfo") else ""
    if masked["libm"] == libm and " fma " in flags:
        bad.append("the mask changed no libm result, so it tested nothing")
    names = [*BUILDS, *(MORE if options.all else {})]
    for name in names:
        start = time.monotonic()
        program = build(name, options)
        built = time.monotonic()
        for ranks in (1, 2) if "-O0" not in name else (2,):  # -O0 is forty times slower
            compare(f"{name}, {ranks} ranks", run(options.mpiexec, program, ranks))
        print(f"{name}: built in {built - start:.0f} s, ran in {time.monotonic() - built:.0f} s", flush=True)
    if bad:
        sys.exit("\n".join(bad))
    print(f"{len(wanted)} cases agree in {len(names) + 1} builds, on 1 and 2 ranks, with CPU features masked")


if __name__ == "__main__":
    main()
