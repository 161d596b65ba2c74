#!/bin/sh
# Runs the conduit and its map over viscosity and permeability, the freezing dyke, the dome and the edifice, and draws the pictures in
# gallery/: a quarter of an hour on two cores. Runs that have already come to their end in RUNS are only drawn.
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
/usr/bin/python3 -B "$here/../../cmake/manifest.py" "$here/gallery/conduit.png" \
  --runs "$runs/conduit" --scenes "$here/conduit.toml"

# picture SCENE NAME: NAME.png, which NAME.py makes of runs of the scene, and its entry.
picture() {
  /usr/bin/python3 -B "$here/$2.py" "$runs/$2" --programs "$programs" --out "$here/gallery"
  /usr/bin/python3 -B "$here/../../cmake/manifest.py" "$here/gallery/$2.png" --runs "$runs/$2"/* --scenes "$here/$1"
}
picture conduit.toml map
picture dyke.toml dyke
picture dome.toml dome
picture edifice.toml edifice
