"""Runs the programs under mpirun and looks at what they leave."""
import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "HWLOC_COMPONENTS": "-opencl",  # or signals to mpirun are lost, see cmake/environment.sh
}


class Finished:
    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err

    @property
    def fingerprint(self):
        found = re.fullmatch(r"(fingerprint [0-9a-f]{32} step \d+ t \S+)", self.out.strip().splitlines()[-1])
        assert found, f"the last line is no fingerprint:\n{self.out}\n{self.err}"
        return found.group(1)

    @property
    def complaints(self):
        """Lines on stderr that are ours, not mpirun's."""
        return [line for line in self.err.splitlines() if line.startswith("peperite:")]


class Runner:
    def __init__(self, programs, mpirun):
        self.programs = Path(programs).resolve()
        self.mpirun = mpirun
        self.folder = Path(tempfile.mkdtemp(prefix="peperite_run_"))
        self.environment = {**os.environ, **ENVIRONMENT}

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def command(self, ranks, program, arguments):
        start = [self.mpirun, "-n", str(ranks)] if ranks > 1 else []
        return start + [str(self.programs / program)] + [str(a) for a in arguments]

    def start(self, ranks, program, *arguments, **options):
        return self.start_command(self.command(ranks, program, arguments), **options)

    def start_command(self, command, **options):
        return subprocess.Popen([str(word) for word in command], cwd=self.folder, env=self.environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)

    def finish(self, process, timeout=240):
        try:
            out, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            kill_tree(process.pid)
            out, err = process.communicate()
            raise AssertionError(f"hangs: {process.args}\n{out}\n{err}")
        return Finished(process.returncode, out, err)

    def run(self, ranks, program, *arguments, code=0, **options):
        result = self.finish(self.start(ranks, program, *arguments, **options))
        assert result.code == code, f"{ranks} ranks: {arguments}: exit {result.code}, not {code}\n{result.out}\n{result.err}"
        return result

    def refused(self, ranks, program, *arguments, says="", **options):
        """Exits 2 with one line that contains `says`."""
        result = self.run(ranks, program, *arguments, code=2, **options)
        assert len(result.complaints) == 1, f"{arguments}: {result.err}"
        assert says in result.complaints[0], f"{arguments}: \"{says}\" is not in {result.complaints[0]}"
        return result

    def files(self, directory):
        """What must be identical however a run came to its end."""
        directory = self.folder / directory
        return {name: (directory / name).read_bytes() for name in ("series.csv", "particles.xdmf")}


def descendants(pid):
    try:
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return []
    out = []
    for child in map(int, children):
        out += [child] + descendants(child)
    return out


def kill_tree(pid):
    """kill -9 of mpirun and its ranks, or of one rank alone (mpirun then ends the others)."""
    for victim in [pid] + descendants(pid):
        try:
            os.kill(victim, signal.SIGKILL)
        except ProcessLookupError:
            pass


def kill_somehow(process, generator):
    ranks = descendants(process.pid)
    if ranks and generator.random() < 0.5:
        try:
            os.kill(generator.choice(ranks), signal.SIGKILL)
        except ProcessLookupError:
            pass
    else:
        kill_tree(process.pid)


def wait_for(condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.01)


def rows_in(path):
    try:
        return path.read_bytes().count(b"\n")
    except OSError:
        return 0


def damage(checkpoint, generator):
    """Truncates, empties or flips a bit of one of a checkpoint's files."""
    file = generator.choice(sorted(checkpoint.iterdir()))
    data = bytearray(file.read_bytes())
    how = generator.choice(["empty", "truncate", "flip"])
    if how == "empty":
        data = b""
    elif how == "truncate":
        data = data[: generator.randrange(len(data))]
    else:
        data[generator.randrange(len(data))] ^= 1 << generator.randrange(8)
    file.write_bytes(data)
    return f"{how} {file.name}"


def generator(seed):
    return random.Random(seed)


def run_all(cases, names):
    """Calls the methods test_NAME of `cases`, or all, tells what came of each and closes its runner: the exit status."""
    failed = 0
    for name in names or [n[5:] for n in dir(cases) if n.startswith("test_")]:
        begin = time.monotonic()
        try:
            getattr(cases, f"test_{name}")()
            verdict = "ok"
        except Exception as error:
            verdict = f"FAILED: {type(error).__name__}: {error}"
            failed += 1
        print(f"{name}: {verdict} ({time.monotonic() - begin:.1f} s)", flush=True)
    cases.run.close()
    return 1 if failed else 0


def path(text):
    return Path(text).resolve()


given = argparse.Namespace()  # what main() has read: programs, source, mpirun


class Case(unittest.TestCase):
    """A test case with programs to run, in a folder of its own."""

    @classmethod
    def setUpClass(cls):
        cls.run_of = Runner(given.programs, given.mpirun)
        cls.folder, cls.source = cls.run_of.folder, given.source

    @classmethod
    def tearDownClass(cls):
        cls.run_of.close()


def main(*folders):
    """Runs the cases of the script that calls this, or those that its command line names."""
    parser = argparse.ArgumentParser()
    for name in ("programs", "source", *folders):
        parser.add_argument(f"--{name}", type=path, required=True)
    parser.add_argument("--mpirun", default="mpirun")
    _, names = parser.parse_known_args(namespace=given)
    unittest.main(argv=sys.argv[:1] + names)
