#!/bin/sh
# Makes the pictures of the repository anew, each entered with its commit and scenes in the pictures.json beside it
# (cmake/manifest.py; the test `pictures` compares). The tree must be committed.
#
#     sh cmake/pictures.sh            galleries and rising bubbles: three quarters of an hour of two cores
#     sh cmake/pictures.sh all        also dykes in gelatine, the bulk behaviour of grains and the partitions: some hours
#
# Runs are kept in out/pictures/COMMIT: what has come to its end there is only drawn.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh
which=${1:-quick}
if [ -n "$(git status --porcelain --untracked-files=no)" ]; then
  echo "pictures.sh: uncommitted changes: no commit could be named for the pictures" >&2
  exit 2
fi
runs=$PWD/out/pictures/$(git describe --always)
mkdir -p "$runs"

configure -DPEPERITE_BENCHMARKS=ON  # reads the commit that the programs will name
cmake --build build -j "$jobs"

sh apps/buoyant_cylinder/gallery.sh build/bin "$runs"
sh apps/sandbox/gallery.sh build/bin "$runs"
sh apps/magma_chamber/gallery.sh build/bin "$runs"
sh apps/volcano/gallery.sh build/bin "$runs"
/usr/bin/python3 -B benchmarks/accuracy/accuracy.py build --cases rising_bubble rising_bubble_2 --formulations default \
  --work "$runs/accuracy" --out "$runs/accuracy"
/usr/bin/python3 -B benchmarks/accuracy/bubbles.py "$runs/accuracy"
/usr/bin/python3 -B benchmarks/accuracy/accuracy.py build --cases heat_decay heat_layers barenblatt water_decay \
  --work "$runs/accuracy" --out "$runs/accuracy" --chart benchmarks/accuracy/exchanges.png
if [ "$which" = all ]; then
  sh apps/dyke/gallery.sh build/bin "$runs"
  /usr/bin/python3 -B benchmarks/bulk/bulk.py build --work "$runs/bulk"
  /usr/bin/python3 -B benchmarks/partitions.py build --work "$runs/partitions"
fi
