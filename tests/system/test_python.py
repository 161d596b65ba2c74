#!/usr/bin/python3
"""The package peperite (apps/python): runs as they are on disk, by ascending id, nothing read before it is asked for.

    test_python.py --programs build/bin --source .
"""
import importlib
import shutil
import sys
import tracemalloc
import unittest
import unittest.mock
from pathlib import Path

import h5py
import matplotlib
import numpy as np

from runner import Case, main


class Package(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        sys.path.insert(0, str(cls.source / "apps/python"))
        cls.peperite = importlib.import_module("peperite")
        scenes = cls.source / "tests/scenes"
        for name, scene, *options in (
                ("grains", "grains_pour", "output.contacts=true", "output.snapshot_interval=0.0005"),
                ("owners", "grains_pour", "output.snapshot_interval=0.0005", "output.sort_limit=1"),
                ("fluid", "box3d_fluid", "output.snapshot_interval=0.02"),
                ("solid", "bodies2d", "output.snapshot_interval=0.001"),
                ("silent", "box3d_fluid", "output.snapshot_interval=0")):
            cls.run_of.run(3, "peperite", "run", scenes / f"{scene}.toml", "--steps", 100, "--out", name,
                           *(word for option in options for word in ("--set", option)))

    def open(self, name):
        return self.peperite.open(self.folder / name)

    def refused(self, says, work):
        with self.assertRaises(self.peperite.Error) as caught:
            work()
        self.assertEqual(len(str(caught.exception).splitlines()), 1)
        self.assertIn(says, str(caught.exception))

    def test_particles_stand_by_their_ids_whatever_the_order_in_the_file(self):
        by_id, by_owner = self.open("grains"), self.open("owners")
        with h5py.File(by_owner.files[-1]) as file:
            self.assertTrue(np.any(np.diff(file["particles/id"][()].astype(np.int64)) < 0), "no test: its rows are sorted")
        for a, b in zip(by_id, by_owner):
            for field in ("id", "position", "velocity", "spin"):
                self.assertTrue(np.array_equal(a[field], b[field]), field)
        with h5py.File(by_id.files[-1]) as file:
            self.assertTrue(np.array_equal(file["particles/velocity"][()], by_id[-1].velocity))

    def test_nothing_is_read_before_it_is_asked_for(self):
        opened = []
        real = h5py.File

        def counting(path, *arguments, **options):
            opened.append(Path(path).name)
            return real(path, *arguments, **options)
        with unittest.mock.patch("h5py.File", counting):
            run = self.open("grains")
            self.assertEqual(opened, [run.files[-1].name])
            self.assertGreater(len(run), 3)
            snapshot = run[1]
            self.assertEqual(opened[1:], [run.files[1].name])
            before = snapshot["position"]
            self.assertIs(snapshot["position"], before)
            self.assertIsNot(run[1], snapshot)
        with self.assertRaises(ValueError):
            before[0] = 0

    def test_open_holds_no_snapshot_however_many_there_are(self):
        def peak(count):
            folder = self.folder / f"many_{count}"
            folder.mkdir()
            for k in range(count):
                (folder / f"snapshot_{k}.h5").hardlink_to(file)
            tracemalloc.start()
            run = self.peperite.open(folder)
            opened = tracemalloc.get_traced_memory()[1]
            sum(snapshot["position"].sum() for snapshot in run)
            used = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            return np.array([opened, used])
        file = self.open("grains").files[-1]
        few, many = peak(2), peak(1002)
        self.assertLess(max(many - few) / 1000, 1000, "bytes a snapshot: paths alone")

    def test_times(self):
        run = self.open("grains")
        self.assertTrue(np.array_equal(run.times, [s.time for s in run]))
        self.assertTrue(np.all(np.diff(run.times) > 0))
        middle = run.times[2]
        self.assertEqual(run.at(middle + 1e-6).time, middle)
        self.assertEqual([s.time for s in run.spread(3)], list(run.times[[0, len(run) // 2, -1]]) if len(run) % 2 else
                         [s.time for s in run.spread(3)])
        self.assertEqual([s.step for s in run[1:3]], [run[1].step, run[2].step])

    def test_fields(self):
        last = self.open("solid")[-1]
        self.assertEqual((last.unit("pressure"), last.unit("velocity"), last.unit("group")), ("Pa", "m/s", "1"))
        self.assertTrue(np.array_equal(last.component("stress", "xy"), last["stress"][:, 2]))
        self.assertTrue(np.array_equal(last.component("velocity", "y"), last.velocity[:, 1]))
        self.assertTrue(np.abs(last.metres("displacement")).max() < 100 and last.metres("displacement").any())
        self.refused("velocity is in m/s", lambda: last.metres("velocity"))
        self.refused("pressure has no components", lambda: last.component("pressure", "x"))
        self.assertIn("displacement", dir(last))
        self.assertIsNone(last.get("void_fraction"))
        grains = self.open("grains")[-1]
        self.assertTrue(np.array_equal(grains.component("stress", "xz"), grains.stress[:, 5]))

    def test_groups(self):
        run = self.open("fluid")
        names, kinds = ([g[key] for g in run.scene["group"]] for key in ("name", "kind"))
        for name, kind in zip(names, kinds):
            chosen = run[-1].where(group=name)
            self.assertTrue(np.array_equal(chosen, run[-1].group == names.index(name)))
            self.assertTrue(np.all(run[-1].where(kind=kind)[chosen]))
        self.assertTrue(np.array_equal(run[-1].moves(), ~run[-1].where(kind="wall")))

    def test_profiles_hold_what_there_is(self):
        snapshot = self.open("grains")[-1]
        domain = snapshot.scene["domain"]
        size = np.array(domain["upper"]) - domain["lower"]
        volume = 4 / 3 * np.pi * snapshot.radius**3
        for axis in "xyz":
            k = "xyz".index(axis)
            whole = {} if snapshot.periodic()[k] else {"lower": -1, "upper": 1}
            profile = snapshot.profile(axis, slices=7, fixed=True, **whole)
            across = np.prod(np.delete(size, k))
            self.assertAlmostEqual((profile.fraction * profile.volume).sum() / volume.sum(), 1, places=12)
            full = profile.fraction > 0
            momentum = np.einsum("k,ki->i", (profile.fraction * profile.volume)[full], profile.velocity[full])
            self.assertTrue(np.allclose(momentum, volume @ snapshot.velocity, rtol=1e-12))
            self.assertTrue(np.allclose(profile.volume, across * (2 if whole else size[k]) / 7))
            contacts = snapshot.contacts
            end = np.where((contacts.second >= 0)[:, None], snapshot.position[contacts.second], contacts.point)
            line = snapshot.nearest_image(end - snapshot.position[contacts.first])
            virial = -np.einsum("ni,nj->ij", contacts.force, line)
            self.assertTrue(np.allclose(np.einsum("k,kij->ij", profile.volume, profile.stress), virial))
        self.refused("along", lambda: snapshot.profile("w"))
        self.refused("of 2.5", lambda: snapshot.profile("z", slices=2.5))
        self.refused("above 0", lambda: snapshot.profile("z", area=0))
        self.assertTrue(any(snapshot.periodic()))
        self.refused("no slices", lambda: snapshot.profile("z", lower=1, upper=0))
        self.refused("no grains", lambda: self.open("fluid")[-1].profile())
        self.assertIsNone(self.open("owners")[-1].profile().stress)

    def test_profiles_bear_weights(self):
        """Balls on each other at rest: the stress in a slice is the weight above, over its area."""
        (self.folder / "pile.csv").write_text("\n".join(["id,x,y,z,vx,vy,vz,group,radius", *(
            f"{k},0.005,0.005,{0.001 * (2 * k + 1) - 1e-9},0,0,0,0,0.001" for k in range(5))]) + "\n")
        (self.folder / "pile.toml").write_text(f"""
            domain = {{ lower = [0, 0, 0], upper = [0.01, 0.01, 0.012], gravity = [0, 0, -9.81] }}
            contact = {{ law = "linear" }}
            group = [{{ name = "ball", kind = "grain", density = 2500, diameter = "2 mm", normal_stiffness = 1000, restitution = 0.1 }}]
            wall = [{{ name = "floor", material = "ball", point = [0, 0, 0], normal = [0, 0, 1] }}]
            start = {{ file = "{self.folder / 'pile.csv'}" }}
            time = {{ steps = 40000 }}
            output = {{ contacts = true }}
            """)
        self.run_of.run(1, "peperite", "run", self.folder / "pile.toml", "--out", "pile")
        last = self.open("pile")[-1]
        weight = 2500 * 4 / 3 * np.pi * 0.001**3 * 9.81
        fine = last.profile("z", slices=100, lower=0.0002, upper=0.0008)
        self.assertTrue(np.allclose(fine.stress[:, 2, 2] * 1e-4, 5 * weight, rtol=1e-6), fine.stress[0, 2, 2] * 1e-4 / weight)
        upper = last.profile("z", slices=10, lower=0.0072, upper=0.0088)
        self.assertTrue(np.allclose(upper.stress[:, 2, 2] * 1e-4, weight, rtol=1e-6), upper.stress[:, 2, 2] * 1e-4 / weight)

    def test_contacts_bear_what_grains_are_given(self):
        snapshot = self.open("grains")[-1]
        contacts = snapshot.contacts
        self.assertGreater(len(contacts), 20)
        self.assertTrue(np.allclose(np.linalg.norm(contacts.normal, axis=1), 1))
        between = contacts.second >= 0
        a, b = contacts.first[between], contacts.second[between]
        reach = (snapshot.radius[a] + snapshot.radius[b])
        apart = snapshot.nearest_image(snapshot.position[b] - snapshot.position[a])
        self.assertTrue(np.all(np.linalg.norm(apart, axis=1) < reach), "what touches overlaps, through periodic faces too")
        push = np.einsum("ij,ij->i", contacts.force, contacts.normal)
        self.assertGreater(np.mean(push < 0), 0.9, "a force on the first points away from the second")
        self.refused("output.contacts = true", lambda: self.open("owners")[-1].contacts)

    def test_displacements_go_through_periodic_faces(self):
        run = self.open("grains")
        way = run[-1].displacement_since(run[0])
        flight = np.array([0.4, 0.1, -0.3]) * (run[-1].time - run[0].time)
        free = run[0].position[:, 2] > 0.007
        self.assertLess(np.median(np.linalg.norm(way[free] - flight, axis=1)), 0.2 * np.linalg.norm(flight))

    def test_series(self):
        run = self.open("fluid")
        titles = (self.folder / "fluid/series.csv").read_text().splitlines()[0].split(",")
        table = np.loadtxt(self.folder / "fluid/series.csv", delimiter=",", skiprows=1)
        self.assertEqual([f"{name} [{run.series.unit(name)}]" if run.series.unit(name) else name for name in run.series], titles)
        self.assertTrue(np.array_equal(np.array(list(run.series.values())).T, table))
        self.assertEqual([run.series.unit(name) for name in ("step", "t", "energy_kinetic")], ["", "s", "J"])
        self.refused("no column depth", lambda: run.series["depth"])
        copy = self.folder / "going_on"
        shutil.copytree(self.folder / "fluid", copy)
        text = (copy / "series.csv").read_text()
        (copy / "series.csv").write_text(text[:-5])
        self.assertEqual(len(self.peperite.open(copy).series["t"]), len(table) - 1)
        self.assertEqual(run.perf["steps"], 100)

    def test_what_is_wrong_is_one_line(self):
        (self.folder / "empty").mkdir()
        for says, folder in (("no such folder", "nowhere"), ("not the folder of a run", "empty")):
            self.refused(says, lambda folder=folder: self.open(folder))
        last = self.open("fluid")[-1]
        for says, work in (("no field \"void\" in it; there are", lambda: last["void"]),
                           ("no group \"rock\"; there are", lambda: last.where(group="rock")),
                           ("no component \"xw\" of velocity; there are x, y, z", lambda: last.component("velocity", "xw"))):
            self.refused(says, work)
        with self.assertRaises(AttributeError):
            last.void
        broken = self.folder / "broken"
        shutil.copytree(self.folder / "fluid", broken)
        path = max(broken.glob("snapshot_*.h5"))
        path.write_bytes(path.read_bytes()[:1000])
        self.refused(path.name, lambda: self.peperite.open(broken))

    def test_damaged_files_are_refused_where_they_are_read(self):
        def put(name, values):
            def damage(file):
                del file["particles"][name]
                if values is not None:
                    file["particles"][name] = values
            return damage

        def scene(value):
            return lambda file: file.attrs.__setitem__("scene", value)
        count = len(self.open("fluid")[-1])
        for says, damage in (("not a snapshot", scene(5)), ("not a snapshot: no group in it", scene("a = 1")), ("not a snapshot", scene("a = ")),
                             ("group: the scene has", put("group", np.full(count, 7, dtype=np.uint32))),
                             ("velocity is not a row", put("velocity", np.zeros(count))),
                             ("pressure is not a row", put("pressure", np.zeros(count - 5))),
                             ("pressure is not a row", put("pressure", np.array([b"x"] * count))),
                             ("id is not", put("id", np.zeros(count))), ("no field \"mass\"", put("mass", None))):
            broken = self.folder / "damaged"
            shutil.copytree(self.folder / "fluid", broken, dirs_exist_ok=True)
            for path in broken.glob("snapshot_*.h5"):
                with h5py.File(path, "r+") as file:
                    damage(file)
            self.refused(says, lambda: self.peperite.open(broken).plot())
        self.refused("not a snapshot", lambda: self.peperite.open(self.with_directory()))

    def with_directory(self):
        odd = self.folder / "odd"
        (odd / "snapshot_000000001.h5").mkdir(parents=True)
        return odd

    def test_titles_are_no_formulas(self):
        path = self.folder / "dollars"
        shutil.copytree(self.folder / "fluid", path)
        for snapshot in path.glob("snapshot_*.h5"):
            with h5py.File(snapshot, "r+") as file:
                text = file.attrs["scene"]
                file.attrs["scene"] = "title = 'costs $\\frac{$ and _more_'\n" + text[text.index("\n", text.index("title")):]
        run = self.peperite.open(path)
        self.assertEqual(run.title, "costs $\\frac{$ and _more_")
        self.assertEqual(len(run.plot()), 1)
        for snapshot in path.glob("snapshot_*.h5"):
            with h5py.File(snapshot, "r+") as file:
                file.attrs["scene"] = "title = ''\n" + file.attrs["scene"].split("\n", 1)[1]
        self.assertEqual(self.peperite.open(path).title, "dollars")

    def test_a_run_that_has_no_snapshot_yet(self):
        early = self.folder / "early"
        shutil.copytree(self.folder / "silent", early)
        for path in early.glob("snapshot_*"):
            path.unlink()
        (early / "snapshot_mine.h5").write_bytes(b"")  # no name that a run gives
        run = self.peperite.open(early)
        self.assertEqual((len(run), list(run), run.title), (0, [], self.open("silent").title))
        self.assertGreater(len(run.series["t"]), 0)
        for work in (lambda: run[-1], lambda: run.at(0), lambda: run.plot()):
            self.refused("no snapshot_*.h5", work)
        (early / "scene.toml").write_text("title = 'no resolved one'")
        self.refused("scene.toml: not a resolved scene: no group", lambda: self.peperite.open(early))

    def test_plot_leaves_the_settings_of_who_calls_it(self):
        matplotlib.use("pdf")
        before = dict(matplotlib.rcParams)
        for name, pictures in (("solid", {"particles.png", "pressure.png", "strip.png"}), ("grains", {"side.png"})):
            paths = self.open(name).plot(out=self.folder / f"of_{name}")
            self.assertEqual({path.name for path in paths}, pictures)
            self.assertTrue(all(path.stat().st_size > 5000 for path in paths))
        self.assertEqual({key for key, value in matplotlib.rcParams.items() if before[key] != value}, set())
        (path,) = self.open("solid").plot(draw="particles", time=0)
        self.assertEqual(path, self.folder / "solid/particles.png")
        self.refused("stars", lambda: self.open("solid").plot(draw="stars"))


if __name__ == "__main__":
    main()
