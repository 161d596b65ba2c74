#!/bin/sh
# Runs a dyke that stays, one that rises, and one that turns into a sill, and draws them in gallery/: a quarter of an hour on two cores.
# Runs that have already come to their end in RUNS are only drawn.
#
#     sh apps/dyke/gallery.sh [PROGRAMS] [RUNS]     default: build/bin out/gallery
set -eu
here=$(cd "$(dirname "$0")" && pwd)
programs=${1:-build/bin}
runs=${2:-out/gallery}

mkdir -p "$here/gallery"
/usr/bin/python3 -B "$here/rise.py" "$runs/rise" --programs "$programs" --out "$here/gallery"
/usr/bin/python3 -B "$here/../../cmake/manifest.py" "$here/gallery/rise.png" --runs "$runs/rise"/* --scenes "$here/stall.toml"
/usr/bin/python3 -B "$here/sill.py" "$runs/sill" --programs "$programs" --out "$here/gallery"
/usr/bin/python3 -B "$here/../../cmake/manifest.py" "$here/gallery/sill.png" --runs "$runs/sill"/* --scenes "$here/sill.toml"
