#!/usr/bin/python3
"""Random legal scenes, each run in random ways on 1 to 8 ranks: fingerprint, exit code and message must be those of
the plain run on one rank. A case that differs is made smaller and printed as a scene and a command line.

  bit_fuzz                        cases of a fresh seed until interrupted
  bit_fuzz --seed S --minutes 3   for three minutes; --cases N: so many; --from K: from that number on
  bit_fuzz --seed S --case K      one case, as printed; --keep DIR: its files there
  bit_fuzz --replay FILE...       cases that were kept
  bit_fuzz --print --cases N      the fingerprints of the runs on one rank, for comparisons of builds
"""

import argparse
import collections
import json
import os
import shutil
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import cases
import shrink
from bench import Bench
from judge import Judge, job
from program import Program, kept, shown


class OneLineParser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"bit_fuzz: {message}; see bit_fuzz --help\n")


def options():
    here = Path(sys.argv[0]).absolute().parent
    parser = OneLineParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, help="of everything; default: drawn")
    parser.add_argument("--case", type=int, help="this one alone")
    parser.add_argument("--from", dest="first", type=int, default=0, metavar="K", help="the first case")
    parser.add_argument("--cases", type=int, default=10**9, help="so many")
    parser.add_argument("--minutes", type=float, default=1e9, help="begin no case later")
    parser.add_argument("--only", choices=["sph", "grains", "melts"], help="scenes of one kind")
    parser.add_argument("--replay", nargs="+", default=[], type=Path, metavar="FILE", help="kept cases")
    parser.add_argument("--print", action="store_true", help="print fingerprints of one rank, compare nothing")
    parser.add_argument("--program", type=int, default=40, metavar="N",
                        help="every N-th case is run by peperite itself, with all its files; 0: none")
    parser.add_argument("--go-on", action="store_true", help="do not end at the first case that differs")
    parser.add_argument("--no-shrink", action="store_true", help="print cases that differ as they are")
    parser.add_argument("--keep", type=Path, help="folder for cases that differ; default: here, bit_fuzz_failures")
    parser.add_argument("--log", type=Path, help="append a line on each case, and go on after its last of this seed")
    parser.add_argument("--programs", type=Path, default=here, help="folder of fuzz_ranks and peperite")
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--timeout", type=float, default=120, help="of a case [s]")
    parser.add_argument("--loose", action="store_true", help="messages may name other particles and numbers")
    parser.add_argument("--verbose", action="store_true")
    return parser.parse_args()


class Session:
    def __init__(self, o):
        self.o = o
        self.seed = o.seed if o.seed is not None else int.from_bytes(os.urandom(4), "little")
        self.folder = Path(tempfile.mkdtemp(prefix="bit_fuzz_"))
        self.keep = o.keep or Path("bit_fuzz_failures")
        self.judge = Judge(Bench(o.programs, o.mpirun, o.timeout), Program(o.programs, o.mpirun), self.folder / "case", o.loose)
        self.differ, self.begin, self.why = 0, time.monotonic(), collections.Counter()

    def close(self):
        self.judge.bench.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def first(self):
        if not (self.o.log and self.o.log.exists()):
            return self.o.first
        numbers = [int(line.split()[0].split("/")[1]) for line in self.o.log.read_text().splitlines()
                   if line.startswith(f"{self.seed}/")]
        return max(numbers, default=self.o.first - 1) + 1

    def all(self):
        if self.o.replay:
            for path in self.o.replay:
                yield kept(path)
            return
        first = self.o.case if self.o.case is not None else self.first()
        for number in range(first, first + (1 if self.o.case is not None else self.o.cases)):
            if time.monotonic() - self.begin > 60 * self.o.minutes:
                return
            yield cases.make(self.seed, number, self.o.only)

    def print_all(self):
        """One line a case: what any build must say."""
        for case in self.all():
            said = self.judge.bench.run(job(case | {"rows": []}, cases.write(case, self.judge.folder)))
            plain = said.get("reference", {"code": "died", "text": "", "fingerprints": {}})
            text = plain["text"].replace(str(self.judge.folder), "").replace("\n", " ")
            print(case["name"], plain["code"], *plain["fingerprints"].values(), text, flush=True)
        return 0

    def run(self):
        if self.o.print:
            return self.print_all()
        print(f"seed {self.seed}", flush=True)
        for number, case in enumerate(self.all()):
            by_program = self.o.program > 0 and number % self.o.program == self.o.program - 1
            start = time.monotonic()
            verdict = self.judge.judge(case, by_program and not self.o.replay)
            self.note(case, verdict, time.monotonic() - start)
            if verdict.kind == "differs":
                self.differ += 1
                self.tell(case, verdict)
                if not self.o.go_on and not self.o.replay:
                    break
        self.summary()
        return 1 if self.differ else 0

    def note(self, case, verdict, seconds):
        if verdict.kind == "refused":
            self.why[verdict.what.split(": ", 1)[-1][:90]] += 1
        line = f"{case['name']} {verdict.kind} {seconds:.2f} s {case['scene'].get('title', '')}: {verdict.what[:300]!r}"
        if self.o.verbose:
            print(line, flush=True)
        if self.o.log:
            with self.o.log.open("a") as log:
                log.write(line + "\n")

    def tell(self, case, verdict):
        print(f"DIFFERS: case {case['name']}: {verdict.what}", flush=True)
        if not self.o.no_shrink:
            case, verdict = shrink.smallest(self.judge, case, verdict)
            print(f"smallest: {verdict.what}")
        folder = self.keep / case["name"].replace("/", "_")
        shutil.rmtree(folder, ignore_errors=True)
        cases.write(case, folder)
        (folder / "case.json").write_text(json.dumps(case, indent=1) + "\n")
        for row in [verdict.row] if verdict.row else case["rows"]:
            print("  " + shown(case, {"ranks": 1}, folder))
            print("  " + shown(case, row, folder))
        print(f"  again: bit_fuzz --replay {folder}/case.json   (whole: --seed {case['name'].replace('/', ' --case ')})",
              flush=True)

    def summary(self):
        counts, n = self.judge.counts, max(1, self.judge.counts["scenes"])
        minutes = (time.monotonic() - self.begin) / 60
        rows = max(1, counts["rows"])
        print(f"{counts['scenes']} scenes ({counts['grains']} of grains) in {counts['rows']} rows, {self.differ} differ; "
              f"{minutes:.1f} min, {counts['scenes'] / max(minutes, 1e-3) * 60:.0f} scenes an hour")
        print(f"refused as input {100 * counts['refused'] / n:.1f} %, ended by a guard {100 * counts['guards'] / n:.1f} %, "
              f"by one rank alone {counts['alone']}, run by the program {counts['by program']}; "
              f"{counts['particles'] / n:.0f} particles a scene")
        print(f"rows with particles in a halo {100 * counts['shared'] / rows:.0f} %, that migrated "
              f"{100 * counts['migrated'] / rows:.0f} %, that rebuilt lists {100 * counts['rebuilt'] / rows:.0f} %")
        for text, times in self.why.most_common(8 if self.o.verbose else 0):
            print(f"  refused {times} times: {text}")


def main():
    session = Session(options())
    try:
        code = session.run()
    except KeyboardInterrupt:
        session.summary()
        code = 1 if session.differ else 0
    finally:
        session.close()
    sys.exit(code)


if __name__ == "__main__":
    main()
