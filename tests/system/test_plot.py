#!/usr/bin/python3
"""plot.py draws what a short run leaves, and refuses everything else with one line and exit code 2.

    test_plot.py --programs build/bin --source .
"""
import contextlib
import importlib
import io
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
from PIL import Image

from runner import Case, main

STEPS = 40
OPTIONS = ["--steps", STEPS, "--set", "output.snapshot_interval=0.002", "--set", "output.series_interval=0",
           "--set", "output.average_time=0.001"]
ALL = {"particles.png", "pressure.png", "strip.png", "series.png"}


class Plot(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cases = cls.source / "apps" / "buoyant_cylinder"
        cls.program = cases.parent / "plot.py"
        sys.path.insert(0, str(cases.parent / "python"))
        cls.drawing, cls.script, cls.command = (importlib.import_module(name) for name in (
            "peperite.drawing", "peperite.drawing.flat", "peperite.drawing.command"))
        for case in ("solid", "gas"):
            cls.run_of.run(2, "buoyant_cylinder", cases / f"{case}.toml", *OPTIONS, "--out", case)
        scenes = cls.source / "benchmarks/accuracy"
        cls.run_of.run(2, "peperite", "run", scenes / "hydrostatic.toml", "--steps", 10, "--out", "tank")
        cls.run_of.run(1, "peperite", "run", scenes / "magma_column.toml", "--steps", 1, "--out", "foam")

    def plot(self, *arguments):
        """Exit code, stdout and stderr, without the second that it takes to start the script."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), contextlib.chdir(self.folder):
            code = self.command.refusing(lambda: self.command.show(self.drawing.draw(self.drawing.parser().parse_args([*map(str, arguments)]))))
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
            return subprocess.run(["/usr/bin/python3", "-B", self.program, *arguments], cwd=self.folder,
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
        for name, folder in (("solid", "a"), ("gas", "b")):
            shutil.copytree(self.folder / name, self.folder / folder / "run")
        names = [p.name for p in self.drawn("a/run", "b/run", "--out", "both", "--draw", "pressure")]
        self.assertEqual(names, ["run_pressure.png", "run_2_pressure.png"])
        shutil.copytree(self.folder / "solid", self.folder / "c/run_2")
        names = [p.name for p in self.drawn("a/run", "b/run", "c/run_2", "--out", "three", "--draw", "pressure")]
        self.assertEqual(names, ["run_pressure.png", "run_3_pressure.png", "run_2_pressure.png"])

    def test_time_and_averages_change_the_picture(self):
        pictures = set()
        for words in (["gas"], ["gas", "--time", 0.004], ["--average=time", "gas"], ["gas", "--dynamic"]):
            (path,) = self.drawn("--draw", "particles", "--out", "gas_one", *words)
            pictures.add((self.folder / path).read_bytes())
        self.assertEqual(len(pictures), 4)

    def test_pressure_less_hydrostatic_at_the_start(self):
        for case, (density, depth) in {"solid": (2500, 62.5), "gas": (2500, 62.5)}.items():
            run = self.script.Run(self.folder / case)
            first = run[0]
            self.assertEqual(first.step, 0)
            (_, pressure, limits, _, label), (_, excess, *_) = self.script.pressure_maps(run, first)
            self.assertIn("(MPa)", label)
            movers = ~first.where(kind="wall")
            deep = depth - first.position[movers, 1]
            # p + p_0 = K (exp(rho_0 g d / K) - 1) + p_0 exp(rho_0 g d / K), Ida's atmosphere included.
            growth = np.expm1(density * 9.8 * deep / 1e10)
            at_rest = (1e10 + 1e5) * growth
            melt = first.group[movers] == 0
            self.assertLess(np.abs(pressure[movers] * 1e6 - at_rest)[melt].max(), 0.05, case)
            self.assertLess(np.abs(run.at_rest(first)[movers] - at_rest).max(), 0.05, case)
            self.assertLess(np.abs(first.pressure - run.at_rest(first))[movers].max(), 0.05, case)
            self.assertAlmostEqual(limits[1], 2500 * 9.8 * 60.5 / 1e6, delta=0.02)
            greater, smaller, _ = first.principal_stresses(run.at_rest(first))
            self.assertLess(max(np.abs(greater[movers]).max(), np.abs(smaller[movers]).max()), 0.05, case)

    def test_layers_at_rest(self):
        at_rest = importlib.import_module("peperite.drawing.at_rest")
        light = {"name": "light", "kind": "fluid", "density": 1000, "bulk_modulus": 1e10}
        heavy = {"name": "heavy", "kind": "fluid", "density": 2000, "bulk_modulus": 1e10}
        foam = {"name": "foam", "kind": "fluid", "eos": "bubbly", "density": 2500, "bulk_modulus": 1e10,
                "gas_content": 0.03, "gas_rt": 5e5, "solubility_pressure": 1e11, "solubility_exponent": 0.5}
        domain = {"gravity": [0, 0, -10.0], "surface_pressure": 1e5}
        depth = np.linspace(0, 5, 201)
        places = np.stack([0 * depth, 0 * depth, 7 - depth], axis=1)
        scene = {"domain": domain, "group": [heavy, light, foam], "start": {
            "layer": [{"group": "light", "top": 7.0}, {"group": "heavy", "top": 5.0}]}}
        wanted = np.where(depth < 2, 1e4 * depth, 2e4 + 2e4 * (depth - 2))
        self.assertLess(np.abs(at_rest.pressure_at_rest(scene, places, 0) / np.maximum(wanted, 1) - 1)[1:].max(), 5e-5)
        around = {**scene, "domain": {**domain, "background_density": 1500}}
        wanted = np.where(depth < 2, -5e3 * depth, -1e4 + 5e3 * (depth - 2))
        self.assertLess(np.abs(at_rest.pressure_at_rest(around, places, 0) - wanted).max(), 1)
        scene["start"] = {"layer": [{"group": "foam", "top": 7.0}]}
        p = at_rest.pressure_at_rest(scene, places, 0)
        slope = (p[2:] - p[:-2]) / (depth[2:] - depth[:-2])
        # Of the mixture at 1 bar and below: 1 / rho = (1 - xi) / rho_l + xi R T / p.
        absolute = p[1:-1] + 1e5
        free = (0.03 - np.sqrt(absolute / 1e11)) / 1.03
        density = 1 / ((1 - free) / (2500 * (1 + absolute / 1e10)) + free * 5e5 / absolute)
        self.assertLess(density.max(), 100)  # it is a foam
        self.assertLess(np.abs(slope / (10 * density) - 1).max(), 1e-3)
        self.assertIsNone(at_rest.pressure_at_rest({**scene, "domain": {}}, places, 0))
        run = self.script.Run(self.folder / "foam")  # which the program starts at rest by an integration of its own
        first = run[0]
        excess = (first.pressure - run.at_rest(first))[~first.where(kind="wall")]
        self.assertLess(np.abs(excess).max(), 1e-3 * 1000 * 9.8)

    def test_units_fit_the_numbers(self):
        figures = importlib.import_module("peperite.drawing.style")
        for value, name, wanted in ((2.3e9, "Pa", "2.3 GPa"), (1e6, "Pa", "1 MPa"), (999, "Pa", "999 Pa"),
                                    (0.02, "Pa", "20 mPa"), (1500, "m", "1500 m"), (0.0035, "s", "3.5 ms"), (0, "Pa", "0 Pa")):
            self.assertEqual(figures.text_with_unit(value, name), wanted)
        run = self.script.Run(self.folder / "tank")
        (_, pressure, limits, _, label), _ = self.script.pressure_maps(run, run[0])
        self.assertIn("(kPa)", label)
        highest = pressure[~run[0].where(kind="wall")].max()
        self.assertTrue(9.5 < highest < 9.8 and 9.5 < limits[1] < 9.8, (highest, limits))

    def test_colours_are_those_of_the_scale_beside_them(self):
        style = importlib.import_module("peperite.drawing.style")
        for colours in ("viridis", "RdBu_r", "YlGnBu"):
            figure, axes = style.plt.subplots()
            axes.imshow(np.linspace(0, 1, 256)[None], cmap=colours)
            levels = (255 * style.plt.get_cmap(colours)(np.arange(256))[:, :3]).round().astype(np.uint8)
            # Each of them rare among much else, as in a picture of discs.
            noise = np.random.default_rng(5).integers(0, 256, (400, 256, 3)).astype(np.uint8)
            few = np.asarray(style.to_palette(np.concatenate([levels[None], noise]), style.exact_colours(figure)).convert("RGB"))
            style.plt.close(figure)
            self.assertLess(np.abs(few[0].astype(int) - levels).max(), 12, colours)

    def test_all_particles_are_in_the_picture(self):
        self.run_of.run(1, "peperite", "run", self.source / "tests/scenes/slope2d.toml", "--steps", 1, "--out", "slope")
        run = self.script.Run(self.folder / "slope")
        (low, high), position = self.script.view_of(run, [run[0]]), run[0]["position"]
        self.assertTrue(np.all((low < position) & (position < high)))

    def test_a_run_whose_particles_have_left(self):
        shutil.copytree(self.folder / "solid", self.folder / "left")
        with h5py.File(max((self.folder / "left").glob("snapshot_*.h5")), "r+") as file:
            for name, rows in [*file["particles"].items()]:
                kept, about = rows[()][:0], dict(rows.attrs)
                del file["particles"][name]
                file["particles"][name] = kept
                file["particles"][name].attrs.update(about)
        code, out, err = self.plot("left", "--draw", "particles,pressure", "--out", "of_left")
        self.assertEqual((code, out), (0, "of_left/particles.png\nof_left/pressure.png\n"), err)

    def test_a_scene_that_follows_no_particle(self):
        code, out, err = self.plot("tank")
        self.assertEqual((code, out), (0, "tank/particles.png\ntank/pressure.png\n"))
        self.assertEqual(err.splitlines(), [err.strip()])
        self.assertIn("no series.png: the scene of tank follows no particle", err)
        self.refused("tank", "--draw", "series", says="follows no particle")

    def test_series_are_those_of_the_file(self):
        run = self.script.Run(self.folder / "solid")
        table, tracked = self.script.series_of(run)
        self.assertEqual(sorted(tracked), ["p", "rho", "vy", "y"])
        self.assertEqual(tracked["y"][0], 16)
        self.assertAlmostEqual(tracked["p"][0] / 1e6, 2500 * 9.8 * 46.5 / 1e6, delta=0.01)
        axes = self.script.draw_series([run]).axes
        drawn = axes[3].lines[0].get_xydata()
        self.assertIn("(MPa)", axes[3].get_ylabel())
        self.assertTrue(np.array_equal(drawn[:, 0], table["t"]) and np.allclose(drawn[:, 1] * 1e6, tracked["p"]))

    def test_bad_input(self):
        self.refused("nowhere", says="nowhere")
        self.refused("solid", "--time", "soon", says="--time")
        self.refused("solid", "--time", "nan", says="--time")
        self.refused("solid", "--draw", "particles,stars", says="stars")
        self.refused("solid", "--average", "space", says="average_space")
        self.refused("solid", "--out", "", says="--out")
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


class ThreeDimensions(Case):
    """apps/plot.py finds what draws it."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.apps = cls.source / "apps"
        sys.path.append(str(cls.apps / "python"))
        cls.script = importlib.import_module("peperite.drawing.solid")
        scenes = cls.source / "tests/scenes"
        for run, scene, interval in (("fluid", "box3d_fluid", 0.02), ("grains", "grains_pour", 0.0005)):
            cls.run_of.run(2, "peperite", "run", scenes / f"{scene}.toml", "--steps", 100, "--set",
                           f"output.snapshot_interval={interval}", "--out", run)

    def plot(self, *arguments):
        return subprocess.run(["/usr/bin/python3", "-B", self.apps / "plot.py", *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True)

    def test_pictures(self):
        for run, name in (("fluid", "slice"), ("grains", "side")):
            done = self.plot(run)
            self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", f"{run}/{name}.png\n"))
            Plot.look_at(self, self.folder / run / f"{name}.png")
        done = self.plot("fluid", "--time", 0.02, "--out", "fluid")
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", "fluid/slice.png\n"))
        for arguments, says in ((["nowhere"], "nowhere"), (["fluid", "grains"], "both"), ([], "DIR"),
                                (["fluid", "--draw", "side"], "slice"), (["fluid", "--time", "soon"], "--time")):
            done = self.plot(*arguments)
            if says == "both":
                self.assertEqual(done.stdout, "fluid/fluid_slice.png\nfluid/grains_side.png\n", done.stderr)
                continue
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(says, done.stderr)

    def test_slice_of_a_fluid(self):
        run = self.script.Run(self.folder / "fluid")
        view = self.script.View(run[0])
        self.assertEqual((view.along, view.depth, view.up), (0, 1, 2))
        for snapshot in run:
            rows, place, diameter, columns = self.script.sliced(run, snapshot, view)
            position, velocity = snapshot["position"], snapshot["velocity"]
            inside = np.flatnonzero(np.abs(position[:, 1] - view.middle) < run.spacing)
            self.assertTrue(np.array_equal(np.sort(rows), inside))
            self.assertTrue(np.array_equal(place, position[rows][:, [0, 2]]))
            self.assertTrue(np.allclose(diameter, run.spacing, rtol=0.02))
            self.assertTrue(np.allclose(columns["speed"][1]**2, (velocity[rows]**2).sum(axis=1)))
            self.assertTrue(np.array_equal(columns["pressure"][1], snapshot["pressure"][rows]))

    def test_grains_from_the_side(self):
        run = self.script.Run(self.folder / "grains")
        first, last = run[:2]
        view = self.script.View(first)
        self.assertEqual((view.along, view.depth, view.up), (0, 1, 2))
        rows, place, diameter, columns = self.script.from_the_side(run, last, view)
        depth = last["position"][rows, 1]
        self.assertTrue(np.all(np.diff(depth) <= 0), "the nearest is drawn last")
        self.assertTrue(np.array_equal(diameter, 2 * last["radius"][rows]))
        # x(t) = v t + g t^2 / 2, also through the periodic faces, but for the few that touch each other at the start.
        t, gravity = last.time - first.time, np.array([3.355, 0, -9.218])
        flight = np.linalg.norm(np.array([0.4, 0.1, -0.3]) * t + 0.5 * gravity * t * t)
        high = first["position"][rows, 2] > 0.007
        self.assertGreater(np.sum(high), 1000)
        self.assertGreater(np.mean(np.abs(columns["displacement"][1][high] / flight - 1) < 1e-3), 0.95)


class Sandbox(Case):
    """apps/sandbox/plot.py, on a box a quarter as long with a block of sand half as high, pushed fast."""

    SMALL = ["domain.upper=[0.1, 0.0076, 0.12]", "start.spacing=0.0019", "start.upper=[0.0988, 0.0076, 0.0285]",
             "wall.front.point=[0.099, 0, 0]", "stage.shorten.begin=0.08",
             "stage.shorten.wall.back.velocity=[0.2, 0, 0]", "output.snapshot_interval=0.02"]

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.cases = cls.source / "apps" / "sandbox"
        small = [word for value in cls.SMALL for word in ("--set", value)]
        cls.run_of.run(1, "sandbox", *small, "--until", 0.16, "--out", "small")
        cls.run_of.run(1, "sandbox", cls.cases / "shear_floor.toml", "--until", 0.06, "--set", "stage.lower.begin=0.02",
                       "--set", "stage.press.begin=0.03", "--set", "stage.shear.begin=0.04", "--out", "box")

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
    main()
