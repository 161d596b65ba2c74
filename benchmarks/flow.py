#!/usr/bin/python3
"""Grains in flow, whole programs from start to end: the block of scenes/pile.toml falls and spreads over the floor of a
box, with Peperite, LAMMPS and LIGGGHTS, alternating, medians. Run on a quiet machine.

    flow.py [BUILD] [--ranks 1 2] [--repeats 3] [--page]      --page writes the table of README.md

Peers come from Debian's lammps and liggghts. Each runs at the skin that is best for it over the first quarter, ours at
its default. Where the grains lie in the end, on average, is printed beside ours: in a flow no two codes agree on more.
"""
import argparse
import shutil
import statistics
import time
from pathlib import Path

import h5py
import numpy as np

import tables
from grains import program
from peers.bed import Bed, write_data
from speed import run

here = Path(__file__).resolve().parent
STEPS, DT = 15625, 32e-6
SKINS = (0.1e-3, 0.2e-3, 0.4e-3, 0.6e-3)  # [m]
SIZE = (0.1232, 0.1232, 0.08)
LOWER = (-0.002, -0.002, -0.002)


def timed(function, *arguments):
    begin = time.monotonic()
    function(*arguments)
    return time.monotonic() - begin


def lying(x):
    """Mean distance from the corner on the floor and mean height [m]."""
    return float(np.mean(np.hypot(x[:, 0], x[:, 1]))), float(np.mean(x[:, 2]))


# Codes: functions (ranks, folder) -> (seconds, positions in the end)

def ours(build):
    def measure(ranks, folder):
        shutil.rmtree(folder, ignore_errors=True)
        words = ["mpirun", "-np", str(ranks), build / "bin/peperite", "run", here / "scenes/pile.toml", "--out", folder,
                 "--set", f"output.snapshot_interval={STEPS * DT}"]
        seconds = timed(run, list(map(str, words)))
        return seconds, snapshots(folder)[-1][0]

    return measure


def snapshots(folder):
    out = []
    for path in folder.glob("snapshot_*.h5"):
        with h5py.File(path) as file:
            out.append((float(file.attrs["time"]), file["particles/position"][()], file["particles/radius"][()]))
    return [(x, radius) for _, x, radius in sorted(out, key=lambda frame: frame[0])]


def peer(path, deck, data, words=()):
    def measure(ranks, folder, skin, steps=STEPS):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        variables = {"data": data, "skin": skin, "steps": steps, "out": folder / "at.*"}
        command = ["mpirun", "-np", ranks, path, "-in", here / "peers" / deck, "-log", "none", *words,
                   *(word for name, value in variables.items() for word in ("-var", name, value))]
        seconds = timed(run, list(map(str, command)))
        return seconds, np.loadtxt(folder / f"at.{steps}", skiprows=9)

    return measure


def at_best_skin(name, measure, work):
    seconds = {skin: measure(1, work / name, skin, STEPS // 4)[0] for skin in SKINS}
    print(f"{name}: " + ", ".join(f"skin {1e3 * skin:g} mm {s:.1f} s" for skin, s in seconds.items()), flush=True)
    best = min(seconds, key=seconds.get)
    return lambda ranks, folder: measure(ranks, folder, best)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=here.parent / "build")
    arguments.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--work", type=Path, default=here.parent / "build/flow")
    arguments.add_argument("--page", action="store_true")
    given = arguments.parse_args()
    work, build = given.work.resolve(), given.build.resolve()
    work.mkdir(parents=True, exist_ok=True)

    codes = {"Peperite": ours(build)}
    codes["Peperite"](2, work / "start")
    x, radius = snapshots(work / "start")[0]
    data = work / "start.data"
    write_data(Bed(2 * radius, x, np.zeros_like(x), SIZE), data, lower=LOWER, types=2)  # grains and, of LIGGGHTS, walls
    flow = ("-var", "mode", "flow", "-var", "weight", "none")
    codes["LAMMPS"] = at_best_skin("LAMMPS", peer(program("lmp"), "lmp_pile.in", data, flow), work)
    codes["LIGGGHTS"] = at_best_skin("LIGGGHTS", peer(program("liggghts"), "lig_pile.in", data), work)

    rows = []
    for ranks in given.ranks:
        seconds, places = {name: [] for name in codes}, {}
        for _ in tables.turns(given.repeats):
            for name, measure in codes.items():
                spent, end = measure(ranks, work / name)
                seconds[name].append(spent)
                places[name] = lying(end)
        rows.append([f"{len(x):,} grains, {STEPS:,} steps, {ranks}"])
        for name, all_seconds in seconds.items():
            ratio = statistics.median(s / o for s, o in zip(all_seconds, seconds["Peperite"]))
            away, high = (1e3 * place for place in places[name])
            print(f"{ranks} ranks, {name}: {', '.join(f'{s:.1f}' for s in all_seconds)} s, {ratio:.2f} times ours; grains lie "
                  f"{away:.2f} mm from the corner, {high:.2f} mm high", flush=True)
            rows[-1].append(f"{statistics.median(all_seconds):.1f} s" + (f" ({ratio:.2f}x)" if name != "Peperite" else "") +
                            f", {away:.1f} and {high:.2f} mm")
    lines = tables.markdown(("fall, ranks; seconds, mean distance and height", *codes), rows)
    print("\n".join(lines))
    if given.page:
        tables.write(here / "README.md", "flow", tables.origin(tables.commit_of(build)), lines)


if __name__ == "__main__":
    main()
