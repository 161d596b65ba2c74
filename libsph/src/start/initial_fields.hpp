// Initial velocity, pressure and hence density and mass of a particle, from the scene and its position.
#pragma once

#include "decomp/types.hpp"
#include "sph/particles.hpp"
#include "sph/scene.hpp"

namespace sph {

struct NewParticle {
  std::uint64_t id;
  Double3 position;  ///< [m]
  Double3 velocity;
  std::uint32_t group;
  double density;
  double mass;
};

/// Uniform in +-jitter spacings on every axis, from a counter-based generator on (seed, id, axis).
void displace_by_jitter(const Scene& scene, NewParticle& p);

/// Density from the initial pressure through the group's equation of state, mass = density spacing^D.
void set_initial_fields(const Scene& scene, NewParticle& p);

/// Adds one owned row with the given coordinates [quanta].
void append(const Scene& scene, const NewParticle& p, const decomp::Int3& quanta, Particles& particles);

}  // namespace sph
