// fingerprints <folder of scenes>: runs each scene for 100 steps and prints "scene precision fingerprint",
// one line a run. First line: "libm <hash>", of results that must never feed the state; compare.py uses it to
// see that masking CPU features had an effect.
#include <mpi.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/run/self_check.hpp"
#include "sph/scene/scene.hpp"
#include "sph/step/simulation.hpp"

namespace {

struct Case {
  const char* scene;
  std::vector<std::string> overrides;
  bool always_double = false;
};

const std::vector<std::string> hertz{"contact.law=hertz",
                                     "group.sand.normal_stiffness=",
                                     "group.sand.young_modulus=1e6",
                                     "group.sand.poisson_ratio=0.3",
                                     "group.glass.normal_stiffness=",
                                     "group.glass.young_modulus=2e6",
                                     "group.glass.poisson_ratio=0.2"};

/// A bar that is a fluid around the others.
const std::vector<std::string> wet{
    "group.bar.kind=fluid", "group.bar.lagrangian=", "group.bar.poisson_ratio=", "start.region.0.group=bar"};

/// ... and in which the others break.
const std::vector<std::string> cracked{
    "group.bar.kind=fluid",
    "group.bar.lagrangian=",
    "group.bar.poisson_ratio=",
    "start.region.0.group=bar",
    "group.beam.becomes=[{group=\"bar\", tensile_strength=2e4, keeps=\"volume\"}]",
    "group.ball.becomes=[{group=\"bar\", cohesion=3e4, friction_angle=30, keeps=\"volume\"}]"};

const std::vector<std::string> weak{
    "group.rock.strength={cohesion=1e4, friction_angle=30, dilatancy_angle=10, tensile_strength=5e3}"};

std::uint64_t libm_hash() {
  std::uint64_t hash = 0;
  for (int k = 1; k <= 2000; ++k) {
    const double x = 0.37 * k;
    for (double y : {std::sin(x), std::exp(-x / 100), std::pow(x, 0.7), std::log(x)})
      hash = (hash ^ std::bit_cast<std::uint64_t>(y)) * 0x9e3779b97f4a7c15U + (hash >> 29);
  }
  return hash;
}

void run(const decomp::Comm& comm, const std::string& folder, const Case& c) {
  for (const char* precision : {"double", "mixed"}) {
    std::vector<std::string> overrides = c.overrides;
    if (!c.always_double) overrides.push_back("precision=" + std::string(precision));
    sph::Simulation simulation(comm, sph::read_scene(folder + "/" + c.scene + ".toml", overrides));
    for (int step = 0; step < 100; ++step) simulation.step();
    const std::string print = simulation.fingerprint();
    std::string name = c.scene;
    if (c.always_double)
      name += c.overrides.empty() ? "" : "+hertz";
    else
      for (const std::string& o : c.overrides) name += "+" + o;
    if (comm.rank() == 0) std::printf("%s %s %s\n", name.c_str(), precision, print.c_str());
    if (c.always_double) break;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool help = argc == 2 && (std::string(argv[1]) == "--help" || std::string(argv[1]) == "-h");
  if (argc != 2 || argv[1][0] == '-') {
    std::fputs("fingerprints FOLDER: those of the scenes in FOLDER after some steps\n",
               help ? stdout : stderr);
    return help ? 0 : 2;
  }
  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    sph::self_check();
    const decomp::Comm comm(MPI_COMM_WORLD);
    if (comm.rank() == 0) std::printf("libm %016llx\n", static_cast<unsigned long long>(libm_hash()));
    for (const Case& c :
         {Case{"fluid", {}}, Case{"fluid", {"formulation=ida", "terms="}},
          Case{"fluid", {"terms.implicit_viscosity=true"}}, Case{"flow", {}}, Case{"solid", {}},
          Case{"solid", weak}, Case{"bodies", {}}, Case{"bodies", wet}, Case{"bodies", cracked},
          Case{"tumbling", {}}, Case{"gas", {}}, Case{"blast", {}}, Case{"box", {}}, Case{"grains", {}, true},
          Case{"grains", hertz, true}, Case{"melts", {}, true}})
      run(comm, argv[1], c);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    status = 1;
  }
  if (status != 0) MPI_Abort(MPI_COMM_WORLD, status);
  MPI_Finalize();
}
