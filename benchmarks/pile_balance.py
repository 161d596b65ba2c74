#!/usr/bin/python3
"""The pile of scenes/pile.toml with our balancers and with LAMMPS's fix balance: how unequal the work is.

    pile_balance.py [BUILD] [--ranks 8] [--lammps lmp] [--work DIR]

Our runs are those of partitions.py (made if they are not there); LAMMPS starts from the same grains. LAMMPS can weigh
grains, neighbours ("neigh") or elapsed time; it balances every 100 steps here, and what it says before and after each
time is averaged. Ours follow CPU time, so both measures of ours are printed: grains and CPU time. All are largest rank
over mean, in the second half of the run.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

from partitions import BALANCERS, CASES, Snapshot, here, run
from peers.bed import Bed, write_data
from speed import environment

TIMED = ("none", "count"), ("shift", "count"), ("rcb", "count"), ("shift", "neigh"), ("rcb", "neigh"), ("shift", "time")


def of_grains(run):
    """Largest number of grains over the mean, in the snapshots of the second half."""
    ratios = []
    for path in sorted(run.folder.glob("snapshot_*.h5")):
        snapshot = Snapshot(path)
        if snapshot.time < 0.5 * run.time[-1]:
            continue
        partition = run.partition_of(snapshot)
        row, column = partition.part(snapshot.position)
        count = np.bincount(partition.first[row] + column, minlength=partition.first[-1])
        ratios.append(count.max() / count.mean())
    return np.mean(ratios)


def lammps(program, ranks, data, mode, weight, out):
    part = out.with_suffix(".part")
    command = ["mpirun", "-np", ranks, program, "-in", here / "peers/lmp_pile.in", "-log",
               part if mode == "none" else "none", "-screen", "none",
               "-var", "data", data, "-var", "mode", mode, "-var", "weight", weight, "-var", "out", part]
    if not out.exists():
        if subprocess.call([str(word) for word in command], env=environment) != 0:
            sys.exit(f"LAMMPS failed: {' '.join(map(str, command))}")
        part.rename(out)
    if mode == "none":
        counts = re.findall(r"^Nlocal: +(\S+) ave +(\S+) max", out.read_text(), re.M)[1:]
        return np.mean([float(largest) / float(mean) for mean, largest in counts])
    _, after, before = np.loadtxt(out).T
    return 0.5 * np.mean((after + before)[len(after) // 2:])


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=here.parent / "build")
    arguments.add_argument("--ranks", type=int, default=8)
    arguments.add_argument("--lammps", default="lmp")
    arguments.add_argument("--work", type=Path, default=here.parent / "build/partitions")
    given = arguments.parse_args()
    work = given.work.resolve() / f"{given.ranks}_ranks"
    work.mkdir(parents=True, exist_ok=True)

    print(f"{'Peperite':24}{'grains':>8}{'CPU time':>10}")
    for name in BALANCERS:
        ours = run(given.build.resolve(), work / f"heap_{name}", given.ranks, CASES["heap"],
                   (f"decomposition.balance={name}",))
        time = ours.imbalance(ours.time[-1] * np.array([0.5, 1]))[0]
        print(f"{name:24}{of_grains(ours):8.2f}{time:10.2f}", flush=True)

    start = Snapshot(sorted(ours.folder.glob("snapshot_*.h5"))[0])
    data = work / "heap.data"
    size = (0.1232, 0.1232, 0.08)
    write_data(Bed(start.diameter, start.position, 0 * start.position, size), data, lower=(-0.002, -0.002, -0.002))
    print(f"\n{'LAMMPS, fix balance':24}{'what it weighs':>16}")
    for mode, weight in TIMED:
        mean = lammps(given.lammps, given.ranks, data, mode, weight, work / f"lammps_{mode}_{weight}.txt")
        print(f"{mode + ', ' + weight:24}{mean:16.2f}", flush=True)


if __name__ == "__main__":
    main()
