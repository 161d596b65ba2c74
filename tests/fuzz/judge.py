"""Does a row agree with the run on one rank? Fingerprints at the compared steps, exit code and message must."""

import re
from pathlib import Path

import cases
import program as programs

INPUT, GUARD = 2, 3


def job(case, scene):
    return {"case": case["name"], "scene": str(scene), "steps": case["steps"], "rows": case["rows"]}


class Verdict:
    def __init__(self, kind, what="", row=None):
        self.kind, self.what, self.row = kind, what, row  # kind: ok, refused, differs


def first_difference(reference, row):
    for step in sorted(set(reference["fingerprints"]) | set(row["fingerprints"]), key=int):
        a, b = reference["fingerprints"].get(step), row["fingerprints"].get(step)
        if a != b:
            return f"step {step}: {b or 'not reached'} instead of {a or 'no such step'}"
    return ""


def compare(reference, row, loose=False):
    """The empty text if they agree. `loose`: whatever particles and numbers a message names."""
    if loose and reference["code"] == row["code"] != 0:
        masked = lambda text: re.sub(r"\bon another rank|\"\w+\"|-?[0-9.]+(e[-+]?[0-9]+)?", "#", text)
        if masked(reference["text"])[:40] == masked(row["text"])[:40]:
            row = row | {"text": reference["text"]}
    if row["code"] == INPUT and reference["code"] != INPUT:
        return f"refused: {row['text']}"
    if (row["code"], row["text"]) != (reference["code"], reference["text"]):
        return (f"exit {row['code']} \"{row['text']}\" instead of {reference['code']} \"{reference['text']}\""
                f"; {first_difference(reference, row)}")
    return first_difference(reference, row)


class Judge:
    def __init__(self, bench, program, folder, loose=False):
        self.loose = loose
        self.bench, self.program, self.folder = bench, program, Path(folder)
        self.particles = 0  # of the last case
        self.counts = {"scenes": 0, "rows": 0, "refused": 0, "guards": 0, "alone": 0, "by program": 0, "grains": 0,
                       "shared": 0, "migrated": 0, "rebuilt": 0, "particles": 0}

    def judge(self, case, by_program=False):
        """Runs a case. The reference's own errors are outcomes that rows must have too."""
        scene = cases.write(case, self.folder)
        if by_program:
            return self.by_program(case)
        said = self.bench.run(job(case, scene))
        if "died" in said:
            return self.died(case, said)
        reference = said["reference"]
        self.count(case, said)
        if reference["text"].startswith("internal error"):
            return Verdict("differs", reference["text"], {"ranks": 1})
        if reference["code"] == INPUT:
            return Verdict("refused", reference["text"])
        for row, outcome in zip(case["rows"], said["rows"]):
            if what := compare(reference, outcome, self.loose):
                return Verdict("differs", what, row)
        return Verdict("ok", reference["text"])

    def count(self, case, said):
        counts, reference = self.counts, said["reference"]
        self.particles = reference["particles"]
        counts["scenes"] += 1
        counts["refused"] += reference["code"] == INPUT
        counts["guards"] += reference["code"] == GUARD
        counts["grains"] += case["scene"]["group"][0]["kind"] == "grain" and reference["code"] != INPUT
        counts["particles"] += reference["particles"]
        for row in said["rows"]:
            counts["rows"] += 1
            counts["shared"] += row["shared"] > 0
            counts["migrated"] += row["migrated"] > 0
            counts["rebuilt"] += row["rebuilds"] > 2

    def died(self, case, said):
        """A rank alone cannot tell the others, but the program would say what it said, and end with its exit code."""
        if "alone" not in said:
            # Which row? The program is tried, each with a time limit.
            verdict = self.by_program(case)
            if verdict.kind == "differs":
                return verdict
            return Verdict("differs", f"{said['died']}\n{said.get('output', '')}", case["rows"][0])
        self.counts["alone"] += 1
        self.count(case, said | {"rows": []})
        row = case["rows"][int(said["alone"].split(" row ")[1])]
        outcome = {"code": said["code"], "text": said["text"], "fingerprints": said["reference"]["fingerprints"]}
        if what := compare(said["reference"], outcome, self.loose):
            return Verdict("differs", f"{what} (on rank {said['rank']} alone)", row)
        return Verdict("ok", said["text"])

    def by_program(self, case):
        reference = self.program.run(case, {"ranks": 1}, self.folder)
        self.counts["by program"] += 1
        self.counts["scenes"] += 1
        self.counts["guards"] += reference["code"] == GUARD
        self.counts["grains"] += case["scene"]["group"][0]["kind"] == "grain" and reference["code"] != INPUT
        if reference["code"] == INPUT:
            self.counts["refused"] += 1
            return Verdict("refused", reference["text"])
        for row in case["rows"]:
            if row.get("shuffle"):
                continue
            result = self.program.run(case, row, self.folder)
            for _ in range(8):
                if programs.feasible(result):
                    break
                row = row | {"ranks": max(1, row["ranks"] - 1)} | (
                    {"restart": row["restart"] | {"ranks": max(1, row["restart"]["ranks"] - 1)}} if "restart" in row else {})
                result = self.program.run(case, row, self.folder)
            self.counts["rows"] += 1
            for key in ("code", "text", "fingerprint", "series"):
                if key == "text" and self.loose:
                    continue
                if result[key] != reference[key]:
                    return Verdict("differs", f"the program's {key}: {result[key]!r:.600} instead of {reference[key]!r:.600}", row)
        return Verdict("ok", reference["text"])
