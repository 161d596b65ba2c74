"""The MPI program that runs cases (fuzz_ranks), started again when a case has ended it."""

import json
import os
import queue
import random
import subprocess
import sys
import threading
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "system"))
from runner import ENVIRONMENT, kill_tree

RANKS = 8


class Bench:
    def __init__(self, programs, mpirun, timeout=120, perturb=None):
        self.command = [mpirun, "-n", str(RANKS), str(Path(programs) / "fuzz_ranks")]
        self.timeout, self.perturb = timeout, perturb
        self.process = None

    def close(self):
        if self.process:
            kill_tree(self.process.pid)
            self.process.wait()
        self.process = None

    def open(self):
        # Freshly allocated and freed memory is filled with a byte that is another in each start.
        byte = self.perturb if self.perturb is not None else random.randrange(1, 256)
        environment = {**os.environ, **ENVIRONMENT, "MALLOC_PERTURB_": str(byte)}
        self.process = subprocess.Popen(self.command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, text=True, bufsize=1)
        self.lines = queue.Queue()
        threading.Thread(target=self.read, args=(self.process, self.lines), daemon=True).start()

    @staticmethod
    def read(process, lines):
        for line in process.stdout:
            lines.put(line)
        lines.put(None)

    def run(self, job):
        """What fuzz_ranks says of the case: "reference" and "rows"; "died": why it did not live to say all, with "alone",
        "code" and "text" if some ranks threw and others did not."""
        if self.process is None or self.process.poll() is not None:
            self.open()
        self.process.stdin.write(json.dumps(job) + "\n")
        self.process.stdin.flush()
        other, reference = [], {}
        while True:
            try:
                line = self.lines.get(timeout=self.timeout)
            except queue.Empty:
                self.close()
                return reference | {"died": f"no answer in {self.timeout} s", "output": "".join(other[-30:])}
            if line is None:
                self.close()
                return reference | {"died": "the program ended", "output": "".join(other[-60:])}
            try:
                said = json.loads(line)
            except ValueError:
                other.append(line)
                continue
            if "alone" in said:
                self.close()
                return reference | said | {"died": "one rank threw alone"}
            if "rows" in said:
                return reference | said
            reference = said
