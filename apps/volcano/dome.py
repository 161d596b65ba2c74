#!/usr/bin/python3
"""Draws a dome that loses its gas through the rock, and one that keeps it and bursts: two runs of dome.toml, the second a
hundred times less permeable.

    dome.py RUNS [--out DIR] [--programs build/bin]

Runs that are not in RUNS yet are made, on one rank each, side by side: three minutes in all.
"""

import sys
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "python"))
from peperite.drawing.command import refusing  # noqa: E402
from peperite.drawing.scene_runs import drawn_from_runs  # noqa: E402
from peperite.drawing.style import RUNS, plt  # noqa: E402

PERMEABILITIES = {"permeable": 1e-10, "tight": 1e-12}
MAGMA, PLUG, SPRAY = 0, 1, 2
LAYER = 6.0  # m, of the means over the conduit


def state_of(snapshot):
    matter = snapshot["group"] <= SPRAY
    names = ("position", "group", "void_fraction", "viscosity", "dissolved_gas", "pressure")
    return {"time": snapshot.time} | {name: snapshot[name][matter] for name in names}


def draw_state(axes, state, name):
    x = state["position"]
    drawn = axes.scatter(x[:, 0], x[:, 1], c=np.log10(state["viscosity"]), s=7, cmap="viridis", vmin=4, vmax=9)
    axes.set(title=f"{name}, {state['time']:.0f} s", xlim=(-60, 60), ylim=(-152, 90), xlabel="x (m)", aspect="equal")
    return drawn


def draw_profiles(all_axes, state, color, label):
    """Means across the conduit of what is no spray, every LAYER."""
    x, kept = state["position"], state["group"] != SPRAY
    inside = kept & (np.abs(x[:, 0]) < 16)
    layer = np.floor(x[:, 1] / LAYER).astype(int)
    layers = [k for k in range(-25, 12) if (inside & (layer == k)).sum() >= 3]
    y = (np.array(layers) + 0.5) * LAYER
    for axes, values in zip(all_axes, (np.log10(state["viscosity"]), 100 * state["dissolved_gas"], 100 * state["void_fraction"])):
        axes.plot([values[inside & (layer == k)].mean() for k in layers], y, color=color, label=label)


def draw_series(all_axes, s, color, label):
    count = s["spray_n"] + s["magma_n"] + s["plug_n"]
    gone, spray, rise = -100 * s["budget_gas_in"] / s["budget_gas"][0], 100 * s["spray_n"] / count, s["plug_y"] - s["plug_y"][0]
    for axes, values in zip(all_axes, (gone, rise, spray)):
        axes.plot(s["t"], values, color=color, label=label)
    at = np.argmax(np.abs(s["plug_vy"]) > 5)  # 0: it never is
    bursts = f"it bursts at {s['t'][at]:.0f} s, when the plug has risen {rise[at]:.0f} m" if at else "it does not burst"
    print(f"{label}: {bursts}; at {s['t'][-1]:.0f} s {gone[-1]:.0f} % of the gas is gone through rock and surface, the plug "
          f"{rise[-1]:.0f} m higher at {s['plug_vy'][-1]:.2f} m/s, {spray[-1]:.0f} % is spray")


def draw(runs):
    figure, axes = plt.subplots(2, 6, figsize=(15, 9), layout="constrained", height_ratios=(3, 2))
    for row, (name, run) in enumerate(runs.items()):
        states = [state_of(snapshot) for snapshot in run]
        last = len(states) - 1
        shown = [states[k * last // 10] for k in (4, 8, 10)]
        for k, state in enumerate(shown):
            drawn = draw_state(axes[0, 3 * row + k], state, name)
        label = f"{name}, {PERMEABILITIES[name]:.0e} m²"
        draw_series(axes[1, :3], run.series, RUNS[row], label)
        draw_profiles(axes[1, 3:], shown[1], RUNS[row], f"{label}, {shown[1]['time']:.0f} s")
    draw_profiles(axes[1, 3:], states[0], "#999999", "start")
    figure.colorbar(drawn, ax=axes[0, -1], label="log10 of viscosity (Pa s)")
    titles = (("gas gone (%)", "time (s)"), ("rise of the plug (m)", "time (s)"), ("spray (%)", "time (s)"),
              ("y (m)", "log10 of viscosity (Pa s)"), ("y (m)", "dissolved water (%)"), ("y (m)", "gas's share of the volume (%)"))
    for panel, (y, x) in zip(axes[1], titles):
        panel.set(xlabel=x, ylabel=y)
    axes[1, 1].set_ylim(-5, 60)
    axes[1, 0].legend(fontsize=8)
    axes[1, 3].legend(fontsize=7)
    return figure


def main():
    drawn_from_runs(__doc__, here / "dome.toml", {name: (name, [f"group.{group}.permeability.coefficient={k}" for group in ("magma", "plug")])
                                           for name, k in PERMEABILITIES.items()}, draw, "dome")


if __name__ == "__main__":
    sys.exit(refusing(main))
