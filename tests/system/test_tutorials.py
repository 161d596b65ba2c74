#!/usr/bin/python3
"""apps/tutorials as a new user would follow them: what a page says to save is saved, what it says to run is run, what it says
comes comes: the lines of a block of text, in their order, "..." for anything.

    test_tutorials.py --programs build/bin --source .
"""
import os
import re
import subprocess

from runner import Case, given, main

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)


def steps_of(page):
    """(kind, text, name of the file that it is saved as or None), one after the other."""
    for found in BLOCK.finditer(page):
        before = page[:found.start()].rstrip().rpartition("\n\n")[2]
        name = re.search(r"ave (?:this|it) as\s+`([^`]+)`", before)
        yield found[1], found[2], name[1] if name else None


def pattern_of(line):
    return ".*".join(map(re.escape, line.split("...")))


class Tutorials(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.pages = cls.source / "apps/tutorials"

    def follow(self, name):
        folder = self.run_of.folder / name
        folder.mkdir()
        (folder / "build").mkdir()
        for link, there in (("build/bin", given.programs), ("build/python", given.module),
                            ("apps", self.source / "apps"), ("benchmarks", self.source / "benchmarks")):
            (folder / link).symlink_to(there)
        out, variables = "", {key: value for key, value in self.run_of.environment.items() if key != "PYTHONPATH"}
        for kind, text, saved in steps_of((self.pages / f"{name}.md").read_text()):
            if kind == "sh":
                # What a shell sets stays set for the next block.
                done = subprocess.run(["bash", "-e", "-c", f"{text}\nenv -0 > environment"], cwd=folder, env=variables,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
                out = done.stdout
                self.assertEqual(done.returncode, 0, f"{name}:\n{text}\n{out[-4000:]}")
                pairs = (folder / "environment").read_text().rstrip("\0").split("\0")
                variables = dict(pair.split("=", 1) for pair in pairs)
            elif kind == "text":
                lines = [line for line in text.splitlines() if line != "..."]
                wanted = "\n(?:.*\n)*?".join(map(pattern_of, lines))
                self.assertRegex("\n" + out, "\n" + wanted + "\n", f"{name}: the output is not as the page has it")
            else:
                self.assertIsNotNone(saved, f"{name}: a block of {kind} that is not saved")
                (folder / saved).write_text(text)

    def test_every_page_is_here_and_listed(self):
        pages = {path.stem for path in self.pages.glob("*.md")} - {"README"}
        listed = re.findall(r"\]\((\w+)\.md\)", (self.pages / "README.md").read_text())
        self.assertEqual(sorted(listed), sorted(pages))
        self.assertEqual(pages, {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")} -
                         {"every_page_is_here_and_listed"})

    def test_first_run(self):
        self.follow("first_run")

    def test_dam_break(self):
        self.follow("dam_break")

    def test_volcano(self):
        self.follow("volcano")

    def test_grains(self):
        self.follow("grains")

    def test_drum(self):
        self.follow("drum")

    def test_cluster(self):
        self.follow("cluster")

    def test_python(self):
        self.follow("python")


if __name__ == "__main__":
    os.environ.pop("PYTHONPATH", None)
    main("module")
