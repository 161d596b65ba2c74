#!/bin/sh
# Hours of random scenes (tests/fuzz): every case of a seed, in the release build, then with poisoned memory, then under
# sanitizers. Interrupted and started again it goes on where it was.
#   sh benchmarks/full_fuzz.sh [LOG] [SEED] [MINUTES of release] [of poison] [of sanitizers]
# LOG is build/full_fuzz.log by default, with .poison and .asan beside it: one line a case. Cases that differ are kept in
# build/bit_fuzz_failures; the exit status is then 1.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh
log=${1:-build/full_fuzz.log}
seed=${2:-1}
status=0

fuzz() {  # folder of the programs, log, minutes
  if [ "$3" = 0 ]; then return; fi
  build/bin/bit_fuzz --programs "$1" --seed "$seed" --minutes "$3" --log "$2" --go-on --keep build/bit_fuzz_failures ||
    status=1
  awk '{ kinds[$2]++ } /Random grains/ && $2 == "ok" { grains++ }
    END { for (k in kinds) printf "%d %s, ", kinds[k], k; printf "%d ok of grains\n", grains }' "$2"
}

[ -d build ] || configure
cmake --build build -j "$jobs" --target fuzz_ranks peperite poisoned_fuzz_ranks poisoned_peperite
fuzz build/bin "$log" "${3:-120}"
fuzz build/bin/poisoned "$log.poison" "${4:-60}"
if [ "${5:-60}" != 0 ]; then
  cmake --preset asan >/dev/null
  cmake --build build-asan -j "$jobs" --target fuzz_ranks peperite
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
  fuzz build-asan/bin "$log.asan" "${5:-60}"
fi
exit $status
