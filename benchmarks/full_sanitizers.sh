#!/bin/sh
# What the tests do not run for its price: everything under sanitizers, where halo and fresh memory are poisoned too
# (libdecomp/include/decomp/poison.hpp), and short runs under valgrind.
#   sh benchmarks/full_sanitizers.sh [unit] [scenes] [fuzz] [valgrind]      all of them by default
# unit: all unit tests on 1 and 3 ranks; scenes: tests/scenes and tests/compilers/scenes on 1 and 3 ranks, their
# fingerprints those of the release build; fuzz: 500 random cases; valgrind: a build for any x86-64 on 2 ranks.
# Builds lie in build-asan and build-baseline, or where BUILDS says; FUSIONS may name sources of few fusions
# (tests/compilers/few_fusions_*.cpp), which are compiled sooner.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh
parts=${*:-unit scenes fuzz valgrind}
builds=${BUILDS:-.}
asan=$builds/build-asan
baseline=$builds/build-baseline
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
# Open MPI and its helpers leak at their end.
export ASAN_OPTIONS=detect_leaks=0:abort_on_error=0 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
scenes="tests/compilers/scenes/*.toml tests/scenes/*.toml"

wants() { case " $parts " in *" $1 "*) ;; *) return 1 ;; esac; }

build() {  # preset, folder, targets
  cmake --preset "$1" -B "$2" -DPEPERITE_TESTS=ON ${FUSIONS:+"-DPEPERITE_FUSIONS=$FUSIONS"} >/dev/null
  shift
  folder=$1
  shift
  cmake --build "$folder" -j "$jobs" --target "$@"
}

print_of() { tail -n 1 "$1" | grep '^fingerprint'; }

run_scenes() {  # what goes before the program, its folder, ranks, steps
  for scene in $scenes; do
    name=$(basename "$scene" .toml)
    echo "$name on $3 ranks"
    mpirun -n "$3" $1 "$2/bin/peperite" run "$scene" --steps "$4" --out "$out/$name.$3" >"$out/log" 2>"$out/errors" ||
      { cat "$out/errors"; echo "FAILED: $scene on $3 ranks"; exit 1; }
    build/bin/peperite run "$scene" --steps "$4" --out "$out/$name.plain.$3" >"$out/plain" 2>/dev/null
    [ -n "$(print_of "$out/log")" ] && [ "$(print_of "$out/log")" = "$(print_of "$out/plain")" ] || { echo "FAILED: other bits of $scene"; exit 1; }
  done
}

[ -d build ] || configure
cmake --build build -j "$jobs" --target peperite
if wants unit || wants scenes || wants fuzz; then
  build asan "$asan" peperite fuzz_ranks
fi
if wants unit; then
  cmake --build "$asan" -j "$jobs" --target test_sph test_decomp
  for ranks in 1 3; do
    mpirun -n $ranks "$asan/bin/test_decomp" --gtest_brief=1 --gtest_filter=-Balance.*
    mpirun -n $ranks "$asan/bin/test_sph" --gtest_brief=1
  done
  "$asan/bin/test_decomp" --gtest_brief=1 --gtest_filter=Balance.*  # no MPI in it
fi
if wants scenes; then
  run_scenes "" "$asan" 1 5
  run_scenes "" "$asan" 3 5
fi
if wants fuzz; then
  build/bin/bit_fuzz --programs "$asan/bin" --seed "${SEED:-1}" --cases 500 --timeout 600 --go-on --keep build/bit_fuzz_failures
fi
if wants valgrind; then
  few=$PWD/tests/compilers/few_fusions
  FUSIONS="${FUSIONS:-$few"_2d.cpp;"$few"_3d.cpp"}"  # valgrind is slow: the scenes that need no more
  build baseline "$baseline" peperite
  scenes="tests/compilers/scenes/*.toml tests/scenes/grains_pour.toml tests/scenes/grains_servo.toml"
  supp=$(find /usr/share/openmpi /usr/lib -name openmpi-valgrind.supp 2>/dev/null | head -n 1)
  run_scenes "valgrind -q --error-exitcode=9 --suppressions=$supp --suppressions=benchmarks/valgrind.supp" "$baseline" 2 2
fi
echo "all clean: $parts"
