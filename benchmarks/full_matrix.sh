#!/bin/sh
# The full product of the equivalence matrix (tests/system) in a seeded random order: 11,000 rows of grains, then 23,000
# of SPH.
#   sh benchmarks/full_matrix.sh [LOG] [PART/PARTS] [SEED] [STEPS]
# LOG is build/full_matrix.log by default; rows that it calls good over as many STEPS (2000) are not run again.
# PART/PARTS splits the work: 1/10 is a random tenth. Rows that fail are said, and the exit status is then 1.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh
log=${1:-build/full_matrix.log}
part=${2:-1/1}
seed=${3:-1}
steps=${4:-2000}
[ -d build ] || configure
cmake --build build --target equivalence
status=0
for family in --grains --sph; do
  mpirun -n 8 build/bin/equivalence --full $family --seed "$seed" --part "$part" --log "$log" --steps "$steps" || status=1
done
exit $status
