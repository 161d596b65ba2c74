#!/bin/sh
# The same bits on arm64: on x86-64 with Debian 12 this gets a cross compiler, an emulator and, into build-arm64/root,
# the libraries for arm64 (of this system's packages none changes its architecture), builds, and runs the tests `recorded` and `fused`.
# Arguments go to ctest instead: sh cmake/arm64.sh -R '^(sph|decomp)'.
set -eu
cd "$(dirname "$0")/.."
. cmake/environment.sh

# apt as it would be on an arm64 system on which nothing is installed yet.
arm64_apt() {
  apt-get -q -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Install-Recommends=0 -o APT::Sandbox::User=root \
    -o Dir::State="$apt" -o Dir::State::status="$apt/status" -o Dir::Cache="$apt" \
    -o Dir::Etc::sourcelist="$apt/sources.list" -o Dir::Etc::sourceparts="$apt/none" "$@"
}

unpack_libraries() {
  apt=$PWD/build-arm64/apt
  mkdir -p "$apt/lists/partial" "$apt/archives/partial" "$apt/none" "$root/usr/bin" "$root/usr/lib" "$root/usr/sbin"
  : >"$apt/status"
  echo "deb http://deb.debian.org/debian $(. /etc/os-release && echo "$VERSION_CODENAME") main" >"$apt/sources.list"
  arm64_apt update
  # shellcheck disable=SC2046  # a list
  arm64_apt install -y --download-only $(grep -oE '(lib[a-z0-9-]+|nlohmann-json3)-dev' cmake/packages.sh)
  for directory in bin lib sbin; do ln -sfn usr/$directory "$root/$directory"; done
  for package in "$apt"/archives/*.deb; do dpkg-deb -x "$package" "$root"; done
  # Links and CMake's packages say /usr and mean the one below the root.
  find "$root/usr" -type l -lname '/*' -printf '%p %l\n' | while read -r link target; do ln -sfn "$root$target" "$link"; done
  find "$root/usr/lib" -name '*.cmake' -exec sed -i "s|\([\";:]\)/usr|\1$root/usr|g" {} +
  rm -rf "$apt"
}

sh cmake/packages.sh arm64
root=$PWD/build-arm64/root
if [ ! -e "$root/complete" ]; then
  rm -rf "$root"
  unpack_libraries
  touch "$root/complete"
fi
cmake --preset arm64
cmake --build --preset arm64 -j "$jobs"
export OMPI_MCA_btl_vader_single_copy_mechanism=none # the emulator does not let ranks read each other's memory
[ $# -gt 0 ] || set -- -R '^(recorded|fused)'
ctest --test-dir build-arm64 --output-on-failure "$@"
