"""Format, length and wording."""

import re
import shutil
import subprocess

from source_files import at, cpp, files, text

TEXT = (".cpp", ".hpp", ".py", ".sh", ".cmake", ".in", ".txt", ".toml", ".json", ".md", ".yml", "run")
LONGEST = 400


def marked(root):
    """file:line of the lines that end in a comment "wrong" (fixtures)."""
    return {f"{path.relative_to(root)}:{number}"
            for path in files(root, "") for number, line in enumerate(text(path).splitlines(), 1)
            if re.search(r"(//|#|--) wrong$", line)}


def clang_format(root):
    tool = shutil.which("clang-format")
    if tool is None:
        return ["clang-format: not installed"]
    sources = [str(path) for path in cpp(root, "")]
    done = subprocess.run([tool, "--dry-run", "-Werror", *sources], capture_output=True, text=True)
    found = re.findall(r"^(.*?:\d+):\d+: (?:error|warning): .*clang-format-violations", done.stderr, re.M)
    if done.returncode != 0 and not found:
        return [f"clang-format: {done.stderr.strip()}"]
    places = sorted({place.removeprefix(f"{root}/") for place in found})
    return [f"{place}: run clang-format -i" for place in places]


def length(root):
    for path in files(root, ".cpp", ".hpp", ".py", ".sh", ".cmake", "CMakeLists.txt"):
        lines = text(path).count("\n")
        if lines > LONGEST:
            yield f"{path.relative_to(root)}:{lines}: {lines} lines; split it along a concept"


def _search(root, pattern, message):
    for path in files(root, *TEXT):
        source = text(path)
        for match in pattern.finditer(source):
            yield f"{at(root, path, source, match.start())}: {message.format(match[0])}"


def machine_path(root):
    """Nothing that is true of one machine only."""
    folders = "|".join(("work", "tmp", "root", "home", "scratch", "Users"))
    return _search(root, re.compile(rf"(?<![\w.}})>*/])/(?:{folders})\b(?:/[\w.]+)?"), "{}: a path of one machine")


def todo(root):
    words = "|".join(a + b for a, b in (("TO", "DO"), ("FIX", "ME"), ("XX", "X"), ("HA", "CK")))
    return _search(root, re.compile(rf"\b({words})\b"), "{}: do it, or describe it in an issue")


def header(root):
    """A header says what it is before anything else, and is included once."""
    for path in files(root, ".hpp"):
        lines = text(path).splitlines() or [""]
        if not lines[0].startswith("//"):
            yield f"{path.relative_to(root)}:1: begin with what it is, the equation and the invariant kept"
        if "#pragma once" not in lines:
            yield f"{path.relative_to(root)}:1: #pragma once"


def scene(root):
    """Every scene has a title; every scene of tests/scenes is named by a test, so none lies about unused."""
    sources = [p for p in files(root, ".cpp", ".hpp", ".py", ".sh", ".cmake", "CMakeLists.txt",
                                under=("tests", "benchmarks", "cmake"))]
    everything = "\n".join(text(p) for p in sources)
    for path in files(root, ".toml", under=("apps", "tests/scenes", "tests/compilers", "tests/accuracy")):
        if not re.search(r'^title = "', text(path), re.M):
            yield f"{path.relative_to(root)}:1: no title"
        in_tests = path.relative_to(root).parts[:2] == ("tests", "scenes")
        if in_tests and not re.search(rf"\b{path.stem}\b", everything):
            yield f"{path.relative_to(root)}:1: no test names this scene"
