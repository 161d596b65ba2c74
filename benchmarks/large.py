#!/usr/bin/python3
"""What a particle costs in scenes of ten thousand to tens of millions, on one rank: time of a step, memory, output.

large.py BUILD               grains (a settled bed, linear law) and the 3D dam break; the largest take 9 GB
large.py BUILD --largest N   only scenes of at most so many particles
... --page                   writes the table of README.md, if the machine is idle

Memory is the growth of the peak from the scene before, which leaves out what any run takes.
A run makes its lists anew at least twice, once in a step, and ends with a snapshot and a checkpoint.
"""
import argparse
import json
import tempfile
import time
from pathlib import Path

import grains
import tables
from speed import here, loop_seconds, run

BEDS = {12_800: ((1, 1), 2000), 102_400: ((4, 2), 500), 1_024_000: ((10, 8), 100), 19_968_000: ((40, 39), 20)}
POOLS = {32_037: (29, 500), 172_836: (14.5, 200), 825_280: (8, 40), 11_156_305: (3.16, 10)}  # spacing [mm], steps


def bed(work, tiles, steps):
    tile = grains.files_of(work, "12k", grains.settled_tile(work, grains.program("lmp")))
    size = [tiles[0] * tile.size[0], tiles[1] * tile.size[1], tile.size[2]]
    return "grain_bed.toml", (f"domain.upper={size}", "start.file=", f'start.tile={{file="{tile.start}", repeat={[*tiles, 1]}}}',
                              "decomposition.skin=0.05", f"decomposition.rebuild_every={max(steps // 2, 10)}")


def pool(spacing):
    """The walls are three particles thick."""
    edge, wall = spacing / 1000, 3 * spacing / 1000
    return "dam_break.toml", (f"start.spacing={edge}", f"start.lower={[-wall] * 3}",
                              f"start.upper={[2.001 + wall, 0.6105 + wall, 0.7]}", 'precision="mixed"')


def measured(build, scene, settings, steps):
    """perf.json, and bytes that the run has left."""
    with tempfile.TemporaryDirectory() as out:
        words = [word for s in settings for word in ("--set", s)]
        run(["mpirun", "-np", "1", build / "bin/peperite", "run", here / "scenes" / scene, "--steps", str(steps),
             "--out", f"{out}/run", *words])
        left = sum(file.stat().st_size for file in Path(out, "run").rglob("*.h5"))
        return json.loads(Path(out, "run/perf.json").read_text()), left


def row(kind, perf, left, before):
    particles = perf["particles"]
    memory = "-"
    if before:
        growth = perf["peak_rank_bytes"] - before["peak_rank_bytes"]
        memory = f"{growth / (particles - before['particles']):.0f}"
    output = perf["seconds"]["output"]["max"]
    nanoseconds = 1e9 * loop_seconds(perf) / perf["steps"] / particles
    return [kind, f"{particles:,}", f"{perf['setup_seconds']:.1f}", f"{nanoseconds:.0f}", f"{perf['rebuilds'] / perf['steps']:.3f}",
            memory, f"{left / output / 1e6:.0f}"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--work", type=Path, default=here.parent / "build/beds")
    arguments.add_argument("--largest", type=int, default=10**9)
    arguments.add_argument("--page", action="store_true")
    options = arguments.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    build = options.build.resolve()
    scenes = [("grains", n, *bed(options.work.resolve(), tiles, steps), steps) for n, (tiles, steps) in BEDS.items()]
    scenes += [("3D fluid, mixed", n, *pool(spacing), steps) for n, (spacing, steps) in POOLS.items()]
    header = ("", "particles", "start [s]", "ns a step and particle", "rebuilds a step", "bytes a particle", "output [MB/s]")
    scenes = [scene for scene in scenes if scene[1] <= options.largest]
    last, rows = {}, []  # last of a kind
    for turn in tables.turns(len(scenes)) if options.page else range(len(scenes)):
        kind, particles, scene, settings, steps = scenes[turn]
        began = time.monotonic()
        perf, left = measured(build, scene, settings, steps)
        rows.append(row(kind, perf, left, last.get(kind)))
        print(dict(zip(header, rows[-1])), f"{time.monotonic() - began:.0f} s", flush=True)
        last[kind] = perf
    if options.page:
        tables.write(here / "README.md", "large", tables.origin(tables.commit_of(build)), tables.markdown(header, rows))


if __name__ == "__main__":
    main()
