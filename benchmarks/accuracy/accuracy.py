#!/usr/bin/python3
"""Speed against error: each case at several resolutions and with several formulations.

    accuracy.py [BUILD] [--cases taylor_green ...] [--sizes 25 50] [--formulations default ida] [--work DIR] [--out DIR]
    ... --chart PICTURE     all cases in one picture, entered in the pictures.json beside it
    ... --page [--busy]     enters the results into results.json and the table of README.md, CPU seconds too unless busy

Prints a table for each case; writes report.md and a chart of CPU seconds against error for each case to OUT. One rank;
CPU seconds are those of computation. Runs that have come to their end in the work folder are only measured again.
"""

import argparse
import importlib
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import page  # noqa: E402
from runs import Runner, here, source, write_start  # noqa: E402

sys.path.append(str(source / "cmake"))
import manifest  # noqa: E402

CASES = ("taylor_green", "taylor_green_1000", "taylor_green_3d", "gresho", "poiseuille", "couette", "cavity", "cavity_1000",
         "hydrostatic", "hydrostatic_3d", "two_layers", "rayleigh_taylor", "rising_bubble", "rising_bubble_2",
         "drop_at_rest", "drop_mode", "elliptic_drop", "oscillating_drop", "rotating_patch", "dam_break", "dam_break_3d",
         "sloshing", "kelvin_helmholtz", "kelvin_helmholtz_2", "added_mass", "rayleigh_wave", "standing_wave", "standing_wave_2500", "acoustic", "shock_tube", "shock_tube_10", "sod", "sod_equal", "sedov", "sedov_3d",
         "gaussian_blast", "noh", "cantilever", "rings", "spinning_plate",
         "bar_wave", "gravity_patch", "cylinder", "fragmentation", "held_grain", "sinking_layer",
         "heat_decay", "heat_layers", "barenblatt", "water_decay", "convection", "elastic_gate")


def order(sizes, errors):
    """Of convergence, between the two finest."""
    if len(sizes) < 2 or not all(np.isfinite(errors[-2:])) or min(errors[-2:]) <= 0:
        return float("nan")
    return np.log(errors[-2] / errors[-1]) / np.log(sizes[-1] / sizes[-2])


def seconds_to(error, errors, seconds):
    """CPU seconds to an error, by straight lines between runs in the logarithms; NaN where no run is as good."""
    for k in range(len(errors)):
        if not errors[k] <= error:
            continue
        if k == 0 or not np.isfinite(errors[k - 1]):
            return seconds[k]
        return float(np.exp(np.interp(np.log(error), np.log([errors[k], errors[k - 1]]),
                                      np.log([seconds[k], seconds[k - 1]]))))
    return float("nan")


def number(value):
    return "-" if value is None or not np.isfinite(value) else f"{value:.3g}"


class Table:
    """One case: runs by formulation and size."""

    def __init__(self, case, runner, sizes, formulations):
        self.case = case
        self.name = case.__name__
        self.sizes = [n for n in case.SIZES if not sizes or n in sizes]
        chosen = {name: sets for name, sets in case.FORMULATIONS.items() if not formulations or name in formulations}
        futures = {(name, n): runner.start(f"{self.name}_{name.replace(' ', '_')}_{n}", case.SCENE,
                                           (*case.settings(n), *(sets(n) if callable(sets) else sets),
                                            *self.start_file(runner.work, n)))
                   for name, sets in chosen.items() for n in self.sizes}
        self.formulations = list(chosen)
        self.runs = {key: future.result() for key, future in futures.items()}
        self.values = {key: {} if run.failure else case.measure(run) for key, run in self.runs.items()}

    def start_file(self, work, n):
        """Where the case has a start() of its own, a file of it."""
        if not hasattr(self.case, "start"):
            return ()
        path = work / f"{self.name}_{n}.h5"
        write_start(path, **self.case.start(n))
        return (f"start.file={path}",)

    def errors(self, name):
        return np.array([self.values[name, n].get(self.case.ERROR) or np.nan for n in self.sizes], dtype=float)

    def seconds(self, name):
        return np.array([np.nan if self.runs[name, n].failure else self.runs[name, n].cpu for n in self.sizes])

    def lines(self):
        columns = list(dict.fromkeys(key for values in self.values.values() for key in values))
        yield f"## {self.case.__doc__.strip()}\n"
        yield "| formulation | size | " + " | ".join(columns) + " | CPU s | M particle-steps/s |"
        yield "|" + "---|" * (len(columns) + 4)
        for (name, n), run in self.runs.items():
            if run.failure:
                yield f"| {name} | {n} | stopped: {run.failure} |" + " |" * (len(columns) + 1)
                continue
            cells = [number(self.values[name, n].get(column)) for column in columns]
            yield (f"| {name} | {n} | " + " | ".join(cells) +
                   f" | {number(run.cpu)} | {run.particle_steps_per_second / 1e6:.2f} |")
        yield f"\n| formulation | order | CPU s to 5 % | to 1 % |\n|---|---|---|---|"
        for name in self.formulations:
            errors, seconds = self.errors(name), self.seconds(name)
            yield (f"| {name} | {number(order(self.sizes, errors))} | {number(seconds_to(0.05, errors, seconds))} | "
                   f"{number(seconds_to(0.01, errors, seconds))} |")
        yield ""

    def draw(self, axes):
        for name in self.formulations:
            axes.loglog(self.seconds(name), self.errors(name), "o-", lw=1.2, ms=4, label=name)
        axes.set(xlabel="CPU seconds", ylabel=self.case.ERROR, title=page.title_of(self.case))
        axes.grid(True, which="both", color="#dddddd", lw=0.5)
        axes.legend()


def draw(tables, path):
    """Their charts side by side."""
    figure, axes = plt.subplots(1, len(tables), figsize=(5 if len(tables) == 1 else 2.7 * len(tables), 3.6 if len(tables) == 1 else 2.7),
                                layout="constrained", squeeze=False)
    for table, panel in zip(tables, axes[0]):
        table.draw(panel)
    figure.savefig(path)
    plt.close(figure)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=source / "build")
    arguments.add_argument("--cases", nargs="+", choices=CASES, default=CASES)
    arguments.add_argument("--sizes", nargs="+", type=int)
    arguments.add_argument("--formulations", nargs="+")
    arguments.add_argument("--work", type=Path, default=source / "build/accuracy")
    arguments.add_argument("--out", type=Path, default=source / "build/accuracy")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--chart", type=Path)
    arguments.add_argument("--page", action="store_true")
    arguments.add_argument("--busy", action="store_true", help="others use the machine: CPU seconds of before stay")
    given = arguments.parse_args()
    for folder in (given.work, given.out):
        folder.mkdir(parents=True, exist_ok=True)
    runner = Runner(given.build.resolve(), given.work.resolve(), given.jobs)
    plt.rcParams.update({"font.size": 8, "legend.frameon": False, "legend.fontsize": 7, "figure.dpi": 110})
    report, all_cases = ["# Speed against error\n"], []
    for name in given.cases:
        table = Table(importlib.import_module(name), runner, given.sizes, given.formulations)
        lines = list(table.lines())
        print("\n".join(lines), flush=True)
        draw([table], given.out / f"{name}.png")
        all_cases.append(table)
        report += [*lines, f"![{name}]({name}.png)\n"]
        if given.page:
            page.keep(name, table.runs, table.values, given.busy)
            page.write()
    if given.chart:
        draw(all_cases, given.chart)
        manifest.record([given.chart], [run.folder for table in all_cases for run in table.runs.values()],
                        [here / table.case.SCENE for table in all_cases])
    (given.out / "report.md").write_text("\n".join(report))


if __name__ == "__main__":
    sys.exit(main())
