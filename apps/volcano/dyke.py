#!/usr/bin/python3
"""Draws whether a slot stays open, against what the rock beside it takes: runs of dyke.toml. And how its margin freezes
where nothing moves and the rock is cold, against Neumann's solution of a melt that freezes over a range of temperatures.

    dyke.py RUNS [--out DIR] [--programs build/bin]

Runs that are not in RUNS yet are made, on one rank each, two at a time: four minutes in all.
"""

import math
import sys
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "python"))
from peperite.drawing.command import refusing  # noqa: E402
from peperite.drawing.scene_runs import drawn_from_runs  # noqa: E402
from peperite.drawing.style import plt  # noqa: E402

COEFFICIENTS = (100, 1000, 3000)  # W/m2/K
SOLIDUS, LIQUIDUS, HOT, COLD = 1273, 1423, 1473, 400
CAPACITY, LATENT, CONDUCTIVITY, DENSITY = 1200, 3.2e5, 20, 2475  # of dyke.toml; the density as its pressure makes it
WIDTH, SPACING = 0.05, 2.5e-3
STILL = ("terms.motion=false", "time.cfl=", "time.dt=0.02", "time.until=40", "reset=", "group.rock.heat_transfer=",
         f"group.rock.temperature={COLD}", "output.snapshot_interval=1")


def settings_of(name):
    return STILL if name == "still" else (f"group.rock.heat_transfer.coefficient={name}",)


def neumann():
    """Where solidus and liquidus are, x = 2 lambda sqrt(kappa t), and kappa. In xi = x / (2 sqrt(kappa t)) each
    layer is a + b erf(xi / s): the solid, the mush, whose capacity is c + L / (T_l - T_s), and the melt. Slopes are those of
    the layer before; that at the wall is found by bisection, so that the melt far away is as hot as it was."""
    root_pi, mush = math.sqrt(math.pi), math.sqrt(CAPACITY / (CAPACITY + LATENT / (LIQUIDUS - SOLIDUS)))

    def beyond(slope):
        """Where the solidus is, and how hot it is far away; a layer that never ends is the last."""
        at, hot, fronts = 0.0, COLD, []
        for s, top in ((1, SOLIDUS), (mush, LIQUIDUS), (1, math.inf)):
            b = slope * s * root_pi / 2 * math.exp((at / s) ** 2)
            if hot + b * math.erfc(at / s) <= top:
                return fronts, hot + b * math.erfc(at / s)
            low, high = at, at + 6 * s
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if hot + b * (math.erf(middle / s) - math.erf(at / s)) < top else (low, middle)
            at, hot = low, top
            slope = b * 2 / root_pi / s * math.exp(-((at / s) ** 2))
            fronts.append(at)

    low, high = 1.0, 1e5
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if beyond(middle)[1] < HOT else (low, middle)
    return *beyond(high)[0], CONDUCTIVITY / (DENSITY * CAPACITY)


def margin(snapshot):
    """Time and depth of the solidus, of means over a spacing."""
    melt = snapshot["group"] == 0
    x, hot = snapshot["position"][melt, 0], snapshot["temperature"][melt]
    depth = np.minimum(x, WIDTH - x)
    layer = np.floor(depth / SPACING).astype(int)
    means = np.array([(hot[layer == k].mean(), depth[layer == k].mean()) for k in range(round(WIDTH / SPACING / 2))])
    return snapshot.time, np.interp(SOLIDUS, *means.T, left=0, right=WIDTH / 2)


def draw_temperatures(axes, snapshot, title):
    melt = snapshot["group"] == 0
    x, t = snapshot["position"][melt], snapshot["temperature"][melt]
    drawn = axes.scatter(100 * x[:, 0], 100 * x[:, 1], c=t, s=9, cmap="inferno", vmin=600, vmax=1473)
    if t.min() < SOLIDUS:
        axes.tricontour(100 * x[:, 0], 100 * x[:, 1], t, levels=[SOLIDUS], colors="white", linewidths=1)
    axes.set(title=f"{title}, {snapshot.time:.0f} s", xlabel="x (cm)", ylabel="y (cm)", aspect="equal")
    return drawn


def pressures(run):
    """The least and the largest of the melt in any snapshot."""
    found = [snapshot["pressure"][snapshot["group"] == 0] for snapshot in run]
    return np.min(found), np.max(found)


def draw_margin(axes, run):
    solid, liquid, kappa = neumann()
    times, depths = np.array([margin(snapshot) for snapshot in run[1:]]).T
    wanted = 2 * solid * np.sqrt(kappa * times)
    meets = (WIDTH / 4 / liquid) ** 2 / kappa  # from then on nothing is as hot as it was, and the rest freezes faster
    off = 100 * (depths / wanted - 1)[(wanted > 2 * SPACING) & (times < meets)]
    print(f"margin of the still slot: {off.min():+.1f} to {off.max():+.1f} % of Neumann's, lambda {solid:.4f}, from two spacings "
          f"until crystals meet in the middle at {meets:.1f} s; all frozen at {times[depths >= WIDTH / 2].min():.0f} s, "
          f"of half spaces after {(WIDTH / 4 / solid) ** 2 / kappa:.1f} s")
    axes.plot(np.sqrt(times), 100 * depths, "o", ms=3, label="still slot, cold walls")
    axes.plot(np.sqrt(times), 100 * wanted, "k-", lw=1, label="Neumann")
    axes.set(xlabel="root of time (s$^{1/2}$)", ylabel="frozen from each side (cm)", title="how a still one freezes")
    axes.legend()


def draw(runs):
    figure, axes = plt.subplots(1, 4, figsize=(13, 5), layout="constrained", width_ratios=(1, 1, 2, 2))
    for panel, coefficient in zip(axes, (COEFFICIENTS[0], COEFFICIENTS[-1])):
        drawn = draw_temperatures(panel, runs[coefficient][-1], f"{coefficient} W/m²/K")
    figure.colorbar(drawn, ax=axes[1], label="temperature (K); white: solidus")
    for coefficient in COEFFICIENTS:
        series = runs[coefficient].series
        axes[2].semilogy(series["t"][1:], 100 * series["melt_vy"][1:], label=f"{coefficient} W/m²/K")
        print(f"{coefficient} W/m2/K: {100 * series['melt_vy'][-1]:.3g} cm/s at {series['t'][-1]:.0f} s, pressures from "
              "{:.0f} to {:.0f} Pa".format(*pressures(runs[coefficient])))
    axes[2].set(xlabel="time (s)", ylabel="mean rise of the melt (cm/s)", ylim=(1e-3, None), title="what the rock takes")
    axes[2].legend()
    draw_margin(axes[3], runs["still"])
    return figure


def main():
    drawn_from_runs(__doc__, here / "dyke.toml", {name: (f"h_{name}", settings_of(name)) for name in ("still", *COEFFICIENTS)}, draw, "dyke")


if __name__ == "__main__":
    sys.exit(refusing(main))
