#!/usr/bin/python3
"""Speed side by side, alternating, medians of ratios. Run on a quiet machine.

speed.py BUILD                two ranks against one on balanced scenes of 200,000 particles
speed.py BUILD --lammps LMP   also LAMMPS's sph/taitwater on the 3D dam break (peers/build_lammps.sh makes LMP)
speed.py BUILD ... --page     and writes the table of README.md
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import tables

here = Path(__file__).resolve().parent
environment = dict(
    os.environ,
    OMPI_ALLOW_RUN_AS_ROOT="1",
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
    OMPI_MCA_rmaps_base_oversubscribe="1",
    OMPI_MCA_hwloc_base_binding_policy="none",
    HWLOC_COMPONENTS="-opencl",
    OMP_NUM_THREADS="1",
)


def run(command):
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr or done.stdout}")
    return done.stdout


def run_in_legs(program, scene, folder, settings, steps, ranks):
    """Stopped and gone on with: a leg on each of these numbers of ranks."""
    words = [word for s in settings for word in ("--set", s)]
    for leg, n in enumerate(ranks, 1):
        what = ["run", scene, "--out", folder, *words] if leg == 1 else ["resume", folder]
        run(["mpirun", "-np", str(n), program, *what, "--steps", str(steps * leg // len(ranks))])


def ours(build, scene, ranks, steps, settings=()):
    """perf.json of a run of `scene` on `ranks` ranks."""
    with tempfile.TemporaryDirectory() as directory:
        sets = [word for s in settings for word in ("--set", s)]
        run(["mpirun", "-np", str(ranks), build / "bin/peperite", "run", here / "scenes" / scene, "--steps", str(steps),
             "--out", f"{directory}/run", *sets])
        return json.loads(Path(directory, "run/perf.json").read_text())


def finished(folder):
    """Whether the run in it has come to its end: one that was stopped has a perf.json too."""
    try:
        end = json.loads((folder / "perf.json").read_text())["end"]
        asked = tomllib.loads((folder / "scene.toml").read_text())["time"]
    except FileNotFoundError:
        return False
    return end["step"] >= asked.get("steps", 0) and end["time"] >= asked.get("until", 0)


def run_scene(program, scene, folder, settings):
    """Exit code of a run on one rank; one that has come to its end in the folder stays. Its screen is in a log beside
    it."""
    if finished(folder):
        return 0
    shutil.rmtree(folder, ignore_errors=True)
    sets = [word for setting in settings for word in ("--set", setting)]
    with open(log_of(folder), "w") as out:
        return subprocess.call(["mpirun", "-np", "1", program, "run", scene, "--out", folder, *sets], env=environment,
                               stdout=out, stderr=subprocess.STDOUT)


def log_of(folder):
    return folder.parent / f"{folder.name}.log"


def loop_seconds(perf):
    """Seconds of the run but its output."""
    return perf["wall_seconds"] - perf["seconds"]["output"]["max"]


def lammps(lmp, steps, ranks=1):
    """Directed pairs of water particles within the support, and seconds a step."""
    out = run(["mpirun", "-np", str(ranks), lmp, "-in", here / "peers/lmp_dam.in", "-log", "none", "-var", "n", str(steps)])
    partners = float(re.findall(r"^ +\d+ +\S+ +(\S+) *$", out, re.M)[0])  # thermo column c_mean
    water = int(re.search(r"(\d+) atoms in group water", out)[1])
    seconds = float(re.findall(r"Loop time of (\S+)", out)[-1])
    return partners * water, seconds / steps


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--lammps", type=Path)
    arguments.add_argument("--repeats", type=int, default=5)
    arguments.add_argument("--page", action="store_true")
    options = arguments.parse_args()
    build = options.build.resolve()

    rows = []

    def report(what, speeds, ratios):
        spread = f"{min(ratios):.2f} to {max(ratios):.2f}"
        rows.append((what, speeds, f"{statistics.median(ratios):.2f}x", spread))
        print(f"{what}: {speeds} {statistics.median(ratios):.2f}x, {spread} in {options.repeats}")

    for scene, dim, steps in (("vortices_200k.toml", "2D", 300), ("vortices_3d.toml", "3D", 100)):
        ratios = []
        for _ in tables.turns(options.repeats):
            one = loop_seconds(ours(build, scene, 1, steps))
            two = loop_seconds(ours(build, scene, 2, steps))
            ratios.append(one / two)
        report(f"two ranks over one, {dim}, 200,704 particles", "", ratios)

    if options.lammps:
        for precision in ("mixed", "double"):
            ratios, speeds = [], []
            for _ in tables.turns(options.repeats):
                perf = ours(build, "dam_break.toml", 1, 100, [f"precision={precision}"])
                pairs, seconds = lammps(options.lammps.resolve(), 100)  # the same lattice: the same pairs
                mine, theirs = pairs * perf["steps"] / loop_seconds(perf), pairs / seconds
                speeds.append((mine, theirs))
                ratios.append(mine / theirs)
            mine, theirs = (statistics.median(column) / 1e6 for column in zip(*speeds))
            report(f"3D dam break over LAMMPS's sph/taitwater, {precision}", f"{mine:.0f}, {theirs:.0f} M directed pairs/s", ratios)
    if options.page:
        tables.write(here / "README.md", "speed", tables.origin(tables.commit_of(build)),
                     tables.markdown(("", "speeds", "median of ratios", "all"), rows))


if __name__ == "__main__":
    main()
