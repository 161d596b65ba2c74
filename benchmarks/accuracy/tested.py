#!/usr/bin/python3
"""The table of what the accuracy tests measure: tests/accuracy/table.txt filled with the values that they pin.

    tested.py            writes it into README.md here (after PEPERITE_PIN=1 ctest -R '^accuracy')

The test `tables` fails when the page has others than the pins.
"""

import json
import math
import re
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.append(str(here.parent))
import tables  # noqa: E402

tests = tables.root / "tests/accuracy"
PLACE = re.compile(r"<<(?:(?P<test>\w+\.\w+):)?(?P<name>.+?) (?P<kind>[@#]) (?P<expression>.+?) (?P<format>\S+)>>")
TEST = re.compile(r"^TEST\((\w+), (\w+)\)", re.M)
EXPECT = re.compile(r"EXPECT_(?P<how>LE|LT|GE|GT|NEAR)\(\s*PINNED\(")


def pins(test):
    """Values of a test by name, in their order."""
    suite, name = test.split(".")
    values = {}
    for key, value in json.loads((tests / f"pinned/{suite}.json").read_text())[name].items():
        values.setdefault(re.sub(r", \d+$", "", key), []).append(value)
    return values


def arguments(text, start):
    """Of the call whose opening bracket is just before `start`, without needless spaces."""
    depth, out = 1, [""]
    for character in text[start:]:
        depth += (character in "([{") - (character in ")]}")
        if depth == 0:
            break
        if character == "," and depth == 1:
            out.append("")
        else:
            out[-1] += character
    return [re.sub(r"\s+", " ", words).strip() for words in out]


def bounds():
    """The last argument of EXPECT, a bound or a tolerance, by test and pinned name, and by suite and name."""
    found = {}
    for path in sorted(tests.glob("test_*.cpp")):
        text = path.read_text()
        heads = list(TEST.finditer(text))
        for m in EXPECT.finditer(text):
            name, (_, *more) = arguments(text, m.end())[0], arguments(text, text.index("(", m.start()) + 1)
            # Of a function that tests call, which may stand anywhere in the file, only the suite is known.
            suite, test = max((h for h in heads if h.start() < m.start()), key=re.Match.start, default=heads[0]).groups()
            for key in (f"{suite}.{test}", suite):
                found.setdefault((key, name), more[-1])
    return found


def lines():
    known, rows = bounds(), []
    for row in (tests / "table.txt").read_text().splitlines():
        if row.startswith("#"):
            continue
        test, case, *cells = row.split(" | ")

        def filled(m):
            of, name = m["test"] or test, m["name"]
            if m["kind"] == "@":
                everything = pins(of)[name]
                given = {"v": everything[0], "all": everything}
            else:  # a number as C++ and Python write it
                given = {"v": eval(known.get((of, name)) or known[of.split(".")[0], name])}
            value = format(eval(m["expression"], vars(math) | given), m["format"])
            return re.sub(r"e([+-])0(?=\d)", r"e\1", value)

        rows.append([case, *(PLACE.sub(filled, cell) for cell in cells), f"`{test}`"])
    return tables.markdown(("case", "result", "asserted (asked)", "test"), rows)


if __name__ == "__main__":
    tables.write(here / "README.md", "tested", tables.origin(
        tables.last_commit("tests/accuracy"), "the same on any machine"), lines())
