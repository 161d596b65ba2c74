#!/bin/sh
# Runs the sandbox and its shear boxes and draws the pictures in gallery/: about a quarter of an hour on two cores.
# Cases that have already come to their end in RUNS are only drawn.
#
#     sh apps/sandbox/gallery.sh [PROGRAMS] [RUNS] [RANKS]     default: build/bin out/gallery 2
set -eu
here=$(cd "$(dirname "$0")" && pwd)
programs=${1:-build/bin}
runs=${2:-out/gallery}
ranks=${3:-2}
. "$here/../../cmake/environment.sh"

for case in shear_sand shear_floor sandbox; do
  if [ ! -f "$runs/$case/finished" ]; then
    # The boxes are too small for more than one rank.
    [ "$case" = sandbox ] && np=$ranks || np=1
    mpirun -np "$np" "$programs/sandbox" "$here/$case.toml" --out "$runs/$case"
    touch "$runs/$case/finished"
  fi
done

mkdir -p "$here/gallery"
folders="$runs/sandbox $runs/shear_sand $runs/shear_floor"
# shellcheck disable=SC2086  # one word a run
/usr/bin/python3 -B "$here/plot.py" $folders --out "$here/gallery"
# shellcheck disable=SC2086
/usr/bin/python3 -B "$here/../../cmake/manifest.py" "$here"/gallery/*.png "$here/gallery/summary.txt" --runs $folders \
  --scenes "$here/sandbox.toml" "$here/shear_sand.toml" "$here/shear_floor.toml"
