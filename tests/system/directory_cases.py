#!/usr/bin/python3
"""Whose is what in the directory of a run: locks, files that a run did not write, leftovers, a finished run that lacks
something, and tools that read damaged files.

    directory_cases.py --programs build/bin --preload build/tests/libfaulty_files.so --source . [name ...]
"""
import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from runner import Runner, kill_tree, rows_in, run_all, wait_for

ENDLESS = 10**9


class Cases:
    def __init__(self, run, source):
        self.run = run
        self.scene = Path(source).resolve() / "apps" / "buoyant_cylinder" / "fluid.toml"

    def go(self, out, *more, ranks=1, steps=3, **options):
        return self.run.run(ranks, "peperite", "run", self.scene, "--steps", steps, *more, "--out", out, **options)

    def start(self, out, *more, ranks=1):
        process = self.run.start(ranks, "peperite", "run", self.scene, "--steps", ENDLESS, "--out", out, *more)
        wait_for(lambda: rows_in(self.run.folder / out / "series.csv") > 1)
        return process

    def stopped(self, process):
        process.send_signal(signal.SIGUSR1)
        result = self.run.finish(process)
        assert result.code == 75, result.err
        return result

    def folder(self, out):
        return self.run.folder / out

    # ---- files that a run did not write ---------------------------------------------------------------------

    def test_foreign_files(self):
        """Any file named like a run's own keeps a new run away; others do not, and stay as they are."""
        for name in ("perf.json", "series.csv", "particles.xdmf", "scene.toml", "snapshot_mine.h5", "scene.toml.tmp",
                     "checkpoint/notes", "crash/notes"):
            out = self.folder("used_" + name.replace("/", "_"))
            (out / name).parent.mkdir(parents=True)
            (out / name).write_text("mine")
            self.run.refused(1, "peperite", "run", self.scene, "--steps", 3, "--out", out, says="--out")
            assert (out / name).read_text() == "mine" and len(list(out.iterdir())) == 1, name
        out = self.folder("notes")
        out.mkdir()
        (out / "notes.txt").write_text("mine")
        self.go(out)
        assert (out / "notes.txt").read_text() == "mine"

    def test_resume_changes(self):
        """What the state does not depend on may change when a run goes on, and nothing else."""
        out = self.folder("changed")
        whole = self.go("unchanged", steps=30)
        self.go(out, steps=10)
        before = self.run.files("changed")
        for ranks in (1, 3):
            self.run.refused(ranks, "peperite", "resume", out, "--set", "group.melt.viscosity=1", "--steps", 30,
                             says="group.melt.viscosity")
            self.run.refused(ranks, "peperite", "resume", out, "--set", "output.status_interval=no", "--steps", 30,
                             says="output.status_interval")
        assert self.run.files("changed") == before, "a refused change has changed files"
        result = self.run.run(2, "peperite", "resume", out, "--steps", 30, "--set", "output.series_interval=1e9",
                              "--set", "decomposition.skin=0.5")
        assert result.fingerprint == whole.fingerprint, "another skin has changed the bits"
        assert "skin = 0.5" in (out / "scene.toml").read_text() and rows_in(out / "series.csv") < 20

    def test_branch(self):
        """Another run begins with a checkpoint: unchanged with the bits of the one that goes on, changed with others, on any number of
        ranks the same; what would change the parts of the scene is refused, and the first run stays as it is."""
        out, other = self.folder("trunk"), {ranks: self.folder(f"branch{ranks}") for ranks in (1, 3)}
        self.go(out, steps=10)
        before = self.run.files("trunk")
        words = ("peperite", "resume", out, "--branch")
        plain = self.run.run(2, *words, self.folder("plain"), "--steps", 30)
        changed = [self.run.run(ranks, *words, other[ranks], "--steps", 30, "--set", "group.melt.viscosity=900",
                                "--set", "terms.artificial_viscosity=0.05", "--set", "domain.gravity=[1, -9]") for ranks in (1, 3)]
        assert changed[0].fingerprint == changed[1].fingerprint != plain.fingerprint
        assert "viscosity = 900" in (other[1] / "scene.toml").read_text()
        assert (other[1] / "series.csv").read_bytes() == (other[3] / "series.csv").read_bytes()
        for key, value in {"group.melt.density": 2000, "kernel.h_over_dx": 1.1, "domain.upper": "[99, 99]", "reset": "[]",
                           "group.melt.becomes": "[]", "group": "[]", "terms.none": 1}.items():
            self.run.refused(2, *words, self.folder("refused"), "--set", f"{key}={value}", says=key)
        self.run.refused(2, *words, self.folder("refused"), "--set", "terms.shifting=true", "--set", "terms.none=1", says="none")
        self.run.refused(2, *words, self.folder("refused"), "--set", "terms.bond_reach=2", says="terms.bond_reach")
        self.run.refused(1, *words, other[1], says="holds a run already; choose another with --branch")
        # Far more viscous than its step was made for: energy does not rise.
        stiff = self.folder("stiff")
        self.run.run(1, *words, stiff, "--steps", 14, "--set", "output.series_interval=0", "--set", "group.melt.viscosity=1e8",
                     "--set", "group.wall.viscosity=1e8", "--set", "time.dt=", "--set", "time.cfl=0.8", "--set", 'monitor=[{kind="energy"}]')
        kinetic = [float(row.split(",")[2]) for row in (stiff / "series.csv").read_text().splitlines()[1:]]
        assert len(kinetic) > 2 and max(kinetic) <= 1.001 * kinetic[0], kinetic
        self.run.refused(1, *words, "", says="--branch: is empty")
        self.run.refused(1, "peperite", "resume", "", says="dir: is empty")
        grains, sand = self.folder("grains"), self.scene.parents[2] / "tests/scenes/grains_pour.toml"
        self.run.run(2, "peperite", "run", sand, "--out", grains, "--steps", 60)
        self.run.refused(2, "peperite", "resume", grains, "--branch", self.folder("rolling"), "--set", "group.sand.rolling_friction=0.1",
                         says="rolling")
        self.run.run(2, "peperite", "resume", grains, "--branch", self.folder("rougher"), "--steps", 80, "--set", "group.sand.friction=0.7")
        # Who is nearest to a point moves on: its monitor goes with it.
        one, far = self.folder("one"), self.folder("far")
        self.run.run(2, "peperite", "run", sand, "--out", one, "--steps", 200, "--set", "output.series_interval=0",
                     "--set", 'monitor=[{kind="particle", name="one", nearest_to=[0.005,0.005,0.01]}]')
        self.run.run(2, "peperite", "resume", one, "--branch", far, "--steps", 201, "--set", "group.sand.friction=0.7")
        last, first = ([float(x) for x in (folder / "series.csv").read_text().splitlines()[row].split(",")]
                       for folder, row in ((one, -1), (far, 1)))
        assert abs(last[2] - 0.005) > 1e-3 and max(abs(a - b) for a, b in zip(last[2:5], first[2:5])) < 2e-5, (last, first)
        assert self.run.files("trunk") == before, "a branch has changed the run that it comes from"
        assert self.run.run(1, "peperite", "resume", out, "--steps", 30).fingerprint == plain.fingerprint

    def test_resume_keeps(self):
        """What lies in the directory besides the run's own files outlives a resume."""
        out = self.folder("keeps")
        self.go(out, "--set", "output.snapshot_interval=0.4 ms")  # at steps 0, 2 and the end
        last = out / "snapshot_000000003.h5"
        kept = {out / name: last.read_bytes() for name in ("snapshot_keep_for_paper.h5", "snapshot_3.h5", "old.tmp",
                                                           "checkpoint/000000000003/copy.h5")}
        for path, content in kept.items():
            path.write_bytes(content)
        leftovers = [out / name for name in ("series.csv.tmp", "snapshot_000000004.h5.tmp", "run.lock.host.1.tmp",
                                             "snapshot_000000004.h5.tmp.locktest.77")]
        for path in leftovers:
            path.touch()
        # Of this run, but of a future that the checkpoint does not know: written again with the same bits.
        longer = self.folder("longer")
        self.go(longer, "--set", "output.snapshot_interval=0.4 ms", steps=9)
        shutil.copy(longer / "snapshot_000000004.h5", out)
        self.run.run(1, "peperite", "resume", out, "--steps", 9)
        for path, content in kept.items():
            assert path.read_bytes() == content, path
        assert last.exists(), "the last snapshot of the first end is gone"
        assert not [path for path in leftovers if path.exists()]
        assert self.run.files(out) == self.run.files(longer)
        # A file of a name that the run will write, of another scene.
        self.go("other", "--set", "group.melt.viscosity=400", steps=12)
        shutil.copy(self.folder("other") / "snapshot_000000012.h5", out)
        content = (out / "snapshot_000000012.h5").read_bytes()
        series = (out / "series.csv").read_bytes()
        self.run.refused(1, "peperite", "resume", out, "--steps", 12, says="snapshot_000000012.h5 is not of this run")
        assert (out / "snapshot_000000012.h5").read_bytes() == content and (out / "series.csv").read_bytes() == series

    def test_resume_with_another_series(self):
        """Rows of the same length are not those that the checkpoint knows."""
        out = self.folder("series")
        self.go(out)
        series, right = out / "series.csv", (out / "series.csv").read_bytes()
        wrong = right[:-2] + (b"1" if right[-2:-1] != b"1" else b"2") + b"\n"
        series.write_bytes(wrong)
        self.run.refused(1, "peperite", "resume", out, "--steps", 9, says="are not those of when the checkpoint was written")
        assert series.read_bytes() == wrong
        series.write_bytes(right)
        self.run.run(1, "peperite", "resume", out, "--steps", 9)

    def test_record(self):
        """Cuts are recorded in a file of their own, or not at all."""
        scene = self.folder("mine.toml")
        shutil.copy(self.scene, scene)
        before = scene.read_bytes()
        record = ["--set", f"decomposition.record={scene}"]
        for ranks in (1, 2):
            self.run.refused(ranks, "peperite", "run", scene, *record, "--steps", 3, "--out", "recorded", says="record")
        self.run.run(2, "peperite", "check", scene, *record)
        assert scene.read_bytes() == before and not self.folder("recorded").exists()
        own = self.folder("own")
        own.mkdir()
        for name in ("run.lock", "stop", "scene.toml", "series.csv.tmp", "crash/../perf.json"):
            self.run.refused(2, "peperite", "run", self.scene, "--set", f"decomposition.record={own / name}", "--steps", 3, "--out", own,
                             says="name of a file of a run")
        assert not list(own.iterdir())
        self.go("other_run")
        for name in ("stop", "snapshot_000000099.h5", "checkpoint/mine"):
            self.run.refused(2, "peperite", "run", self.scene, "--set", f"decomposition.record={self.folder('other_run') / name}", "--steps", 3,
                             "--out", own, says="name of a file of a run")
        cuts = self.folder("cuts")
        record = ["--set", f"decomposition.record={cuts}", "--set", "decomposition.rebuild_every=2"]
        self.go("recorded", *record, ranks=2)
        first = cuts.read_bytes()
        assert first
        self.run.refused(2, "peperite", "run", self.scene, *record, "--steps", 3, "--out", "again", says="exists")
        self.run.run(2, "peperite", "resume", "recorded", "--steps", 6)
        more = cuts.read_bytes()
        assert more.startswith(first) and len(more) > len(first)
        cuts.write_bytes(more[:-3])  # as a run that was killed leaves it
        self.run.run(2, "peperite", "resume", "recorded", "--steps", 8)
        assert all(line.count(b"[") == more.splitlines()[0].count(b"[") for line in cuts.read_bytes().splitlines())
        other = self.folder("other_cuts")
        other.write_bytes(first)
        self.run.refused(2, "peperite", "resume", "recorded", "--steps", 9, "--set", f"decomposition.record={other}", says="exists")
        assert other.read_bytes() == first
        cuts.write_bytes(first + b"a note of mine\n")
        self.run.refused(2, "peperite", "resume", "recorded", "--steps", 9, says="exists")
        assert cuts.read_bytes().endswith(b"mine\n")

    # ---- locks ----------------------------------------------------------------------------------------------

    def test_two_at_once(self):
        """Of runs that start at the same moment in one directory, one wins."""
        for n in range(4):
            many = [self.run.start(1, "peperite", "run", self.scene, "--steps", 40, "--out", f"two{n}") for _ in range(4)]
            results = [self.run.finish(process) for process in many]
            assert sorted(r.code for r in results) == [0, 2, 2, 2], [r.err for r in results]
            assert all(len(r.complaints) == 1 for r in results if r.code == 2)
            assert rows_in(self.folder(f"two{n}") / "series.csv") == 2

    def test_resume_beside_a_run(self):
        process = self.start("living", ranks=2)
        for ranks in (1, 2):
            self.run.refused(ranks, "peperite", "resume", "living", says=f"in use by another run (process ")
        self.run.refused(1, "peperite", "run", self.scene, "--out", "living", says="--out")
        self.stopped(process)
        assert not (self.folder("living") / "run.lock").exists(), "exit 75 keeps the lock"
        assert b"\0" not in (self.folder("living") / "series.csv").read_bytes()

    def test_dead_lock(self):
        """A killed run leaves its lock; the next on the same machine takes it over, and only one of many does."""
        for n in range(3):
            process = self.start(f"dead{n}")
            kill_tree(process.pid)
            self.run.finish(process)
            assert (self.folder(f"dead{n}") / "run.lock").exists()
            many = [self.run.start(1, "peperite", "resume", f"dead{n}", "--steps", 40) for _ in range(4)]
            results = [self.run.finish(process) for process in many]
            won = [r for r in results if r.code == 0 and "took over" in r.err]
            # Who comes when all is over finds a finished run.
            assert len(won) == 1 and all(r.code == 2 or "took over" in r.err or not r.complaints for r in results), \
                [(r.code, r.err) for r in results]
            assert not list(self.folder(f"dead{n}").glob("run.lock*"))

    def test_lock_of_another(self):
        """Of another machine: refused while there are signs of life, or taken over by a later start of the same job."""
        out = self.folder("another")
        self.stopped(self.start(out))
        lock = out / "run.lock"
        owner = {"host": "node7", "machine": "other", "pid": 7, "started": "1", "job": "c:12", "restart": 0, "since": "noon"}

        def put(age, **more):
            lock.write_text(json.dumps({**owner, **more}))
            os.utime(lock, (time.time() - age,) * 2)

        def resumed(**environment):
            self.run.environment.update(environment)
            result = self.run.run(2, "peperite", "resume", out, "--max-time", "0:0:1", code=75)
            for name in environment:
                del self.run.environment[name]
            assert "took over" in result.err and not lock.exists(), result.err

        put(60)
        for ranks in (1, 2):
            result = self.run.refused(ranks, "peperite", "resume", out, says=f"delete {lock}")
            assert "process 7 on node7" in result.err, result.err
        put(16 * 60)
        resumed()
        put(0)
        resumed(SLURM_CLUSTER_NAME="c", SLURM_JOB_ID="12", SLURM_RESTART_COUNT="1")
        self.run.environment.update(SLURM_CLUSTER_NAME="c", SLURM_JOB_ID="12", SLURM_RESTART_COUNT="0")
        put(0)
        self.run.refused(1, "peperite", "resume", out, says="in use")
        for name in ("SLURM_CLUSTER_NAME", "SLURM_JOB_ID", "SLURM_RESTART_COUNT"):
            del self.run.environment[name]
        lock.write_text("")  # whoever wrote this
        self.run.refused(1, "peperite", "resume", out, says=f"delete {lock}")

    def test_reused_pid(self):
        """A process with the pid of a dead run is not that run."""
        out = self.folder("reused")
        process = self.start(out)
        owner = json.loads((out / "run.lock").read_text())
        assert owner["pid"] == process.pid
        self.stopped(process)
        (out / "run.lock").write_text(json.dumps({**owner, "pid": os.getpid()}))
        result = self.run.run(1, "peperite", "resume", out, "--max-time", "0:0:1", code=75)
        assert "took over" in result.err, result.err

    def test_lost_lock(self):
        """A run whose directory became another's writes no more."""
        out = self.folder("lost")
        process = self.start(out, ranks=2)
        lock = out / "run.lock"
        other = {**json.loads(lock.read_text()), "host": "node7", "machine": "other"}
        (out / "put").write_text(json.dumps(other))
        (out / "put").rename(lock)
        result = self.run.finish(process, timeout=60)
        assert result.code == 4 and len(result.complaints) == 1 and "another run" in result.complaints[0], result.err
        assert json.loads(lock.read_text()) == other

    # ---- the end --------------------------------------------------------------------------------------------

    def test_finished_run_lacks_something(self):
        out = self.folder("finished")
        fingerprint = self.go(out, ranks=2).fingerprint
        last, index = out / "snapshot_000000003.h5", (out / "particles.xdmf").read_bytes()
        content = last.read_bytes()
        for missing in (last, out / "perf.json", out / "particles.xdmf"):
            missing.unlink()
            result = self.run.run(2, "peperite", "resume", out)
            assert result.fingerprint == fingerprint
            assert last.read_bytes() == content and (out / "particles.xdmf").read_bytes() == index, missing
            assert json.loads((out / "perf.json").read_text())["end"]["step"] == 3
        # A stop is no end: where the step at which it stopped is made the end, the last snapshot is still to come.
        process = self.start("stop", ranks=2)
        step = int(self.stopped(process).fingerprint.split()[3])
        assert not (self.folder("stop") / f"snapshot_{step:09}.h5").exists()
        self.run.run(1, "peperite", "resume", "stop", "--steps", step)
        self.go("whole", steps=step)
        for name in (f"snapshot_{step:09}.h5", "series.csv", "particles.xdmf"):
            assert (self.folder("stop") / name).read_bytes() == (self.folder("whole") / name).read_bytes(), name

    # ---- tools that read ------------------------------------------------------------------------------------

    def test_tools_end(self):
        """SIGTERM ends who reads."""
        fifo = self.folder("fifo.toml")
        os.mkfifo(fifo)
        for arguments in (["check", fifo], ["info", fifo], ["diff", fifo, fifo]):
            process = self.run.start(1, "peperite", *arguments)
            time.sleep(0.6)
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
            assert self.run.finish(process, timeout=5).code in (2, -signal.SIGTERM), arguments


    def test_damaged_snapshots(self):
        """HDF5 crashes on a file, or does not come to an end with it: one line, exit 2."""
        import h5py
        self.go("damaged")
        snapshot = self.folder("damaged") / "snapshot_000000003.h5"
        with h5py.File(snapshot) as file:
            git = str(file.attrs["git"]).encode()
        good = snapshot.read_bytes()
        text = good.index(git)  # in HDF5's heap for texts; in front of each is its length
        heap = good.index(b"GCOL") + 16
        bad = {"signal": good[: text - 1] + b"\x80" + good[text:],
               "does not come to an end": good[: heap + 8] + (2**64 - 16).to_bytes(8, "little") + good[heap + 16:]}
        for says, content in bad.items():
            snapshot.write_bytes(content)
            self.run.refused(1, "peperite", "info", snapshot, says=says)
        snapshot.write_bytes(good)
        with h5py.File(snapshot, "r+") as file:
            file.attrs.modify("dim", 7)
        self.run.refused(1, "peperite", "info", snapshot, says="7 dimensions")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--source", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    for other in ("--preload", "--sample", "--seed"):  # of fault_cases.py
        parser.add_argument(other)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    run = Runner(arguments.programs, arguments.mpirun)
    cases = Cases(run, arguments.source)
    sys.exit(run_all(cases, arguments.names))


if __name__ == "__main__":
    main()
