#include "start/start_densities.hpp"

#include <fmt/format.h>

#include "sph/core/error.hpp"
#include "sph/core/findings.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {

namespace {

// Beyond it is no matter of the group's, and products of such values leave the range of the numbers.
constexpr double most = 1e6;

bool is_near(double value, double usual) { return value <= most * usual && value * most >= usual; }

std::string advice(const Group& g, double density) {
  if (density > 0) return fmt::format("it must be within 1e-6 to 1e6 of the group's {:.6g}", g.density);
  return std::string(g.eos.law->remedy);
}

}  // namespace

void check_start_densities(const decomp::Comm& comm, const Scene& scene, const Particles& particles) {
  const double* density = particles.data<Field::density>();
  const double* mass = particles.data<Field::mass>();
  const double volume = particle_volume(scene);
  Findings found;
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    const Group& g = scene.groups[particles.data<Field::group>()[i]];
    const std::uint64_t id = particles.data<Field::id>()[i];
    const double usual = g.density * volume;
    const bool summed = g.eos.law->kind == EosKind::ideal_gas;  // the density of a gas: later
    if ((summed || is_near(density[i], g.density)) && is_near(mass[i], usual)) continue;
    found.add(id, [&] {
      const std::string who = fmt::format("start: particle {} of group {} would have a ", id, g.name);
      if (!summed && !is_near(density[i], g.density))
        return fmt::format("{}density of {:.6g} kg/m^3; {}", who, density[i], advice(g, density[i]));
      return fmt::format("{}mass of {:.6g} kg; it must be within 1e-6 to 1e6 of the group's {:.6g}", who,
                         mass[i], usual);
    });
  }
  if (const std::string text = found.agree(comm); !text.empty()) throw InputError(scene.file + ": " + text);
}

}  // namespace sph
