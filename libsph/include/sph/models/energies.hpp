// The energies of a scene [J]. Each model says which it counts, and adds what this rank's particles have of them to
// sums that are exact; what a scene's monitors and its columns of series.csv show follows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "decomp/exact_sum.hpp"
#include "sph/core/particles.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// In the order of columns.
enum class Energy : std::uint8_t { kinetic, rotational, potential, internal, elastic, plastic };
inline constexpr std::array energy_names{"kinetic",  "rotational", "potential",
                                         "internal", "elastic",    "plastic"};

class EnergySums {
 public:
  [[nodiscard]] decomp::ExactSum& operator[](Energy e) { return sums_[static_cast<std::size_t>(e)]; }

 private:
  std::array<decomp::ExactSum, energy_names.size()> sums_;
};

/// What is not moved by forces has no part in energy and momentum: walls and fixed grains.
[[nodiscard]] bool is_held(const Group& group);

/// m v^2 / 2 of a particle.
[[nodiscard]] double kinetic_energy(const Particles& particles, std::size_t row);
/// Of a fluid's or an updated solid's volume [J], from the density at no pressure.
[[nodiscard]] double compression_energy(const Group& group, double mass, double density);
/// -m g.x, and that of the scene's central pull; positions are those within the periodic domain.
[[nodiscard]] double potential_energy(const Scene& scene, const PositionScale& scale, const Wrap& wrap,
                                      const Particles& particles, std::size_t row);

}  // namespace sph
