// What a scene of grains says beyond what every scene says: materials, contact law, drag, walls,
// stages, and how grains are placed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sph/scene/law_key.hpp"
#include "sph/scene/mesh_scene.hpp"

namespace sph {

using Double3 = std::array<double, 3>;

struct ContactLaw;  // laws/contact/law.hpp
struct DragLaw;     // laws/drag/law.hpp
[[nodiscard]] const DragLaw* no_drag();

/// Of a group with kind = "grain": spheres, or only the material of walls.
struct GrainMaterial {
  double least_radius = 0, largest_radius = 0;  ///< uniform distribution of the radius between them [m]
  LawConstants constants{};                     ///< of the contact law, in the order of its keys
  double restitution = 1;                       ///< of a head-on impact, 0 < e <= 1
  double friction = 0;                          ///< mu
  double rolling_friction = 0;                  ///< mu_r
  bool fixed = false;  ///< glued in space; WallMaterial::velocity drags what touches it, as a belt does
  friend bool operator==(const GrainMaterial&, const GrainMaterial&) = default;
};

/// Replaces the mixed value of two materials (by default: the smaller friction, rolling friction and
/// restitution of the two; always the harmonic mean of linear stiffnesses and the sum of Hertz's
/// compliances).
struct ContactPair {
  std::array<int, 2> groups{};
  std::optional<double> friction, rolling_friction, restitution;
  friend bool operator==(const ContactPair&, const ContactPair&) = default;
};

struct ContactControl {
  const ContactLaw* law = nullptr;       ///< of laws/contact/registry.hpp; of all scenes of grains
  std::optional<double> normal_damping;  ///< linear law: gamma_n [1/s] for all, instead of restitution
  double tangential_damping = 0;         ///< of the tangential dashpot, in normal ones
  double rolling_damping = 0.3;          ///< of the rolling dashpot, in critical ones
  bool pull = false;                     ///< dashpots may pull at the end of a contact
  double largest_overlap = 0.2;          ///< in radii of the smaller grain: beyond it the run stops
  std::vector<ContactPair> pairs;
  friend bool operator==(const ContactControl&, const ContactControl&) = default;
};

/// How a fluid and the grains in it act on each other.
struct DragControl {
  const DragLaw* law = no_drag();
  bool own_disturbance = true;     ///< what a grain itself does to the fluid around it is taken out
  double packed_fraction = 0.585;  ///< phi_m, of which grains in melts do not flow any more
  friend bool operator==(const DragControl&, const DragControl&) = default;
};

/// A plane: grains stay on the side to which the normal points. It moves with the prescribed velocity, or, as
/// a servo, along its normal so that the grains press on it with `force`.
struct Wall {
  std::string name;
  int group = 0;  ///< material
  Double3 point{}, normal{};
  Double3 velocity{};           ///< [m/s]; a tangential part drags the grains and moves nothing else
  std::optional<double> force;  ///< servo: target of the normal force on the wall [N]
  double servo_gain = 0;        ///< speed per excess of force [m/s/N]
  double largest_speed = 0;     ///< of a servo [m/s]
  friend bool operator==(const Wall&, const Wall&) = default;
};

/// From `begin` on, some walls behave otherwise.
struct WallChange {
  int wall = 0;
  bool remove = false;
  std::optional<Double3> velocity;
  std::optional<double> force;
  friend bool operator==(const WallChange&, const WallChange&) = default;
};
struct WallStage {
  std::string name;
  double begin = 0;  ///< [s], ascending
  std::vector<WallChange> walls;
  friend bool operator==(const WallStage&, const WallStage&) = default;
};

struct GrainScene {
  ContactControl contact;
  DragControl drag;  ///< of grains in a fluid
  std::vector<Wall> walls;
  std::vector<WallStage> stages;
  std::vector<MeshWall> meshes;
  /// Of walls and meshes, in the order in which results number them.
  [[nodiscard]] std::vector<std::string> names() const;
  friend bool operator==(const GrainScene&, const GrainScene&) = default;
};

/// Grains in a fluid: a cubic lattice of its own fills a box.
struct GrainFill {
  int group = -1;            ///< of grains
  Double3 lower{}, upper{};  ///< points sit at lower + (k + 1/2) spacing, below upper [m]
  double spacing = 0;        ///< [m]
  double jitter = 0;         ///< amplitude of a uniform displacement, in spacings
  double occupied = 1;       ///< share of the points that get a grain, at random
  friend bool operator==(const GrainFill&, const GrainFill&) = default;
};

/// A settled packing that is repeated side by side.
struct Tile {
  std::string file;  ///< a snapshot of a run of grains, or a particle file
  std::array<std::int64_t, 3> repeat{1, 1, 1};
  friend bool operator==(const Tile&, const Tile&) = default;
};

}  // namespace sph
