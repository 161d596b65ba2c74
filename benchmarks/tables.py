"""Tables of the pages, written by the scripts that measure them. A page has

    <!-- table NAME: COMMAND that measures it -->
    *commit, machine, date; remark*

    | table |
    <!-- end -->

and write() replaces what stands between the comments. The test `tables` compares those that committed files make.
"""

import os
import re
import subprocess
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent
MARKED = re.compile(r"<!-- table (?P<name>[\w-]+): (?P<command>[^\n]*) -->\n(?P<body>.*?)<!-- end -->", re.S)
ORIGIN = re.compile(r"\*[0-9a-f]{7,40}(-dirty)?[^\n]*, \d{4}-\d\d-\d\d[^\n]*\*")


def tables(page):
    """(command, body) by name."""
    return {m["name"]: (m["command"], m["body"]) for m in MARKED.finditer(Path(page).read_text())}


def without_origin(body):
    return ORIGIN.sub("", body, count=1).strip()


def write(page, name, origin, lines):
    page = Path(page)
    if name not in tables(page):
        raise SystemExit(f"{page}: no <!-- table {name}: ... --> to write into")

    def body(m):
        return m[0] if m["name"] != name else (f"<!-- table {name}: {m['command']} -->\n*{origin}*\n\n" +
                                               "\n".join(lines) + "\n<!-- end -->")

    page.write_text(MARKED.sub(body, page.read_text()))


def markdown(header, rows):
    return [f"| {' | '.join(map(str, row))} |" for row in (header, ["---"] * len(header), *rows)]


def machine():
    """What makes times comparable; no name of a host."""
    found = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    return f"{found[1].strip() if found else 'unknown processor'}, {os.cpu_count()} cores"


def cores_in_use(seconds=0.5):
    def ticks():
        user, nice, system, idle, waiting, *rest = map(int, Path("/proc/stat").read_text().split("\n")[0].split()[1:])
        busy = user + nice + system + sum(rest[:3])
        return busy, busy + idle + waiting

    before = ticks()
    time.sleep(seconds)
    busy, total = (after - b for after, b in zip(ticks(), before))
    return os.cpu_count() * busy / max(total, 1)


def turns(count):
    """Numbers of as many alternations; ends the script before one that other processes would disturb."""
    for turn in range(count):
        if (used := cores_in_use()) > 0.3:
            raise SystemExit(f"{used:.1f} cores are busy with something else: times would mean nothing")
        yield turn


def git(*words):
    return subprocess.run(["git", *words], cwd=root, check=True, capture_output=True, text=True).stdout.strip()


def last_commit(*paths):
    """That changed these files."""
    return git("log", "-1", "--format=%h", "--", *paths) + ("-dirty" if git("status", "--porcelain", "--", *paths) else "")


def commit_of(build):
    """Of the programs in a build folder."""
    said = subprocess.run([Path(build) / "bin/peperite", "--version"], check=True, capture_output=True, text=True).stdout
    return re.search(r"^git +(\S+)", said, re.M)[1]


def origin(commit, remark="", date=None):
    return f"{commit}, {machine()}, {date or time.strftime('%Y-%m-%d')}" + (f"; {remark}" if remark else "")
