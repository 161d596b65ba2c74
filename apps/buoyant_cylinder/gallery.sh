#!/bin/sh
# Runs the solid, fluid and gas cases to 20 s and draws the pictures in gallery/: about four minutes.
# Cases that have already come to their end in RUNS are only drawn.
#
#     sh apps/buoyant_cylinder/gallery.sh [PROGRAMS] [RUNS] [RANKS]     default: build/bin out/gallery 2
set -eu
here=$(cd "$(dirname "$0")" && pwd)
programs=${1:-build/bin}
runs=${2:-out/gallery}
ranks=${3:-2}
. "$here/../../cmake/environment.sh"

for case in solid fluid gas; do
  if [ ! -f "$runs/$case/finished" ]; then
    mpirun -np "$ranks" "$programs/buoyant_cylinder" "$here/$case.toml" --out "$runs/$case" \
      --set output.snapshot_interval=0.4 --set output.average_time=0.2
    touch "$runs/$case/finished"
  fi
done

# draw NAME PICTURE "CASE ..." [arguments of plot.py]: PICTURE becomes gallery/NAME.png.
draw() {
  name=$1 picture=$2 folders= scenes=
  for case in $3; do folders="$folders $runs/$case" scenes="$scenes $here/$case.toml"; done
  shift 3
  # shellcheck disable=SC2086  # one word a case
  /usr/bin/python3 -B "$here/../plot.py" $folders "$@" --draw "$picture" --out "$runs" > /dev/null
  mv "$runs/$picture.png" "$here/gallery/$name.png"
  # shellcheck disable=SC2086
  /usr/bin/python3 -B "$here/../../cmake/manifest.py" "$here/gallery/$name.png" --runs $folders --scenes $scenes
  echo "$here/gallery/$name.png"
}

mkdir -p "$here/gallery"
for case in solid fluid gas; do
  draw "${case}_10s" particles "$case" --time 10
done
draw gas_fragmented particles gas --time 13.6
draw gas_pressure pressure gas --time 13.6 --average time
draw time_series series "solid fluid gas"
