#!/usr/bin/python3
"""Who owns which particles as they move, and how unequal the work is, for each balancer; after figure 3 of
Furuichi & Nishiura (2017).

    partitions.py [BUILD] [--ranks 8] [--scenes dam heap sandbox] [--slow] [--page] [--work DIR] [--pictures DIR]

Runs each scene with each balancer, prints the mean imbalance over the second half of the time, and draws
partition_SCENE.png and imbalance.png. With --slow, rank 3 takes twice as long, in a work folder and pictures of
their own. With --page it writes the table partitions-RANKS of README.md. Runs that have come to their end in the work folder are not repeated. Exit code 1 if the balancers of one
scene do not end in the same bits.
"""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402
from PIL import Image  # noqa: E402

import tables  # noqa: E402
from speed import environment, finished  # noqa: E402

here = Path(__file__).resolve().parent
sys.path.append(str(here.parent / "cmake"))
import manifest  # noqa: E402

BALANCERS = {"fixed": "#888888", "literal": "#c1272d", "quasi_newton": "#1b6ca8", "hybrid": "#3a7d44"}
DRAWN = ("fixed", "quasi_newton")
COLOURS = np.array([to_rgb(c) for c in ("#4477aa", "#ee8866", "#44bb99", "#ddaa33", "#aa5599", "#88bbdd", "#bb4455",
                                        "#99aa44")])
STYLE = {"font.size": 9, "axes.titlesize": 9, "axes.edgecolor": "#555555", "axes.linewidth": 0.8,
         "legend.frameon": False, "figure.dpi": 110}


@dataclass
class Case:
    title: str
    scene: Path
    unit: str  # of the picture's axes
    times: tuple  # of the panels [s]
    every: float  # between snapshots [s]
    settings: tuple = ()


CASES = {
    # To where the water reaches the far wall.
    "dam": Case("Dam break from above", here / "scenes/dam_break.toml", "m", (0.04, 0.16, 0.28, 0.44), 0.04,
                ("precision=mixed",)),
    "heap": Case("Pile from above", here / "scenes/pile.toml", "cm", (0.02, 0.1, 0.2, 0.5), 0.02),
    # Cut along the height instead of the thin direction, where the rain falls out of the upper ranks.
    "sandbox": Case("Sandbox from the side", here.parent / "apps/sandbox/sandbox.toml", "cm", (0.02, 0.12, 0.24, 0.4),
                    0.02, ('decomposition.cut_axes=["x", "z"]', "output.contacts=false")),
}


class Partition:
    """Cuts as perf.json and the record of a run write them, on the cells of perf.json."""

    def __init__(self, cells, line):
        self.row_axis, self.column_axis = cells["cut_axes"]
        self.cells = cells
        self.row, *self.columns = (np.array(part.split(), int) for part in line.removeprefix("rows").split("|"))
        self.first = np.cumsum([0] + [len(columns) - 1 for columns in self.columns])

    def part(self, position):
        """Row and column of each position."""
        row, column = (np.clip((position[:, a] - self.cells["origin"][a]) // self.cells["edge"][a], 0,
                               self.cells["number"][a] - 1) for a in (self.row_axis, self.column_axis))
        row = np.searchsorted(self.row, row, side="right") - 1
        for k, columns in enumerate(self.columns):
            column[row == k] = np.searchsorted(columns, column[row == k], side="right") - 1
        return row, column.astype(int)

    def misplaced(self, position):
        """How many particles of a snapshot in the order of its owners these cuts would put elsewhere."""
        row, column = self.part(position)
        rank = (self.first[row] + column).astype(np.int16)
        return np.count_nonzero(rank != np.sort(rank, kind="stable"))

    def colours(self, position):
        """Neighbours differ, and all ranks up to eight in rows of up to four."""
        row, column = self.part(position)
        return COLOURS[(column + min(4, len(self.columns[0]) - 1) * row) % len(COLOURS)]

    def lines(self, low, high):
        """From end to end of the picture, each a pair of points along (first, second) axis of the picture."""
        ends = {a: (low[a], high[a]) for a in (self.row_axis, self.column_axis)}

        def place(axis, cell):
            inner = self.cells["origin"][axis] + self.cells["edge"][axis] * cell
            return np.where(cell == 0, low[axis], np.where(cell == self.cells["number"][axis], high[axis], inner))

        row = place(self.row_axis, self.row)
        out = [{self.row_axis: (y, y), self.column_axis: ends[self.column_axis]} for y in row[1:-1]]
        for k, columns in enumerate(self.columns):
            out += [{self.row_axis: row[k:k + 2], self.column_axis: (x, x)}
                    for x in place(self.column_axis, columns)[1:-1]]
        return [tuple(line[a] for a in sorted(line)) for line in out]


class Snapshot:
    def __init__(self, path):
        with h5py.File(path) as file:
            self.time = float(file.attrs["time"])
            scene = tomllib.loads(file.attrs["scene"])
            particles = file["particles"]
            self.position = particles["position"][()]
            kinds = [group["kind"] for group in scene["group"]]
            self.wall = np.array([kind == "wall" for kind in kinds])[particles["group"][()]]
            # Particles of a fluid fill the space: drawn as discs that overlap.
            self.diameter = 2 * particles["radius"][()] if "radius" in particles else 1.2 * scene["start"]["spacing"]


class Run:
    """A folder FOLDER, and beside it what the screen showed and the cuts of each rebuild."""

    def __init__(self, folder):
        self.folder = folder
        self.perf = json.loads((folder / "perf.json").read_text())
        log = folder.with_suffix(".log").read_text()
        progress = re.findall(r"^step \d+  t (\S+) s .* imb (\S+)", log, re.M)
        time, imbalance = np.array(progress, float).T  # of the interval that ends at this time
        # After the last line all goes on as before it.
        self.time = np.array([0, *time, self.perf["end"]["time"]])
        self.integral = np.array([0, *np.cumsum(np.array([*imbalance, imbalance[-1]]) * np.diff(self.time))])

    def imbalance(self, edges):
        """Mean over the time of the scene between each two edges."""
        return np.diff(np.interp(edges, self.time, self.integral)) / np.diff(edges)

    def snapshots(self, times):
        """Those nearest to the times, in their order."""
        all_of_it = [Snapshot(path) for path in sorted(self.folder.glob("snapshot_*.h5"))]
        return [min(all_of_it, key=lambda s: abs(s.time - t)) for t in times]

    def partition_of(self, snapshot):
        """Snapshots have no cuts and cuts have no time. But rows of a snapshot that is not sorted by id are in the
        order of their owners: those cuts were in force under which the fewest are not. (Some always are: who crosses a
        cut changes its owner at the next rebuild.)"""
        lines = dict.fromkeys(self.folder.with_suffix(".cuts").read_text().splitlines())
        return min((Partition(self.perf["cells"], line) for line in lines),
                   key=lambda partition: partition.misplaced(snapshot.position))


def run(build, folder, ranks, case, settings):
    if finished(folder):
        return Run(folder)
    shutil.rmtree(folder, ignore_errors=True)
    settings = (*case.settings, *settings, f"decomposition.record={folder.with_suffix('.cuts')}", "output.sort_limit=0",
                f"output.snapshot_interval={case.every}", "output.status_interval=0.5")
    command = ["mpirun", "-np", str(ranks), build / "bin/peperite", "run", case.scene, "--until", str(case.times[-1]),
               "--out", folder, *(word for setting in settings for word in ("--set", setting))]
    with open(folder.with_suffix(".log"), "w") as log:
        code = subprocess.call(command, env=environment, stdout=log, stderr=subprocess.STDOUT)
    if code != 0:
        sys.exit(f"{folder.name}: exit code {code}\n{folder.with_suffix('.log').read_text()[-2000:]}")
    return Run(folder)


def draw_particles(axes, snapshot, partition, plane, low, high, scale):
    """Higher is brighter and in front; walls are pale."""
    above = ({0, 1, 2} - set(plane)).pop()
    height = (snapshot.position[:, above] - low[above]) / (high[above] - low[above])
    order = np.argsort(height)
    colours = (0.8 + 0.2 * height[:, None]) * partition.colours(snapshot.position)
    colours[snapshot.wall] = 0.75 + 0.25 * colours[snapshot.wall]
    size = scale * np.broadcast_to(snapshot.diameter, height.shape)[order]
    axes.add_collection(EllipseCollection(size, size, 0, units="xy", facecolors=colours[order], linewidths=0,
                                          offsets=scale * snapshot.position[order][:, plane],
                                          offset_transform=axes.transData))
    for x, y in partition.lines(low, high):
        axes.plot(scale * np.array(x), scale * np.array(y), color="#222222", linewidth=0.7)


def draw_partitions(case, runs):
    snapshots = {name: runs[name].snapshots(case.times) for name in DRAWN}
    everything = [s for several in snapshots.values() for s in several]
    low, high = (reach([reach(s.position, axis=0) for s in everything], axis=0) for reach in (np.min, np.max))
    margin = 0.03 * max(high - low)
    low, high = low - margin, high + margin
    plane = sorted(next(iter(runs.values())).perf["cells"]["cut_axes"])
    scale = {"m": 1, "cm": 100}[case.unit]
    wide, tall = (high - low)[plane]
    # Time goes to the right, but downwards where the panels are wide.
    down, across, width = (len(case.times), len(DRAWN), 4.5) if wide > 2 * tall else (len(DRAWN), len(case.times), 2.7)
    figure, axes = plt.subplots(down, across, sharex=True, sharey=True, squeeze=False, layout="compressed",
                                figsize=(across * (width + 0.1) + 0.5, down * (width * tall / wide + 0.3) + 0.7))
    for name, panels in zip(DRAWN, axes.T if wide > 2 * tall else axes):
        for panel, snapshot in zip(panels, snapshots[name]):
            draw_particles(panel, snapshot, runs[name].partition_of(snapshot), plane, low, high, scale)
            imbalance = runs[name].imbalance([snapshot.time - case.every, snapshot.time])[0]
            panel.set_title(f"{name}, {snapshot.time:.2f} s: max/mean {imbalance:.2f}", pad=3)
            panel.set(xlim=scale * np.array([low[plane[0]], high[plane[0]]]), aspect="equal",
                      ylim=scale * np.array([low[plane[1]], high[plane[1]]]))
    for panel in axes[:, 0]:
        panel.set_ylabel(f"{'xyz'[plane[1]]} ({case.unit})")
    for panel in axes[-1]:
        panel.set_xlabel(f"{'xyz'[plane[0]]} ({case.unit})")
    figure.suptitle(case.title, weight="bold")
    return figure


def draw_imbalance(runs):
    figure, axes = plt.subplots(1, len(runs), sharey=True, squeeze=False, layout="constrained",
                                figsize=(3.6 * len(runs) + 0.6, 3.2))
    largest = 1
    for panel, (scene, of_scene) in zip(axes[0], runs.items()):
        for name, of_it in of_scene.items():
            edges = np.linspace(0, of_it.time[-1], 41)
            imbalance = of_it.imbalance(edges)
            largest = max(largest, *imbalance)
            panel.plot(0.5 * (edges[:-1] + edges[1:]), imbalance, color=BALANCERS[name], linewidth=1.4, label=name)
        panel.set(title=CASES[scene].title.split(" from ")[0], xlabel="t (s)", yscale="log", xlim=(0, None))
        panel.set_yticks(ticks := [1, 1.2, 1.5, 2, 3, 4, 6, 8], labels=[f"{t:g}" for t in ticks])
        panel.minorticks_off()
        panel.grid(True, color="#dddddd")
    axes[0, 0].set(ylabel="work of ranks, max/mean", ylim=(1, 1.2 * largest))
    axes[0, -1].legend()
    return figure


def save(figure, path):
    """With 256 colours: a third as large."""
    figure.savefig(path, bbox_inches="tight", pad_inches=0.08)
    with Image.open(path) as picture:
        picture.convert("RGB").quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)
    plt.close(figure)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path, nargs="?", default=here.parent / "build")
    arguments.add_argument("--ranks", type=int, default=8)
    arguments.add_argument("--scenes", nargs="+", choices=CASES, default=list(CASES))
    arguments.add_argument("--slow", action="store_true")
    arguments.add_argument("--page", action="store_true")
    arguments.add_argument("--work", type=Path, default=here.parent / "build/partitions")
    arguments.add_argument("--pictures", type=Path, default=here)
    given = arguments.parse_args()
    suffix = "_slow" if given.slow else ""
    slow = ("decomposition.slow_rank=3", "decomposition.slowness=2") if given.slow else ()
    work = given.work.resolve() / f"{given.ranks}_ranks{suffix}"
    for folder in (work, given.pictures):
        folder.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update(STYLE)

    agree, all_runs, rows = True, {}, []
    print(f"{'scene':10}{'balancer':14}{'imbalance, 2nd half':>20}{'seconds':>10}")
    for scene in given.scenes:
        runs = all_runs[scene] = {}
        rows.append([scene])
        for name in BALANCERS:
            runs[name] = run(given.build.resolve(), work / f"{scene}_{name}", given.ranks, CASES[scene],
                             (f"decomposition.balance={name}", *slow))
            late = runs[name].imbalance(runs[name].time[-1] * np.array([0.5, 1]))[0]
            print(f"{scene:10}{name:14}{late:20.2f}{runs[name].perf['wall_seconds']:10.1f}", flush=True)
            rows[-1].append(f"{late:.2f}")
        prints = {r.perf["fingerprint"] for r in runs.values()}
        print(f"{scene}: " + ("all fingerprints agree" if len(prints) == 1 else "FINGERPRINTS DIFFER"), flush=True)
        agree = agree and len(prints) == 1
        drawn = given.pictures / f"partition_{scene}{suffix}.png"
        save(draw_partitions(CASES[scene], runs), drawn)
        manifest.record([drawn], [r.folder for r in runs.values()], [CASES[scene].scene])
    drawn = given.pictures / f"imbalance{suffix}.png"
    save(draw_imbalance(all_runs), drawn)
    manifest.record([drawn], [r.folder for runs in all_runs.values() for r in runs.values()],
                    [CASES[scene].scene for scene in given.scenes])
    if given.page:
        tables.write(here / "README.md", f"partitions-{given.ranks}{suffix}", tables.origin(tables.commit_of(given.build)),
                     tables.markdown(("scene", *BALANCERS), rows))
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
