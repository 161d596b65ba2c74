#!/bin/sh
# Runs the conduit, and its map over viscosity and permeability, and draws the pictures in gallery/: a minute on two cores.
# Runs that have already come to their end in RUNS are only drawn.
#
#     sh apps/volcano/gallery.sh [PROGRAMS] [RUNS] [RANKS]     default: build/bin out/gallery 2
set -eu
here=$(cd "$(dirname "$0")" && pwd)
programs=${1:-build/bin}
runs=${2:-out/gallery}
ranks=${3:-2}
. "$here/../../cmake/environment.sh"

if [ ! -f "$runs/conduit/finished" ]; then
  mpirun -np "$ranks" "$programs/peperite" run "$here/conduit.toml" --out "$runs/conduit"
  touch "$runs/conduit/finished"
fi

mkdir -p "$here/gallery"
/usr/bin/python3 -B "$here/../plot.py" "$runs/conduit" --draw particles --out "$runs/conduit" > /dev/null
mv "$runs/conduit/particles.png" "$here/gallery/conduit.png"
/usr/bin/python3 -B "$here/../plotting/manifest.py" "$here/gallery/conduit.png" \
  --runs "$runs/conduit" --scenes "$here/conduit.toml"
/usr/bin/python3 -B "$here/map.py" "$runs/map" --programs "$programs" --out "$here/gallery"
/usr/bin/python3 -B "$here/../plotting/manifest.py" "$here/gallery/map.png" \
  --runs "$runs"/map/eta_* --scenes "$here/conduit.toml"
