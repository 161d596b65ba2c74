#!/usr/bin/python3
"""Draws a dyke that turns into a sill below a stiff layer: where the melt is, and the tension around it. A run of sill.toml.

    sill.py RUNS [--out DIR] [--programs build/bin]

A run that is not in RUNS yet is made, on one rank.
"""

import sys
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "python"))
from peperite.drawing.command import refusing  # noqa: E402
from peperite.drawing.scene_runs import drawn_from_runs  # noqa: E402
from peperite.drawing.style import plt  # noqa: E402

MELT, TANK = 0, 4  # groups of sill.toml
BELOW = 0.15  # the stiff layer is above it [m]


def tension_of(snapshot, solid):
    """Largest principal stress, less the pressure."""
    xx, yy, xy = snapshot["stress"][solid].T
    return (xx + yy) / 2 + np.hypot((xx - yy) / 2, xy) - snapshot["pressure"][solid]


def width_of_sill(snapshot):
    x = snapshot["position"][snapshot["group"] == MELT]
    along = x[abs(x[:, 1] - BELOW) < 0.012, 0]
    return np.ptp(along) if along.size else 0.0


def draw(runs):
    (run,) = runs.values()
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.6), layout="constrained", sharey=True)
    for panel, share in zip(axes, (0.4, 0.65, 1)):
        snapshot = run[round(share * (len(run) - 1))]
        x, group = 100 * snapshot["position"], snapshot["group"]
        solid = (group != MELT) & (group != TANK)
        drawn = panel.scatter(*x[solid].T, c=tension_of(snapshot, solid), s=2.5, cmap="RdBu_r", vmin=-300, vmax=300)
        panel.scatter(*x[group == MELT].T, c="black", s=2.5)
        panel.axhline(100 * BELOW, color="#777777", lw=1, ls="--")
        panel.set(title=f"{snapshot.time:.2f} s", xlabel="x (cm)", xlim=(-15, 15), ylim=(-3, 30), aspect="equal")
        print(f"{snapshot.time:.2f} s: melt up to {x[group == MELT, 1].max():.1f} cm, sill {100 * width_of_sill(snapshot):.1f} cm wide")
    axes[0].set_ylabel("y (cm)")
    figure.colorbar(drawn, ax=axes[2], label="largest principal stress (Pa)")
    return figure


def main():
    drawn_from_runs(__doc__, here / "sill.toml", {"sill": ("sill", ())}, draw, "sill")


if __name__ == "__main__":
    sys.exit(refusing(main))
