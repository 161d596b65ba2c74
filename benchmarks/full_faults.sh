#!/bin/sh
# A fault at every file operation of a fluid and a grain run, on one and on three ranks of which one meets it: the
# process is killed there, the disk is full, once or from then on, or input and output fail (tests/system/fault_cases.py).
#   sh benchmarks/full_faults.sh [JOBS] [SEED]
# About 4,400 faults, a second each with two JOBS. Says what came of them; the exit status is 1 if anything was lost.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh
[ -d build ] || configure
cmake --build build --target peperite faulty_files
exec /usr/bin/python3 -B tests/system/fault_cases.py --programs build/bin --preload build/tests/libfaulty_files.so \
  --source . --jobs "${1:-2}" --seed "${2:-1}"
