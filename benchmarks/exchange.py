#!/usr/bin/python3
"""What exchanges of heat and gas cost beside a step of a fluid without them, alternating, medians of ratios of
CPU seconds, one rank.

exchange.py BUILD [--page]      --page writes the table of README.md
"""
import argparse
import statistics
from pathlib import Path

import tables
from speed import here, loop_seconds, ours


def warm(conductivity):
    return tuple(f"group.{name}.{what}" for name, t in (("magma", 1200), ("fresh", 1400)) for what in
                 (f"heat={{specific_heat=1200, conductivity={conductivity}}}", f"temperature={t}"))


def permeable(coefficient):
    return tuple(f"group.{name}.permeability={{coefficient={coefficient}}}" for name in ("magma", "fresh"))


# Beside a step in which water lags: pressures then are another law's.
LAGS = tuple(f"group.{name}.exsolution_time=1" for name in ("magma", "fresh"))
SPREADS = tuple(f"group.{name}.water_diffusivity=1e-3" for name in ("magma", "fresh"))

# What is added, its settings, passes over pairs that it adds to a step.
CASES = {
    "conduction": (warm(2), 1),
    "gas flow": (permeable(1e-12), 1),
    "both, and heat that gas brings": (warm(2) + permeable(1e-12), 2),
    "friction, too": (warm(2) + permeable(1e-12) + ("terms.viscous_heat=true",), 3),
    "diffusion of water that lags": (SPREADS, 1),
}
BESIDE = {"diffusion of water that lags": LAGS}
SOLVED = {
    "implicit conduction": (*warm(2e11), "terms.implicit_conduction=true"),
    "implicit gas flow": (*permeable(1e-8), "terms.implicit_gas_flow=true"),
}

# Passes that find what there is to solve, and move it.
SOLVED_BESIDES = {"implicit conduction": 2, "implicit gas flow": 3}
STEPS = 100


def of_pairs(perf):
    """CPU seconds of passes over pairs."""
    return perf["cost_seconds"] * perf["seconds"]["pairs"]["mean"] / loop_seconds(perf)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--repeats", type=int, default=5)
    arguments.add_argument("--page", action="store_true", help="write the table of README.md")
    options = arguments.parse_args()
    seen = {name: [] for name in (*CASES, *SOLVED)}
    counts, plain = {name: passes for name, (_, passes) in CASES.items()}, []
    for _ in tables.turns(options.repeats):
        # So that dt, and with it the number of rebuilds, is the same in all.
        fixed = ("time.dt=1e-4", "time.cfl=")
        beside = {more: ours(options.build, "exchange.toml", 1, STEPS, fixed + more) for more in ((), LAGS)}
        plain.append(1e3 * beside[()]["cost_seconds"] / STEPS)
        for name, more in [(n, m) for n, (m, _) in CASES.items()] + list(SOLVED.items()):
            base = BESIDE.get(name, ())
            alone, perf = beside[base], ours(options.build, "exchange.toml", 1, STEPS, fixed + base + more)
            step = alone["cost_seconds"]
            pairs = of_pairs(perf) - of_pairs(alone)
            if name in SOLVED:
                counts[name] = perf["solver_iterations"] / STEPS + SOLVED_BESIDES[name]
            seen[name].append((perf["cost_seconds"] / step - 1, pairs / step / counts[name]))
    rows = [("a step without", f"{statistics.median(plain):.1f} ms", "", "")]
    for name, found in seen.items():
        rows.append((name, f"+{statistics.median(x for x, _ in found):.2f} of it", f"{counts[name]:.0f}",
                     f"{statistics.median(x for _, x in found):.2f}"))
    for row in rows:
        print(" | ".join(row))
    if options.page:
        tables.write(here / "README.md", "exchange", tables.origin(tables.commit_of(options.build)),
                     tables.markdown(("added", "costs", "passes over pairs", "each, of a step"), rows))


if __name__ == "__main__":
    main()
