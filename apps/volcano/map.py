#!/usr/bin/python3
"""Draws what share of the magma was thrown out as spray against viscosity and permeability, and where Ida (2007) has the
boundary: where gas takes as long to get out sideways as the magma takes to expand. Runs of conduit.toml.

    map.py RUNS [--out DIR] [--programs build/bin]

Runs that are not in RUNS yet are made, on one rank each and two at a time, at twice the spacing of the scene, 40 m deep and
with a bulk viscosity like the viscosity, which decides how fast foam can expand: five minutes in all.
"""

import math
import sys
import tomllib
from pathlib import Path

import numpy as np

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "python"))
from peperite.drawing.command import refusing  # noqa: E402
from peperite.drawing.scene_runs import drawn_from_runs  # noqa: E402
from peperite.drawing.style import plt  # noqa: E402

UNTIL = {1e5: 4, 3e5: 4, 1e6: 6, 3e6: 14}  # s, by viscosity (Pa s): afterwards little changes
PERMEABILITIES = (6.3e-12, 6.3e-11, 6.3e-10, 6.3e-9, 6.3e-8)
WIDTH, DEPTH = 20, 40
# Weights by density: thick magma beside light spray bears no longer steps without.
SETTINGS = ("start.spacing=2", "terms.implicit_gas_flow=true", "terms.pressure_weights=density",
            "domain.lower=[-4000, -3000]", "domain.upper=[4000, 4000]", f"start.lower=[-20, {-DEPTH - 10}]", "output.snapshot_interval=0",
            f'start.region=[{{group="rock"}}, {{group="magma", shape="box", lower=[-10, {-DEPTH}], upper=[10, 0]}}]')


def settings_of(viscosity, permeability):
    return (*SETTINGS, f"group.magma.viscosity={viscosity}", f"group.magma.bulk_viscosity={viscosity}",
            f"group.magma.permeability.coefficient={permeability}", f"time.until={UNTIL[viscosity]}")


def at_the_end(series):
    """Shares: of the particles that are spray, of the gas that got away without it."""
    spray, magma = series["spray_n"][-1], series["magma_n"][-1]
    return spray / (spray + magma), -series["budget_gas_in"][-1] / series["budget_gas"][0]


class Magma:
    """Of conduit.toml as it starts at the top: what gas spreads with, and what drives the expansion."""

    def __init__(self):
        scene = tomllib.loads((here / "conduit.toml").read_text())
        g = next(group for group in scene["group"] if group["name"] == "magma")
        self.drive, outside = 9e6, 1e6  # Pa
        p, m, rt, rho = self.drive + outside, g["gas_content"], g["gas_rt"], g["density"]
        dissolved = (p / 59.2e9) ** g["solubility_exponent"]
        gas, free = p / rt, (m - dissolved) / (1 + m)
        density = 1 / ((1 - free) / (rho * (1 + p / 1e9)) + free / gas)
        psi = free * density / gas
        liquid = density / (1 + m)  # mass of it in a volume
        self.stiffness = liquid / (psi / rt + liquid * dissolved * g["solubility_exponent"] / p)  # dp/dm of a fixed volume
        self.per_coefficient = gas * psi**3.4 / 2e-5 * self.stiffness * (1 + m) ** 2 / density

    def escape(self, permeability):
        """w^2 / (pi^2 D), D = k b (dp/dm) (1 + m)^2 / rho."""
        return WIDTH**2 / (math.pi**2 * self.per_coefficient * permeability)

    def permeability_at(self, time):
        return self.escape(1) / time


def boundary(shares):
    """By viscosity: the permeability at which half as much is thrown out as with the lowest; nothing where none is."""
    logs = np.log10(PERMEABILITIES)
    found = []
    for row in shares:
        half = row[0] / 2
        k = next((k for k in range(1, len(row)) if row[k] < half <= row[k - 1]), None)
        found.append(math.nan if k is None else
                     10 ** (logs[k - 1] + (logs[k] - logs[k - 1]) * (row[k - 1] - half) / (row[k - 1] - row[k])))
    return np.array(found)


def edges(values):
    logs = np.log10(values)
    middles = (logs[1:] + logs[:-1]) / 2
    return 10 ** np.concatenate([[2 * logs[0] - middles[0]], middles, [2 * logs[-1] - middles[-1]]])


def draw(runs):
    values = {at: at_the_end(run.series) for at, run in runs.items()}
    figure, all_axes = plt.subplots(1, 2, figsize=(11, 4.8), layout="constrained")
    viscosities, magma = np.array(list(UNTIL)), Magma()
    for axes, k, title in zip(all_axes, (0, 1), ("share of the magma that is spray", "share of the gas that got away")):
        shares = np.array([[values[eta, p][k] for p in PERMEABILITIES] for eta in UNTIL])
        axes.pcolormesh(edges(PERMEABILITIES), edges(viscosities), shares, vmin=0, vmax=1, cmap="YlOrRd" if k == 0 else "YlGnBu")
        for (row, column), share in np.ndenumerate(shares):
            axes.text(PERMEABILITIES[column], viscosities[row], f"{share:.2f}", ha="center", va="center",
                      color="white" if share > 0.6 else "black")
        axes.set(title=title, xlabel="permeability coefficient (m²)", ylabel="viscosity (Pa s)", xscale="log", yscale="log",
                 xlim=edges(PERMEABILITIES)[[0, -1]], ylim=edges(viscosities)[[0, -1]])
        if k == 0:
            draw_boundaries(axes, viscosities, magma, boundary(shares))
    return figure


def draw_boundaries(axes, viscosities, magma, measured):
    """Escape as slow as the expansion of a foam that its viscosities hold, (zeta + 4/3 eta)/dp with zeta = eta, and as the flow
    of all of it through the conduit, 12 eta L^2/(w^2 dp)."""
    expansion, flow = (7 / 3) / magma.drive, 12 * DEPTH**2 / WIDTH**2 / magma.drive  # s/(Pa s)
    for name, per_viscosity, style in (("escape = expansion", expansion, "k--"), ("escape = flow through", flow, "k:")):
        axes.plot(magma.permeability_at(per_viscosity * viscosities), viscosities, style, label=name)
    axes.plot(measured, viscosities, "o-", color="#1b6ca8", label="half as much spray")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=3, fontsize=9)
    there = np.isfinite(measured)
    print(f"escape of 6.3e-11 m2: {magma.escape(6.3e-11):.3g} s; expansion of 1e6 Pa s {expansion * 1e6:.3g} s, flow "
          f"{flow * 1e6:.3g} s")
    for eta, k in zip(viscosities[there], measured[there]):
        print(f"{eta:.0e} Pa s: boundary at {k:.2e} m2, {k / magma.permeability_at(expansion * eta):.2f} of that of the "
              f"expansion, {k / magma.permeability_at(flow * eta):.1f} of that of the flow")
    if there.sum() > 1:
        steps = np.diff(np.log10(viscosities[there])) / np.diff(np.log10(measured[there]))
        print("slopes between them:", ", ".join(f"{s:.2f}" for s in steps))


def main():
    drawn_from_runs(__doc__, here / "conduit.toml", {(eta, k): (f"eta_{eta:.0e}_k_{k:.1e}", settings_of(eta, k)) for eta in UNTIL for k in PERMEABILITIES},
                    draw, "map")


if __name__ == "__main__":
    sys.exit(refusing(main))
