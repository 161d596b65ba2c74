"""The same by the program itself: peperite run, and resume where a row restarts."""

import json
import re
import shutil
import subprocess
import os
from pathlib import Path

from bench import ENVIRONMENT, kill_tree

HANGS = -1
KEPT = re.compile(r"; the state (is kept in|could not be kept:) .*")


def commands(case, row, folder, ranks=None):
    """Command lines, as words after `mpirun -n <ranks> build/bin/peperite`."""
    ranks = ranks or row["ranks"]
    settings = list(row.get("set", []))
    if row.get("cuts") in ("chaos", "replay"):  # a recording differs from chaos by its file alone
        settings += ["decomposition.balance=chaos", f"decomposition.chaos_seed={row['seed'] >> 1}"]
    words = [w for s in settings for w in ("--set", s)]
    last, scene = case["steps"][-1], f"{folder}/scene.toml"
    if "restart" not in row:
        return [(ranks, ["run", scene, "--out", f"{folder}/out", *words, "--steps", str(last)])]
    restart = row["restart"]
    files = ["--set", f"output.checkpoint_files={restart['files']}"]
    return [(ranks, ["run", scene, "--out", f"{folder}/out", *words, *files, "--steps", str(restart["at"])]),
            (restart["ranks"], ["resume", f"{folder}/out", "--steps", str(last)])]


class Program:
    def __init__(self, programs, mpirun):
        self.program, self.mpirun = Path(programs) / "peperite", mpirun

    def line(self, ranks, words):
        return [self.mpirun, "-n", str(ranks), str(self.program), *words]

    def run(self, case, row, folder, timeout=60):
        """Exit code, message, fingerprint and series of a row, of which {"ranks": 1} is the plain one."""
        shutil.rmtree(Path(folder) / "out", ignore_errors=True)
        for ranks, words in commands(case, row, folder):
            process = subprocess.Popen(self.line(ranks, words), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       text=True, env={**os.environ, **ENVIRONMENT})
            try:
                out, err = process.communicate(timeout=timeout)
            except subprocess.TimeoutExpired:
                kill_tree(process.pid)
                process.communicate()
                return {"code": HANGS, "text": f"no end in {timeout} s", "fingerprint": "", "series": ""}
            said = [KEPT.sub("", line) for line in err.splitlines() if line.startswith("peperite:")]
            result = {"code": process.returncode, "text": "\n".join(said), "fingerprint": "", "series": ""}
            if process.returncode != 0:
                result["output"] = err[-2000:]
                return result
            result["fingerprint"] = out.strip().splitlines()[-1] if out.strip() else ""
        series = Path(folder) / "out" / "series.csv"
        result["series"] = series.read_text() if series.exists() else ""
        return result


def feasible(result):
    """False where there were too few cells for so many ranks."""
    return not (result["code"] == 2 and "ranks" in result["text"] and "start fewer" in result["text"])


def shown(case, row, folder):
    """The row as anybody can type it."""
    lines = [f"mpirun -n {ranks} build/bin/peperite {' '.join(w if ' ' not in w else repr(w) for w in words)}"
             for ranks, words in commands(case, row, folder)]
    return " && ".join(lines) + ("   (from the particles of the lattice in another order)" if row.get("shuffle") else "")


def kept(path):
    return json.loads(Path(path).read_text())
