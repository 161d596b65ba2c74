"""Runs a scene once for each combination of values of some keys.

    sweep SCENE --vary KEY=VALUE,VALUE,... [--vary ...] --out DIR [--set KEY=VALUE]... [--steps N | --until T] [--ranks N] [--jobs N]

Runs are in DIR, in folders named by their values; what has come to its end is not run again, what was stopped goes on. DIR/sweep.csv
has a line for each: its values, the last line of its series, what it cost. A run that fails is said so, the others go on.
"""

import argparse
import csv
import hashlib
import itertools
import json
import os
import re
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .drawing.command import Parser, folder, refusing
from .errors import Error
from .run import Run

PROGRAM = os.environ.get("PEPERITE_PROGRAM", "peperite")


def values_of(text):
    """"1,[2,3],\\"a,b\\"" are three."""
    depth, quoted, start, out = 0, "", 0, []
    for k, letter in enumerate(text):
        if quoted:
            quoted = "" if letter == quoted else quoted
        elif letter in "\"'":
            quoted = letter
        elif letter in "[{":
            depth += 1
        elif letter in "]}":
            depth -= 1
        elif letter == "," and depth == 0:
            out.append(text[start:k])
            start = k + 1
    return [*out, text[start:]]


def varied(text):
    key, equals, values = text.partition("=")
    if not key or not equals or not values or "" in values_of(values):
        raise argparse.ArgumentTypeError(f"\"{text}\" is not KEY=VALUE,VALUE,...")
    return key, values_of(values)


def name_of(setting):
    """Of a folder: the last words of the keys, and the values."""
    parts = (f"{key.rpartition('.')[2]}={value}" for key, value in setting)
    return re.sub(r"[^\w=.,+-]+", "_", " ".join(parts)).strip("_") or "run"


def command_of(given, folder, setting):
    launch = ["mpirun", "-n", str(given.ranks)] if given.ranks > 1 else []
    end = [word for name in ("steps", "until") if getattr(given, name) is not None for word in (f"--{name}", getattr(given, name))]
    if (folder / "checkpoint").is_dir():
        return [*launch, PROGRAM, "resume", str(folder), *end]
    sets = [*given.set, *(f"{key}={value}" for key, value in setting)]
    return [*launch, PROGRAM, "run", str(given.scene), "--out", str(folder), *(w for s in sets for w in ("--set", s)), *end]


def run(given, folder, setting):
    """None, or what went wrong."""
    if not (folder / "perf.json").is_file():
        done = subprocess.run(command_of(given, folder, setting), capture_output=True, text=True, errors="replace")
        if done.returncode:
            said = [line for line in done.stderr.splitlines() if line.startswith("peperite:")] or done.stderr.splitlines() or ["no word"]
            print(f"{folder.name}: exit code {done.returncode}: {said[0]}", flush=True)
            return said[0]
    print(f"{folder.name}: done", flush=True)
    return None


def row_of(folder, setting):
    run = Run(folder)
    row = {**dict(setting), "fingerprint": run.perf["fingerprint"], "cost_seconds": run.perf["cost_seconds"]}
    try:
        return row | {name: column[-1] for name, column in run.series.items()}
    except Error:
        return row


def write_table(path, rows):
    names = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, names, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def arguments(words):
    parser = Parser(prog="peperite sweep", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", metavar="SCENE", type=Path)
    parser.add_argument("--vary", metavar="KEY=VALUES", type=varied, action="append", required=True)
    parser.add_argument("--out", metavar="DIR", type=folder, required=True)
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="for all runs")
    parser.add_argument("--steps", metavar="N")
    parser.add_argument("--until", metavar="T")
    parser.add_argument("--ranks", metavar="N", type=int, default=1, help="of each run")
    parser.add_argument("--jobs", metavar="N", type=int, help="runs side by side (default: as many as fit on the cores)")
    given = parser.parse_args(words)
    for name in ("ranks", "jobs"):
        if getattr(given, name) is not None and getattr(given, name) < 1:
            parser.error(f"--{name}: must be at least 1")
    return given


def files_of(scene):
    """The scene and what it includes, as far as they can be read: what is wrong with them the runs say."""
    found = {}

    def add(path):
        try:
            itself = path.resolve()
            if itself in found or not path.is_file():
                return
            found[itself] = path.read_bytes()
            include = tomllib.loads(found[itself].decode()).get("include")
        except (OSError, RuntimeError, ValueError):
            return
        for name in include if isinstance(include, list) else [include]:
            if isinstance(name, str):
                add(path.parent / name)

    add(scene)
    return list(found.values())


def claim(given):
    """The folder is of this scene with these settings; the varied values and the number of ranks may be others later."""
    if not given.scene.is_file():
        raise Error(f"{given.scene}: no such file")
    of = {"scene": hashlib.sha256(b"".join(files_of(given.scene))).hexdigest(), "set": given.set, "steps": given.steps, "until": given.until}
    given.out.mkdir(parents=True, exist_ok=True)
    record = given.out / "sweep.json"
    if not record.exists():
        record.write_text(json.dumps(of) + "\n")
    elif json.loads(record.read_text()) != of:
        raise Error(f"{given.out}: holds a sweep of another scene, or of other --set, --steps or --until; name another --out")


def main():
    given = arguments(sys.argv[1:])
    claim(given)
    keys = [key for key, _ in given.vary]
    settings = [tuple(zip(keys, values)) for values in itertools.product(*(values for _, values in given.vary))]
    names = [name_of(setting) for setting in settings]
    if len(set(names)) < len(names):
        names = [f"{k:03}_{name}" for k, name in enumerate(names)]
    jobs = given.jobs or max(1, len(os.sched_getaffinity(0)) // given.ranks)
    with ThreadPoolExecutor(jobs) as pool:
        failures = list(pool.map(lambda k: run(given, given.out / names[k], settings[k]), range(len(names))))
    good = [k for k, failure in enumerate(failures) if failure is None]
    write_table(given.out / "sweep.csv", [row_of(given.out / names[k], settings[k]) for k in good])
    print(given.out / "sweep.csv")
    if len(good) < len(names):
        raise Error(f"{len(names) - len(good)} of {len(names)} runs failed")


if __name__ == "__main__":
    sys.exit(refusing(main))
