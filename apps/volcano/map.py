#!/usr/bin/python3
"""Draws what share of the magma was thrown out as spray against viscosity and permeability: runs of conduit.toml.

    map.py RUNS [--out DIR] [--programs build/bin]

Runs that are not in RUNS yet are made, on one rank each, at twice the spacing of the scene: a minute in all.
"""

import argparse
import subprocess
import sys
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
sys.path.append(str(here.parent / "plotting"))
from figures import plt, save  # noqa: E402
from run_folder import BadInput, refusing  # noqa: E402

VISCOSITIES = (1e4, 1e5, 1e6, 1e7)
PERMEABILITIES = (6.3e-13, 6.3e-12, 6.3e-11, 6.3e-10, 6.3e-9)


def folder_of(runs, viscosity, permeability):
    return Path(runs) / f"eta_{viscosity:.0e}_k_{permeability:.1e}"


def make(programs, folder, viscosity, permeability):
    done = subprocess.run([str(Path(programs) / "peperite"), "run", str(here / "conduit.toml"), "--out", str(folder), "--set",
                           "start.spacing=2", "--set", f"group.magma.viscosity={viscosity}", "--set",
                           f"group.magma.permeability.coefficient={permeability}"], capture_output=True, text=True)
    if done.returncode:
        raise BadInput(done.stderr.strip().split("\n")[0])


def at_the_end(folder):
    """Shares: of the particles that are spray, of the gas that got away without it."""
    series = np.genfromtxt(folder / "series.csv", delimiter=",", names=True)
    spray, magma = series["spray_n"][-1], series["magma_n"][-1]
    return spray / (spray + magma), -series["budget_gas_in"][-1] / series["budget_gas"][0]


def draw(values, out):
    figure, all_axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for axes, k, title in zip(all_axes, (0, 1), ("share of the magma that is spray", "share of the gas that got away")):
        shares = np.array([[values[eta, p][k] for p in PERMEABILITIES] for eta in VISCOSITIES])
        axes.imshow(shares, origin="lower", vmin=0, vmax=1, cmap="YlOrRd" if k == 0 else "YlGnBu", aspect="auto")
        for (row, column), share in np.ndenumerate(shares):
            axes.text(column, row, f"{share:.2f}", ha="center", va="center", color="white" if share > 0.6 else "black")
        axes.set(title=title, xlabel="permeability coefficient (m²)", ylabel="viscosity (Pa s)")
        axes.set_xticks(range(len(PERMEABILITIES)), [f"{p:.1e}" for p in PERMEABILITIES])
        axes.set_yticks(range(len(VISCOSITIES)), [f"{v:.0e}" for v in VISCOSITIES])
    save(figure, Path(out) / "map.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs")
    parser.add_argument("--out", help="default: RUNS")
    parser.add_argument("--programs", default="build/bin")
    given = parser.parse_args()
    values = {}
    for viscosity in VISCOSITIES:
        for permeability in PERMEABILITIES:
            folder = folder_of(given.runs, viscosity, permeability)
            if not (folder / "perf.json").is_file():
                make(given.programs, folder, viscosity, permeability)
            values[viscosity, permeability] = at_the_end(folder)
    draw(values, given.out or given.runs)


if __name__ == "__main__":
    sys.exit(refusing(main))
