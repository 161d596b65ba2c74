#!/usr/bin/python3
"""peperite sweep: a run for each combination of values, none of them twice, and a table.

    test_sweep.py --programs build/bin --source .
"""
import csv
import json
import shutil
import signal
import sys
import tomllib

from runner import Case, main, rows_in, wait_for


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
        """After SIGTERM, to the runs at hand too; after the loss of all but the first files; not what ended elsewhere."""
        out = self.folder / "stopped"
        words = ["--vary", "time.cfl=0.5,0.7", "--jobs", 1, "--out", "stopped", "--steps", 1500]
        sweep = self.run_of.start(1, "peperite", "sweep", self.scene, *words)
        wait_for(lambda: rows_in(out / "cfl=0.5/series.csv") > 2)
        sweep.send_signal(signal.SIGTERM)
        done = self.run_of.finish(sweep)
        self.assertEqual(done.code, 75, done.err)
        self.assertIn("exit code 75", done.out)
        self.assertIn("cfl=0.7: not begun", done.out)
        self.assertLess(json.loads((out / "cfl=0.5/perf.json").read_text())["end"]["step"], 1500)
        self.sweep(*words)
        self.assertEqual([row["step"] for row in self.table("stopped")], ["1500.0", "1500.0"])
        for value in ("0.5", "0.7"):
            whole = self.run_of.run(1, "peperite", "run", self.scene, "--set", f"time.cfl={value}", "--steps", 1500, "--out", f"whole{value}")
            self.assertIn(whole.fingerprint.split()[1], {row["fingerprint"] for row in self.table("stopped") if row["time.cfl"] == value})
        (out / "cfl=0.5/perf.json").unlink()
        shutil.rmtree(out / "cfl=0.5/checkpoint")  # as a run is that was killed before its first
        before = self.table("stopped")
        self.sweep(*words)
        self.assertEqual([row["fingerprint"] for row in self.table("stopped")], [row["fingerprint"] for row in before])

    def test_folders_are_of_their_settings(self):
        """Whatever their names: of two keys with the same last word, of values that differ by what a name cannot hold."""
        words = ["--out", "named", "--steps", 2, "--set", "output.series_interval=0"]
        self.sweep(*words, "--vary", "title=a b,a_b," + 200 * "x")
        self.assertEqual([tomllib.loads((self.folder / "named" / name / "scene.toml").read_text())["title"]
                          for name in ("title=a_b", "title=a_b_2", "title=" + 94 * "x")], ["a b", "a_b", 200 * "x"])
        self.sweep(*words, "--vary", "title=a_b,c")
        self.assertTrue((self.folder / "named/title=c").is_dir())
        self.assertFalse((self.folder / "named/title=a_b_3").exists())
        self.sweep(*words, "--vary", "output.title=a_b", code=2)  # no such key
        self.assertEqual(self.table("named"), [])

    def test_what_is_not_of_a_sweep_is_left(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/sweep.csv").write_text("mine\n")
        self.assertIn("holds no sweep", self.sweep("--vary", "time.cfl=0.5", "--out", "mine", "--steps", 1, code=2).err)
        self.assertEqual((self.folder / "mine/sweep.csv").read_text(), "mine\n")
        self.sweep("--vary", "time.cfl=0.5", "--out", "hurt", "--steps", 1)
        (self.folder / "hurt/cfl=0.5/perf.json").write_text("{}")
        self.assertIn("not of a run", self.sweep("--vary", "time.cfl=0.5", "--out", "hurt", "--steps", 1, code=2).out)
        (self.folder / "hurt/sweep.json").write_text("")
        self.assertIn("damaged", self.sweep("--vary", "time.cfl=0.5", "--out", "hurt", "--steps", 1, code=2).err)

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
