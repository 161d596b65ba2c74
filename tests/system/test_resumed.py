#!/usr/bin/python3
"""What a state shows before its first step, which no step has computed anew: every column of a snapshot and every
monitor is that of the run that got there.

    test_resumed.py --programs build/bin --source .
"""
import csv
import tomllib

import h5py
import numpy as np

from runner import Case, main

# Pressures of walls, of sides of bodies and beside openings, forces of a fluid on grains, viscosities, cracks.
SCENES = {"scenes/rigid2d": 12, "scenes/wet2d": 12, "scenes/open2d": 12, "scenes/freezing2d": 6, "scenes/crack2d": 6,
          "scenes/grains_in_melt": 2, "every_key/depth": 6, "every_key/liquids": 6, "every_key/mixture": 3,
          "every_key/volcanic": 6}


def columns(snapshot):
    """By name, of particles by ascending id."""
    with h5py.File(snapshot) as file:
        order = np.argsort(file["particles/id"][()], kind="stable")
        return {name: data[()][order] for name, data in file["particles"].items()}


def rows(series):
    with open(series) as file:
        return list(csv.reader(file))


class Resumed(Case):
    def go(self, name, ranks, out, *more, **options):
        return self.run_of.run(ranks, "peperite", "run", self.source / "tests" / f"{name}.toml", "--out", out, *more,
                               **options)

    def expect(self, out, wanted, steps, what):
        got = columns(self.folder / out / f"snapshot_{steps:09}.h5")
        self.assertEqual(list(wanted), list(got))
        for column in wanted:
            np.testing.assert_array_equal(got[column], wanted[column], err_msg=f"{what}: {column}")

    def test_a_snapshot_is_written_again(self):
        """A run is killed between its last snapshot and its report."""
        for name, steps in SCENES.items():
            out = f"lost_{name.replace('/', '_')}"
            self.go(name, 1, out, "--steps", steps)
            wanted = columns(self.folder / out / f"snapshot_{steps:09}.h5")
            for ranks in (1, 3):
                (self.folder / out / "perf.json").unlink()
                self.run_of.run(ranks, "peperite", "resume", out)
                self.expect(out, wanted, steps, f"{name} on {ranks} ranks")

    def test_a_run_that_stopped_ends_there(self):
        for name in SCENES:
            base = name.replace("/", "_")
            self.go(name, 1, f"whole_{base}", "--steps", 1)
            wanted = columns(self.folder / f"whole_{base}" / "snapshot_000000001.h5")
            self.go(name, 2, f"stopped_{base}", "--steps", 50, "--max-time", "0:0:0", code=75)
            self.run_of.run(3, "peperite", "resume", f"stopped_{base}", "--steps", 1)
            self.expect(f"stopped_{base}", wanted, 1, name)

    def test_a_branch_begins_with_what_was_last_seen(self):
        monitor = "monitor=[{kind='group', group='floor', name='floor'}]"
        self.go("scenes/rigid2d", 1, "trunk", "--steps", 20, "--set", monitor)
        self.run_of.run(2, "peperite", "resume", "trunk", "--branch", "twig", "--steps", 22, "--set",
                        "output.snapshot_interval=1e-9")
        trunk, twig = (rows(self.folder / run / "series.csv") for run in ("trunk", "twig"))
        self.assertTrue(any(name.startswith("floor_p ") for name in twig[0]), twig[0])
        self.assertEqual(trunk[-1], twig[1])
        self.expect("twig", columns(self.folder / "trunk/snapshot_000000020.h5"), 20, "twig")

    def test_a_branch_with_other_laws_shows_what_pressed_on_walls(self):
        """That is known of the last step alone."""
        self.go("scenes/rigid2d", 1, "old", "--steps", 20)
        self.run_of.run(2, "peperite", "resume", "old", "--branch", "new", "--steps", 22, "--set", "group.melt.viscosity=4000", "--set",
                        "output.snapshot_interval=1e-9")
        old, new = (columns(self.folder / f"{run}/snapshot_000000020.h5") for run in ("old", "new"))
        names = [group["name"] for group in tomllib.loads((self.source / "tests/scenes/rigid2d.toml").read_text())["group"]]
        floor = old["group"] == names.index("floor")
        self.assertTrue(np.any(old["pressure"][floor] > 0))
        np.testing.assert_array_equal(new["pressure"][floor], old["pressure"][floor])


if __name__ == "__main__":
    main()
