#!/bin/sh
# Installs what is missing, builds, and runs the buoyant fluid cylinder, the sandbox until its first thrust and the first
# hour of the magma chamber on two ranks: ten minutes on a fresh machine with two cores, half of it for packages and compiler.
#
#     sh cmake/demo.sh [UNTIL [UNTIL_SAND [UNTIL_CHAMBER]]]     seconds of each, default: 10 2 3600
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh
until=${1:-10}      # of the scene's 20: ten seconds of run
until_sand=${2:-2}  # of the scene's 6.75, 2.4 cm of shortening: two minutes of run
until_chamber=${3:-3600}  # of the scene's seven hours

sh cmake/packages.sh
configure -DPEPERITE_TESTS=OFF -DPEPERITE_BENCHMARKS=OFF
cmake --build build -j "$jobs"

out=out/demo
number=2
while [ -e "$out" ]; do
  out=out/demo-$number
  number=$((number + 1))
done
mkdir -p out

mpirun -np 2 build/bin/buoyant_cylinder apps/buoyant_cylinder/fluid.toml --until "$until" --out "$out/cylinder"
/usr/bin/python3 apps/plot.py "$out/cylinder"

mpirun -np 2 build/bin/sandbox apps/sandbox/sandbox.toml --until "$until_sand" --out "$out/sandbox"
/usr/bin/python3 apps/sandbox/plot.py "$out/sandbox"

mpirun -np 2 build/bin/magma_chamber apps/magma_chamber/chamber.toml --until "$until_chamber" --out "$out/chamber"
/usr/bin/python3 apps/magma_chamber/plot.py "$out/chamber"

build/bin/peperite report "$out/cylinder" "$out/sandbox" "$out/chamber"

for run in cylinder sandbox chamber; do
  echo
  echo "In $PWD/$out/$run:"
  ls -1 "$out/$run" | sed 's/^/  /'
done
echo "a page of each run: report.html; pictures: *.png; numbers: series.csv, summary.txt, perf.json; ParaView: *.xdmf"
