#!/usr/bin/python3
"""Strong and weak scaling of a scene: runs it, checks that all fingerprints agree, draws what perf.json says.

    scaling.py SCENE --ranks 1 2 4 8 --steps 500              strong: the same scene on each number of ranks
    scaling.py SCENE --ranks 1 2 4 8 --steps 500 --weak x     weak: domain, start and tiles grow along x with the ranks
    ... --print               only the commands, for a batch job; what they leave in --out is taken when run again
    ... --launcher "srun -n"  instead of "mpirun -np"
    ... --table NAME          writes the table NAME of README.md

Writes scaling.png and scaling.csv into --out. Runs that are there already are not repeated. Exit code 1 if
fingerprints of one scene differ.
"""

import argparse
import csv
import json
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import tables  # noqa: E402
from speed import environment, finished  # noqa: E402

here = Path(__file__).resolve().parent
WAITING = ("halo wait", "reduce")


def grown(scene, axis, factor):
    """Settings that make the scene `factor` times as long."""
    text = tomllib.loads(scene.read_text())
    lower = text["domain"]["lower"][axis]

    def stretch(point):
        out = list(point)
        out[axis] = lower + factor * (point[axis] - lower)
        return out

    settings = [f"domain.upper={stretch(text['domain']['upper'])}"]
    start = text.get("start", {})
    if "upper" in start:
        settings.append(f"start.upper={stretch(start['upper'])}")
    if "tile" in start:
        repeat = list(start["tile"]["repeat"])
        repeat[axis] *= factor
        settings.append(f"start.tile.repeat={repeat}")
    return settings


def commands(given):
    """Number of ranks, folder and command of each run."""
    for ranks in given.ranks:
        for repeat in range(given.repeats):
            folder = given.out / f"{'weak' if given.weak else 'strong'}_{ranks}_{repeat}"
            settings = list(given.set)
            if given.weak:
                settings += grown(given.scene, "xyz".index(given.weak), ranks // given.ranks[0])
            words = [*shlex.split(given.launcher), ranks, given.build / "bin/peperite", "run", given.scene, "--steps",
                     given.steps, "--out", folder]
            for setting in settings:
                words += ["--set", setting]
            yield ranks, folder, [str(word) for word in words]


def run(folder, command):
    if finished(folder):
        return
    shutil.rmtree(folder, ignore_errors=True)
    print(shlex.join(command), flush=True)
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr or done.stdout)


def measured(ranks, folder):
    perf = json.loads((folder / "perf.json").read_text())
    seconds = perf["seconds"]
    loop = perf["wall_seconds"] - seconds["output"]["max"]
    mean = {name: region["mean"] for name, region in seconds.items() if name != "output"}
    return {"ranks": ranks, "particles": perf["particles"], "seconds": loop, "imbalance": perf["imbalance"],
            "speed": perf["particles"] * perf["steps"] / loop, "halo": perf["halo_per_particle"],
            "waiting": sum(mean[name] for name in WAITING) / loop, "fingerprint": perf["fingerprint"], "mean": mean,
            "deciding": perf["balance"]["seconds"] / loop, "migrating": mean["migrate"] / loop}


def best_of(rows):
    """The fastest of each number of ranks."""
    return [min((r for r in rows if r["ranks"] == ranks), key=lambda r: r["seconds"])
            for ranks in sorted({r["ranks"] for r in rows})]


def draw(rows, weak, path):
    ranks = [r["ranks"] for r in rows]
    first = rows[0]
    efficiency = [r["speed"] / r["ranks"] / (first["speed"] / first["ranks"]) for r in rows]
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.5), layout="constrained")
    axes[0].plot(ranks, efficiency, "o-", label="efficiency")
    axes[0].plot(ranks, [1 / r["imbalance"] for r in rows], "s--", label="1 / imbalance")
    axes[0].set(title=f"{'Weak' if weak else 'Strong'} scaling", ylim=(0, 1.1))
    bottom = [0.0] * len(rows)
    for name in first["mean"]:
        share = [r["mean"][name] / r["seconds"] for r in rows]
        if max(share) > 0.01:
            axes[1].bar([str(n) for n in ranks], share, bottom=bottom, label=name)
            bottom = [b + s for b, s in zip(bottom, share)]
    axes[1].set(title="Share of the time, mean over ranks")
    axes[2].plot(ranks, [r["halo"] for r in rows], "o-", label="halo copies per particle")
    axes[2].plot(ranks, [r["waiting"] for r in rows], "s-", label="share of waiting")
    axes[2].set(title="Halo", ylim=(0, None))
    for axis in axes:
        axis.set_xlabel("ranks")
        axis.legend(fontsize=7, frameon=False)
    for axis in (axes[0], axes[2]):
        axis.set_xscale("log", base=2)
    figure.savefig(path)
    return efficiency


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("scene", type=Path)
    arguments.add_argument("--build", type=Path, default=here.parent / "build")
    arguments.add_argument("--ranks", nargs="+", type=int, default=[1, 2, 4])
    arguments.add_argument("--steps", type=int, default=500)
    arguments.add_argument("--repeats", type=int, default=1)
    arguments.add_argument("--weak", choices=("x", "y", "z"))
    arguments.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    arguments.add_argument("--out", type=Path, default=Path("out/scaling"))
    arguments.add_argument("--launcher", default="mpirun -np")
    arguments.add_argument("--print", action="store_true")
    arguments.add_argument("--table", metavar="NAME")
    given = arguments.parse_args()
    given.scene, given.ranks = given.scene.resolve(), sorted(given.ranks)
    if given.weak and any(n % given.ranks[0] for n in given.ranks):
        arguments.error("--weak: all --ranks must be multiples of the smallest")
    plan = list(commands(given))
    if given.print:
        print(*(shlex.join(command) for _, _, command in plan), sep="\n")
        return 0
    given.out.mkdir(parents=True, exist_ok=True)
    for _, folder, command in plan:
        run(folder, command)
    rows = [measured(ranks, folder) for ranks, folder, _ in plan]
    prints = {(r["particles"], r["fingerprint"]) for r in rows}
    agree = len(prints) == len({particles for particles, _ in prints})
    best = best_of(rows)
    efficiency = draw(best, given.weak, given.out / "scaling.png")
    names = ("ranks", "particles", "seconds", "speed", "imbalance", "halo", "waiting", "deciding", "migrating")
    with open(given.out / "scaling.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([*names, "efficiency"])
        writer.writerows([*(r[name] for name in names), e] for r, e in zip(best, efficiency))
    for r, e in zip(best, efficiency):
        print(f"{r['ranks']:5} ranks {r['particles']:10} particles {r['seconds']:8.2f} s {r['speed'] / 1e6:8.2f} M/s  "
              f"efficiency {e:.2f}  imbalance {r['imbalance']:.2f}  waiting {r['waiting']:.0%}  "
              f"deciding {r['deciding']:.1%}  migrating {r['migrating']:.1%}")
    if given.table:
        tables.write(here / "README.md", given.table, tables.origin(
            tables.commit_of(given.build), f"{given.scene.name}, {'weak' if given.weak else 'strong'}, {given.steps} steps"),
            tables.markdown(("ranks", "particles", "M particle-steps/s", "efficiency", "imbalance", "waiting", "halo copies"),
                            [(r["ranks"], r["particles"], f"{r['speed'] / 1e6:.2f}", f"{e:.2f}", f"{r['imbalance']:.2f}",
                              f"{r['waiting']:.1%}", f"{r['halo']:.3f}") for r, e in zip(best, efficiency)]))
    print("all fingerprints agree" if agree else "FINGERPRINTS DIFFER")
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
