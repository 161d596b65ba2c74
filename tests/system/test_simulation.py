#!/usr/bin/python3
"""peperite.Simulation: a scene stepped from Python has the bits that it has from the command line, on 1, 2 and 3 ranks.

    test_simulation.py --programs build/bin --module build/python --source .
"""
import json
import textwrap

import numpy as np

from python_case import PythonCase
from runner import given, main

SCENES = ("tests/scenes/open2d.toml", "tests/scenes/grains_in_melt.toml", "tests/scenes/bodies3d.toml", "tests/scenes/chamber.toml")
STEPS = 30
# One launch for all scenes: what a scene is in the end, as a line of JSON.
SCRIPT = """
import json, sys
import numpy as np
import peperite
from mpi4py import MPI
for scene in sys.argv[2:]:
    s = peperite.Simulation(scene, set={"output.snapshot_interval": 0, "output.series_interval": 0})
    seen = []
    s.run(steps=%d, each=lambda s: seen.append(s.steps))
    assert seen == list(range(1, %d + 1)), seen
    name = scene.rsplit("/", 1)[-1][:-5]
    s.save(f"{sys.argv[1]}/{name}_{s.comm.size}.h5")
    particles = {name: s.gather(name) for name in ("id", "position", "velocity", *(["stress"] if "stress" in s.fields else []))}
    last = {"name": name, "fingerprint": s.fingerprint(), "step": s.steps, "time": s.time, "monitors": s.monitors()}
    last["units"] = {name: s.unit(name) for name in last["monitors"]}
    if s.rank == 0:
        np.savez(f"{sys.argv[1]}/{name}_{s.comm.size}", **particles)
        print(json.dumps(last), flush=True)
""" % (STEPS, STEPS)


class Simulation(PythonCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "script.py").write_text(SCRIPT)

    def test_the_bits_are_those_of_the_command_line(self):
        import peperite
        scenes = [self.source / scene for scene in SCENES]
        lines = {}
        for ranks in (1, 2, 3):
            for line in self.python(ranks, "script.py", self.folder, *scenes).out.splitlines():
                last = json.loads(line)
                lines.setdefault(last["name"], []).append(last)
        for scene in scenes:
            run = self.run_of.run(2, "peperite", "run", scene, "--steps", STEPS, "--out", scene.stem, "--set",
                                  "output.snapshot_interval=0", "--set", "output.series_interval=0")
            self.assertEqual(len(lines[scene.stem]), 3)
            recorded = peperite.open(self.folder / scene.stem)
            for ranks, last in enumerate(lines[scene.stem], 1):
                self.assertEqual(run.fingerprint.split()[1], last["fingerprint"], f"{scene.stem} on {ranks} ranks")
                self.assertEqual((last["step"], last["time"]), (STEPS, recorded[-1].time))
                self.assertEqual({name: recorded.series[name][-1] for name in last["monitors"]}, last["monitors"])
                self.assertEqual({name: recorded.series.unit(name) for name in last["monitors"]}, last["units"])
                saved = self.folder / f"{scene.stem}_{ranks}.h5"
                self.run_of.run(1, "peperite", "diff", saved, recorded.files[-1])
                there = recorded[-1]
                with np.load(saved.with_suffix(".npz")) as gathered:
                    for name in gathered.files:
                        self.assertTrue(np.array_equal(gathered[name], there[name]), f"{name} of {scene.stem} on {ranks} ranks")

    def test_a_dictionary_is_a_scene(self):
        import tomllib
        import peperite
        path = self.source / "tests/scenes/box3d_fluid.toml"
        scene = tomllib.loads(path.read_text())
        a, b = peperite.Simulation(path), peperite.Simulation(scene)
        for s in (a, b):
            s.step(3)
        self.assertEqual(a.fingerprint(), b.fingerprint())
        scene["start"]["spacing"] = np.float64(scene["start"]["spacing"])
        scene["domain"]["lower"] = np.array(scene["domain"]["lower"], dtype=float)
        c = peperite.Simulation(scene, set=["time.steps=2"])
        c.run()
        self.assertEqual(c.steps, 2)
        self.assertEqual(c.field("velocity").shape, (len(c.field("id")), 3))
        self.assertEqual(c.field("mass").ndim, 1)

    def test_arrays_are_copies(self):
        import peperite
        s = peperite.Simulation(self.source / "tests/scenes/box3d_fluid.toml")
        before = s.fingerprint()
        s.field("velocity")[:] = 1e9
        self.assertEqual(s.fingerprint(), before)
        kept = s.field("position")
        again = kept.copy()
        s.step(5)
        self.assertTrue(np.array_equal(kept, again))

    def test_what_is_wrong_is_an_exception(self):
        import peperite
        path = self.source / "tests/scenes/box3d_fluid.toml"
        for says, scene, settings in (("time.cfl", path, {"time.cfl": -1}), ("nowhere.toml", "nowhere.toml", {}),
                                      ("kernell", {"dimension": 2, "kernell": {}}, {}), ("complex", {"dimension": 2j}, {}), ("set: not", path, "time.steps=2"), ("set: not", path, [1]),
                                      ("no rock in it, ?", {"dimension": 2, "no rock in it, \x7f": 1}, {})):
            with self.assertRaises(peperite.InputError) as caught:
                peperite.Simulation(scene, set=settings)
            self.assertIn(says, str(caught.exception))
            self.assertEqual(len(str(caught.exception).splitlines()), 1)
        from mpi4py import MPI
        for comm in (MPI.COMM_NULL, MPI.GROUP_NULL, 3):
            with self.assertRaises(peperite.InputError):
                peperite.Simulation(path, comm=comm)
        s = peperite.Simulation(path)
        for wrong in (lambda: s.field("void"), lambda: s.step(-1), lambda: s.run(until=float("nan")), lambda: s.run(steps=-1),
                      lambda: s.save("a\0b")):
            with self.assertRaises(peperite.InputError):
                wrong()
        with self.assertRaises(peperite.OutputError) as caught:
            s.save(self.folder / "nowhere/snapshot.h5")
        fast = peperite.Simulation(path, set={"start.velocity": [0, 0, 60]})
        with self.assertRaises(peperite.GuardError) as caught:
            fast.step(2000)
        self.assertIn("step", str(caught.exception))
        for work in (lambda: fast.step(), fast.fingerprint, fast.monitors, lambda: fast.save(self.folder / "half.h5")):
            with self.assertRaises(peperite.GuardError) as caught:
                work()
            self.assertIn("in the middle of a step", str(caught.exception))
        self.assertFalse((self.folder / "half.h5").exists())

    def test_nothing_is_overwritten(self):
        import peperite
        path = self.source / "tests/scenes/box3d_fluid.toml"
        s = peperite.Simulation(path)
        saved, letter, record = (self.folder / name for name in ("saved.h5", "letter.txt", "record.txt"))
        s.save(saved)
        before = saved.read_bytes()
        s.step()
        letter.write_text("dear reader")
        (self.folder / "link.h5").symlink_to(saved)
        for place, overwrite in ((saved, False), (letter, True), (self.folder, True), (self.folder / "link.h5", True)):
            with self.assertRaises(peperite.OutputError) as caught:
                s.save(place, overwrite)
            self.assertIn(f"{place} exists", str(caught.exception))
        self.assertEqual((saved.read_bytes(), letter.read_text()), (before, "dear reader"))
        s.save(saved, overwrite=True)
        self.assertNotEqual(saved.read_bytes(), before)
        part = self.folder / "saved.h5.tmp"
        part.write_text("of another program")
        with self.assertRaises(peperite.OutputError) as caught:
            s.save(saved, overwrite=True)
        self.assertIn(f"{part} exists", str(caught.exception))
        self.assertEqual(part.read_text(), "of another program")
        torn = self.folder / "torn.h5"
        torn.write_bytes(before[:4000])
        with self.assertRaises(peperite.OutputError) as caught:
            s.save(torn, overwrite=True)
        self.assertIn("torn.h5 exists", str(caught.exception))
        record.write_text("cuts of another run")
        with self.assertRaises(peperite.InputError) as caught:
            peperite.Simulation(path, set={"decomposition.record": str(record)})
        self.assertIn("record.txt exists", str(caught.exception))
        self.assertEqual(record.read_text(), "cuts of another run")

    def test_an_exception_on_one_rank_ends_all(self):
        (self.folder / "alone.py").write_text(textwrap.dedent("""
            import sys, peperite
            s = peperite.Simulation(sys.argv[1])
            if s.rank == 1:
                s.field("void")
            s.step(1000000)
        """))
        done = self.run_of.finish(self.run_of.start_command([given.mpirun, "-n", 2, "/usr/bin/python3", "-B", "-m", "mpi4py", "alone.py",
                                                             self.source / "tests/scenes/box3d_fluid.toml"]), timeout=60)
        self.assertNotEqual(done.code, 0)
        self.assertIn("no field \"void\"", done.err)


if __name__ == "__main__":
    main("module")
