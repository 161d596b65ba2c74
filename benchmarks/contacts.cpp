// What it costs that the sums of contact forces have the same bits in any order: the sweep over contacts with
// sums in whole quanta against the same sweep with sums in double, which no application can choose.
// Alternately, on one core, CPU time.
//
//     build/bin/contacts SCENE [key=value ...]      a scene of one material with friction, without rolling
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstring>
#include <functional>
#include <vector>

#include "program.hpp"
#include "sph/core/error.hpp"
#include "sph/laws/contact/hertz.hpp"
#include "sph/laws/contact/linear.hpp"
#include "sph/pairs/contact_pass.hpp"
#include "sph/step/simulation.hpp"
#include "timing.hpp"

namespace {

using namespace sph;

/// In the order of the list. 0.0 and the integer 0 have the same bits, so sweeps of both kinds may alternate.
struct DoubleSums {
  using Sum = double;
  template <int bytes>
  static Simd<double, bytes> lanes(Simd<double, bytes> x) {
    return x;
  }
  static double scalar(double x) { return x; }
  static FourDoubles values(const double* four) {
    FourDoubles sums;
    std::memcpy(&sums, four, sizeof sums);
    return sums;
  }
};

template <class Normal>
struct Sweeps {
  ContactSweepFunction quanta = ContactPass<Normal, Coulomb, NoRolling, true, QuantumSums>::run,
                       doubles = ContactPass<Normal, Coulomb, NoRolling, true, DoubleSums>::run;
};

template <class Normal>
void compare(Simulation& s) {
  // The benchmark moves the grains of the simulation with sweeps of its own.
  auto& grains = const_cast<Grains&>(*s.grains());
  auto& particles = const_cast<Particles&>(s.particles());
  const auto seconds = [&](ContactSweepFunction sweep) {
    const double start = cpu_seconds();
    ContactSweep swept;
    const ContactContext context = grains.context(particles, s.global().dt);
    sweep(context, grains.pairs().lists().interior(), s.sets().front().ranges, swept);
    sweep(context, grains.pairs().lists().boundary(), s.sets().front().ranges, swept);
    return cpu_seconds() - start;
  };
  const Sweeps<Normal> sweeps;
  constexpr int repeats = 100;
  std::vector<double> quanta, doubles;
  for (int r = 0; r < repeats; ++r) {
    quanta.push_back(seconds(sweeps.quanta));
    doubles.push_back(seconds(sweeps.doubles));
  }
  const double n = static_cast<double>(s.particle_count()), q = median(quanta), d = median(doubles);
  fmt::print("{:.0f} grains: quanta {:.1f} ns/grain, doubles {:.1f}: bits {:+.1f} %\n", n, 1e9 * q / n,
             1e9 * d / n, 100 * (q / d - 1));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What the order-free sums of contact forces cost", "contacts");
  std::string scene;
  std::vector<std::string> overrides;
  app.add_option("scene", scene, "of one material with friction, without rolling")->required();
  app.add_option("overrides", overrides, "key=value of the scene");
  if (const auto code = parse(app, argc, argv)) return *code;
  return run_under_mpi(app, argc, argv, [&] {
    const decomp::Comm comm(MPI_COMM_SELF);
    Simulation s(comm, read_scene(scene, overrides));
    if (!s.scene().of_grains()) throw InputError(scene + ": is no scene of grains");
    for (int k = 0; k < 20; ++k) s.step();
    if (s.scene().grains.contact.law->word == HertzNormal::word)
      compare<HertzNormal>(s);
    else if (s.scene().grains.contact.normal_damping)
      compare<LinearRate>(s);
    else
      compare<LinearNormal>(s);
  });
}
