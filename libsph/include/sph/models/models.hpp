// The models that scenes of fluids and solids are made of. Each adds its fields and stages; which of them a
// scene has, and in which order, is said once, in physics.cpp.
#pragma once

#include "sph/models/builder.hpp"

namespace sph {

/// Some group has a second viscosity: forces then have another pressure than the state.
[[nodiscard]] bool bulk_viscous(const Scene& scene);

/// Grains and fluid of the scene act on each other (drag.hpp).
[[nodiscard]] bool has_drag(const Scene& scene);

/// Positions advance: x += v dt, rounded to quanta, for particles that move.
void add_drift(Builder& builder);
/// Bound on how far that moves any particle [m].
[[nodiscard]] double longest_drift(const GlobalState& global);
/// Fluids and updated-Lagrangian solids: densities and stresses from the velocities ...
void add_kinematics(Builder& builder);
/// Updated-Lagrangian solids yield.
void add_strength(Builder& builder);
/// Those of forces, where some have a second viscosity.
void add_excess_pressures(Builder& builder);
/// ... and the forces of pairs.
void add_forces(Builder& builder);
/// Walls take their pressure and velocity from what is beside them; `weighted`: by density.
void add_walls(Builder& builder, bool weighted);
/// Walls and total-Lagrangian solids take theirs from the fluid beside them.
void add_flow_onto_solids(Builder& builder);
void add_wet_sides(Builder& builder);
/// Where torn fluid flies, walls stop it.
void add_walls_that_hold(Builder& builder);
/// How near walls are.
void add_wall_share(Builder& builder);
/// ... and in which direction, for what is straight between them and a particle.
void add_wall_slopes(Builder& builder);
/// The interface's curvature, for a tension that is a jump of the pressure.
void add_curvature(Builder& builder);
/// Viscous forces of the end of the step; where there are walls, after their slopes.
void add_implicit_viscosity(Builder& builder);
/// The literal formulation of Ida's paper.
void add_ida(Builder& builder);
/// Total-Lagrangian solids: bonds of what deforms, contacts.
void add_bodies(Builder& builder);
/// ... in a fluid, whose forces are known.
void add_bond_forces(Builder& builder);
/// v += (F/m + g) dt for particles that move; walls get their own velocity back.
void add_kick(Builder& builder);
/// Pressures of the state alone, where forces had others, and of where particles were moved to after the kick.
void add_pressures(Builder& builder);
/// Terms that are switched on by a number (added_term.hpp): forces, and what moves particles after the kick.
void add_accelerations(Builder& builder);
void add_drifts(Builder& builder);
[[nodiscard]] bool has_drifts(const Scene& scene);
/// The largest speed of sound where it grows with the pressure.
void add_sound(Builder& builder);
/// Sums of what budgets count, in double precision whatever that of the scene.
void add_exchange(Builder& builder, std::string name, const std::vector<Term>& terms);
/// Running averages for output.
void add_averages(Builder& builder);

}  // namespace sph
