#include "start/start_densities.hpp"

#include <fmt/format.h>

#include "sph/error.hpp"
#include "sph/findings.hpp"

namespace sph {

void check_start_densities(const decomp::Comm& comm, const Scene& scene, const Particles& particles) {
  const double* density = particles.data<Field::density>();
  Findings found;
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    const Group& g = scene.groups[particles.data<Field::group>()[i]];
    const std::uint64_t id = particles.data<Field::id>()[i];
    if (density[i] > 0 || g.eos == EosKind::ideal_gas) continue;  // that of a gas is summed later
    found.add(id, [&] {
      return fmt::format(
          "start: particle {} of group {} would have a density of {:.6g} kg/m^3; {}", id, g.name, density[i],
          g.eos == EosKind::bubbly
              ? "without pressure bubbly magma is all gas: raise domain.surface_pressure"
              : "raise the group's bulk_modulus or sound_speed, or the least pressure of the start");
    });
  }
  if (const std::string text = found.agree(comm); !text.empty()) throw InputError(scene.file + ": " + text);
}

}  // namespace sph
