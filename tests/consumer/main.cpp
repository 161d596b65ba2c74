// What a program needs that runs scenes: a scene, some steps, the fingerprint. This one brings a contact law,
// an equation of state, a pair term and a drag law of its own, from its own tree.
#include <mpi.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string_view>

#include "decomp/comm.hpp"
#include "friction_of_flow.hpp"
#include "schiller_naumann.hpp"
#include "sph/scene/scene.hpp"
#include "sph/step/simulation.hpp"
#include "stiffening.hpp"
#include "tait.hpp"

namespace {

/// Once a scene has been read, what its words mean stays.
bool is_too_late() {
  try {
    sph::register_equation_of_state<Tait>();
  } catch (const std::logic_error&) {
    return true;
  }
  return false;
}

struct Clashing : Stiffening {
  static constexpr std::string_view word = "clashing";
  static constexpr std::array keys{sph::LawKey{"soft_stiffness", sph::dimension::length}};
};

/// A key means one thing.
bool is_refused() {
  try {
    sph::register_contact_law<Clashing>();
  } catch (const std::logic_error& error) {
    const std::string_view text = error.what();
    return text.find("\"clashing\": its key soft_stiffness") != text.npos &&
           text.find("\"stiffening\"") != text.npos;
  }
  return false;
}

void run(const char* path) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  sph::Simulation simulation(comm, sph::read_scene(path, {}));
  if (!is_too_late()) throw std::runtime_error("a law was registered after a scene had been read");
  while (simulation.global().step < simulation.scene().time.steps) simulation.step();
  const std::string print = simulation.fingerprint();
  if (comm.rank() == 0)
    std::printf("fingerprint %s step %lld\n", print.c_str(),
                static_cast<long long>(simulation.global().step));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sph::register_contact_law<Stiffening>();
  sph::register_equation_of_state<Tait>();
  sph::register_term<FlowFriction>();
  sph::register_drag_law<SchillerNaumann>();
  const bool refused = is_refused();
  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    if (!refused) throw std::runtime_error("a law was registered whose key means something else");
    run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    status = 2;
  }
  MPI_Finalize();
  return status;
}
