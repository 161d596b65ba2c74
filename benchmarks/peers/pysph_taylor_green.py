#!/usr/bin/python3
"""Taylor-Green vortices, Re 100, side by side with PySPH's own example (python3-pysph), one core, alternating.

    pysph_taylor_green.py BUILD [--n 50] [--schemes wcsph tvf edac] [--repeats 3]

Both start from particles displaced by up to 5 % of their distance, h = dx, quintic kernel, c = 10 U, and are compared
at t = 1 by the same errors at the particles:

    L1 = sum |u - u_exact| / sum |u_exact|    L2 = the same of squares, rooted    Linf = |max |u| / U_exact - 1|

CPU seconds are those of the process in the loop over steps. PySPH compiles on first use: a first run of each scheme
warms it and is not counted. Each runs with its own time step: c + U in 0.25 h / dt (PySPH's example) or 0.8 (ours).
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
source = here.parent.parent
sys.path.append(str(source / "benchmarks"))
sys.path.append(str(source / "benchmarks/accuracy"))
OURS = {"default": (), "mixed": ("precision=mixed",)}


def errors(x, y, u, v, time):
    decay = np.exp(-8 * np.pi**2 / 100 * time)
    x, y = 2 * np.pi * np.asarray(x), 2 * np.pi * np.asarray(y)
    exact = decay * np.array((-np.cos(x) * np.sin(y), np.sin(x) * np.cos(y)))
    away = np.array((u, v)) - exact
    speed, largest = np.sqrt((exact**2).sum(axis=0)), np.sqrt(np.square((u, v)).sum(axis=0)).max()
    return {"L1": np.sqrt((away**2).sum(axis=0)).sum() / speed.sum(),
            "L2": np.sqrt((away**2).sum() / (exact**2).sum()), "Linf": abs(largest / decay - 1)}


def child(scheme, n, until):
    """PySPH in a process of its own: prints errors and CPU seconds of the loop, solver.solve."""
    import time

    from pysph.examples.taylor_green import TaylorGreen
    from pysph.solver.solver import Solver

    solve, spent = Solver.solve, []

    def timed(self, show_progress=True):
        begin = time.process_time()
        solve(self, False)
        spent.append(time.process_time() - begin)

    Solver.solve = timed
    with tempfile.TemporaryDirectory() as directory:
        app = TaylorGreen(output_dir=directory)
        app.run(["--scheme", scheme, "--nx", str(n), "--perturb", "0.1", "--tf", str(until), "--disable-output", "-q"])
    particles = app.solver.particles[0]
    x, y, u, v = (particles.get(key, only_real_particles=True) for key in "xyuv")
    print(json.dumps({**errors(x, y, u, v, app.solver.t), "cpu": spent[0], "steps": app.solver.count}))


def pysph(scheme, n, until):
    done = subprocess.run([sys.executable, __file__, "--child", scheme, "--n", str(n), "--until", str(until)],
                          capture_output=True, text=True)
    lines = done.stdout.strip().splitlines()
    if done.returncode != 0 or not lines:
        return {"failure": (done.stderr.strip().splitlines() or ["no result"])[-1]}
    return json.loads(lines[-1])


def ours(build, settings, n):
    from runs import Run, run_scene

    with tempfile.TemporaryDirectory() as directory:
        folder = Path(directory) / "run"
        code = run_scene(build / "bin/peperite", source / "benchmarks/accuracy/taylor_green.toml", folder,
                         (f"start.spacing={1 / n}", "time.until=1", *settings))
        if code != 0:
            sys.exit(f"exit code {code}")
        run = Run(folder)
        last = run.snapshots()[-1]
        return {**errors(*last.position.T, *last.velocity.T, last.time), "cpu": run.cpu, "steps": run.perf["steps"]}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=source / "build")
    arguments.add_argument("--n", type=int, default=50)
    arguments.add_argument("--schemes", nargs="+", default=["wcsph", "tvf", "edac"])
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--until", type=float, default=1, help=argparse.SUPPRESS)
    arguments.add_argument("--child", help=argparse.SUPPRESS)
    given = arguments.parse_args()
    if given.child:
        return child(given.child, given.n, given.until)
    for scheme in given.schemes:
        pysph(scheme, given.n, 0.01)
    rows = {**{f"PySPH {scheme}": [] for scheme in given.schemes}, **{f"Peperite {name}": [] for name in OURS}}
    for _ in range(given.repeats):
        for scheme in given.schemes:
            rows[f"PySPH {scheme}"].append(pysph(scheme, given.n, 1))
        for name, settings in OURS.items():
            rows[f"Peperite {name}"].append(ours(given.build.resolve(), settings, given.n))
    base = statistics.median(run["cpu"] for run in rows["Peperite default"])
    print(f"| {given.n} x {given.n}, t = 1 | L1 | L2 | Linf | steps | CPU s | over ours |")
    print("|---|---|---|---|---|---|---|")
    for name, runs in rows.items():
        good = [run for run in runs if "failure" not in run]
        if not good:
            print(f"| {name} | {runs[0]['failure']} | | | | | |")
            continue
        cpu = statistics.median(run["cpu"] for run in good)
        cells = [f"{100 * good[0][key]:.3g} %" for key in ("L1", "L2", "Linf")]
        print(f"| {name} | {' | '.join(cells)} | {good[0]['steps']} | {cpu:.2f} | {cpu / base:.1f} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
