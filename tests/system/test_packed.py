#!/usr/bin/python3
"""output.compression: smaller snapshots of the same bits, the same bytes on any number of ranks, for all that reads them.

    test_packed.py --programs build/bin --source .
"""
import importlib
import sys

import h5py
import numpy as np

from runner import Case, main

SCENES = {"grains": ("grains_pour", ("output.contacts=true",)), "melts": ("melts2d", ()), "solid": ("box3d_solid", ())}


def data_sets(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: (item[()], item.compression, item.shuffle, dict(item.attrs))})
                        if isinstance(item, h5py.Dataset) else None)
        return found, dict(file.attrs)


class Packed(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        sys.path.insert(0, str(cls.source / "apps/python"))
        cls.peperite = importlib.import_module("peperite")
        cls.scenes = cls.source / "tests/scenes"
        for name in SCENES:
            for kind, ranks, level in (("plain", 2, 0), ("packed", 1, 4), ("ranks", 3, 4)):
                cls.go(ranks, name, f"{name}_{kind}", f"output.compression={level}")

    @classmethod
    def go(cls, ranks, name, out, *settings, steps=20):
        scene, more = SCENES[name]
        return cls.run_of.run(ranks, "peperite", "run", cls.scenes / f"{scene}.toml", "--steps", steps, "--out", out,
                              *(word for setting in (*more, *settings) for word in ("--set", setting)))

    def snapshot(self, run):
        (path,) = (self.folder / run).glob("snapshot_*.h5")
        return path

    def test_bits_and_bytes(self):
        for name in SCENES:
            plain, packed = self.snapshot(f"{name}_plain"), self.snapshot(f"{name}_packed")
            self.assertEqual(packed.read_bytes(), self.snapshot(f"{name}_ranks").read_bytes(), name)
            self.assertLess(packed.stat().st_size, 0.9 * plain.stat().st_size)
            (a, of_a), (b, of_b) = data_sets(plain), data_sets(packed)
            self.assertEqual(set(a), set(b))
            for of in (of_a, of_b):
                del of["scene"], of["group_names"], of["origin"]
            self.assertEqual(of_a, of_b)
            for field in a:
                self.assertEqual(a[field][0].tobytes(), b[field][0].tobytes(), field)
                self.assertEqual(a[field][3], b[field][3])
                if not field.startswith(("cells/", "others/")):  # views of others
                    self.assertEqual((a[field][1:3], b[field][1:3]), ((None, False), ("gzip", True)), field)

    def test_programs(self):
        for name in SCENES:
            plain, packed = self.snapshot(f"{name}_plain"), self.snapshot(f"{name}_packed")
            self.run_of.run(1, "peperite", "diff", plain, packed)
            about = [self.run_of.run(1, "peperite", "info", path).out.replace(str(path), "") for path in (plain, packed)]
            self.assertEqual(*(text.replace("compression = 4", "compression = 0") for text in about))
            exported = []
            for kind in ("plain", "packed"):
                self.run_of.run(1, "peperite", "export", self.folder / f"{name}_{kind}")
                exported.append([path.read_bytes() for path in sorted((self.folder / f"{name}_{kind}/vtk").glob("*.vtp"))])
            self.assertEqual(*exported)

    def test_python(self):
        for name in SCENES:
            plain, packed = (self.peperite.open(self.folder / f"{name}_{kind}")[-1] for kind in ("plain", "packed"))
            for field in plain.fields:
                self.assertTrue(np.array_equal(plain[field], packed[field], equal_nan=True), field)

    def test_starts(self):
        for kind in ("plain", "packed"):
            text = (self.scenes / "box3d_solid.toml").read_text()
            (self.folder / f"{kind}.toml").write_text(f"{text[:text.index('[start]')]}[start]\nspacing = 1\n"
                                                      f"file = \"{self.snapshot(f'solid_{kind}')}\"\n{text[text.index('[time]'):]}")
        runs = [self.run_of.run(ranks, "peperite", "run", f"{kind}.toml", "--steps", 5, "--out", f"from_{kind}").fingerprint
                for ranks, kind in ((1, "plain"), (3, "packed"))]
        self.assertEqual(*runs)

    def test_resume(self):
        """A run that goes on may compress from then on; its checkpoint is as it was."""
        whole = self.go(1, "grains", "whole", "output.snapshot_interval=0.0002", "output.compression=9", steps=60)
        self.go(3, "grains", "half", "output.snapshot_interval=0.0002", steps=30)
        resumed = self.run_of.run(2, "peperite", "resume", "half", "--steps", 60, "--set", "output.compression=9")
        self.assertEqual(whole.fingerprint, resumed.fingerprint)
        last = "snapshot_000000060.h5"
        with h5py.File(self.folder / "whole" / last) as a, h5py.File(self.folder / "half" / last) as b:
            self.assertEqual((a["particles/velocity"].compression_opts, b["particles/velocity"].compression_opts), (9, 9))
        self.run_of.run(1, "peperite", "diff", f"whole/{last}", f"half/{last}")
        for path in (self.folder / "half/checkpoint").rglob("*.h5"):
            sets, _ = data_sets(path)
            self.assertEqual({compression for _, compression, _, _ in sets.values()}, {None})


if __name__ == "__main__":
    main()
