#!/usr/bin/python3
"""Draws an edifice whose altered flank slides off: plastic strain at three times, and where the energy went. A run of
edifice.toml.

    edifice.py RUNS [--out DIR] [--programs build/bin]

A run that is not in RUNS yet is made, on one rank: half a minute.
"""

import sys
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "python"))
from peperite.drawing.command import refusing  # noqa: E402
from peperite.drawing.scene_runs import drawn_from_runs  # noqa: E402
from peperite.drawing.style import GROUPS, RUNS, WALL, plt  # noqa: E402

TIMES = (0, 10, 20, 60)  # s
ALTERED, GROUND = 1, 2


def draw_state(axes, snapshot):
    x, group, strain = (snapshot[name] for name in ("position", "group", "plastic_strain"))
    for k, color in ((GROUND, WALL), (ALTERED, GROUPS[3]), (0, GROUPS[0])):
        axes.scatter(*x[group == k, :2].T, c=color, s=2, linewidths=0)
    sheared = (group != GROUND) & (strain > 0.05)
    drawn = axes.scatter(*x[sheared, :2].T, c=np.log10(strain[sheared]), s=2, linewidths=0, cmap="inferno_r", vmin=-1.3, vmax=1)
    axes.set(title=f"{snapshot.time:.0f} s", xlim=(-1050, 1650), ylim=(-55, 560), aspect="equal", ylabel="y (m)")
    return drawn


def draw_energies(axes, s):
    fell = s["energy_potential"][0] - s["energy_potential"]
    gone = fell - s["energy_kinetic"] - s["energy_elastic"] - s["energy_plastic"]
    for values, label, color in ((fell, "potential, released", RUNS[5]), (s["energy_plastic"], "plastic strain", RUNS[1]),
                                 (gone, "viscous", RUNS[2]), (s["energy_kinetic"], "kinetic", RUNS[0])):
        axes.plot(s["t"], values / 1e9, color=color, label=label)
    axes.set(title="energy (GJ per metre)", xlabel="t (s)")
    axes.legend()
    return f"of {fell[-1] / 1e9:.0f} GJ/m plastic strain took {100 * s['energy_plastic'][-1] / fell[-1]:.0f} %"


def draw(runs):
    run = runs["edifice"]
    figure, all_axes = plt.subplots(len(TIMES) + 1, 1, figsize=(9, 12), layout="constrained")
    for axes, time in zip(all_axes, TIMES):
        drawn = draw_state(axes, run.at(time))
    figure.colorbar(drawn, ax=list(all_axes[:-1]), label="log10 of the plastic shear", shrink=0.5)
    print(draw_energies(all_axes[-1], run.series))
    return figure


def main():
    drawn_from_runs(__doc__, here / "edifice.toml", {"edifice": ("edifice", ())}, draw, "edifice")


if __name__ == "__main__":
    sys.exit(refusing(main))
