#!/usr/bin/python3
"""Scenes of several files through the programs: the run of one file, refused on any ranks, resumed when the files are gone.

    test_include.py --programs build/bin --source .
"""
import shutil

from runner import Case, main


class Include(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.source / "tests/scenes/box3d_fluid.toml"
        text = cls.scene.read_text()
        cut = text.index("[start]")
        (cls.folder / "parts").mkdir()
        (cls.folder / "parts/materials.toml").write_text(text[:cut])
        (cls.folder / "parts/rest.toml").write_text(text[cut:])
        (cls.folder / "case.toml").write_text('include = ["parts/materials.toml", "parts/rest.toml"]\n[time]\ncfl = 0.5\n')

    def test_the_same_run(self):
        one = self.run_of.run(1, "peperite", "run", self.scene, "--steps", 20, "--set", "time.cfl=0.5", "--out", "one")
        many = self.run_of.run(3, "peperite", "run", "case.toml", "--steps", 20, "--out", "many")
        self.assertEqual(one.fingerprint, many.fingerprint)
        resolved = (self.folder / "many/scene.toml").read_text()
        self.assertNotIn("include", resolved)
        again = self.run_of.run(2, "peperite", "run", "many/scene.toml", "--steps", 20, "--out", "again")
        self.assertEqual(again.fingerprint, many.fingerprint)
        checked = [self.run_of.run(ranks, "peperite", "check", "case.toml").out for ranks in (1, 2)]
        self.assertIn("particles: ", checked[0])

    def test_goes_on_without_its_files(self):
        moved = self.folder / "moved"
        moved.mkdir()
        shutil.copytree(self.folder / "parts", moved / "parts")
        shutil.copy(self.folder / "case.toml", moved)
        self.run_of.run(2, "peperite", "run", "moved/case.toml", "--steps", 10, "--out", "half")
        shutil.rmtree(moved)
        resumed = self.run_of.run(3, "peperite", "resume", "half", "--steps", 20)
        whole = self.run_of.run(1, "peperite", "run", "case.toml", "--steps", 20, "--out", "whole")
        self.assertEqual(resumed.fingerprint, whole.fingerprint)
        branch = self.run_of.run(1, "peperite", "resume", "half", "--branch", "branch", "--steps", 22)
        self.assertIn("step 22 ", branch.fingerprint)

    def test_refused_in_a_line_on_any_ranks(self):
        wrong = {"gone": ('\ninclude = "no.toml"\n', 'wrong.toml:2:11: include: "no.toml": there is no such file; give'),
                 "itself": ('include = "wrong.toml"\n', 'wrong.toml:1:11: include: "wrong.toml": it includes this file, or is it'),
                 "kind": ('include = ["case.toml"]\ntime = 3\n', "wrong.toml:2:8: time: is a whole number, but a table at case.toml:2:1"),
                 "below": ('include = "parts/bad.toml"\n', "parts/bad.toml:2:1: start.spacin: unknown key; did you mean")}
        (self.folder / "parts/bad.toml").write_text("[start]\nspacin = 1\n")
        for name, (text, says) in wrong.items():
            (self.folder / "wrong.toml").write_text(text)
            for ranks in (1, 3):
                for command in ("check", "run"):
                    self.run_of.refused(ranks, "peperite", command, "wrong.toml", says=says)


if __name__ == "__main__":
    main()
