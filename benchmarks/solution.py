#!/usr/bin/python3
"""Time to solution at equal error, side by side: CPU seconds that each code needs to come within a given error. One
core, alternating, medians. Run on a quiet machine (PySPH takes most of the time).

    solution.py BUILD [--lammps LMP] [--cases taylor_green poiseuille dam_break dam_break_3d rising_bubble] [--repeats 3] [--page]

Peers are PySPH (apt-get install python3-pysph) and LAMMPS's package SPH (peers/build_lammps.sh makes LMP). Each code
runs at a ladder of resolutions; the same function measures the error of all at the particles; CPU seconds to the error
asked are by straight lines in the logarithms between the two rungs around it. They are user and system seconds of the
whole program for Peperite and LAMMPS; for PySPH, which compiles on first use, of its loop over steps. Runs of more than
20 s are not repeated. With --page the table of README.md and solution.png are made anew, of the cases given.

Peperite runs the scenes of accuracy/ with their defaults. PySPH runs its own examples (peers/pysph_flow.py) with their
time steps; quintic kernel, h = dx, c = 10 U; the dam break h = 1.3 dx, Wendland's kernel with wcsph. LAMMPS runs
sph/taitwater, with /morris where the fluid is viscous, and what served it best of a few supports, viscosities and time
steps (peers/lmp_*.in). In 3D the dam break is periodic across 14 particles, so its front tends to the same; PySPH takes
its example in 2D, extruded. With a support of 2 spacings it would be 0.62 % off on Poiseuille at any resolution, since
nothing leaves its lattice there; 3 is the nearest of those that converge. Neither has a bubble that rises.
"""

import argparse
import math
import resource
import shutil
import statistics
import subprocess
import sys
import types
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

here = Path(__file__).resolve().parent
sys.path += [str(here / "accuracy"), str(here.parent / "cmake")]
import dam_break  # noqa: E402
import dam_break_3d  # noqa: E402
import manifest  # noqa: E402
import poiseuille  # noqa: E402
import rising_bubble  # noqa: E402
import tables  # noqa: E402
import taylor_green  # noqa: E402
from accuracy import number, seconds_to  # noqa: E402
from runs import Run, environment, run_scene  # noqa: E402

LONG = 20  # CPU seconds of a run that is not repeated
# Of the dam break at 0.6 s [m, m/s]: what ours tends to, 3.554, 3.577 and 3.588 at 40, 80 and 160 across,
# and PySPH's edac, whose distance from it halves from 20 to 40 across.
FRONT, SPEED = 3.598, 6.5
COLOURS = {"Peperite": "#c1272d", "PySPH edac": "#1b6ca8", "PySPH tvf": "#3a7d44", "PySPH wcsph": "#88bbdd",
           "LAMMPS": "#888888"}
TICKS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100]


@dataclass
class Case:
    title: str
    scene: types.ModuleType  # of accuracy/ with SCENE and settings(n)
    measure: Callable  # (run) -> error
    target: float
    ladders: dict  # particles across, by code
    settings: Callable  # (n) -> besides those of the module
    lammps: Callable | None  # (n) -> steps, steps between outputs, time at the end


def steps_of_taylor_green(n):
    return 88 * n, 88 * n, 1  # 1/8 of a spacing over the speeds of sound and flow


def steps_of_poiseuille(n):
    """All five times of the case are multiples of 0.0225 s or, to a step, the end."""
    steps = math.ceil(0.0025 / (0.25 / n**2))  # of at most 0.25 dx^2 / nu, the longest with which it runs
    return 400 * steps, 9 * steps, 1


def room_for_walls(n):
    """Of coarse particles: the scene has room for those of 50 um."""
    spacing = 1e-3 / n
    return f"domain.lower=[0, {-4 * spacing}]", f"domain.upper=[{20 * spacing}, {1e-3 + 4 * spacing}]"


def error_of(module):
    """As the accuracy case measures it."""
    return lambda run: float(module.measure(run)[module.ERROR])


def front_off(run, rows=1):
    first, last = run.snapshots()[0], run.snapshots()[-1]
    exact = FRONT + SPEED * (last.time - 0.6)  # the last step may go beyond
    return abs(dam_break.front(last, math.sqrt(2 * rows / len(first.position)), rows) / exact - 1)


def short_floor(n):
    """Of 4 m, as the peers have it; to the time of the front."""
    layers, depth = 4 / n, dam_break_3d.LAYERS / n
    return (f"domain.upper=[5, 8, {depth}]", f"start.upper=[{4 + layers}, 4, {depth}]",
            f"start.region.1.upper=[4, 4, {depth}]", "time.until=0.6", "output.snapshot_interval=0.6")


def steps_of_dam_break(n):
    steps = math.ceil(0.6 / (1 / 16 / n / 62.6))  # 1/16 of a spacing over the speed of sound
    return steps, steps, 0.6


CASES = {
    "taylor_green": Case("Taylor-Green, Re 100, L2 of the velocity at t = 1", taylor_green, error_of(taylor_green), 0.01, {
        "Peperite": (25, 32, 40, 50, 70),
        "PySPH edac": (25, 50, 75, 100), "PySPH tvf": (25, 50, 75), "PySPH wcsph": (25, 50),
        "LAMMPS": (25, 50, 100),
    }, lambda n: ("time.until=1", "output.snapshot_interval=1"), steps_of_taylor_green),
    "poiseuille": Case("Plane Poiseuille start-up, largest error over u_max", poiseuille, error_of(poiseuille), 0.01, {
        "Peperite": (8, 10, 12, 16, 20), "PySPH tvf": (10, 15, 20, 30, 40), "LAMMPS": (20, 40, 60, 80),
    }, room_for_walls, steps_of_poiseuille),
    "dam_break": Case("Dam break, front at 0.6 s", dam_break, front_off, 0.02, {
        "Peperite": (14, 20, 28, 40), "PySPH edac": (14, 20, 28, 40), "PySPH wcsph": (14, 20, 28, 40),
        "LAMMPS": (14, 20, 28, 40),
    }, lambda n: ("time.until=0.6", "output.snapshot_interval=0.6"), steps_of_dam_break),
    "dam_break_3d": Case("3D dam break, front at 0.6 s", dam_break_3d, lambda run: front_off(run, dam_break_3d.LAYERS), 0.02, {
        "Peperite": (14, 20, 28), "PySPH edac": (8, 14), "PySPH wcsph": (8, 14), "LAMMPS": (14, 20, 28),
    }, short_floor, steps_of_dam_break),
    "rising_bubble": Case("Rising bubble 1, largest rise velocity", rising_bubble, error_of(rising_bubble), 0.02, {
        "Peperite": (16, 20, 24, 32, 40),
    }, lambda n: (), None),
}


class Peer:
    """Particles of another code, as measure() of a case wants them."""

    def __init__(self, times, rows):
        """Rows: x, y, u, v of each particle."""
        self.kept = [types.SimpleNamespace(time=t, position=r[:, :2], velocity=r[:, 2:], mass=np.ones(len(r)),
                                           kinetic=0.5 * np.sum(r[:, 2:]**2)) for t, r in zip(times, rows)]

    def snapshots(self):
        return self.kept


def called(*command):
    done = subprocess.run(list(map(str, command)), env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")


def cpu_of(function, *arguments):
    """User and system seconds of the programs that it calls."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    function(*arguments)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


# Codes: functions (case, n, folder) -> (what measure() takes, CPU seconds)

def peperite(build):
    def run(case, n, folder):
        settings = (*case.scene.settings(n), *case.settings(n))
        cpu = cpu_of(called_scene, build / "bin/peperite", case.scene.SCENE, folder, settings)
        return Run(folder), cpu

    return run


def called_scene(program, scene, folder, settings):
    code = run_scene(program, here / "accuracy" / scene, folder, settings)
    if code != 0:
        raise RuntimeError(f"{folder}: exit code {code}")


def pysph(scheme):
    def run(case, n, folder):
        folder.mkdir()
        called(sys.executable, here / "peers/pysph_flow.py", case.scene.__name__, scheme, n, folder / "out.npz")
        with np.load(folder / "out.npz") as out:
            rows = [out[f"rows_{k}"] for k in range(len(out["times"]))]
            return Peer(out["times"], rows), float(out["cpu"])

    return run


def lammps(lmp):
    def run(case, n, folder):
        folder.mkdir()
        steps, every, until = case.lammps(n)
        deck = here / f"peers/lmp_{case.scene.__name__.removesuffix('_3d')}.in"
        variables = {"n": n, "steps": steps, "every": every, "out": folder / "step.*"}
        if hasattr(case.scene, "LAYERS"):
            variables["layers"] = case.scene.LAYERS
        cpu = cpu_of(called, "mpirun", "-np", 1, lmp, "-in", deck, "-log", "none",
                     *(word for name, value in variables.items() for word in ("-var", name, value)))
        written = sorted((int(path.suffix[1:]), path) for path in folder.glob("step.*"))
        return Peer([until * step / steps for step, _ in written],
                    [np.loadtxt(path, skiprows=9) for _, path in written]), cpu

    return run


# Comparison

@dataclass
class Rung:
    error: float
    seconds: list


def folder_of(work, name, code, n):
    return work / f"{name}_{code.replace(' ', '_')}_{n}"


def climb(name, case, codes, work, repeats):
    """Rungs by code and particles across."""
    rungs = {}
    for _ in tables.turns(repeats):
        for n in sorted({n for code in codes for n in case.ladders[code]}):
            for code, run in codes.items():
                known = rungs.get((code, n))
                if n not in case.ladders[code] or (known and known.seconds[0] > LONG):
                    continue
                folder = folder_of(work, name, code, n)
                shutil.rmtree(folder, ignore_errors=True)
                try:
                    out, cpu = run(case, n, folder)
                except RuntimeError as stopped:
                    print(f"{name}, {code}, {n} across: {stopped}", flush=True)
                    rungs[code, n] = Rung(math.nan, [math.nan])
                    continue
                rung = rungs.setdefault((code, n), Rung(case.measure(out), []))
                rung.seconds.append(cpu)
                print(f"{name}, {code}, {n} across: error {100 * rung.error:.3g} %, {cpu:.3g} CPU s", flush=True)
    return rungs


def line_of(code, ladder, rungs):
    """Errors and medians of the CPU seconds, from coarse to fine."""
    of_code = [rungs[code, n] for n in ladder]
    return [rung.error for rung in of_code], [statistics.median(rung.seconds) for rung in of_code]


def rows_of(case, codes, rungs):
    lines = {code: line_of(code, case.ladders[code], rungs) for code in codes}
    needed = {code: seconds_to(case.target, *line) for code, line in lines.items()}
    out = []
    for code, (errors, seconds) in lines.items():
        best = int(np.nanargmin(errors))
        reached = f"{number(needed[code])} s" if np.isfinite(needed[code]) else (
            f"reaches {number(100 * errors[best])} % in {number(seconds[best])} s")
        ratio = needed[code] / needed["Peperite"]
        out.append((f"{case.title}: {100 * case.target:g} %" if not out else "", code, reached,
                    f"{ratio:.2g}" if np.isfinite(ratio) else "",
                    ", ".join(map(str, case.ladders[code])), ", ".join(number(100 * e) for e in errors),
                    ", ".join(map(number, seconds))))
    return out


def draw(climbed, path):
    figure, axes = plt.subplots(1, len(climbed), figsize=(4.2 * len(climbed), 3.4), layout="constrained", squeeze=False)
    for (case, codes, rungs), panel in zip(climbed, axes[0]):
        for code in codes:
            errors, seconds = line_of(code, case.ladders[code], rungs)
            panel.loglog(seconds, 100 * np.array(errors), "o-", lw=1.2, ms=4, label=code,
                         color=COLOURS[code])
        panel.axhline(100 * case.target, color="#888888", lw=0.8, ls="--")
        panel.set(xlabel="CPU seconds", ylabel="error (%)", title=case.title)
        panel.minorticks_off()
        panel.set_xticks(TICKS, [f"{t:g}" for t in TICKS])
        panel.set_yticks(TICKS, [f"{t:g}" for t in TICKS])
        panel.autoscale(axis="both")
        panel.grid(True, color="#dddddd", lw=0.5)
        panel.legend()
    figure.savefig(path)
    plt.close(figure)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=here.parent / "build")
    arguments.add_argument("--lammps", type=Path)
    arguments.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--work", type=Path, default=here.parent / "build/solution")
    arguments.add_argument("--page", action="store_true")
    given = arguments.parse_args()
    work, build = given.work.resolve(), given.build.resolve()
    work.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update({"font.size": 8, "axes.titlesize": 8, "legend.frameon": False, "legend.fontsize": 7,
                         "figure.dpi": 110})
    codes = {"Peperite": peperite(build)} | {f"PySPH {scheme}": pysph(scheme) for scheme in ("edac", "tvf", "wcsph")}
    if given.lammps:
        codes["LAMMPS"] = lammps(given.lammps.resolve())
    climbed, rows = [], []
    for name in given.cases:
        case = CASES[name]
        of_case = {code: run for code, run in codes.items() if code in case.ladders}
        climbed.append((case, of_case, climb(name, case, of_case, work, given.repeats)))
        rows += rows_of(*climbed[-1])
    lines = tables.markdown(("case: error", "code", "CPU s to it", "over ours", "particles across", "errors (%)", "CPU s"),
                            rows)
    print("\n".join(lines))
    picture = here / "solution.png" if given.page else work / "solution.png"
    draw(climbed, picture)
    if given.page:
        tables.write(here / "README.md", "solution", tables.origin(tables.commit_of(build)), lines)
        manifest.record([picture], [folder_of(work, name, "Peperite", n) for name in given.cases
                                    for n in CASES[name].ladders["Peperite"]],
                        [here / "accuracy" / CASES[name].scene.SCENE for name in given.cases])


if __name__ == "__main__":
    main()
