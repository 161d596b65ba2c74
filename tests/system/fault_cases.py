#!/usr/bin/python3
"""Every file operation of a short run fails once: the process is killed there, the disk is full, once or from then on,
or there is an error of input and output. Each time the exit code is as promised, no state is lost, and the resumed
run ends with the bits and files of the run that nobody disturbed.

    fault_cases.py --programs build/bin --preload build/tests/libfaulty_files.so --source . [--sample N] [--jobs 2] [--seed 1]
"""
import argparse
import collections
import concurrent.futures
import re
import shutil
import sys
import threading
import time
from pathlib import Path

import runner
from runner import Runner

ACTIONS = ("kill", "enospc", "enospc_stay", "eio")
STEPS = 3
# A checkpoint at every step, snapshots at the begin, in the middle and at the end.
OPTIONS = ["--steps", STEPS, "--set", "output.series_interval=0", "--set", "output.checkpoint_interval=1e-9"]
REASONS = {"enospc": "No space left on device", "enospc_stay": "No space left on device", "eio": "Input/output error"}


def step_of(path):
    return int(re.search(r"\d{9,12}", path).group(0))


class Operation:
    def __init__(self, line):
        number, self.kind, self.call, *path = line.split(" ")
        self.number, self.path = int(number), " ".join(path)

    def can(self, action):
        """A full disk is nothing to those who read or delete; killing there is like killing at what follows."""
        return self.kind == "space" or action == "eio" or (action == "kill" and self.kind == "change")


class Family:
    """One scene on a number of ranks, of which one meets the faults."""

    def __init__(self, faults, name, ranks, rank, arguments):
        self.faults, self.run = faults, faults.run
        self.label, self.ranks, self.rank = f"{name}, rank {rank} of {ranks}", ranks, rank
        self.arguments = arguments
        folder = self.run.folder / f"{name}{ranks}{rank}"
        folder.mkdir()
        self.folder = folder
        result = self.go("whole", FAULTS_LOG=folder / "log")
        assert result.code == 0, result.err
        self.fingerprint, self.files = result.fingerprint, self.files_of(folder / "whole")
        self.operations = [Operation(line) for line in (folder / "log").read_text().splitlines()]
        assert len(self.files) == 6, f"{sorted(self.files)}: not what this test is about"
        self.first_output = next(o.number for o in self.operations if o.path.startswith("/snapshot_"))

    def go(self, out, **settings):
        path = self.folder / out
        environment = [f"{key}={value}" for key, value in settings.items()]
        start = ["env", f"LD_PRELOAD={self.faults.preload}", f"FAULTS_BELOW={path}", f"FAULTS_RANK={self.rank}",
                 *environment, str(self.run.programs / "peperite"), "run", *self.arguments, *OPTIONS, "--out", path]
        launch = [self.run.mpirun, "-n", str(self.ranks)] if self.ranks > 1 else []
        return self.run.finish(self.run.start_command([*launch, *start]), timeout=90)

    def certain(self, operation):
        """The step of the last checkpoint that was complete before the operation, 0 if there was none. On the first
        rank it is from the third operation after its manifest was renamed; the others know what they write next."""
        before = [o for o in self.operations if o.number < operation.number]
        if self.rank == 0:
            return max((step_of(o.path) for o in before[:-3] if o.call == "rename" and o.path.endswith("manifest.json")),
                       default=0)
        steps = {step_of(o.path) for o in before if o.path.startswith("/checkpoint")}
        return max((step for step in steps if step < step_of(operation.path)), default=0)

    @staticmethod
    def files_of(path):
        names = ["series.csv", "particles.xdmf", *(p.name for p in path.glob("snapshot_*"))]
        return {name: (path / name).read_bytes() for name in names + ["scene.toml"] if (path / name).exists()}

    def cases(self):
        return [(self, action, o) for action in ACTIONS for o in self.operations if o.can(action)]

    # ---- one fault ------------------------------------------------------------------------------------------

    def check(self, action, operation):
        """What came of it, one word."""
        out = f"{action}{operation.number}"
        path = self.folder / out
        result = self.go(out, FAULTS_AT=operation.number, FAULTS_DO=action)
        verdict = self.verdict(action, operation, result, path)
        if result.code != 0:
            self.go_on(action, operation, result, path)
        shutil.rmtree(path, ignore_errors=True)
        return verdict

    def verdict(self, action, operation, result, path):
        text = f"exit {result.code}\n{result.err}"
        if action == "kill":
            assert result.code in (-9, 137), text
            return "killed"
        if result.code == 0:  # what failed is nothing that the run needs
            self.compare(result, path)
            return "harmless"
        assert len(result.complaints) == 1, text
        assert REASONS[action] in result.complaints[0], text
        if result.code == 2:
            assert operation.number < self.first_output, text
            return "refused at the start"
        assert result.code == 4, text
        return "exit 4"

    def go_on(self, action, operation, result, path):
        # Newest first: the directory of a checkpoint is complete once it has its manifest.
        last = max((int(p.parent.name[:12]) for p in path.glob("checkpoint/*/manifest.json")), default=None)
        assert (last or 0) >= self.certain(operation), f"the checkpoint of step {self.certain(operation)} is gone"
        if result.code == 4:
            said = re.search(r"the checkpoint of step (\d+) is intact", result.err)
            assert said or "there is no checkpoint yet" in result.err, result.err
            assert (int(said.group(1)) if said else None) == last, f"{result.err}: it is of step {last}"
        if not (path / "scene.toml").exists():
            assert last is None
            if path.exists():
                refused = self.run.run(1, "peperite", "resume", path, code=2)
                assert "there is no run in" in refused.err, refused.err
            again = self.run.run(1, "peperite", "run", *self.arguments, *OPTIONS, "--out", path)
        else:
            again = self.run.run(1, "peperite", "resume", path)
            begin = re.search(r"from step (\d+)", again.out)
            finished = begin is None  # all was there
            assert finished or int(begin.group(1)) == (last or 0), f"step {last} was lost:\n{again.out}\n{again.err}"
            assert not finished or last == STEPS
        self.compare(again, path)
        left = [p.name for p in path.rglob("*") if p.name.startswith("run.lock") or ".tmp" in p.name]
        assert not left, f"left behind: {left}"
        assert (path / "perf.json").exists()

    def compare(self, result, path):
        assert result.fingerprint == self.fingerprint, f"{result.fingerprint} is not {self.fingerprint}"
        files = self.files_of(path)
        assert sorted(files) == sorted(self.files), f"{sorted(files)}"
        for name, content in files.items():
            assert content == self.files[name], f"{name} differs"


class Faults:
    def __init__(self, arguments):
        self.run = Runner(arguments.programs, arguments.mpirun)
        self.preload = Path(arguments.preload).resolve()
        self.lock = threading.Lock()
        self.counts = collections.Counter()
        self.failures = []
        source = Path(arguments.source).resolve()
        scenes = {
            "fluid": [source / "apps" / "buoyant_cylinder" / "fluid.toml", "--set", "output.snapshot_interval=0.4 ms"],
            # So close that they touch from the first step on.
            "grains": [source / "tests" / "scenes" / "grains_servo.toml", "--set", "start.spacing=0.98 mm",
                       "--set", "output.snapshot_interval=30 us", "--set", "output.contacts=true"],
        }
        places = ((1, 0), (3, 0), (3, 1))  # ranks, the one with faults: the first writes most, the others their rows
        self.families = [Family(self, name, *place, options) for place in places for name, options in scenes.items()]

    def one(self, case):
        family, action, operation = case
        try:
            verdict = family.check(action, operation)
        except Exception as error:
            verdict = "FAILED"
            with self.lock:
                self.failures.append(f"{family.label}: {action} at {operation.number} ({operation.call} "
                                     f"{operation.path}): {type(error).__name__}: {error}")
                print(self.failures[-1], flush=True)
        with self.lock:
            self.counts[(family.label, action, verdict)] += 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--preload", required=True)
    parser.add_argument("--source", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--sample", type=int, help="so many faults, drawn at random, instead of all")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    arguments = parser.parse_args()
    faults = Faults(arguments)
    generator = runner.generator(arguments.seed)
    cases = [case for family in faults.families for case in family.cases()]
    generator.shuffle(cases)
    print(f"seed {arguments.seed}: {len(cases)} faults at {sum(len(f.operations) for f in faults.families)} operations"
          + (f", of which {arguments.sample} are tried" if arguments.sample else ""), flush=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(faults.one, cases[: arguments.sample]))
    for (label, action, verdict), count in sorted(faults.counts.items()):
        print(f"{label}: {action}: {verdict}: {count}")
    print(f"{sum(faults.counts.values())} faults, {len(faults.failures)} failures")
    faults.run.close()
    sys.exit(1 if faults.failures else 0)


if __name__ == "__main__":
    main()
