#!/usr/bin/python3
"""The fuzzer itself: it varies every key of the scene table, or says why a key cannot matter; the same seed makes the same
case; a case that is kept survives its file."""

import argparse
import json
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import cases

# Keys that no case varies, each with the reason why no bit can depend on it.
NOT_VARIED = {
    "decomposition.record": "fuzz_ranks writes the cuts of every replayed row to a file",
    "decomposition.replay": "fuzz_ranks names the file of every row with cuts = replay",
    "include": "files are put together before anything else is read",
    "mesh.content": "the program notes it when it reads the scene",
    "start.region.content": "the same",
    "decomposition.chaos_seed": "fuzz_ranks draws it for every row with cuts = chaos",
}
# As the key table names them, without the words of a start file, which cases add when they are written.
ADDED = {"start.file", "start.tile", "start.tile.file", "start.tile.repeat"}
CASES = 4000


def varied():
    found, values = set(), {}
    for number in range(CASES):
        case = cases.make(1, number)
        for key in cases.keys(case["scene"]):
            found.add(key)
        for row in case["rows"]:
            for setting in row["set"]:
                key, value = setting.split("=", 1)
                found |= {"decomposition", key}
                values.setdefault(key, set()).add(value)
        if "rows of start" in case:
            found |= ADDED if "repeat" in case else {"start.file"}
    for key, seen in values.items():
        assert len(seen) > 1, f"{key} is always {seen}"
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", required=True, type=Path)
    options = parser.parse_args()
    table = set(subprocess.run([options.programs / "fuzz_ranks", "--keys"], check=True, capture_output=True,
                               text=True).stdout.split())
    found = varied()
    missing = table - found - set(NOT_VARIED)
    assert not missing, f"no case of {CASES} has {sorted(missing)}: vary them, or say in NOT_VARIED why they cannot matter"
    assert not set(NOT_VARIED) & found, f"varied after all: {sorted(set(NOT_VARIED) & found)}"
    assert found <= table, f"not in the table: {sorted(found - table)}"
    case = cases.make(7, 3)
    assert case == cases.make(7, 3), "the same seed made another case"
    assert json.loads(json.dumps(case)) == case, "a case changes when it is kept"
    grains = sum(cases.make(1, k)["scene"]["group"][0]["kind"] == "grain" for k in range(CASES)) / CASES
    assert grains > 0.1, f"only {grains} of the scenes are of grains"
    print(f"{len(found & table)} of {len(table)} keys are varied, {100 * grains:.0f} % of the scenes are of grains")


if __name__ == "__main__":
    main()
