"""The files of a tree, and C++ text without comments and literals."""

import pathlib
import re

SKIPPED = re.compile(r"^(build|out)|^(\.git|__pycache__|fixtures)$")


def files(root, *suffixes, under=("",)):
    """Paths below the folders `under` of root with one of the suffixes ("" is any), build trees and the lint's own
    fixtures left out. A suffix may be a whole name."""
    root = pathlib.Path(root)
    for folder in under:
        for path in sorted((root / folder).rglob("*")):
            relative = path.relative_to(root)
            if path.is_file() and not any(SKIPPED.search(part) for part in relative.parts[:-1]):
                if any(path.name.endswith(suffix) for suffix in suffixes):
                    yield path


def cpp(root, *under):
    return files(root, ".cpp", ".hpp", under=under)


def text(path):
    return path.read_text(encoding="utf-8", errors="replace")


_TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<tag>[^(\s]*)\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*'", re.S)


def code(path):
    """The text of a C++ file with comments and literals blanked: same lines, same columns. Names of includes stay."""

    def blank(match):
        line_start = match.string.rfind("\n", 0, match.start()) + 1
        if match.string[line_start : match.start()].lstrip().startswith("#include"):
            return match[0] if match[0].startswith('"') else " " * len(match[0])
        return re.sub(r"[^\n]", " ", match[0])

    return _TOKEN.sub(blank, text(path))


def at(root, path, source, position):
    """file:line of a position in the text."""
    return f"{path.relative_to(root)}:{source.count(chr(10), 0, position) + 1}"
