#!/usr/bin/python3
"""plot.py draws what a short run leaves, and refuses everything else with one line and exit code 2.

    test_plot.py --programs build/bin --source .
"""
import argparse
import contextlib
import importlib
import io
import shutil
import subprocess
import sys
import unittest
import unittest.mock
from pathlib import Path

import numpy as np
from PIL import Image

from runner import Runner

STEPS = 40
OPTIONS = ["--steps", STEPS, "--set", "output.snapshot_interval=0.002", "--set", "output.series_interval=0",
           "--set", "output.average_time=0.001"]
ALL = {"particles.png", "pressure.png", "strip.png", "series.png"}


class Plot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_of = Runner(Path(given.programs).resolve(), given.mpirun)
        cls.folder = cls.run_of.folder
        cases = Path(given.source).resolve() / "apps" / "buoyant_cylinder"
        sys.path.insert(0, str(cases))
        cls.script = importlib.import_module("plot")
        cls.refusing = importlib.import_module("run_folder").refusing
        for case in ("solid", "gas"):
            cls.run_of.run(2, "buoyant_cylinder", cases / f"{case}.toml", *OPTIONS, "--out", case)

    @classmethod
    def tearDownClass(cls):
        cls.run_of.close()

    def plot(self, *arguments):
        """Exit code, stdout and stderr, without the second that it takes to start the script."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), contextlib.chdir(self.folder), \
                unittest.mock.patch("sys.argv", ["plot.py", *map(str, arguments)]):
            code = type(self).refusing(self.script.draw)
        return code, out.getvalue(), err.getvalue()

    def drawn(self, *arguments):
        """Paths of the pictures, each of them looked at."""
        code, out, err = self.plot(*arguments)
        self.assertEqual((code, err), (0, ""))
        paths = [Path(line) for line in out.splitlines()]
        for path in paths:
            self.look_at(self.folder / path)
        return paths

    def look_at(self, path):
        self.assertLess(path.stat().st_size, 400_000, path)
        pixels = np.asarray(Image.open(path).convert("RGB"))
        self.assertGreater(min(pixels.shape[:2]), 300, path)
        colours, count = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
        self.assertGreater(np.sum(count > 50), 8, f"{path}: hardly a colour")
        ink = np.mean(np.any(pixels < 250, axis=2))
        self.assertTrue(0.02 < ink < 0.9, f"{path}: {ink:.2f} of it is drawn on")

    def refused(self, *arguments, says):
        code, out, err = self.plot(*arguments)
        self.assertEqual((code, out), (2, ""), err)
        self.assertEqual(len(err.splitlines()), 1, err)
        self.assertIn(says, err)

    def test_from_the_shell(self):
        def start(*arguments):
            return subprocess.run(["/usr/bin/python3", "-B", self.script.__file__, *arguments], cwd=self.folder,
                                  capture_output=True, text=True)
        done = start("gas", "--draw", "series")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "gas/series.png\n", ""))
        done = start("nowhere")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", "plot.py: nowhere: no such folder\n"))

    def test_all_pictures_of_a_run(self):
        self.assertEqual({p.name for p in self.drawn("solid")}, ALL)
        self.assertTrue(all((self.folder / "solid" / name).is_file() for name in ALL))

    def test_several_runs_on_one_sheet(self):
        names = {p.name for p in self.drawn("solid", "gas", "--out", "both", "--draw", "pressure,series")}
        self.assertEqual(names, {"solid_pressure.png", "gas_pressure.png", "series.png"})

    def test_time_and_averages_change_the_picture(self):
        pictures = set()
        for more in ([], ["--time", 0.004], ["--average", "time"], ["--dynamic"]):
            (path,) = self.drawn("gas", "--draw", "particles", "--out", "gas_one", *more)
            pictures.add((self.folder / path).read_bytes())
        self.assertEqual(len(pictures), 4)

    def test_bad_input(self):
        self.refused("nowhere", says="nowhere")
        self.refused("solid", "--time", "soon", says="--time")
        self.refused("solid", "--time", "nan", says="--time")
        self.refused("solid", "--draw", "particles,stars", says="stars")
        self.refused("solid", "--average", "space", says="average_space")
        self.refused(says="DIR")
        (self.folder / "none").mkdir()
        self.refused("none", says="no snapshot")
        self.refused("solid", "--out", "solid/series.csv", says="series.csv")

    def test_broken_files(self):
        last = f"snapshot_{STEPS:09}.h5"
        for name, content in ((last, b""), (last, None), ("series.csv", b""), ("series.csv", b"t,centre_y\nx\n"),
                              ("series.csv", b"t,centre_y\n1,2,3\n")):
            shutil.copytree(self.folder / "solid", self.folder / "broken", dirs_exist_ok=True)
            path = self.folder / "broken" / name
            path.write_bytes(path.read_bytes()[: path.stat().st_size // 2] if content is None else content)
            self.refused("broken", "--draw", "series", says=name)
        (self.folder / "broken" / "series.csv").unlink()
        self.refused("broken", "--draw", "series", says="series.csv")


class Sandbox(unittest.TestCase):
    """apps/sandbox/plot.py, on a box a quarter as long with a block of sand half as high, pushed fast."""

    SMALL = ["domain.upper=[0.1, 0.0076, 0.12]", "start.spacing=0.0019", "start.upper=[0.0988, 0.0076, 0.0285]",
             "wall.front.point=[0.099, 0, 0]", "stage.shorten.begin=0.08",
             "stage.shorten.wall.back.velocity=[0.2, 0, 0]", "output.snapshot_interval=0.02"]

    @classmethod
    def setUpClass(cls):
        cls.run_of = Runner(Path(given.programs).resolve(), given.mpirun)
        cls.folder = cls.run_of.folder
        cls.cases = Path(given.source).resolve() / "apps" / "sandbox"
        small = [word for value in cls.SMALL for word in ("--set", value)]
        cls.run_of.run(1, "sandbox", *small, "--until", 0.16, "--out", "small")
        cls.run_of.run(1, "sandbox", cls.cases / "shear_floor.toml", "--until", 0.06, "--set", "stage.lower.begin=0.02",
                       "--set", "stage.press.begin=0.03", "--set", "stage.shear.begin=0.04", "--out", "box")

    @classmethod
    def tearDownClass(cls):
        cls.run_of.close()

    def plot(self, *arguments):
        return subprocess.run(["/usr/bin/python3", "-B", self.cases / "plot.py", *arguments], cwd=self.folder,
                              capture_output=True, text=True)

    def test_pictures_and_summary(self):
        done = self.plot("small", "--out", "drawn")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        names = ["layers", "strain", "chains", "stress", "history"]
        self.assertEqual(done.stdout.splitlines()[:5], [f"drawn/{name}.png" for name in names])
        for name in names:
            path = self.folder / "drawn" / f"{name}.png"
            self.assertLess(path.stat().st_size, 400_000, path)
            pixels = np.asarray(Image.open(path).convert("RGB"))
            ink = np.mean(np.any(pixels < 250, axis=2))
            self.assertTrue(0.01 < ink < 0.9, f"{path}: {ink:.2f} of it is drawn on")
        summary = (self.folder / "drawn" / "summary.txt").read_text()
        self.assertIn("shortening 1.60 cm of a layer", summary)
        self.assertIn("coordination", summary)
        self.assertIn("critical taper", summary)

    def test_shear_box(self):
        done = self.plot("box")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("floor: friction angle", done.stdout)

    def test_bad_input(self):
        (self.folder / "none").mkdir()
        for arguments, says in ((["nowhere"], "nowhere"), (["none"], "no snapshot"), (["small", "small"], "more than one"),
                                (["small", "--draw", "stars"], "stars")):
            done = self.plot(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(says, done.stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--source", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    given, names = parser.parse_known_args()
    unittest.main(argv=sys.argv[:1] + names)
