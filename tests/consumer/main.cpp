// The least a program needs: a scene, five steps, the fingerprint.
#include <mpi.h>

#include <cstdio>

#include "decomp/comm.hpp"
#include "sph/scene.hpp"
#include "sph/simulation.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  MPI_Init(&argc, &argv);
  {
    const decomp::Comm comm(MPI_COMM_WORLD);
    sph::Simulation simulation(comm, sph::read_scene(argv[1], {}));
    for (int step = 0; step < 5; ++step) simulation.step();
    std::printf("fingerprint %s step %lld\n", simulation.fingerprint().c_str(),
                static_cast<long long>(simulation.global().step));
  }
  MPI_Finalize();
}
