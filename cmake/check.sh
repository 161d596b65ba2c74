#!/bin/sh
# Installs what is missing, builds everything, runs all tests and then random scenes of a fresh seed for a minute:
# up to an hour on two cores. With arguments, which go to ctest, these tests alone: sh cmake/check.sh -R lint
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh

sh cmake/packages.sh tests
configure -DPEPERITE_TESTS=ON -DPEPERITE_BENCHMARKS=ON
cmake --build build -j "$jobs"
ctest --test-dir build --output-on-failure -j "$jobs" "$@"
# A case that differs is printed with its command line; to keep it as a test, copy its case.json to tests/fuzz/kept.
[ $# -gt 0 ] || build/bin/bit_fuzz --minutes 1 --keep build/bit_fuzz_failures
