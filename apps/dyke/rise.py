#!/usr/bin/python3
"""Draws two dykes in gelatine, of less and of more melt than a crack needs to rise by itself: where they are and the
tension around them, how high their tips are, how far they are open. Runs of stall.toml.

    rise.py RUNS [--out DIR] [--programs build/bin]

Runs that are not in RUNS yet are made, on one rank each, side by side.
"""

import math
import sys
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "python"))
from peperite.drawing.command import refusing  # noqa: E402
from peperite.drawing.scene_runs import drawn_from_runs  # noqa: E402
from peperite.drawing.style import RUNS, plt  # noqa: E402

MELT, SOLID = 0, 1
TOUGHNESS, LIGHTER, SHEAR_MODULUS, POISSON, SPACING = 77, 500 * 9.81, 1000, 0.45, 1.5e-3  # of stall.toml
# Half the length at which K = 0 below and K_Ic above, and the area then (Weertman 1971; Rivalta et al. 2015).
HALF = (TOUGHNESS / (LIGHTER * math.sqrt(math.pi))) ** (2 / 3)
AREA = math.pi * (1 - POISSON) / (2 * SHEAR_MODULUS) * LIGHTER * HALF**3
MORE = ("inlet.0.velocity=[[0, 0], [0.1, 0.0446], [0.96, 0.0446], [1.06, 0]]", "time.until=1.3")


def tip(snapshot):
    """Time, and the height of the highest melt that hangs together with the inlet: no gap of three spacings."""
    y = np.sort(snapshot["position"][snapshot["group"] == MELT, 1])
    gaps = np.flatnonzero(np.diff(y) > 3 * SPACING)
    return snapshot.time, y[gaps[0]] if gaps.size else y[-1]


def opening(snapshot):
    """Heights, and how far what was 1 to 4 spacings on either side of the middle is further apart than at the start."""
    solid = snapshot["group"] == SOLID
    x, moved = snapshot["position"][solid], snapshot.metres("displacement")[solid]
    then = x - moved
    near = (abs(then[:, 0]) > SPACING) & (abs(then[:, 0]) < 4 * SPACING) & (then[:, 1] > 0.01)
    rows = np.round(then[near, 1] / SPACING).astype(int)
    side = then[near, 0] > 0
    heights = np.intersect1d(rows[side], rows[~side])  # what has failed is melt
    apart = [moved[near, 0][(rows == row) & side].mean() - moved[near, 0][(rows == row) & ~side].mean() for row in heights]
    return heights * SPACING, np.array(apart)


def draw_state(axes, snapshot, title):
    x, group, stress, pressure = (snapshot[name] for name in ("position", "group", "stress", "pressure"))
    solid = group == SOLID
    xx, yy, xy = stress[solid].T
    tension = (xx + yy) / 2 + np.hypot((xx - yy) / 2, xy) - pressure[solid]
    drawn = axes.scatter(100 * x[solid, 0], 100 * x[solid, 1], c=tension, s=1.5, cmap="RdBu_r", vmin=-400, vmax=400)
    axes.scatter(100 * x[group == MELT, 0], 100 * x[group == MELT, 1], c="black", s=1.5)
    axes.set(title=f"{title}, {snapshot.time:.1f} s", xlabel="x (cm)", ylabel="y (cm)", xlim=(-6, 6), ylim=(-1, 22), aspect="equal")
    return drawn


def draw(runs):
    figure, axes = plt.subplots(1, 4, figsize=(13, 5), layout="constrained", width_ratios=(1, 1, 1.7, 1.2))
    for panel, (name, run), color in zip(axes, runs.items(), RUNS):
        drawn = draw_state(panel, run[-1], f"{name} of the area")
        times, tips = np.array([tip(snapshot) for snapshot in run]).T
        axes[2].plot(times, 100 * tips, "o-", color=color, ms=3, label=f"{name} of the critical area")
        heights, apart = opening(run[-1])
        axes[3].plot(1000 * apart, 100 * heights, color=color)
        print(f"{name}: tip at {100 * tips[-1]:.1f} cm after {times[-1]:.2f} s, {100 * np.interp(times[-1] - 0.2, times, tips):.1f} "
              f"0.2 s before; open by {1000 * apart.max():.1f} mm at most")
    figure.colorbar(drawn, ax=axes[1], label="largest principal stress (Pa)")
    axes[2].axhline(200 * HALF, color="#777777", lw=1, ls="--", label="critical length (Weertman 1971)")
    axes[2].set(xlabel="time (s)", ylabel="height of the tip (cm)", title="one stays")
    axes[2].legend(fontsize=8)
    axes[3].set(xlabel="open by (mm)", ylabel="height (cm)", ylim=(-1, 22), title="in the end")
    print(f"Weertman: {200 * HALF:.1f} cm long, {1e4 * AREA:.2f} cm2")
    return figure


def main():
    drawn_from_runs(__doc__, here / "stall.toml", {"0.7": ("stays", ()), "1.4": ("rises", MORE)}, draw, "rise")


if __name__ == "__main__":
    sys.exit(refusing(main))
