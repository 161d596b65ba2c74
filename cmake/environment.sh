# Sourced by demo.sh and check.sh from the repository's root: lets root run, and more ranks than cores without
# binding two jobs to the same core.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
# Where an OpenCL driver is installed, hwloc loads it into mpirun, whose signals then no longer reach the ranks.
export HWLOC_COMPONENTS=-opencl
jobs=$(nproc)

# configure [cmake options]: the Release build in build/, with the generator it has if there is one.
configure() {
  generator="-G Ninja"
  [ ! -f build/CMakeCache.txt ] || generator=
  # shellcheck disable=SC2086  # empty or two words
  cmake -S . -B build $generator -DCMAKE_BUILD_TYPE=Release "$@"
}
