#!/usr/bin/python3
"""A settled bed of grains with Peperite, LAMMPS and LIGGGHTS, alternating, medians. Run on a quiet machine.

grains.py BUILD           speed and memory; peers come from Debian's lammps and liggghts
grains.py --peers-only    the same without Peperite
grains.py BUILD --check   kinetic energy of a pushed bed against LAMMPS, step by step
... --page                writes the table of README.md, a row for each bed, law and number of ranks

Each code runs at the skin that is best for it in a short scan. Beds are made once, in the work directory: LAMMPS
settles 12,800 spheres (minutes; on one rank, so that everybody gets the same bed), which are laid side by side.
"""
import argparse
import itertools
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import tables
from peers import bed
from speed import environment

here = Path(__file__).resolve().parent
sys.path.append(str(here.parent / "apps/python"))
import peperite  # noqa: E402
BEDS = {"12k": (1, 1, 2000), "100k": (4, 2, 500), "1m": (10, 8, 100)}  # tiles in x and y, timed steps
SKINS = (0.02, 0.05, 0.1, 0.15)  # of the largest diameter
WARM = 50  # steps before the timed ones
DT = 4e-6  # [s]
PUSH = 0.05  # speed of the top of the pushed bed [m/s]
CHECKED = 100  # steps of it
# Hertz's constants for those of the scene. LAMMPS makes a dashpot of e = 0.5 with Tsuji's polynomial; this is the
# restitution that has the same dashpot.
LAWS = {"linear": [],
        "hertz": ["contact.law=hertz", "contact.normal_damping=", "contact.tangential_damping=1",
                  "group.grains.normal_stiffness=", "group.grains.young_modulus=1e7",
                  "group.grains.poisson_ratio=0.25", "group.grains.restitution=0.6160760311847482"]}


@dataclass
class Files:
    grains: int
    size: tuple
    data: Path  # LAMMPS's and LIGGGHTS's
    start: Path  # ours


@dataclass
class Timing:
    seconds: float  # per step
    rebuilds: float  # per step
    memory: int  # peak of the largest rank [B]


def run(ranks, *command, cwd=None):
    """What the program prints, and the peak memory of its largest rank [B]. Interrupted, LIGGGHTS writes into `cwd`."""
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen([str(word) for word in ("mpirun", "-np", ranks, *command)], env=environment,
                                   cwd=cwd, stdout=out, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
    if process.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{text}")
    return text, 1024 * usage.ru_maxrss


def program(name):
    found = shutil.which(name)
    return Path(found).resolve() if found else sys.exit(f"{name} is not installed (apt-get install lammps liggghts)")


def variables(**values):
    return [word for name, value in values.items() for word in ("-var", name, value)]


# Beds

def cached(path, make):
    """Makes the file unless it is there. A run that is interrupted leaves no half of it."""
    if not path.exists():
        part = path.with_name(f"part_{path.name}")
        make(part)
        part.rename(path)
    return path


def settled_tile(work, lmp):
    def settle(path):
        print("settling the tile with LAMMPS takes minutes", flush=True)
        run(1, lmp, "-in", here / "peers/lmp_settle.in", "-log", "none", *variables(loose=loose, settled=path))

    loose = cached(work / "loose.data", lambda path: bed.write_data(bed.loose_tile(), path))
    return bed.read_data(cached(work / "settled.data", settle))


def files_of(work, name, grains, drift=0):
    """Start files of a bed; the peers' is `drift` seconds early."""
    data = cached(work / f"{name}.data", lambda path: bed.write_data(bed.drifted(grains, -drift), path))
    start = cached(work / f"{name}.h5", lambda path: bed.write_start(grains, path))
    return Files(len(grains), grains.size, data, start)


# Codes: functions (files, law, ranks, skin, steps) -> Timing

def peer(path, deck, law_variable, law_words):
    def measure(files, law, ranks, skin, steps):
        text, memory = run(ranks, path, "-in", here / "peers" / deck, "-log", "none",
                           *variables(peers=here / "peers", data=files.data, skin=skin * bed.LARGEST_DIAMETER,
                                      warm=WARM, n=steps, **{law_variable: law_words[law]}), cwd=files.data.parent)
        seconds = float(re.findall(r"Loop time of (\S+)", text)[-1])
        rebuilds = int(re.findall(r"Neighbor list builds = (\d+)", text)[-1])
        return Timing(seconds / steps, rebuilds / steps, memory)

    return measure


def lammps(path):
    return peer(path, "lmp_bed.in", "law", {"linear": "linear", "hertz": "hertz"})


def liggghts(path):
    return peer(path, "lig_bed.in", "model", {"linear": "hooke/stiffness", "hertz": "hertz"})


def run_ours(build, files, law, ranks, steps, out, *settings):
    sets = [f"start.file={files.start}", f"domain.upper={list(files.size)}", *LAWS[law], *settings]
    return run(ranks, build / "bin/peperite", "run", here / "scenes/grain_bed.toml", "--steps", steps, "--out", out,
               *[word for s in sets for word in ("--set", s)])[1]


def our_code(build):
    def measure(files, law, ranks, skin, steps):
        seconds, rebuilds = [], []
        for end in (WARM, WARM + steps):  # the difference is steps alone, as the peers' second run
            with tempfile.TemporaryDirectory() as out:
                memory = run_ours(build, files, law, ranks, end, f"{out}/run", f"decomposition.skin={skin}")
                perf = json.loads(Path(out, "run/perf.json").read_text())
            seconds.append(perf["wall_seconds"] - perf["seconds"]["output"]["max"])
            rebuilds.append(perf["rebuilds"])
        if seconds[1] <= seconds[0]:
            sys.exit(f"{steps} more steps took no more time: the machine is too busy, or more --steps are needed")
        return Timing((seconds[1] - seconds[0]) / steps, (rebuilds[1] - rebuilds[0]) / steps, memory)

    return measure


# Comparison

def best_skin(name, measure, files, steps, law):
    speeds, words = {}, []
    for skin in SKINS:
        timing = measure(files, law, 1, skin, steps)
        speeds[skin] = files.grains / timing.seconds / 1e6
        words.append(f"{skin:g} d {speeds[skin]:.2f} ({1000 * timing.rebuilds:.0f})")
    print(f"  {name}, {law}: {', '.join(words)}", flush=True)
    return max(speeds, key=speeds.get)


def repeat(codes, files, steps, law, ranks, skins, repeats):
    timings = {name: [] for name in codes}
    for _ in tables.turns(repeats):
        for name, measure in codes.items():
            timings[name].append(measure(files, law, ranks, skins[name, law], steps))
    return timings


def compare(codes, beds, tile, options):
    steps = {name: options.steps or BEDS[name][2] for name in beds}
    if not options.skin:
        print("skin: M grain-steps/s on one rank (rebuilds in 1000 steps)")
    first = options.beds[0]
    skins = {(name, law): options.skin or best_skin(name, measure, beds[first], steps[first], law)
             for law in options.laws for name, measure in codes.items()}
    small = {name: measure(tile, options.laws[0], 1, skins[name, options.laws[0]], 200).memory
             for name, measure in codes.items()}
    print("\nbytes per grain: growth of the peak memory from the tile of 12,800 to the bed, one rank")
    print("bed   law    ranks code             M/s  ours/its  B/grain  skin/d  rebuilds/1000")
    rows = []
    for size, law, ranks in itertools.product(options.beds, options.laws, options.ranks):
        files = beds[size]
        timings = repeat(codes, files, steps[size], law, ranks, skins, options.repeats)
        rows.append([f"{files.grains:,}, {law}, {ranks}"])
        for name, runs in timings.items():
            speed = files.grains / statistics.median(t.seconds for t in runs) / 1e6
            ratio = memory = "-"
            if "Peperite" in codes:
                ratio = f"{statistics.median(t.seconds / o.seconds for t, o in zip(runs, timings['Peperite'])):.2f}"
            if ranks == 1 and files.grains > tile.grains:
                memory = f"{(runs[0].memory - small[name]) / (files.grains - tile.grains):.0f}"
            print(f"{size:5} {law:6} {ranks:5} {name:14} {speed:6.2f} {ratio:>8} {memory:>8} {skins[name, law]:7g} "
                  f"{1000 * statistics.mean(t.rebuilds for t in runs):10.1f}", flush=True)
            rows[-1].append(f"{speed:.2f}" + (f" ({ratio}x)" if name != "Peperite" and ratio != "-" else ""))
    return tables.markdown(("grains, law, ranks; M grain-steps/s (ours over its)", *codes), rows)


# Check

def energies_of_lammps(lmp, files, law):
    """Translational energy of each step, of the velocities that Peperite has then (see the deck), and rotational."""
    text, _ = run(1, lmp, "-in", here / "peers/lmp_push.in", "-log", "none", cwd=files.data.parent,
                  *variables(peers=here / "peers", data=files.data, law=law, skin=0.1 * bed.LARGEST_DIAMETER, n=CHECKED,
                             tangential="mindlin_rescale/force"))  # as ours: unloading makes no energy
    table = re.findall(r"^ *Step.*?\n(.*?)^Loop", text, re.M | re.S)[-1]
    return [tuple(map(float, line.split()[1:])) for line in table.splitlines()]


def energies_of_ours(build, files, law):
    with tempfile.TemporaryDirectory() as out:
        run_ours(build, files, law, 1, CHECKED, f"{out}/run", "output.series_interval=0")
        return list(peperite.open(f"{out}/run").series["energy_kinetic"])


def check(build, lmp, files, laws):
    """Whether the kinetic energies agree to 1e-4. The linear law's agree to rounding but for contacts whose dashpot
    pulls: their friction is mu |F| in LAMMPS and 0 here."""
    good = True
    for law in laws:
        theirs, ours = energies_of_lammps(lmp, files, law), energies_of_ours(build, files, law)
        print(f"{law}: step, kinetic energy [J], difference from LAMMPS's, LAMMPS's energy of spin [J]")
        for step in range(0, CHECKED + 1, 10):
            difference = ours[step] / theirs[step][0] - 1
            good = good and abs(difference) <= 1e-4
            print(f"{step:5} {ours[step]:.10g} {difference:9.1e} {theirs[step][1]:9.3g}")
    print("agree to 1e-4" if good else "differ by more than 1e-4")
    return good


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=here.parent / "build")
    arguments.add_argument("--check", action="store_true")
    arguments.add_argument("--peers-only", action="store_true")
    arguments.add_argument("--work", type=Path, default=here.parent / "build/beds")
    arguments.add_argument("--lammps", default="lmp")
    arguments.add_argument("--liggghts", default="liggghts")
    arguments.add_argument("--native", help="a LAMMPS built for this machine (peers/build_lammps.sh)")
    arguments.add_argument("--beds", nargs="+", choices=BEDS, default=["100k", "1m"])
    arguments.add_argument("--laws", nargs="+", choices=LAWS, default=[*LAWS])
    arguments.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--skin", type=float, help="in largest diameters; no scan")
    arguments.add_argument("--steps", type=int, help="timed steps, instead of each bed's own number")
    arguments.add_argument("--page", action="store_true")
    options = arguments.parse_args()
    work = options.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    build = options.build.resolve()
    lmp = program(options.lammps)
    tile = settled_tile(work, lmp)

    if options.check:
        pushed = bed.pushed(bed.repeated(tile, 4, 2), PUSH)
        sys.exit(not check(build, lmp, files_of(work, "pushed", pushed, drift=DT), options.laws))
    codes = {} if options.peers_only else {"Peperite": our_code(build)}
    codes["LAMMPS"] = lammps(lmp)
    if options.native:
        codes["LAMMPS native"] = lammps(program(options.native))
    codes["LIGGGHTS"] = liggghts(program(options.liggghts))
    beds = {name: files_of(work, name, bed.repeated(tile, *BEDS[name][:2])) for name in {*options.beds, "12k"}}
    lines = compare(codes, beds, beds["12k"], options)
    if options.page:
        tables.write(here / "README.md", "grains", tables.origin(tables.commit_of(build)), lines)


if __name__ == "__main__":
    main()
