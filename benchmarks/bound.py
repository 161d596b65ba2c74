#!/usr/bin/python3
"""The hot loops beside what the processor could do. Run on a quiet machine.

    bound.py BUILD [--cpu znver4] [--page]

Cycles of one round of a loop, which is as many pairs as a vector has lanes. "measured" is a profile by time of a run on
one rank (linux-perf), at the clock that a chain of additions shows; what rebuilds of lists and others do is not in it.
"model" is what llvm-mca (llvm-16) says of the instructions that the compiler made, "port" the busiest unit alone: no
order of these instructions beats it.
"""

import argparse
import json
import re
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import grains
import tables
from speed import environment, here, run

ROUNDS = 100  # that the model looks at
# Each of these additions waits for the one before it, for a cycle.
CHAIN = """#include <stdio.h>
#include <time.h>
int main(void) {
  clock_t start = clock();
  for (long i = 0; i < 100000000; ++i) __asm__ volatile("add $1,%%rax;add $1,%%rax;add $1,%%rax;add $1,%%rax" ::: "rax", "cc");
  printf("%.9f", 4e8 * CLOCKS_PER_SEC / (clock() - start));
}"""


@dataclass
class Kernel:
    title: str
    symbol: str
    lanes: int
    scene: str
    settings: tuple
    steps: int
    pairs: str  # a particle, in perf.json
    part: Callable  # of the function's instructions, that is a round


# What the model says

def instructions(program, symbol):
    """(address, operation, arguments) of a function."""
    names = [line.split(" ", 2)[2] for line in run(["nm", "-C", program]).splitlines()]
    name = next(name for name in names if name.startswith(f"{symbol}("))
    text = run(["objdump", "-d", "--no-show-raw-insn", "-C", f"--disassemble={name}", program])
    found = (re.match(r"\s*([0-9a-f]+):\s+(\S+)\s*(.*)", line) for line in text.splitlines())
    return [(int(m[1], 16), m[2], re.sub(r"\s*(#|<).*", "", m[3])) for m in found if m]


def hot(code):
    """The shortest loop around a square root."""
    at = {address: k for k, (address, _, _) in enumerate(code)}
    loops = []
    for end, (_, operation, argument) in enumerate(code):
        start = at.get(int(argument, 16), end) if operation.startswith("j") and re.fullmatch("[0-9a-f]+", argument) else end
        if any("sqrt" in o for _, o, _ in code[start:end]):
            loops.append(code[start:end])
    return min(loops, key=len)


def called(code):
    """What a call does up to the first return, where a round is a call."""
    return code[:next(k for k, (_, operation, _) in enumerate(code) if operation.startswith("ret"))]


def modelled(code, cpu):
    """Cycles of a round, and of its busiest unit alone."""
    straight = [f"{o} {a}" for _, o, a in code if not o.startswith(("j", "call", "leave", "data16"))]
    done = subprocess.run(["llvm-mca-16", f"-mcpu={cpu}", f"-iterations={ROUNDS}"], input="\n".join(straight), capture_output=True, text=True,
                          check=True)
    said = dict(re.findall(r"^(\w[\w ]+):\s+([\d.]+)", done.stdout, re.M))
    return float(said["Total Cycles"]) / ROUNDS, float(said["Block RThroughput"]), len(straight)


# Kernels

def fluid(title, precision, *terms):
    real, lanes = ("float", 16) if precision == "mixed" else ("double", 8)
    name = f"sph::PairPass<{real}, 3, sph::Quintic, {', '.join('sph::' + term for term in terms)}>::run"
    return Kernel(f"3D fluid, {precision}, {title}", name, lanes, "vortices_3d.toml", (f'precision="{precision}"', "terms.shifting=false"), 60,
                  "neighbours_per_particle", hot)


def contacts(law, normal, size, steps):
    name = f"sph::ContactPass<sph::{normal}, sph::Coulomb, sph::NoRolling, true, sph::QuantumSums>::add_pairs"
    return Kernel(f"contacts, {law}, {size} grains", name, 8, "grain_bed.toml", (law, size), steps, "pairs_per_particle", called)


KERNELS = [fluid(title, precision, *terms) for precision in ("mixed", "double")
           for title, terms in (("density", ("Divergence", "UniformDensityDiffusion")), ("forces", ("Pressure", "UniformViscosity")))]
KERNELS += [contacts(*law, *bed) for law in (("linear", "LinearRate"), ("hertz", "HertzNormal")) for bed in (("12k", 4000), ("100k", 500))]


# What a run takes

def clock():
    """Cycles a second."""
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder, "chain")
        subprocess.run(["gcc", "-O2", "-xc", "-", "-o", program], input=CHAIN, text=True, check=True)
        return float(run([program]))


def words_of(kernel, work):
    """Settings of its scene, on a command line."""
    settings = list(kernel.settings)
    if kernel.scene == "grain_bed.toml":
        law, size = settings
        tile = grains.settled_tile(work, grains.program("lmp"))
        files = grains.files_of(work, size, grains.bed.repeated(tile, *grains.BEDS[size][:2]))
        settings = [f"start.file={files.start}", f"domain.upper={list(files.size)}", *grains.LAWS[law]]
    return [word for setting in settings for word in ("--set", setting)]


def measured(kernel, build, work):
    """Seconds in the function, and rounds of its loop."""
    with tempfile.TemporaryDirectory() as folder:
        profile, out = f"{folder}/profile", Path(folder, "run")
        run(["perf", "record", "-q", "-e", "cpu-clock", "-F", "1999", "-o", profile, build / "bin/peperite", "run", here / "scenes" / kernel.scene,
             "--steps", str(kernel.steps), "--out", out, *words_of(kernel, work)])
        text = run(["perf", "report", "-i", profile, "--stdio", "--no-children", "-F", "sample,symbol", "-w", "0,0"])
        perf = json.loads((out / "perf.json").read_text())
    samples = sum(int(m[1]) for m in re.finditer(r"^\s*(\d+)\s+\[\.\] (.*)$", text, re.M) if m[2].strip() == kernel.symbol)
    return samples / 1999, kernel.steps * perf["particles"] * perf[kernel.pairs] / kernel.lanes


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--cpu", default="znver4")
    arguments.add_argument("--work", type=Path, default=here.parent / "build/grains")
    arguments.add_argument("--page", action="store_true")
    options = arguments.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    build, rows = options.build.resolve(), []
    for kernel in KERNELS:
        cycles, port, number = modelled(kernel.part(instructions(build / "bin/peperite", kernel.symbol)), options.cpu)
        seconds, rounds = measured(kernel, build, options.work.resolve())
        took = clock() * seconds / rounds
        rows.append((kernel.title, kernel.lanes, number, f"{port:.0f}", f"{cycles:.0f}", f"{took:.0f}", f"{1e9 * seconds / rounds / kernel.lanes:.2f}"))
        print(*rows[-1], sep=" | ", flush=True)
    if options.page:
        header = ("loop", "lanes", "instructions", "port", "model", "measured", "ns a pair")
        tables.write(here / "README.md", "bound", tables.origin(tables.commit_of(build)), tables.markdown(header, rows))


if __name__ == "__main__":
    main()
