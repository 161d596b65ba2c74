// Energies of one particle [J], as monitors.hpp defines them.
#pragma once

#include "output/particle_values.hpp"

namespace sph {

/// What is not moved by forces has no part in energy and momentum: walls and fixed grains.
[[nodiscard]] bool is_held(const Group& group);

[[nodiscard]] double kinetic_energy(const ParticleValues& of, std::size_t row);
[[nodiscard]] double internal_energy(const ParticleValues& of, std::size_t row);    ///< of ideal gases
[[nodiscard]] double rotational_energy(const ParticleValues& of, std::size_t row);  ///< of grains
[[nodiscard]] double potential_energy(const Scene& scene, const ParticleValues& of, std::size_t row);
[[nodiscard]] double elastic_energy(const Scene& scene, const ParticleValues& of, std::size_t row);  ///< SPH

}  // namespace sph
