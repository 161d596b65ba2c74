#!/bin/sh
# Installs the Debian packages that are missing: `packages.sh` for building and running, `packages.sh tests`
# for the tests too, `packages.sh docs` for the site of the documents alone, `packages.sh arm64` for cmake/arm64.sh. On a system
# without apt-get it names them and goes on.
set -eu

packages="g++ cmake ninja-build pkg-config git
  libopenmpi-dev openmpi-bin libhdf5-openmpi-dev zlib1g-dev libeigen3-dev libmetis-dev libtomlplusplus-dev libcli11-dev
  libfmt-dev nlohmann-json3-dev libxxhash-dev libsleef-dev libassimp-dev
  python3 python3-h5py python3-jinja2 python3-matplotlib python3-numpy python3-pil libjs-dygraphs
  python3-dev python3-mpi4py pybind11-dev"
documents="python3-sphinx python3-myst-parser furo doxygen"
if [ "${1-}" = tests ]; then
  packages="$packages $documents clang clang-format libgtest-dev librapidcheck-dev libbenchmark-dev python3-scipy python3-vtk9 chromium"
elif [ "${1-}" = docs ]; then
  packages="python3 python3-h5py python3-jinja2 python3-matplotlib $documents"
elif [ "${1-}" = arm64 ]; then
  packages="g++-aarch64-linux-gnu qemu-user-static cmake ninja-build pkg-config git openmpi-bin python3"
fi

missing=
for package in $packages; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) || status=absent
  [ "$status" = installed ] || missing="$missing $package"
done
if [ -z "$missing" ]; then
  echo "packages: all present"
  exit 0
fi
if ! command -v apt-get >/dev/null; then
  echo "packages: no apt-get here; needed, by their Debian names:$missing"
  exit 0
fi

as_root=
[ "$(id -u)" = 0 ] || as_root=sudo
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "packages: installing$missing"
# shellcheck disable=SC2086  # the list is meant to be split
if ! { $as_root apt-get update -q && $as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends $missing; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "packages: apt-get failed" >&2
  exit 1
fi
