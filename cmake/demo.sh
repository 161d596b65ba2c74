#!/bin/sh
# Installs what is missing, builds, and runs the buoyant fluid cylinder on two ranks: about ten minutes on a
# fresh machine with two cores, most of them for packages and compiler.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh
until=${1:-10}  # seconds of the scene, of its 20: half a minute of run

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

mpirun -np 2 build/bin/buoyant_cylinder apps/buoyant_cylinder/fluid.toml --until "$until" --out "$out"
/usr/bin/python3 apps/buoyant_cylinder/plot.py "$out"

echo
echo "In $PWD/$out:"
ls -1 "$out" | sed 's/^/  /'
echo "pictures and time series: *.png; numbers: series.csv; final report: perf.json; ParaView: *.xdmf"
