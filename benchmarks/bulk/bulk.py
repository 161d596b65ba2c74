#!/usr/bin/python3
"""Bulk behaviour of grains against experiments and published simulations; numbers, and pictures in PICTURES.

    bulk.py [BUILD] [--cases column repose cone drum incline stable_wedge quiet hopper sandbox] [--work DIR] [--jobs 2] [--pictures DIR]
    ... --page              writes the tables of README.md, one a case

Each run takes one core, a minute or several; all of `sandbox` takes an hour of them. Runs that have come to
their end in the work folder are only measured again.
"""

import argparse
import importlib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from runs import Runner, here, source  # noqa: E402
import manifest  # noqa: E402
import tables  # noqa: E402

CASES = {"column": 2, "repose": 1, "cone": 1, "drum": 1, "incline": 2, "stable_wedge": 2, "quiet": 1, "sandbox": 1, "hopper": 2}  # and the panels of its picture


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=source / "build")
    arguments.add_argument("--cases", nargs="+", choices=CASES, default=[case for case in CASES if case != "sandbox"])
    arguments.add_argument("--work", type=Path, default=source / "build/bulk")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--pictures", type=Path, default=here)
    arguments.add_argument("--page", action="store_true")
    given = arguments.parse_args()
    given.work.mkdir(parents=True, exist_ok=True)
    runner = Runner(given.build.resolve(), given.work.resolve(), given.jobs)
    plt.rcParams.update({"font.size": 8, "legend.frameon": False, "legend.fontsize": 7, "figure.dpi": 110})
    for name in given.cases:
        case = importlib.import_module(name)
        runner.asked.clear()
        lines, result = case.measure(runner)
        print(f"{case.__doc__}\n" + "\n".join(lines) + "\n", flush=True)
        if given.page:
            tables.write(here / "README.md", name, tables.origin(tables.commit_of(given.build)), ["```", *lines, "```"])
        figure, axes = plt.subplots(1, CASES[name], figsize=(4 * max(CASES[name], 1.5), 3), layout="constrained")
        case.draw(axes, result)
        figure.savefig(given.pictures / f"{name}.png")
        manifest.record([given.pictures / f"{name}.png"], runner.asked, set(runner.asked.values()))


if __name__ == "__main__":
    main()
