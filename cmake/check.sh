#!/bin/sh
# Installs what is missing, builds everything, runs the tests and then random scenes of a fresh seed for a minute:
# up to an hour on two cores. With arguments, which go to ctest, these tests alone: sh cmake/check.sh -R lint.
# Those of a minute and more each are the ones of sh cmake/check.sh -L long.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh

sh cmake/packages.sh tests
configure -DPEPERITE_TESTS=ON -DPEPERITE_BENCHMARKS=ON
cmake --build build -j "$jobs"
if [ $# -gt 0 ]; then
  ctest --test-dir build --output-on-failure -j "$jobs" "$@"
else
  ctest --test-dir build --output-on-failure -j "$jobs" -LE long
  # A case that differs is printed with its command line; to keep it as a test, copy its case.json to tests/fuzz/kept.
  build/bin/bit_fuzz --minutes 1 --keep build/bit_fuzz_failures
fi
