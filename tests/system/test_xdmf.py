#!/usr/bin/python3
"""particles.xdmf names what the snapshots hold, as ParaView's readers need it, and tensors have ParaView's order.

    test_xdmf.py --programs build/bin --source .
"""
import shutil
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

from runner import Case, main

PARAVIEW = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"]  # what ParaView calls the six components of an array
NUMBERS = {("Float", 8): "f8", ("Int", 8): "i8", ("UInt", 4): "u4"}
WALL = 1 << 63
MESHES = {  # cells, lower corner and edges of the scenes' grids
    "melts2d": ((24, 28), (-0.1, 0.2), (0.025, 1 / 28)),
    "melts3d": ((16, 20, 16), (0, 0, 0), (1 / 16, 1.25 / 20, 1 / 16)),
}


class Xdmf(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scenes = cls.source / "tests/scenes"
        cls.run_of.run(2, "buoyant_cylinder", cls.source / "apps/buoyant_cylinder/solid.toml", "--steps", 6, "--set",
                       "output.snapshot_interval=0.0005", "--out", "flat")
        cls.run_of.run(2, "peperite", "run", cls.scenes / "box3d_solid.toml", "--steps", 5, "--out", "solid")
        cls.run_of.run(2, "peperite", "run", cls.scenes / "grains_pour.toml", "--steps", 100, "--set",
                       "output.contacts=true", "--out", "grains")
        cls.run_of.run(2, "peperite", "run", cls.scenes / "grains_pour.toml", "--steps", 20, "--set",
                       "output.compression=4", "--out", "packed")
        for scene in MESHES:
            cls.run_of.run(2, "peperite", "run", cls.scenes / f"{scene}.toml", "--steps", 2, "--out", scene)
        cls.run_of.run(2, "peperite", "run", cls.scenes / "melts2d.toml", "--steps", 1, "--set",
                       "output.sort_limit=100", "--out", "long")

    def snapshot(self, run):
        return max((self.folder / run).glob("snapshot_*.h5"))

    def held(self, run, item):
        """Values of a DataItem, after a look at all that it says about them."""
        name, data_set = item.text.split(":")
        with h5py.File(self.folder / run / name) as file:
            values = file[data_set][()]
        self.assertEqual(tuple(map(int, item.get("Dimensions").split())), values.shape, item.text)
        kind = NUMBERS[item.get("NumberType"), int(item.get("Precision"))]
        # XDMF 2 knows no unsigned numbers of eight bytes.
        self.assertEqual(np.dtype(kind), "i8" if values.dtype == "u8" else values.dtype, item.text)
        return values

    def test_every_item_is_there(self):
        for run in ("flat", "solid", "grains", "packed"):
            grids = ElementTree.parse(self.folder / run / "particles.xdmf").getroot().findall("Domain/Grid/Grid")
            self.assertEqual(len(grids), len(list((self.folder / run).glob("snapshot_*.h5"))))
            for grid in grids:
                position = self.held(run, grid.find("Geometry/DataItem"))
                topology = grid.find("Topology")
                self.assertEqual((topology.get("TopologyType"), topology.get("NumberOfElements"),
                                  topology.get("NodesPerElement")), ("Polyvertex", str(len(position)), "1"))
                # Without a list of them the "Xdmf3 Reader" finds no vertices, and shows nothing.
                vertices = self.held(run, topology.find("DataItem"))
                self.assertTrue(np.array_equal(vertices, np.arange(len(position))))
                for attribute in grid.findall("Attribute"):
                    values = self.held(run, attribute.find("DataItem"))
                    self.assertEqual(len(values), len(position))
                    if attribute.get("Name") == "stress" and run != "flat":
                        # Tensor6 means xx xy xz yy yz zz to one reader, and to the others nothing.
                        self.assertEqual((attribute.get("AttributeType"), values.shape[1]), ("Matrix", 6))
                        self.assertTrue(np.all(np.any(values[:, 3:] != 0, axis=0)))

    def test_cells_are_a_mesh(self):
        for run, (cells, lower, edge) in MESHES.items():
            (cells_of_times,) = ElementTree.parse(self.folder / run / "particles.xdmf").getroot().findall("Domain/Grid")
            self.assertEqual((cells_of_times.get("Name"), cells_of_times.get("CollectionType")), ("cells", "Temporal"))
            grids = cells_of_times.findall("Grid")
            self.assertEqual(len(grids), len(list((self.folder / run).glob("snapshot_*.h5"))))
            # A plane is a layer of cells below z = 0.
            shape = (1,) * (3 - len(cells)) + cells[::-1]
            corner = lower if len(cells) == 3 else (*lower, -edge[0])
            for grid in grids:
                topology = grid.find("Topology")
                self.assertEqual((topology.get("TopologyType"), topology.get("Dimensions")),
                                 ("3DCoRectMesh", " ".join(str(n + 1) for n in shape)))
                origin, spacing = ([float(x) for x in item.text.split()] for item in grid.findall("Geometry/DataItem"))
                self.assertTrue(np.allclose(origin, corner[::-1], rtol=1e-12, atol=1e-12))
                self.assertTrue(np.allclose(spacing, (*edge, edge[0])[2::-1], rtol=1e-12))
                held = {}
                for attribute in grid.findall("Attribute"):
                    self.assertEqual(attribute.get("Center"), "Cell")
                    held[attribute.get("Name")] = self.held(run, attribute.find("DataItem"))
                    self.assertEqual(held[attribute.get("Name")].shape[:3], shape)
                self.assertLessEqual({"temperature", "composition", "flow_pressure", "velocity_on_lower_faces"},
                                     set(held))
                self.in_the_order_of_the_grid(run, grid, held["temperature"], cells, corner, edge)

    def in_the_order_of_the_grid(self, run, grid, temperature, cells, corner, edge):
        name = grid.find("Attribute/DataItem").text.split(":")[0]
        with h5py.File(self.folder / run / name) as file:
            rows = file["particles"]
            place = np.floor((rows["position"][()] - corner[: len(cells)]) / edge).astype(int)
            wanted = np.zeros(temperature.shape)
            wanted[(*([0] * (3 - len(cells))), *place.T[::-1])] = rows["temperature"][()]
            self.assertTrue(np.array_equal(temperature, wanted))
            self.assertGreater(np.ptp(wanted), 0)
            self.assertTrue(np.array_equal(file["cells/velocity"][()].reshape(rows["velocity"].shape), rows["velocity"]))
            self.assertEqual(file["cells/temperature"].attrs["unit"], "K")

    def test_rows_that_are_not_sorted_are_no_mesh(self):
        (points,) = ElementTree.parse(self.folder / "long" / "particles.xdmf").getroot().findall("Domain/Grid")
        self.assertEqual(points.get("Name"), "particles")
        with h5py.File(self.snapshot("long")) as file:
            self.assertNotIn("cells", file)

    def test_stress_of_grains_is_that_of_their_contacts(self):
        with h5py.File(self.snapshot("grains")) as file:
            names = file["particles/stress"].attrs["components"].split()
            ids, position, radius, stress = (file["particles"][k][()] for k in ("id", "position", "radius", "stress"))
            first, second, force, point = (file["contacts"][k][()] for k in ("id", "partner", "force", "point"))
        self.assertEqual([name.upper() for name in names], PARAVIEW)
        sums = np.zeros((len(ids), 3, 3))
        period = np.array([0.0352, 0.011, np.inf])
        for grain, push in ((first, force), (second[second < WALL], -force[second < WALL])):
            where = np.searchsorted(ids, grain)
            arm = (point if grain is first else point[second < WALL]) - position[where]
            arm -= np.where(np.isinf(period), 0, period) * np.round(arm / period)
            np.add.at(sums, where, push[:, :, None] * arm[:, None, :])
        sums = 0.5 * (sums + sums.transpose(0, 2, 1)) / (4 / 3 * np.pi * radius**3)[:, None, None]
        largest = np.abs(sums).max()
        for k, name in enumerate(names):
            a, b = ("xyz".index(axis) for axis in name)
            self.assertGreater(np.abs(sums[:, a, b]).max(), 1e-3 * largest)
            self.assertLess(np.abs(stress[:, k] - sums[:, a, b]).max(), 1e-5 * largest, name)

    def test_a_snapshot_as_a_start_keeps_every_bit_of_the_stress(self):
        start = self.snapshot("solid")
        text = (self.scenes / "box3d_solid.toml").read_text()
        (self.folder / "case.toml").write_text(f"{text[:text.index('[start]')]}[start]\nspacing = 1\nfile = \"{start}\"\n"
                                               f"{text[text.index('[time]'):]}")
        arguments = ["run", "case.toml", "--steps", 0]
        self.run_of.run(1, "peperite", *arguments, "--out", "again")
        with h5py.File(start) as before, h5py.File(self.snapshot("again")) as after:
            self.assertEqual([k.upper() for k in before["particles/stress"].attrs["components"].split()], PARAVIEW)
            self.assertTrue(np.array_equal(before["particles/stress"][()], after["particles/stress"][()]))

        # As earlier versions wrote it, without the names of the components.
        old = self.folder / "old.h5"
        shutil.copy(start, old)
        with h5py.File(old, "r+") as file:
            del file["particles/stress"].attrs["components"]
            file["particles/stress"][:, 4:] = file["particles/stress"][:, 4:][:, ::-1]
        self.run_of.run(1, "peperite", *arguments, "--set", f"start.file={old}", "--out", "from_old")
        with h5py.File(self.snapshot("again")) as new, h5py.File(self.snapshot("from_old")) as after:
            self.assertTrue(np.array_equal(new["particles/stress"][()], after["particles/stress"][()]))
        with h5py.File(old, "r+") as file:
            del file.attrs["format"]  # now it could be anybody's
        self.run_of.refused(1, "peperite", *arguments, "--set", f"start.file={old}", says="xx yy zz xy yz xz")


if __name__ == "__main__":
    main()
