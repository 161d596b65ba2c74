#!/bin/sh
# Installs what is missing, builds everything and runs all tests: 15 to 20 minutes on two cores.
# Arguments go to ctest, for example: sh cmake/check.sh -R lint
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh

sh cmake/packages.sh tests
configure -DPEPERITE_TESTS=ON -DPEPERITE_BENCHMARKS=ON
cmake --build build -j "$jobs"
ctest --test-dir build --output-on-failure -j "$jobs" "$@"
