#!/usr/bin/python3
"""Budgets of mass, gas and heat over 100,000 steps: melt that moves, freezes, melts, exsolves, fragments and heals, with
gas that flows and escapes, water that spreads, walls and a [[reset]] box that give heat; stopped and gone on with ten
times, on other numbers of ranks. Prints the largest departures, relative to what there was.

budgets.py BUILD [--steps 100000]
"""
import argparse
import os
import sys
import tempfile
from pathlib import Path

from speed import here, run_in_legs

sys.path.append(str(here.parent / "apps/python"))
import peperite  # noqa: E402

bubbly = [f"group.{name}.{what}" for name in ("magma", "spray")
          for what in ("exsolution_time=0.05", "water_diffusivity=0.5")]
settings = [*bubbly, "reset=[{lower=[10,3],upper=[30,10],temperature=1500}]"]
# What is there, and what came in of it.
budgets = {"mass": ("budget_mass", "budget_gas_in"), "gas": ("budget_gas", "budget_gas_in"),
           "heat": ("budget_heat", "budget_heat_in")}
kinds = ("rock", "melt", "spray", "magma")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--steps", type=int, default=100000)
    options = arguments.parse_args()
    program = os.path.abspath(options.build / "bin/peperite")
    with tempfile.TemporaryDirectory() as directory:
        folder = f"{directory}/run"
        run_in_legs(program, here.parent / "tests/scenes/freezing2d.toml", folder, settings, options.steps,
                    [1 + leg % 3 for leg in range(1, 11)])
        series = peperite.open(folder).series
        rows = [dict(zip(series, line)) for line in zip(*series.values())]
    print(f"{len(rows) - 1} steps, {rows[-1]['t']:.4g} s")
    for name, (held, gained) in budgets.items():
        first = rows[0][held]
        off = max(abs((row[held] - row[gained]) / first - 1) for row in rows)
        exchanged = sum(abs(b[gained] - a[gained]) for a, b in zip(rows, rows[1:])) / first
        print(f"{name}: off by at most {off:.1e}; came and went {exchanged:.2g} of what there was")
    for kind in kinds:
        counts = [row[f"{kind}_n"] for row in rows]
        print(f"{kind}: {min(counts):.0f} to {max(counts):.0f} particles, "
              f"{sum(a != b for a, b in zip(counts, counts[1:]))} steps in which they became more or less")


if __name__ == "__main__":
    main()
