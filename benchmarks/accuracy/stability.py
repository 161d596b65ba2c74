#!/usr/bin/python3
"""Hard cases near the limit of the time step: each at 0.9 of it, in double and mixed precision, on 1 and 2 ranks.

    stability.py [BUILD] [--cases tank ...] [--limit] [--work DIR]

Passes where no guard stops the run, its energies stay below the bound of the case, and both rank counts give the same
bits. --limit: also the largest c dt / h that passes, by bisection up to the 1.2 that the program allows.
"""

import argparse
import importlib
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

from runs import Run, environment, here, source, write_start

LIMIT = 1.2  # courant_limit of sph/models/physics.hpp


def kinetic(run):
    """Largest kinetic energy over the first."""
    energy = run.series()["energy_kinetic"]
    return np.max(energy) / energy[0]


def kinetic_of_tank(run):
    return np.max(run.series()["energy_kinetic"]) / (1000 * 9.8)


def rise(run):
    """Largest rise of the total energy over the range it has fallen through, or over the kinetic energy."""
    series = run.series()
    energy = sum(series[k] for k in series if k.startswith("energy"))
    return np.max(energy - np.minimum.accumulate(energy)) / max(np.ptp(energy), np.max(series["energy_kinetic"]))


# Case, its size, settings; what is bounded, and by what.
CASES = {
    "jittered vortices": ("taylor_green", 50, (), kinetic, 1.02),
    "lattice vortices": ("taylor_green", 50, ("start.jitter=0",), kinetic, 1.02),
    "tank": ("hydrostatic", 25, ("time.until=10",), kinetic_of_tank, 1e-4),
    "dam break": ("dam_break", 20, (), rise, 0.02),
    "elliptic drop": ("elliptic_drop", 25, (), rise, 0.02),
    # Of the drop held by a pull the total energy does rise for a time, by 5.5 and 2.5 % of the range it falls through
    # at 12 and 25 particles a radius: shifting moves particles against the pull.
    "oscillating drop": ("oscillating_drop", 12, (), kinetic, 1.02),
    "patch": ("rotating_patch", 50, (), kinetic, 1.02),
    "cylinder": (source / "apps/buoyant_cylinder/fluid_fine.toml", 0,
                 ("time.dt=", "time.until=3", "output.snapshot_interval=0", "output.series_interval=0.05"), rise, 0.02),
    # Implicit viscosity, at 15 times the explicit limit of the step
    "viscous cylinder": (source / "apps/buoyant_cylinder/fluid_fine.toml", 0,
                         ("time.dt=", "time.until=1", "output.snapshot_interval=0", "output.series_interval=0.05",
                          "group.melt.viscosity=1e6", "group.cylinder.viscosity=1e6",
                          "terms.implicit_viscosity=true"), rise, 0.02),
}


def once(build, work, name, courant, precision, ranks):
    """Value over its bound, infinite after a guard, and the fingerprint."""
    module, n, more, value, bound = CASES[name]
    settings = [*more, f"time.cfl={courant}", f"precision={precision}"]
    scene = module
    if n:
        case = importlib.import_module(module)
        scene = here / case.SCENE
        settings = [*case.settings(n), "output.snapshot_interval=0", *settings]
        if hasattr(case, "start"):
            path = work / f"{module}_{n}.h5"
            write_start(path, **case.start(n))
            settings.append(f"start.file={path}")
    folder = work / "run"
    shutil.rmtree(folder, ignore_errors=True)
    sets = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run(["mpirun", "-np", str(ranks), build / "bin/peperite", "run", scene, "--out", folder, *sets],
                          env=environment, capture_output=True, text=True)
    if done.returncode == 3:
        return np.inf, ""
    if done.returncode != 0:
        sys.exit(f"{name}: exit code {done.returncode}\n{done.stderr[-500:]}")
    measured = value(Run(folder))
    return (measured / bound if np.isfinite(measured) else np.inf), done.stdout.split("fingerprint ")[-1].split()[0]


def largest_courant(build, work, name, precision):
    def stable(courant):
        return once(build, work, name, courant, precision, 1)[0] <= 1

    if stable(LIMIT):
        return f">= {LIMIT}"
    low, high = 0.2, LIMIT
    if not stable(low):
        return f"< {low}"
    while high - low > 0.05:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return f"{low:.2f}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=source / "build")
    arguments.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    arguments.add_argument("--limit", action="store_true")
    arguments.add_argument("--work", type=Path, default=source / "build/stability")
    given = arguments.parse_args()
    given.work.mkdir(parents=True, exist_ok=True)
    build, work = given.build.resolve(), given.work.resolve()
    last = " largest c dt / h |" if given.limit else ""
    print(f"| case at c dt / h = {0.9 * LIMIT:.3g} | precision | of its bound | same bits on 2 ranks |{last}")
    print(f"|---|---|---|---|{'---|' if given.limit else ''}", flush=True)
    good = True
    for name in given.cases:
        for precision in ("double", "mixed"):
            value, bits = once(build, work, name, 0.9 * LIMIT, precision, 1)
            other = once(build, work, name, 0.9 * LIMIT, precision, 2)[1]
            good = good and value <= 1 and bits == other
            limit = f" {largest_courant(build, work, name, precision)} |" if given.limit else ""
            print(f"| {name} | {precision} | {value:.3g} | {'yes' if bits == other else 'NO'} |{limit}", flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
