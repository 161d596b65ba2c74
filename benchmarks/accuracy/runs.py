"""Runs of the accuracy cases on one rank; what has come to its end in the work folder stays."""

import json
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

here = Path(__file__).resolve().parent
source = here.parent.parent
sys.path += [str(source / "benchmarks"), str(source / "apps/python")]
import tables  # noqa: E402, F401
from peperite import Series  # noqa: E402
from speed import environment, log_of, run_scene  # noqa: E402, F401


class Snapshot:
    """The particles at one time; walls are left out."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.time = float(file.attrs["time"])
            particles = file["particles"]
            names = ("position", "velocity", "density", "pressure", "mass", "group")
            position, velocity, density, pressure, mass, group = (particles[name][()] for name in names)
            kinds = [g["kind"] for g in tomllib.loads(file.attrs["scene"])["group"]]
            others = ("stress", "fluid_force", "temperature", "dissolved_gas")
            others = [particles[name][()] if name in particles else None for name in others]
        moves = np.array([kind != "wall" for kind in kinds])[group]
        self.position, self.velocity, self.density = position[moves], velocity[moves], density[moves]
        self.pressure, self.mass, self.group = pressure[moves], mass[moves], group[moves]
        self.stress, self.fluid_force, self.temperature, self.dissolved = (
            None if values is None else values[moves] for values in others)

    @property
    def kinetic(self):
        return 0.5 * float(np.sum(self.mass * np.sum(self.velocity**2, axis=1)))


def write_start(path, x, v, group=0, **matter):
    """A start file; ids in the order of the rows. `matter`: rho, mass, stress, u, T, m; what is not given follows from the scene."""
    n = len(x)
    with h5py.File(path, "w") as file:
        file["id"] = np.arange(1, n + 1, dtype=np.uint64)
        file["x"], file["v"] = x, np.broadcast_to(v, np.shape(x))
        file["group"] = np.broadcast_to(np.asarray(group, dtype=np.uint32), n)
        for name, values in matter.items():
            if values is not None:
                file[name] = np.broadcast_to(values, n) if np.ndim(values) < 2 else values


class Run:
    """What a run left in its folder."""

    def __init__(self, folder, failure=""):
        self.folder = folder
        self.failure = failure  # the last line of a run that a guard stopped
        self.perf = None if failure else json.loads((folder / "perf.json").read_text())

    @property
    def cpu(self):
        """Seconds of computation."""
        return self.perf["cost_seconds"]

    @property
    def particle_steps_per_second(self):
        return self.perf["particles"] * self.perf["steps"] / self.cpu

    def snapshots(self):
        """In the order of their times."""
        return sorted((Snapshot(path) for path in self.folder.glob("snapshot_*.h5")), key=lambda s: s.time)

    def series(self):
        """Columns of series.csv by name."""
        return Series(self.folder / "series.csv")


class Runner:
    def __init__(self, build, work, jobs):
        self.program = build / "bin/peperite"
        self.work = work
        self.pool = ThreadPoolExecutor(jobs)

    def start(self, name, scene, settings):
        """A future of a Run."""
        return self.pool.submit(self.run, name, scene, settings)

    def run(self, name, scene, settings):
        folder = self.work / name
        failed = self.work / f"{name}.failed"
        if failed.exists():
            return Run(folder, failed.read_text())
        code = run_scene(self.program, here / scene, folder, settings)
        log = log_of(folder)
        if code == 3:  # a physics guard: a result too
            lines = [line for line in log.read_text().splitlines() if line.startswith("peperite:")]
            failed.write_text(lines[-1])
            return Run(folder, lines[-1])
        if code != 0:
            raise RuntimeError(f"{name}: exit code {code}\n{log.read_text()[-2000:]}")
        return Run(folder)
