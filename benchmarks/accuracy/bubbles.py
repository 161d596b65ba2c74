#!/usr/bin/python3
"""Draws bubbles.png beside this file: both rising bubbles with their speed and height against time.

    bubbles.py WORK    # the work folder of accuracy.py --cases rising_bubble rising_bubble_2
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import rising_bubble  # noqa: E402
from runs import Run  # noqa: E402

here = Path(__file__).resolve().parent
sys.path.append(str(here.parents[1] / "cmake"))
import manifest  # noqa: E402

# Time and rise velocity of the groups' bubble 1 (MooNMD), and their largest velocities of bubble 2.
PUBLISHED = {1: ((0.5, 1, 1.5, 2, 2.5, 3), (0.1964, 0.2409, 0.2186, 0.1979, 0.1915, 0.1938)),
             2: ((0.7317, 2.0600), (0.2502, 0.2393))}
TIMES = {1: (0, 1, 3), 2: (0, 1, 2)}


def draw_particles(axes, snapshot):
    for group, colour in ((0, "#c8dbe8"), (1, "#b6401f")):
        x = snapshot.position[snapshot.group == group]
        axes.plot(*x.T, ".", ms=1.8, color=colour, mew=0)
    axes.set(aspect="equal", xlim=(0, 1), ylim=(0.2, 1.6), xticks=(), yticks=(), title=f"{snapshot.time:.0f} s")


def main():
    work = Path(sys.argv[1])
    plt.rcParams.update({"font.size": 8, "axes.titlesize": 8, "legend.frameon": False})
    used = []
    figure, axes = plt.subplots(2, 4, figsize=(9, 4.6), layout="constrained",
                                gridspec_kw={"width_ratios": (1, 1, 1, 1.7)})
    for row, case in enumerate((1, 2)):
        name = "rising_bubble" if case == 1 else "rising_bubble_2"
        runs = {n: Run(work / f"{name}_default_{n}") for n in rising_bubble.SIZES}
        used += [run.folder for run in runs.values()]
        snapshots = runs[80].snapshots()
        for panel, time in zip(axes[row], TIMES[case]):
            draw_particles(panel, min(snapshots, key=lambda s: abs(s.time - time)))
        for (n, run), style in zip(runs.items(), (":", "--", "-")):
            axes[row, 3].plot(*rising_bubble.smooth_speed(run), style, color="#1b6ca8", lw=1.1, label=f"h = 1/{n}")
        axes[row, 3].plot(*PUBLISHED[case], "o", ms=4, mfc="none", color="#333333", label="MooNMD (Hysing et al.)")
        axes[row, 3].set(xlabel="t (s)", ylabel="rise velocity (m/s)", xlim=(0, 3), ylim=(0, 0.3))
        axes[row, 3].legend()
    picture = here / "bubbles.png"
    figure.savefig(picture, dpi=110)
    manifest.record([picture], used, [here / "rising_bubble.toml"])


if __name__ == "__main__":
    sys.exit(main())
