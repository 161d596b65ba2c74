#!/usr/bin/python3
"""Which commit and which scenes made a picture: pictures.json beside the pictures of the repository.

    manifest.py PICTURE [PICTURE ...] --runs DIR [DIR ...] --scenes FILE [FILE ...]

Enters each picture (or other file) with its hash, the commit of the programs that made the runs, as their perf.json
has it, the fingerprints of these, and the hashes of the scenes. The test `pictures` compares.
"""

import argparse
import hashlib
import json
import sys
import tomllib
from pathlib import Path

NAME = "pictures.json"
root = Path(__file__).resolve().parents[1]


def digest(data):
    return hashlib.sha256(data).hexdigest()[:16]


def hash_of(path):
    return digest(Path(path).read_bytes())


def scene_hash(text):
    """Of what a scene says, comments apart."""
    return digest(json.dumps(tomllib.loads(text), sort_keys=True).encode())


def read(folder):
    path = Path(folder) / NAME
    return json.loads(path.read_text()) if path.exists() else {}


def write(folder, entries):
    (Path(folder) / NAME).write_text(json.dumps(entries, indent=1, sort_keys=True) + "\n")


def record(pictures, runs, scenes):
    """The runs must be of one commit."""
    perf = [json.loads((Path(run) / "perf.json").read_text()) for run in runs]
    commits = sorted({p["build"]["git"] for p in perf})
    if len(commits) != 1:
        raise ValueError(f"runs of {len(commits)} commits: {', '.join(commits)}")
    for picture in map(Path, pictures):
        entries = read(picture.parent)
        entries[picture.name] = {
            "commit": commits[0], "sha256": hash_of(picture),
            "fingerprints": {Path(run).name: p["fingerprint"] for run, p in zip(runs, perf)},
            "scenes": {Path(s).resolve().relative_to(root).as_posix(): scene_hash(Path(s).read_text())
                       for s in sorted(map(str, scenes))}}
        write(picture.parent, entries)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pictures", nargs="+")
    parser.add_argument("--runs", nargs="+", required=True)
    parser.add_argument("--scenes", nargs="+", required=True)
    given = parser.parse_args()
    record(given.pictures, given.runs, given.scenes)


if __name__ == "__main__":
    sys.exit(main())
