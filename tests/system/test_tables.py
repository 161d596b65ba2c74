#!/usr/bin/python3
"""Tables of the pages that committed files make are those that these files make now: the accuracy tests' pinned values
and the results of accuracy.py. Each table says which commit, machine and day it is of.

    test_tables.py --source .
"""
import argparse
import json
import re
import sys
import unittest
from pathlib import Path


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = Path(given.source).resolve()
        sys.path[:0] = [str(cls.source / "benchmarks/accuracy"), str(cls.source / "benchmarks")]
        global tables
        import tables
        cls.pages = {path: tables.tables(path) for path in (cls.source / "benchmarks").rglob("*.md")}

    def test_each_says_where_it_is_from(self):
        found = 0
        for path, of_page in self.pages.items():
            self.assertEqual(len(re.findall("^<!-- table ", path.read_text(), re.M)), len(of_page),
                             f"{path}: a table without name, command or end")
            for name, (_, body) in of_page.items():
                self.assertRegex(body, tables.ORIGIN, f"{path}: {name}")
                found += 1
        self.assertGreater(found, 0)

    def same(self, name, lines, how):
        page = self.source / "benchmarks/accuracy/README.md"
        self.assertEqual(tables.without_origin(self.pages[page][name][1]).splitlines(), lines, f"{page}: {how}")

    def test_tested(self):
        import tested
        self.same("tested", tested.lines(), "the pins are others: benchmarks/accuracy/tested.py")

    def test_suite(self):
        import page
        self.same("suite", page.lines(), "results.json has others: accuracy.py --page")

    def test_every_test_that_pins_is_in_the_table(self):
        import tested
        shown = (tested.tests / "table.txt").read_text()
        for path in tested.tests.glob("pinned/*.json"):
            for test in json.loads(path.read_text()):
                self.assertIn(f"{path.stem}.{test}", shown, "has no row in tests/accuracy/table.txt")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", required=True)
    given, names = parser.parse_known_args()
    unittest.main(argv=sys.argv[:1] + names)
