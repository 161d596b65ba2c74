// Initial velocity, pressure and hence density and mass of a particle, from the scene and its position; of a
// grain its radius and hence its mass.
#pragma once

#include <optional>

#include "decomp/types.hpp"
#include "sph/core/particles.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"
#include "start/hydrostatic.hpp"

namespace sph {

struct NewParticle {
  std::uint64_t id;
  Double3 position;  ///< [m]
  Double3 velocity;
  std::uint32_t group;
  double density;  ///< 0 of grains
  double mass;
  double energy = 0;     ///< u of an ideal gas [J/kg]
  double prestress = 0;  ///< of total-Lagrangian solids in a fluid [Pa]
  double radius = 0;     ///< of grains [m]
  Double3 spin{};        ///< of grains [rad/s]
};

/// Uniform in +-amplitude [m] on every axis, from a counter-based generator on (start.seed, id, axis).
void displace(const Scene& scene, double amplitude, NewParticle& p);

/// Uniform between the least and the largest of the grain's group, a function of seed and id alone [m].
[[nodiscard]] double random_radius(const Scene& scene, const NewParticle& p);

/// Whether this point of a fill gets a grain, a function of start.seed and id alone.
[[nodiscard]] bool is_occupied(const Scene& scene, const GrainFill& fill, std::uint64_t id);

class InitialFields {
 public:
  explicit InitialFields(const Scene& scene);

  /// Density from the initial pressure through the group's equation of state, mass = density spacing^D. Of a
  /// grain, whose radius must be known: its mass and velocity.
  void set(NewParticle& p) const;

 private:
  [[nodiscard]] double pressure(const Double3& x) const;  ///< above the surface pressure
  /// ... where a file that is read back would have the point.
  [[nodiscard]] double pressure_in_place(const Double3& x) const;

  const Scene& scene_;
  PositionScale scale_;
  std::optional<HydrostaticColumn> hydrostatic_;
};

/// Adds one owned row with the given coordinates [quanta]: those fields that `particles` have.
void append(const Scene& scene, const NewParticle& p, const decomp::Int3& quanta, Particles& particles);

}  // namespace sph
