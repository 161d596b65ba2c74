#!/usr/bin/python3
"""The pictures of the repository are those that pictures.json beside them names, made by a commit of theirs from
the scenes as they are. cmake/pictures.sh makes them anew.

    test_pictures.py --source .
"""
import argparse
import re
import subprocess
import sys
import unittest
from pathlib import Path

FOLDERS = ("apps", "benchmarks")


def git(*arguments):
    """What git says; None outside a repository, or where it has no history to look into."""
    done = subprocess.run(["git", *arguments], cwd=given.source, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else None


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = Path(given.source).resolve()
        sys.path.append(str(cls.source / "cmake"))
        global manifest
        import manifest
        cls.manifests = {path.parent: manifest.read(path.parent)
                         for folder in FOLDERS for path in (cls.source / folder).rglob(manifest.NAME)}

    def entries(self):
        for folder, entries in sorted(self.manifests.items()):
            for name, entry in sorted(entries.items()):
                yield folder / name, entry

    def test_every_picture_is_the_one_in_its_manifest(self):
        pictures = {path for folder in FOLDERS for path in (self.source / folder).rglob("*.png")}
        listed = dict(self.entries())
        for path in sorted(pictures):
            self.assertTrue(path in listed, f"{path} is in no {manifest.NAME}: make it with cmake/pictures.sh")
        for path, entry in listed.items():
            self.assertTrue(path.is_file(), f"{path} is missing")
            self.assertEqual(manifest.hash_of(path), entry["sha256"], f"{path} is not the one that was entered")

    def test_scenes_are_those_of_the_pictures(self):
        for path, entry in self.entries():
            self.assertTrue(entry["scenes"], path)
            for scene, was in entry["scenes"].items():
                with self.subTest(picture=path.name, scene=scene):
                    self.assertEqual(manifest.scene_hash((self.source / scene).read_text()), was,
                                     "the scene has changed since the picture was made: cmake/pictures.sh")

    def test_each_names_the_commit_that_made_it(self):
        """Prints how old each is. Histories may be shallow or squashed: a commit need not be in this one."""
        for path, entry in self.entries():
            self.assertRegex(entry["commit"], re.compile(r"[0-9a-f]{7,40}\Z"), f"{path}: not made by a commit")
            age = git("rev-list", "--count", f"{entry['commit']}..HEAD")
            print(f"{path.relative_to(self.source)}: {entry['commit']}, {age or '?'} commits ago")

    def test_pages_show_pictures_that_are_there(self):
        shown = [(page.parent / name) for top in ("", "apps", "benchmarks", "libsph", "libdecomp", "tests")
                 for page in (self.source / top).glob("*.md" if top == "" else "**/*.md")
                 for name in re.findall(r"!\[[^]]*\]\(([^)]*)\)", page.read_text())]
        self.assertTrue(shown)
        for path in shown:
            self.assertTrue(path.is_file(), path)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", required=True)
    given, names = parser.parse_known_args()
    unittest.main(argv=sys.argv[:1] + names)
