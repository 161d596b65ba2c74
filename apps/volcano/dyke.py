#!/usr/bin/python3
"""Draws whether a slot stays open, against what the rock beside it takes: runs of dyke.toml.

    dyke.py RUNS [--out DIR] [--programs build/bin]

Runs that are not in RUNS yet are made, on one rank each, two at a time: some minutes in all.
"""

import argparse
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

here = Path(__file__).resolve().parent
sys.path.append(str(here.parent / "plotting"))
from figures import plt, save  # noqa: E402
from run_folder import BadInput, refusing  # noqa: E402

COEFFICIENTS = (100, 300, 1000, 3000)  # W/m2/K
SOLIDUS, LIQUIDUS = 1273, 1423


def make(programs, folder, coefficient):
    done = subprocess.run([str(Path(programs) / "peperite"), "run", str(here / "dyke.toml"), "--out", str(folder), "--set",
                           f"group.rock.heat_transfer.coefficient={coefficient}"], capture_output=True, text=True)
    if done.returncode:
        raise BadInput(done.stderr.strip().split("\n")[0])


def draw_temperatures(axes, folder, title):
    with h5py.File(sorted(folder.glob("snapshot_*.h5"))[-1]) as f:
        p = f["particles"]
        melt = p["group"][:] == 0
        x, t, time = p["position"][melt], p["temperature"][melt], f.attrs["time"]
    drawn = axes.scatter(100 * x[:, 0], 100 * x[:, 1], c=t, s=9, cmap="inferno", vmin=900, vmax=1473)
    axes.tricontour(100 * x[:, 0], 100 * x[:, 1], t, levels=[SOLIDUS], colors="white", linewidths=1)
    axes.set(title=f"{title}, {time:.0f} s", xlabel="x (cm)", ylabel="y (cm)", aspect="equal")
    return drawn


def draw(folders, out):
    figure, axes = plt.subplots(1, 3, figsize=(11, 5), layout="constrained", width_ratios=(1, 1, 2))
    for panel, coefficient in zip(axes, (COEFFICIENTS[0], COEFFICIENTS[-1])):
        drawn = draw_temperatures(panel, folders[coefficient], f"{coefficient} W/m²/K")
    figure.colorbar(drawn, ax=axes[1], label="temperature (K); white: solidus")
    for coefficient in COEFFICIENTS:
        series = np.genfromtxt(folders[coefficient] / "series.csv", delimiter=",", names=True)
        axes[2].semilogy(series["t"][1:], 100 * series["melt_vy"][1:], label=f"{coefficient} W/m²/K")
    axes[2].set(xlabel="time (s)", ylabel="mean rise of the melt (cm/s)", ylim=(1e-3, None), title="what the rock takes")
    axes[2].legend()
    save(figure, Path(out) / "dyke.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs")
    parser.add_argument("--out", help="default: RUNS")
    parser.add_argument("--programs", default="build/bin")
    given = parser.parse_args()
    folders = {c: Path(given.runs) / f"h_{c}" for c in COEFFICIENTS}
    wanted = [c for c, folder in folders.items() if not (folder / "perf.json").is_file()]
    with ThreadPoolExecutor(2) as two:
        list(two.map(lambda c: make(given.programs, folders[c], c), wanted))
    draw(folders, given.out or given.runs)


if __name__ == "__main__":
    sys.exit(refusing(main))
