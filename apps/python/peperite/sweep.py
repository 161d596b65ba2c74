"""Runs a scene once for each combination of values of some keys.

    sweep SCENE --vary KEY=VALUE,VALUE,... [--vary ...] --out DIR [--set KEY=VALUE]... [--steps N | --until T] [--ranks N] [--jobs N]

Runs are in DIR, in folders named by their values; what has come to its end is not run again, what was stopped goes on. DIR/sweep.csv
has a line for each: its values, the last line of its series, what it cost. A run that fails is said so, the others go on. SIGINT or
SIGTERM: runs write a checkpoint and stop, exit code 75; the same command goes on.
"""

import argparse
import csv
import hashlib
import io
import itertools
import json
import math
import os
import re
import signal
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
    name = re.sub(r"[^\w=.,+-]+", "_", " ".join(parts)).strip("_.") or "run"
    return name.encode()[:100].decode(errors="ignore")


class Runs:
    """As programs, until it is told to stop."""

    def __init__(self, given):
        self.given, self.running, self.stopped = given, set(), False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self.stop)

    def stop(self, *_):
        self.stopped = True
        for child in list(self.running):
            child.send_signal(signal.SIGUSR1)  # which mpirun passes on: a checkpoint, and the end

    def command(self, folder, setting):
        given = self.given
        launch = ["mpirun", "-n", str(given.ranks)] if given.ranks > 1 else []
        end = [word for name in ("steps", "until") if getattr(given, name) is not None for word in (f"--{name}", getattr(given, name))]
        if (folder / "scene.toml").is_file() or (folder / "checkpoint").is_dir():
            return [*launch, PROGRAM, "resume", str(folder), *end]
        sets = [*given.set, *(f"{key}={value}" for key, value in setting)]
        return [*launch, PROGRAM, "run", str(given.scene), "--out", str(folder), *(w for s in sets for w in ("--set", s)), *end]

    def run(self, folder, setting):
        """None, or what went wrong."""
        try:
            failure = None if is_done(folder) else self.go(folder, setting)
        except (Error, OSError) as error:
            failure = str(error)
        print(f"{folder.name}: {failure or 'done'}", flush=True)
        return failure

    def go(self, folder, setting):
        if self.stopped:
            return "not begun"
        with subprocess.Popen(self.command(folder, setting), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              errors="replace", start_new_session=True) as child:
            self.running.add(child)
            if self.stopped:
                child.send_signal(signal.SIGUSR1)
            lines = child.communicate()[1].splitlines()
            self.running.discard(child)
        if child.returncode == 0:
            return None
        said = [line for line in lines if line.startswith("peperite:")] or lines or ["no word"]
        return f"exit code {child.returncode}: {said[0]}"


def is_done(folder):
    """It has come to its end."""
    if not (folder / "perf.json").is_file():
        return False
    run = Run(folder)
    try:
        wanted, end = run.scene["time"], run.perf["end"]
        return end["step"] >= wanted.get("steps", math.inf) or end["time"] >= wanted.get("until", math.inf)
    except (KeyError, TypeError):
        raise Error(f"{folder / 'perf.json'}: is not of a run") from None


def row_of(folder, setting):
    run = Run(folder)
    row = {**dict(setting), "fingerprint": run.perf["fingerprint"], "cost_seconds": run.perf["cost_seconds"]}
    try:
        return row | {name: column[-1] for name, column in run.series.items()}
    except Error:
        return row


def write_table(path, rows):
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO()
    table = csv.DictWriter(text, names, lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    replace(path, text.getvalue())


def replace(path, text):
    """All of it, or what was there before."""
    new = path.with_name(f"{path.name}.new")
    try:
        new.write_text(text)
        new.replace(path)
    except OSError as error:
        raise Error(f"{path}: cannot be written: {error.strerror}") from None


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


def claim(given, settings):
    """Folders of the settings. All runs are of this scene with these settings; the varied values and the number of ranks may be others
    later."""
    if not given.scene.is_file():
        raise Error(f"{given.scene}: no such file")
    of = {"scene": hashlib.sha256(b"".join(files_of(given.scene))).hexdigest(), "set": given.set, "steps": given.steps, "until": given.until}
    given.out.mkdir(parents=True, exist_ok=True)
    record, runs = given.out / "sweep.json", {}
    if record.exists():
        try:
            earlier = json.loads(record.read_text())
            runs = earlier.pop("runs")
        except (ValueError, KeyError, AttributeError):
            raise Error(f"{record}: is damaged; name another --out") from None
        if earlier != of:
            raise Error(f"{given.out}: holds a sweep of another scene, or of other --set, --steps or --until; name another --out")
    elif any(given.out.iterdir()):
        raise Error(f"{given.out}: is not empty, and holds no sweep; name another --out")
    names = [named(runs, setting) for setting in settings]
    replace(record, json.dumps({**of, "runs": runs}) + "\n")
    return [given.out / name for name in names]


def named(runs, setting):
    """Its folder, which is in `runs` from then on; one with the values of other keys may have the same name."""
    setting = [list(pair) for pair in setting]
    for name, of in runs.items():
        if of == setting:
            return name
    first = name_of(setting)
    name = next(name for k in range(1, len(runs) + 2) if (name := first if k == 1 else f"{first}_{k}") not in runs)
    runs[name] = setting
    return name


def main():
    given = arguments(sys.argv[1:])
    keys = [key for key, _ in given.vary]
    settings = list(dict.fromkeys(tuple(zip(keys, values)) for values in itertools.product(*(values for _, values in given.vary))))
    folders = claim(given, settings)
    runs = Runs(given)
    jobs = given.jobs or max(1, len(os.sched_getaffinity(0)) // given.ranks)
    with ThreadPoolExecutor(jobs) as pool:
        failures = list(pool.map(runs.run, folders, settings))
    good = [k for k, failure in enumerate(failures) if failure is None]
    write_table(given.out / "sweep.csv", [row_of(folders[k], settings[k]) for k in good])
    print(given.out / "sweep.csv")
    if runs.stopped:
        print("peperite sweep: stopped; the same command goes on", file=sys.stderr)
        sys.exit(75)
    if len(good) < len(folders):
        raise Error(f"{len(folders) - len(good)} of {len(folders)} runs failed")


if __name__ == "__main__":
    sys.exit(refusing(main))
