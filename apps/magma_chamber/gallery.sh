#!/bin/sh
# Runs the magma chamber for its seven hours and draws the pictures in gallery/: a quarter of an hour on two cores.
# A run that has already come to its end in RUNS is only drawn.
#
#     sh apps/magma_chamber/gallery.sh [PROGRAMS] [RUNS] [RANKS]     default: build/bin out/gallery 2
set -eu
here=$(cd "$(dirname "$0")" && pwd)
programs=${1:-build/bin}
runs=${2:-out/gallery}
ranks=${3:-2}
. "$here/../../cmake/environment.sh"

if [ ! -f "$runs/chamber/finished" ]; then
  mpirun -np "$ranks" "$programs/magma_chamber" "$here/chamber.toml" --out "$runs/chamber"
  touch "$runs/chamber/finished"
fi

mkdir -p "$here/gallery"
/usr/bin/python3 -B "$here/plot.py" "$runs/chamber" --times 3600,10800,17100 --out "$here/gallery"
/usr/bin/python3 -B "$here/../../cmake/manifest.py" "$here"/gallery/*.png \
  --runs "$runs/chamber" --scenes "$here/chamber.toml"
