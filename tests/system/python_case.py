"""Test cases of peperite.Simulation: in this process, or in scripts on several ranks."""
import os
import sys

from runner import Case, given


class PythonCase(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        paths = [str(cls.source / "apps/python"), str(given.module)]
        sys.path[:0] = paths
        cls.run_of.environment["PYTHONPATH"] = os.pathsep.join(paths)
        os.environ["PYTHONPATH"] = cls.run_of.environment["PYTHONPATH"]

    def python(self, ranks, *words, code=0, timeout=240):
        launch = [given.mpirun, "-n", ranks, "/usr/bin/python3", "-B", "-m", "mpi4py"] if ranks > 1 else ["/usr/bin/python3", "-B"]
        done = self.run_of.finish(self.run_of.start_command([*launch, *words]), timeout=timeout)
        self.assertEqual(done.code, code, done.err[-3000:])
        return done
