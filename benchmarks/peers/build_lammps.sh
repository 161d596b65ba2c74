#!/bin/sh
# Builds LAMMPS from Debian's own source; needs apt-get and the build tools of cmake/packages.sh.
#   build_lammps.sh DIR          DIR/build/lmp with the SPH package, which Debian's lammps lacks (-O2, as Debian does)
#   build_lammps.sh DIR native   DIR/native/lmp with the GRANULAR package for this machine (-O3 -march=native)
set -eu
dir=$(mkdir -p "$1" && cd "$1" && pwd)
cd "$dir"
cat >src.sources <<EOF
Types: deb-src
URIs: http://deb.debian.org/debian
Suites: bookworm
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
EOF
mkdir -p lists/partial
apt="-o Dir::Etc::sourceparts=$dir/none -o Dir::Etc::sourcelist=$dir/src.sources -o Dir::State::lists=$dir/lists"
# shellcheck disable=SC2086  # options are meant to be split
apt-get $apt update -q
# shellcheck disable=SC2086
apt-get $apt source -q --download-only lammps
tar xf lammps_*.orig.tar.xz
build=build package=SPH flags=-O2
[ "${2:-}" != native ] || build=native package=GRANULAR flags="-O3 -march=native"
cmake -S "$(ls -d lammps-*/)/cmake" -B $build -G Ninja -D CMAKE_BUILD_TYPE=Release \
  -D CMAKE_CXX_FLAGS_RELEASE="$flags -DNDEBUG" -D PKG_$package=on -D BUILD_MPI=on -D BUILD_OMP=off \
  -D WITH_JPEG=off -D WITH_PNG=off -D WITH_FFMPEG=off
cmake --build $build -j "$(nproc)"
