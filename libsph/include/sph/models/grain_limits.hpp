// How long the time steps of grains may be, and how far grains and walls may go in one.
#pragma once

#include <string>

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/triangle_surface.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

[[nodiscard]] bool any_grain_moves(const Scene& scene);

/// Time steps of a scene of grains [s].
struct GrainTimeSteps {
  double recommended = 0;  ///< the default
  double advised = 0;      ///< above it `check` warns: 0.2 Rayleigh times, or 0.17 sqrt(m/k)
  double limit = 0;        ///< above it a single contact is unstable: refused
};
[[nodiscard]] GrainTimeSteps grain_time_steps(const Scene& scene);
[[nodiscard]] double grain_step(const Scene& scene);  ///< time.dt, or the default [s]

/// No grain and no wall may go further in a step [m]; what is said of one that would.
[[nodiscard]] double longest_grain_move(const Scene& scene);
[[nodiscard]] std::string grain_move_text(const Scene& scene, double way);
/// Below it a mesh with a mass that as many grains touch as find room is unstable [kg].
[[nodiscard]] double least_mesh_mass(const Scene& scene, const MeshWall& mesh,
                                     const TriangleSurface& surface);
/// Throw InputError.
void check_mesh_speed(const Scene& scene, const MeshWall& mesh, double arm);  ///< about its axis [m]
void check_wall_speeds(const Scene& scene);
void check_start_speeds(const decomp::Comm& comm, const Scene& scene, const Particles& particles);

}  // namespace sph
