#!/usr/bin/python3
"""peperite sweep: a run for each combination of values, none of them twice, and a table.

    test_sweep.py --programs build/bin --source .
"""
import csv
import json
import sys

from runner import Case, main


class Sweep(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.source / "tests/scenes/box3d_fluid.toml"
        sys.path.insert(0, str(cls.source / "apps/python"))

    def sweep(self, *words, code=0):
        return self.run_of.run(1, "peperite", "sweep", self.scene, *words, code=code)

    def table(self, out):
        with open(self.folder / out / "sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_all_combinations(self):
        words = ["--out", "grid", "--vary", "time.cfl=0.5,0.7", "--vary", "start.velocity=[5,0,0],[1,2,0]", "--set", "output.series_interval=0"]
        done = self.sweep(*words, "--steps", 5)
        self.assertEqual(done.out.splitlines()[-1], "grid/sweep.csv")
        rows = self.table("grid")
        self.assertEqual([(row["time.cfl"], row["start.velocity"]) for row in rows],
                         [(a, b) for a in ("0.5", "0.7") for b in ("[5,0,0]", "[1,2,0]")])
        self.assertEqual(len({row["fingerprint"] for row in rows}), 4)
        for row in rows:
            alone = self.run_of.run(2, "peperite", "run", self.scene, "--steps", 5, "--set", f"time.cfl={row['time.cfl']}", "--set",
                                    f"start.velocity={row['start.velocity']}", "--out", f"alone{row['time.cfl']}{row['start.velocity']}")
            self.assertEqual(alone.fingerprint.split()[1], row["fingerprint"])
            self.assertEqual(row["step"], "5.0")
        # Nothing is run again, and one value more is one run more.
        before = {path: path.stat().st_mtime_ns for path in (self.folder / "grid").glob("*/perf.json")}
        words[3] += ",0.6"
        self.sweep(*words, "--steps", 5)
        after = {path: path.stat().st_mtime_ns for path in (self.folder / "grid").glob("*/perf.json")}
        self.assertEqual((len(before), len(after)), (4, 6))
        self.assertEqual({path: after[path] for path in before}, before)
        refused = self.sweep(*words, "--steps", 6, code=2)
        self.assertIn("another scene", refused.err)

    def test_included_files_are_of_the_scene(self):
        whole = self.scene.read_text()
        base, more = self.folder / "base.toml", self.folder / "more.toml"
        base.write_text(whole)
        more.write_text('include = "base.toml"\n[start]\nvelocity = [1, 2, 0]\n')
        words = ["--vary", "time.cfl=0.5,0.7", "--steps", 3, "--out", "parts"]
        self.run_of.run(1, "peperite", "sweep", more, *words)
        self.sweep(*words[:-1], "one", "--set", "start.velocity=[1,2,0]")
        self.assertEqual([row["fingerprint"] for row in self.table("parts")], [row["fingerprint"] for row in self.table("one")])
        base.write_text(whole + "# another\n")
        self.assertIn("another scene", self.run_of.run(1, "peperite", "sweep", more, *words, code=2).err)

    def test_what_was_stopped_goes_on(self):
        out = self.folder / "stopped"
        words = ["--vary", "time.cfl=0.5", "--out", "stopped", "--steps", 8]
        self.run_of.run(1, "peperite", "run", self.scene, "--set", "time.cfl=0.5", "--steps", 3, "--out", out / "cfl=0.5")
        (out / "cfl=0.5/perf.json").unlink()
        self.sweep(*words)
        whole = self.run_of.run(1, "peperite", "run", self.scene, "--set", "time.cfl=0.5", "--steps", 8, "--out", "whole")
        self.assertEqual(self.table("stopped")[0]["fingerprint"], whole.fingerprint.split()[1])

    def test_one_that_fails_leaves_the_others(self):
        done = self.sweep("--vary", "time.cfl=0.5,-1,0.7", "--out", "some", "--steps", 2, code=2)
        self.assertIn("cfl=-1: exit code 2: peperite: error:", done.out)
        self.assertIn("1 of 3 runs failed", done.err)
        self.assertEqual([row["time.cfl"] for row in self.table("some")], ["0.5", "0.7"])

    def test_on_several_ranks(self):
        self.sweep("--vary", "time.cfl=0.5,0.7", "--out", "ranks", "--steps", 2, "--ranks", 2, "--jobs", 1)
        for path in (self.folder / "ranks").glob("*/perf.json"):
            self.assertEqual(json.loads(path.read_text())["ranks"], 2)

    def test_values(self):
        from peperite.sweep import name_of, values_of
        self.assertEqual(values_of('1,[2,3],"a,b",{x=1,y=2},4'), ["1", "[2,3]", '"a,b"', "{x=1,y=2}", "4"])
        self.assertEqual(name_of((("a.b", "1e-3"), ("c", '"x/y"'))), "b=1e-3_c=_x_y")

    def test_refusals(self):
        for words, says in ((["--out", "x"], "--vary"), (["--vary", "time.cfl", "--out", "x"], "KEY=VALUE"),
                            (["--vary", "time.cfl=1,,2", "--out", "x"], "KEY=VALUE"), (["--vary", "a=1"], "--out"), (["--vary", "a=1", "--out", ""], "--out"),
                            (["--vary", "a=1", "--out", "x", "--ranks", 0], "--ranks")):
            done = self.sweep(*words, code=2)
            self.assertEqual(len(done.err.splitlines()), 1, done.err)
            self.assertIn(says, done.err)
        self.assertFalse((self.folder / "x").exists())


if __name__ == "__main__":
    main()
