#!/usr/bin/python3
"""peperite export: what VTK's own reader, which is ParaView's, finds in the files is what the snapshots hold.

    test_export.py --programs build/bin --source .
"""
import importlib
import sys
from xml.etree import ElementTree

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from runner import Case, main

SIX = {2: ((0, 0), (1, 1), (0, 1)), 3: ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))}  # of a tensor, as components are named
NAMES = {2: ("xx", "yy", "xy"), 3: ("xx", "yy", "zz", "xy", "xz", "yz")}


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


class Export(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        sys.path.insert(0, str(cls.source / "apps/python"))
        cls.peperite = importlib.import_module("peperite")
        scenes = cls.source / "tests/scenes"
        for name, scene, *options in (
                ("grains", "grains_pour", "output.contacts=true", "output.snapshot_interval=0.0005"),
                ("flat", "slope2d", "output.snapshot_interval=0"), ("solid", "box3d_solid", "output.snapshot_interval=0")):
            cls.run_of.run(2, "peperite", "run", scenes / f"{scene}.toml", "--steps", 100, "--out", name,
                           *(word for option in options for word in ("--set", option)))

    def export(self, *words, code=0):
        return self.run_of.run(1, "peperite", "export", *words, code=code)

    def test_fields_are_those_of_the_snapshots(self):
        for name in ("grains", "flat", "solid"):
            run = self.peperite.open(self.folder / name)
            said = self.export(self.folder / name).out.split()
            self.assertIn(str(self.folder / name / "vtk/particles.pvd"), said)
            index = ElementTree.parse(self.folder / name / "vtk/particles.pvd").getroot().findall("Collection/DataSet")
            self.assertEqual([float(entry.get("timestep")) for entry in index], list(run.times))
            for snapshot, entry in zip(run, index):
                dim = snapshot.scene["dimension"]
                data = read(self.folder / name / "vtk" / entry.get("file"))
                points, found = vtk_to_numpy(data.GetPoints().GetData()), arrays(data.GetPointData())
                self.assertTrue(np.array_equal(points[:, :dim], snapshot["position"]))
                self.assertEqual(data.GetNumberOfVerts(), len(snapshot))
                self.assertEqual(set(found), set(snapshot.fields) - {"position"})
                self.assertEqual(vtk_to_numpy(data.GetFieldData().GetArray("TimeValue"))[0], snapshot.time)
                for field, values in found.items():
                    wanted = snapshot[field]
                    if wanted.ndim == 2 and wanted.shape[1] == dim:
                        values = values[:, :dim]
                    elif wanted.ndim == 2 and wanted.shape[1] == len(SIX[dim]):
                        values = np.stack([values[:, 3 * a + b] for a, b in SIX[dim]], axis=1)
                        wanted = np.stack([snapshot.component(field, c) for c in NAMES[dim]], axis=1)
                    self.assertTrue(np.array_equal(values, wanted), f"{name}: {field}")

    def test_contacts_are_lines_from_grain_to_grain(self):
        self.export(self.folder / "grains", "--out", self.folder / "lines", "--fields", "id,radius")
        snapshot = self.peperite.open(self.folder / "grains")[-1]
        contacts = self.peperite.Contacts(snapshot)
        data = read(self.folder / "lines" / f"contacts_{snapshot.step:09}.vtp")
        self.assertEqual(data.GetNumberOfLines(), len(contacts))
        self.assertGreater(len(contacts), 100)
        found, points = arrays(data.GetCellData()), vtk_to_numpy(data.GetPoints().GetData())
        way = points[len(contacts):] - points[:len(contacts)]
        pairs = contacts.second >= 0
        length = np.linalg.norm(way, axis=1)
        reach = (snapshot["radius"][contacts.first] + snapshot["radius"][contacts.second])[pairs]
        self.assertTrue(np.all(length[pairs] <= reach) and np.all(length[pairs] > 0.6 * reach), "of nearest images")
        self.assertTrue(np.array_equal(found["with_wall"] == 1, ~pairs))
        self.assertTrue(np.array_equal(found["force"], contacts.force))
        self.assertGreater(np.mean(found["normal_force"] > 0), 0.9, "they press")
        self.assertEqual(set(arrays(read(self.folder / "lines" / f"particles_{snapshot.step:09}.vtp").GetPointData())), {"id", "radius"})

    def test_files_of_others_stay(self):
        there = self.folder / "shared"
        self.export(self.folder / "flat", "--out", there)
        files = {path.name: path.read_bytes() for path in there.iterdir()}
        self.assertIn("not of this run", self.export(self.folder / "grains", "--out", there, code=2).err)
        self.assertEqual({path.name: path.read_bytes() for path in there.iterdir()}, files)
        self.export(self.folder / "flat", "--out", there)
        own = self.folder / "own"
        own.mkdir()
        (own / "particles.pvd").write_text("mine")
        self.assertIn("not of this run", self.export(self.folder / "flat", "--out", own, code=2).err)
        self.assertEqual((own / "particles.pvd").read_text(), "mine")

    def test_what_is_wrong_is_said_in_a_line(self):
        self.export(self.folder / "none", code=2)
        self.assertIn("no field", self.export(self.folder / "flat", "--fields", "colour", code=2).err)
        self.assertIn("no snapshot between", self.export(self.folder / "flat", "--from", "100", code=2).err)
        self.assertIn("--every", self.export(self.folder / "flat", "--every", "0", code=2).err)


if __name__ == "__main__":
    main()
