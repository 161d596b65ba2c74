#!/usr/bin/python3
"""Pictures of runs with melts: of the package peperite and of apps/magma_chamber/plot.py.

    test_melt_plot.py --programs build/bin --source .
"""
import importlib
import subprocess
import sys

import numpy as np

import made_chamber
import test_plot
from runner import Case, main


class MeltPlot(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.apps = cls.source / "apps"
        sys.path += [str(cls.apps / "python"), str(cls.apps / "magma_chamber")]
        cls.melt_run, cls.melt, cls.layers = (importlib.import_module(name) for name in (
            "peperite.drawing.melt_run", "peperite.drawing.melts", "layers"))
        for name, scene, *options in (
                ("flat", cls.source / "tests/scenes/melts2d.toml", "output.snapshot_interval=4"),
                ("deep", cls.source / "tests/scenes/melts3d.toml", "output.snapshot_interval=2"),
                ("hot", cls.source / "benchmarks/accuracy/blankenbach.toml", "melt.cells=[16, 16]", "time.until=0.004"),
                ("cold", cls.source / "benchmarks/accuracy/van_keken.toml", "melt.cells=[16, 16]", "time.until=2")):
            cls.run_of.run(2, "peperite", "run", scene, "--out", name, *(w for o in options for w in ("--set", o)))
        cls.times = np.linspace(0, 7 * made_chamber.HOUR, 8)
        cls.heights = made_chamber.write(cls.folder / "chamber", cls.times)
        made_chamber.write(cls.folder / "early", [0.0], heat=False, shuffled=True)

    def plot(self, *arguments, script="plot.py"):
        return subprocess.run(["/usr/bin/python3", "-B", self.apps / script, *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True)

    def drawn(self, names, *arguments, **options):
        done = self.plot(*arguments, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.splitlines(), names)
        for name in names:
            test_plot.Plot.look_at(self, self.folder / name)

    def test_any_run(self):
        for run in ("flat", "deep", "hot", "cold", "chamber"):
            self.drawn([f"{run}/plane.png", f"{run}/series.png"], run)
        self.drawn(["one/plane.png"], "deep", "--time", 2, "--draw", "plane", "--out", "one")
        self.assertNotEqual((self.folder / "one/plane.png").read_bytes(), (self.folder / "deep/plane.png").read_bytes())

    def test_chamber(self):
        def names(run, *pictures):
            return [f"{run}/{picture}.png" for picture in pictures]
        script = "magma_chamber/plot.py"
        self.drawn(names("chamber", "isotherms", "fraction", "series", "layer"), "chamber", script=script)
        self.drawn(names("early", "isotherms", "fraction", "series", "layer"), "early", script=script)
        for run in ("hot", "cold", "deep"):
            self.drawn(names(run, "isotherms", "series"), run, script=script)
        self.drawn(names("two", "chamber_isotherms", "hot_isotherms"), "chamber", "hot", "--times", "0,7200", "--draw",
                   "isotherms", "--out", "two", script=script)

    def test_refusals(self):
        for script, arguments, says in (
                ("magma_chamber/plot.py", ["cold", "--draw", "layer"], "no grains"),
                ("magma_chamber/plot.py", ["chamber", "--times", "soon"], "--times"),
                ("magma_chamber/plot.py", ["nowhere"], "nowhere"),
                ("plot.py", ["cold", "--draw", "slice"], "slice"), ("plot.py", ["cold", "--time", "nan"], "--time")):
            done = self.plot(*arguments, script=script)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(says, done.stderr)

    def test_cells_stand_where_they_are_in_the_grid(self):
        run = self.melt_run.Run(self.folder / "deep")
        self.assertEqual((run.plane.along, run.plane.depth, run.plane.layer), (1, 0, 8))
        snapshot = run[-1]
        place = snapshot.cell("position")
        for axis in range(3):
            wanted = run.grid.centres(axis).reshape([-1 if 2 - axis == k else 1 for k in range(3)])
            self.assertLess(np.abs(place[..., axis] - wanted).max(), 1e-6)
        self.assertTrue(np.array_equal(run.plane.of(snapshot.cell("temperature")), snapshot.cell("temperature")[:, :, 8]))
        sorted_run, shuffled = (self.melt_run.Run(self.folder / name) for name in ("chamber", "early"))
        for field in ("composition", "velocity"):
            self.assertTrue(np.array_equal(sorted_run[0].cell(field), shuffled[0].cell(field)))
        self.assertTrue(np.array_equal(sorted_run[0].grain("position"), shuffled[0].grain("position")))

    def test_flow_at_the_centres(self):
        run = self.melt_run.Run(self.folder / "chamber")
        self.assertEqual((run.plane.along, run.plane.depth), (0, 1))
        x, z = np.meshgrid(*(np.pi * (run.grid.centres(a) - run.grid.low[a]) / (run.grid.high[a] - run.grid.low[a])
                             for a in run.plane.axes))
        along, up = run.plane.velocity(run[0])
        self.assertLess(np.abs(along - 2e-4 * np.sin(x) * np.cos(z)).max(), 2e-6)
        self.assertLess(np.abs(up + 2e-4 * np.cos(x) * np.sin(z)).max(), 2e-6)
        wrapped = run.grid.at_centres(np.ones((20, 16, 16, 3)), 1)
        self.assertTrue(np.all(wrapped == 1), "periodic along y")

    def test_grains_in_the_plane(self):
        run = self.melt_run.Run(self.folder / "chamber")
        snapshot, plane = run[3], run.plane
        place, diameter, group = plane.discs(snapshot)
        away = np.abs(snapshot.grain("position")[:, 1] - plane.place)
        self.assertEqual(len(place), np.sum(away < 0.012))
        self.assertTrue(np.allclose(np.sort(diameter), np.sort(2 * np.sqrt(0.012**2 - away[away < 0.012]**2))))
        self.assertTrue(np.all(group == 2))

    def test_fractions_and_the_layer_on_the_interface(self):
        radius, half_way = np.array([0.5, 0.1]), np.array([1.0, 3.0])
        volumes = 4 / 3 * np.pi * radius**3
        below = self.layers.volumes_below(np.array([0.0, 0.75, 1.0, 2.0, 3.0, 9.0]), half_way, radius)
        cap = np.pi * 0.25**2 * (3 * 0.5 - 0.25) / 3
        self.assertTrue(np.allclose(below, [0, cap, volumes[0] / 2, volumes[0], volumes[0] + volumes[1] / 2,
                                            volumes.sum()]))
        history = self.layers.History(self.melt_run.Run(self.folder / "chamber"))
        layer_volume = 0.96 * 0.96 * 0.06
        self.assertTrue(np.allclose(history.fractions.sum(axis=1) * layer_volume, 4000 * 4 / 3 * np.pi * 0.012**3))
        self.assertLess(np.abs(history.interface - made_chamber.FLOOR).max(), 0.005)
        self.assertTrue(np.array_equal(history.below, [np.sum(z < h) for z, h in zip(self.heights, history.interface)]))
        hours, fallen = history.fallen(made_chamber.HOUR)
        self.assertTrue(np.allclose(hours, self.times[:-1] + 1800) and np.allclose(fallen, 40, atol=1))
        # At the start grains are everywhere above, at the end most are in the layer of cells on the interface.
        self.assertAlmostEqual(history.thickness[0], 0.6, delta=0.05)
        self.assertLess(history.thickness[-1], 0.1)
        self.assertGreater(history.mean[-1], 4 * history.mean[0])

    def test_layer_of_a_known_profile(self):
        edges = np.linspace(0, 1, 11)
        for profile, floor, wanted in (([0.6, 0, 0, 0, 0.3, 0.3, 0.3, 0, 0, 0], 0.3, (0.3, 0.3)),
                                       ([0, 0, 0, 0, 0, 0, 0, 0, 0.2, 0.2], 0.5, (0.2, 0.2)),
                                       ([0.6, 0, 0, 0, 0, 0, 0, 0, 0, 0], 0.3, (0, np.nan))):
            found = self.layers.trapped_layer(edges, np.array(profile), floor)
            self.assertTrue(np.allclose(found, wanted, equal_nan=True), (found, wanted))

    def test_heat_over_conduction(self):
        run = self.melt_run.Run(self.folder / "hot")
        table = run.series
        curves, quantity = run.heat(table)
        self.assertIn("Nu", quantity)
        self.assertEqual([name for name, _ in curves], ["in at the bottom", "out at the top"])
        for (_, values), column in zip(curves, ("melt_heat_y0", "melt_heat_y1")):
            self.assertTrue(np.allclose(values, np.abs(table[column])))  # kappa, height and difference are 1
        curves, quantity = self.melt_run.Run(self.folder / "flat").heat(self.melt_run.Run(self.folder / "flat").series)
        self.assertEqual(([name for name, _ in curves], quantity),
                         (["in through y0", "in through y1"], "heat in (K m/s)"))


if __name__ == "__main__":
    main()
