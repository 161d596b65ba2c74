#!/usr/bin/python3
"""Whole runs: the same bits and files on any number of ranks, stopped and resumed in every way, and bad input.

    run_cases.py --programs build/bin --source . [--kills 10] [--seed 1] [name ...]
"""
import argparse
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import runner
from runner import Runner, damage, kill_somehow, rows_in, run_all, wait_for

LONG = 4000  # steps: two seconds on an idle machine, long enough to be interrupted
# Interrupted runs: a row every step, six snapshots, a checkpoint as often as possible.
BUSY = ["--set", "output.series_interval=0", "--set", "output.snapshot_interval=0.2"]
OFTEN = ["--set", "output.checkpoint_interval=0.05"]
GRAIN_STEPS = 8000
# Random cuts at every rebuild: contacts change ranks all the time.
CHAOS = ["--set", "output.series_interval=0", "--set", "decomposition.balance=chaos"]
CHAMBER_STEPS = 1500


def terminate_twice(process):
    """As Slurm does where pre-empted jobs have no grace."""
    rank = runner.descendants(process.pid)[-1]
    os.kill(rank, signal.SIGTERM)
    time.sleep(0.02)
    os.kill(rank, signal.SIGTERM)


class Cases:
    def __init__(self, run, source, kills, seed):
        self.run = run
        self.cases = Path(source) / "apps" / "buoyant_cylinder"
        self.bad_scenes = Path(source) / "tests" / "bad_scenes"
        self.scenes = Path(source) / "tests" / "scenes"
        self.grain_scene = self.scenes / "grains_servo.toml"
        self.kills = kills
        self.random = runner.generator(seed)
        self._reference = None

    @property
    def reference(self):
        """Fingerprint and files of the run that nobody disturbed."""
        if self._reference is None:
            result = self.run.run(2, "buoyant_cylinder", "--steps", LONG, *BUSY, "--out", "reference")
            self._reference = result.fingerprint, self.run.files("reference")
        return self._reference

    def start(self, ranks, out, *more, **options):
        return self.run.start(ranks, "buoyant_cylinder", "--steps", LONG, *BUSY, "--out", out, *more, **options)

    def expect_reference(self, result, out):
        self.expect(result, out, "reference", self.reference, LONG)

    def expect(self, result, out, like, reference, steps):
        fingerprint, files = reference
        assert result.fingerprint == fingerprint, f"{result.fingerprint} is not {fingerprint}"
        for name, content in self.run.files(out).items():
            assert content == files[name], f"{out}/{name} differs"
        last = f"snapshot_{steps:09}.h5"
        self.run.run(1, "peperite", "diff", f"{out}/{last}", f"{like}/{last}")

    # ---- the same bits ------------------------------------------------------------------------------------

    def test_ranks(self):
        for case in ("fluid", "gas", "solid"):
            scene = self.cases / f"{case}.toml"
            more = ["--steps", 60, "--set", "output.series_interval=0", "--set", "output.average_space=true",
                    "--set", "output.average_time=0.002"]
            one = self.run.run(1, "buoyant_cylinder", scene, *more, "--out", f"{case}1")
            three = self.run.run(3, "peperite", "run", scene, *more, "--out", f"{case}3")
            assert one.fingerprint == three.fingerprint
            assert self.run.files(f"{case}1") == self.run.files(f"{case}3")
            plain = self.run.run(1, "buoyant_cylinder", scene, "--steps", 60, "--out", f"{case}0")
            assert plain.fingerprint == one.fingerprint, "output changes the state"

    def test_start_file(self):
        """A snapshot, and its rows as CSV in any order, are starts."""
        self.run.run(1, "buoyant_cylinder", self.cases / "gas.toml", "--steps", 20, "--out", "first")
        snapshot = self.run.folder / "first" / "snapshot_000000020.h5"
        scene = self.scene_from_file()
        options = ["run", scene, "--steps", 20, "--set"]
        one = self.run.run(1, "peperite", *options, f"start.file={snapshot}", "--out", "again1")
        two = self.run.run(4, "peperite", *options, f"start.file={snapshot}", "--out", "again4")
        assert one.fingerprint == two.fingerprint
        fingerprints = set()
        rows = self.csv_rows(snapshot)
        for ranks in (1, 3):
            name = self.run.folder / f"rows{ranks}.csv"
            name.write_text("\n".join([rows[0]] + rows[1:]) + "\n")
            result = self.run.run(ranks, "peperite", *options, f"start.file={name}", "--out", f"rows{ranks}")
            fingerprints.add(result.fingerprint)
            rows[1:] = self.random.sample(rows[1:], len(rows) - 1)
        assert len(fingerprints) == 1
        self.bad_start_files(rows, scene)

    def bad_start_files(self, rows, scene):
        def refused(lines, says):
            name = self.run.folder / "bad.csv"
            name.write_text("\n".join(lines))
            for ranks in (1, 3):
                self.run.refused(ranks, "peperite", "check", scene, "--set", f"start.file={name}", says=says)

        def changed(line, column, value):
            cells = rows[line - 1].split(",")
            cells[column] = value
            return rows[: line - 1] + [",".join(cells)] + rows[line:]

        refused([], "empty")
        refused([row.rsplit(",", 3)[0] for row in rows], "column \"group\" is missing")
        refused(changed(1, 3, "ux"), "unknown column \"ux\"")
        refused(changed(2000, 0, rows[1000].split(",")[0]), "line 2000: id")
        refused(changed(3000, 3, "nan"), "line 3000: v is not finite")
        refused(changed(17, 5, "melk"), "line 17: group \"melk\"")
        refused(changed(17, 1, "1e9"), "line 17: particle")
        refused(changed(17, 6, "-1"), "line 17: rho")
        refused(changed(17, 6, "1,2"), "line 17: has")

    def scene_from_file(self):
        lines, skip, start = [], False, False
        for line in (self.cases / "gas.toml").read_text().splitlines():
            if line.startswith("["):
                skip = line.startswith("[[start.region]]")
                start = line == "[start]"
            lattice = start and line.split(" ")[0] in ("lattice", "origin", "lower", "upper")
            if not skip and not lattice:
                lines.append(line)
        scene = self.run.folder / "from_file.toml"
        scene.write_text("\n".join(lines))
        return scene

    @staticmethod
    def csv_rows(snapshot):
        import h5py
        p = {name: data[...] for name, data in h5py.File(snapshot)["particles"].items()}
        names = ["melt", "cylinder", "spray", "wall"]
        rows = ["id,x,y,vx,vy,group,rho,m"]
        for k in range(len(p["id"])):
            values = [*p["position"][k], *p["velocity"][k]]
            rows.append(",".join([str(p["id"][k]), *(repr(float(v)) for v in values), names[p["group"][k]],
                                  repr(float(p["density"][k])), repr(float(p["gas_content"][k]))]))
        return rows

    # ---- stopped and resumed --------------------------------------------------------------------------------

    def stop_and_resume(self, out, ranks, stop, resume_ranks):
        process = self.start(ranks, out)
        wait_for(lambda: rows_in(self.run.folder / out / "series.csv") > self.random.randrange(20, LONG // 3))
        stop(process)
        result = self.run.finish(process)
        assert result.code == 75, f"exit {result.code}\n{result.err}"
        assert len(result.complaints) == 1 and "peperite resume" in result.complaints[0], result.err
        self.expect_reference(self.run.run(resume_ranks, "peperite", "resume", out), out)

    def test_signals(self):
        self.stop_and_resume("usr1", 3, lambda p: p.send_signal(signal.SIGUSR1), 2)
        self.stop_and_resume("one_rank", 2, lambda p: os.kill(runner.descendants(p.pid)[-1], signal.SIGUSR1), 1)
        self.stop_and_resume("term", 1, lambda p: p.send_signal(signal.SIGTERM), 3)
        self.stop_and_resume("term_twice", 2, terminate_twice, 1)
        self.stop_and_resume("file", 2, lambda p: (self.run.folder / "file" / "stop").touch(), 2)
        assert not (self.run.folder / "file" / "stop").exists()

    def test_checkpoint_signal(self):
        process = self.start(2, "usr2")
        wait_for(lambda: rows_in(self.run.folder / "usr2" / "series.csv") > 100)
        process.send_signal(signal.SIGUSR2)
        wait_for(lambda: list((self.run.folder / "usr2" / "checkpoint").glob("*/manifest.json")))
        result = self.run.finish(process)
        assert result.code == 0
        self.expect_reference(result, "usr2")

    def test_max_time(self):
        result = self.run.run(2, "buoyant_cylinder", "--steps", LONG, *BUSY, "--out", "time", "--max-time",
                              "0:0:0.4", code=75)
        stops = 0
        while result.code == 75 and stops < 50:  # longer each time, or a busy machine comes to no end
            result = self.run.finish(self.run.start(self.random.randint(1, 3), "peperite", "resume", "time",
                                                    "--max-time", f"0:{0.5 * 1.1**stops:.1f}"))
            stops += 1
        self.expect_reference(result, "time")
        again = self.run.run(2, "peperite", "resume", "time")
        assert again.fingerprint == self.reference[0], "a finished run has changed"

    def test_new_end(self):
        self.run.run(1, "buoyant_cylinder", "--steps", 250, *BUSY, "--out", "longer")
        self.expect_reference(self.run.run(3, "peperite", "resume", "longer", "--steps", LONG), "longer")

    def test_kills(self):
        self.kill_and_resume("kill", self.start, self.expect_reference)

    def test_grain_kills(self):
        """Contact histories, walls and stages outlive kills, wherever the cuts are."""
        self.kills_of_scene("grains_servo", GRAIN_STEPS, 0.02)

    def test_chamber_kills(self):
        """So does what a flow leaves to the steps that it serves, and its effort in the series."""
        self.kills_of_scene("chamber", CHAMBER_STEPS, 20)

    def kills_of_scene(self, name, steps, snapshot_interval):
        def start(ranks, out, *more):
            return self.run.start(ranks, "peperite", "run", self.scenes / f"{name}.toml", "--steps", steps, *CHAOS, "--set",
                                  f"output.snapshot_interval={snapshot_interval}", "--out", out, *more)

        whole = self.run.finish(start(1, name))
        reference = whole.fingerprint, self.run.files(name)
        self.kill_and_resume(f"{name}_kill", start,
                             lambda result, out: self.expect(result, out, name, reference, steps))

    def kill_and_resume(self, name, start, expect):
        kills = runs = 0
        while kills < self.kills:
            out = f"{name}{runs}"  # a run may end before it is killed
            runs += 1
            process = start(self.random.randint(1, 3), out, *OFTEN)
            wait_for(lambda: (self.run.folder / out / "scene.toml").exists() or process.poll() is not None)
            result = None
            while result is None:
                try:
                    code = process.wait(timeout=self.random.uniform(0.05, 1.2))
                    result = self.run.finish(process)
                    assert code == 0, f"exit {code}\n{result.err}"
                except subprocess.TimeoutExpired:
                    if kills < self.kills:
                        kill_somehow(process, self.random)
                        kills += 1
                        self.run.finish(process)
                        process = self.run.start(self.random.randint(1, 3), "peperite", "resume", out)
            expect(result, out)

    # ---- damage ---------------------------------------------------------------------------------------------

    def test_damaged_checkpoints(self):
        for ranks in (1, 3):
            out = f"damaged{ranks}"
            process = self.start(ranks, out, *OFTEN)
            found = lambda: sorted((self.run.folder / out / "checkpoint").glob("*/manifest.json"))
            wait_for(lambda: len(found()) >= 2)
            process.send_signal(signal.SIGUSR1)
            assert self.run.finish(process).code == 75
            newest, older = [m.parent for m in reversed(found())][:2]
            kept = {f: f.read_bytes() for f in newest.iterdir()}
            what = damage(newest, self.random) + ", " + damage(older, self.random)
            result = self.run.refused(ranks, "peperite", "resume", out, says="no checkpoint can be used")
            assert newest.name in result.complaints[0] and older.name in result.complaints[0], what
            for file, content in kept.items():
                file.write_bytes(content)
            self.run.run(ranks, "peperite", "resume", out)

            out = f"fallback{ranks}"
            process = self.start(ranks, out, *OFTEN)
            wait_for(lambda: len(found()) >= 2)
            process.send_signal(signal.SIGUSR1)
            assert self.run.finish(process).code == 75
            newest = found()[-1].parent
            what = damage(newest, self.random)
            result = self.run.run(ranks, "peperite", "resume", out)
            assert len(result.complaints) == 1 and newest.name in result.complaints[0], (what, result.err)
            self.expect_reference(result, out)

    def test_unwritable(self):
        file = self.run.folder / "a_file"
        file.touch()
        for ranks in (1, 3):
            for out in (file, file / "below", "/proc/peperite"):
                self.run.refused(ranks, "buoyant_cylinder", "--steps", 3, "--out", out, says=str(out))

    def test_full_disk(self):
        """A limit on file sizes, and where mounting is allowed a small file system."""
        def limit(process):  # once MPI has made its own files
            wait_for(lambda: list((self.run.folder / "full" / "checkpoint").glob("*/manifest.json")))
            resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (100_000, resource.RLIM_INFINITY))

        self.fill(1, "full", limit, lambda: None)
        disk = self.run.folder / "disk"
        disk.mkdir()
        mount = ["mount", "-t", "tmpfs", "-o", "size=1500k", "tmpfs", disk]
        if subprocess.run(mount, stderr=subprocess.DEVNULL).returncode != 0:
            print("  (no small file system: mounting is not allowed here)")
            return
        try:
            grow = ["mount", "-o", "remount,size=100m", disk]
            self.fill(2, "disk/full", lambda process: None, lambda: subprocess.run(grow, check=True))
        finally:
            subprocess.run(["umount", disk], check=True)

    def fill(self, ranks, out, less_space, more_space):
        process = self.start(ranks, out, *OFTEN)
        less_space(process)
        result = self.run.finish(process)
        assert result.code == 4, f"exit {result.code}\n{result.err}"
        assert len(result.complaints) == 1, result.err
        assert list((self.run.folder / out / "checkpoint").glob("*/manifest.json"))
        more_space()
        self.expect_reference(self.run.run(2, "peperite", "resume", out), out)

    # ---- bad input ------------------------------------------------------------------------------------------

    def test_bad_input(self):
        scenes = sorted(self.bad_scenes.glob("*.toml"))
        for ranks, some in ((1, 12), (4, 6)):
            for scene in self.random.sample(scenes, min(some, len(scenes))):
                begin = time.monotonic()
                self.run.refused(ranks, "peperite", "run", scene, "--out", "bad", says=":")
                assert time.monotonic() - begin < 40, f"{scene} takes too long"
        for ranks in (1, 4):
            self.run.refused(ranks, "buoyant_cylinder", "missing.toml", says="missing.toml")
            self.run.refused(ranks, "buoyant_cylinder", "--no-such-option", says="--no-such-option")
            self.run.refused(ranks, "peperite", "resume", "nowhere", says="nowhere")
            self.run.refused(ranks, "buoyant_cylinder", "--max-time", "soon", says="soon")
            self.run.refused(ranks, "buoyant_cylinder", "--steps", "3", "--until", "1", says="--until")
            self.run.refused(ranks, "peperite", "check", self.cases / "fluid.toml", "--set", "time.dt=1", says="time.dt")
        assert not (self.run.folder / "bad").exists()

    def test_too_many_ranks(self):
        small = ["--set", "decomposition.skin=2", "--set", "domain.lower=[-1, -1]", "--set", "domain.upper=[49, 65]",
                 "--set", "kernel.h_over_dx=2"]
        self.run.refused(9, "buoyant_cylinder", *small, "--steps", 1, says="at most 6 ranks")

    def test_guard(self):
        """A particle that leaves the domain is seen by its owner alone; the others must not wait for ever."""
        for ranks in (1, 3):
            out = f"guard{ranks}"
            result = self.run.run(ranks, "buoyant_cylinder", "--set", "start.velocity=[0, 5000]", "--steps", 100,
                                  "--out", out, code=3)
            assert len(result.complaints) == 1 and "is outside the domain" in result.complaints[0], result.err
            kept = list((self.run.folder / out / "crash").iterdir())
            assert len(kept) == 1 and kept[0].name in result.complaints[0], result.err
            self.run.run(1, "peperite", "info", kept[0])

    def test_grain_guards(self):
        for ranks in (1, 3):
            out = f"overlap{ranks}"
            result = self.run.run(ranks, "peperite", "run", self.grain_scene, "--set", "start.velocity=[0, 0, -20]",
                                  "--steps", 5000, "--out", out, code=3)
            assert len(result.complaints) == 1 and "contact.largest_overlap" in result.complaints[0], result.err
            for command in (["check"], ["run", "--out", "bad_step"]):
                self.run.refused(ranks, "peperite", command[0], self.grain_scene, *command[1:], "--set", "time.dt=1 ms",
                                 says="above the limit of a stable contact")

    def test_used_directory(self):
        self.run.run(1, "buoyant_cylinder", "--steps", 3, "--out", "used")
        before = self.run.files("used")
        for ranks in (1, 3):
            self.run.refused(ranks, "buoyant_cylinder", "--steps", 5, "--out", "used", says="--out")
        assert self.run.files("used") == before

    def test_scale_sim(self):
        """The simulator's halos are those of real runs, and it predicts from a run's costs."""
        for n in (1, 3, 6):
            self.run.run(n, "peperite", "run", self.grain_scene, "--steps", 3000, "--out", f"scaling{n}",
                         "--set", "decomposition.balance=fixed")
        out = self.run.run(1, "scale_sim", "check", "scaling1", "scaling3", "scaling6").out
        _, one, three, six = (line.split() for line in out.splitlines()[1:])
        assert float(one[1]) == 0, out
        for row in (three, six):  # the measured ones are the mean over a run in which grains move
            assert abs(float(row[1]) / float(row[2]) - 1) < 0.1, out
        out = self.run.run(1, "scale_sim", "scaling", "scaling1", "--ranks", 10, 100).out
        assert out.count("bytes for each rank of the run") == 6, out

    def test_tool(self):
        for program in (["peperite"], ["peperite", "run"], ["buoyant_cylinder"]):
            text = self.run.run(1, *program, "--help").out
            assert len(text.splitlines()) < 40, text
        assert "compiler" in self.run.run(2, "peperite", "--version").out
        self.run.run(2, "buoyant_cylinder", "--steps", 2, "--out", "tool")
        self.run.run(2, "buoyant_cylinder", "--steps", 2, "--out", "other", "--set", "group.melt.viscosity=400")
        here, there = (f"{out}/snapshot_000000002.h5" for out in ("tool", "other"))
        assert "3095 particles" in self.run.run(1, "peperite", "info", here).out
        difference = self.run.run(1, "peperite", "diff", here, there, code=1).out
        assert "particle" in difference, difference
        self.run.run(1, "peperite", "diff", here, "tool")
        assert "3095" in self.run.run(3, "peperite", "check", self.cases / "gas.toml").out


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--source", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    print(f"seed {arguments.seed}")
    run = Runner(arguments.programs, arguments.mpirun)
    cases = Cases(run, Path(arguments.source).resolve(), arguments.kills, arguments.seed)
    sys.exit(run_all(cases, arguments.names))


if __name__ == "__main__":
    main()
