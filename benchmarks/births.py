#!/usr/bin/python3
"""A silo that fills, empties and fills again until a million grains have come: on one rank, and on one, two and three in turn, gone on
with from checkpoints ten times. Prints how many came and left, that none was lost, whether the bits are the same, and the time.

births.py BUILD [--births 1000000]
"""
import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

from speed import here, run_in_legs

sys.path.append(str(here.parent / "apps/python"))
import peperite  # noqa: E402

SCENE = here.parent / "tests/scenes/grains_silo.toml"
STEP, CYCLE, BIRTHS = 15e-6, 0.3, 145e3  # [s, s, grains that come in a second, on average]
LEGS = 10
ROWS = 100  # steps between lines of the series, the last of which is that of the last step


def settings(steps):
    """Sand comes in the first half of each cycle."""
    times = [k * CYCLE / 2 for k in range(2 + int(2 * steps * STEP / CYCLE))]
    sand = [point for k, t in enumerate(times) for point in ([t, 0.2 * (k % 2 == 0)], [t + 0.49 * CYCLE, 0.2 * (k % 2 == 0)])]
    return (f"insertion.0.rate={sand}", f"time.steps={steps}", f"output.series_interval={ROWS * STEP * (1 - 1e-6)}",
            "output.snapshot_interval=1e9", 'monitor=[{kind="budget"}]')


def legs(program, folder, steps, ranks):
    began = time.monotonic()
    run_in_legs(program, SCENE, folder, settings(steps), steps, ranks)
    return peperite.open(folder), time.monotonic() - began


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--births", type=int, default=1_000_000)
    options = arguments.parse_args()
    program = os.path.abspath(options.build / "bin/peperite")
    steps = round(options.births / BIRTHS / STEP / LEGS / ROWS) * LEGS * ROWS
    with tempfile.TemporaryDirectory() as work:
        one, took = legs(program, f"{work}/one", steps, [1])
        many, _ = legs(program, f"{work}/many", steps, [1 + leg % 3 for leg in range(LEGS)])
        series = one.series
        came, left = int(series["budget_n_in"][-1]), int(series["budget_n_out"][-1])
        there_now, expected = len(one[-1]), len(one[0]) + came - left
        print(f"{steps} steps, {came} grains came, {left} left, {there_now} are there"
              f"{'' if expected == there_now else f', but there should be {expected}'}")
        held = series["budget_mass"] + series["budget_mass_out"] - series["budget_mass_in"]
        print(f"mass, less what came, with what left: off by at most {abs(held - held[0]).max() / series['budget_mass_in'][-1]:.1e} of that")
        there = series["budget_n_in"] - series["budget_n_out"]
        cycle = round(CYCLE / STEP / ROWS)
        cycles = there[:len(there) // cycle * cycle].reshape(-1, cycle)
        fills = sum((cycles.max(1) > 0.8 * there.max()) & (cycles.min(1) < 0.5 * there.max()))
        print(f"filled and emptied {fills} times, {there.min():.0f} to {there.max():.0f} more than at the start")
        same = one.perf["fingerprint"] == many.perf["fingerprint"]
        print(f"one rank, and 1 to 3 ranks over {LEGS - 1} restarts: {'the same bits' if same else 'OTHER BITS'}, {one.perf['fingerprint']}")
        print(f"{took:.0f} s on one rank")
    return 0 if same and expected == there_now else 1


if __name__ == "__main__":
    sys.exit(main())
