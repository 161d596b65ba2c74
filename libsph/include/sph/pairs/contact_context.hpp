// What a sweep over contacts works on, and what it reports (contact_pass.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "sph/core/particles.hpp"
#include "sph/pairs/contact_lists.hpp"
#include "sph/pairs/facet_contacts.hpp"

namespace sph {

/// Force and torque sums of every row, halo copies included, between steps 0: 4 integers a row, or 8 where grains spin. Beside
/// either, in the fourth, stand the bits of what owned rows are moved by, 1 / m and 5 / (2 m r^2); sweeps add nothing to it.
using ContactSums = decomp::LargeVector<std::uint64_t>;

/// What grains are made of.
struct ContactMaterials {
  const double* constants;  ///< [groups * groups][8], see ContactConstants; aligned
  std::uint32_t groups;
  double least_force;  ///< see ContactConstants
};

struct ContactWalls {
  std::span<const PlaneNow> planes;
  FacetContacts* facets;
  std::size_t count;    ///< planes and meshes
  std::int64_t* force;  ///< [2][count][3] quanta of force, low halves and high halves, added to
};

/// What accelerates grains besides contacts [m/s^2].
struct ContactPull {
  double gravity[3];
  const double* given;  ///< [row][3] by a caller; null: nothing
};

struct ContactQuanta {
  double length, force, torque;
  double per_force = 1 / force, per_torque = 1 / torque;
};

/// How grains move that have no inertia, columns of the grains: v = free + mobility F (models/suspension.hpp). Null
/// where they have.
struct Gliding {
  const double *free_velocity = nullptr, *free_spin = nullptr, *mobility = nullptr;
  double* force = nullptr;      ///< of the contacts, kept [N]
  std::int64_t* way = nullptr;  ///< added to [quanta]
};

/// Everything a compiled contact pass needs besides its laws.
struct ContactContext {
  Particles* particles;
  ContactLists* lists;
  ContactMaterials materials;
  ContactWalls walls;
  std::uint64_t* sums;
  ContactQuanta quantum;
  double dt;
  ContactPull pull;
  double path;             ///< no grain has gone further since the lists were made [m]; infinity: not known
  double largest_overlap;  ///< in radii of the smaller grain
  bool drifts;             ///< grains drift once they are kicked, while they are in the cache
  Gliding gliding{};
};

/// A contact that must not be: that of the lowest ids is kept.
struct ContactFault {
  static constexpr std::uint64_t nobody = ~std::uint64_t{0};
  std::uint64_t id = nobody, partner = nobody;
  double value = 0, limit = 0;
  std::array<std::int64_t, 3> x{};  ///< where `id` is [quanta]
  [[nodiscard]] bool any() const { return id != nobody; }
  void add(const ContactFault& other) {
    if (std::pair(other.id, other.partner) < std::pair(id, partner)) *this = other;
  }
};

/// What a sweep reports.
struct ContactSweep {
  double speed2 = 0, acceleration2 = 0;  ///< NaN stays
  ContactFault strong, deep;             ///< component of a force [quanta], overlap [m] beyond the limit
  std::int64_t created = 0, ended = 0;   ///< contacts, each once a rank that sees it
};

/// A compiled sweep over blocks of contacts: the laws fused.
using ContactSweepFunction = void (*)(const ContactContext&, std::span<const ContactBlock>, const RowRanges&,
                                      ContactSweep&);
struct ContactFusion {
  ContactSweepFunction sweep;
  int history;  ///< doubles a contact carries
  bool spins;
  std::span<const Parity> parities;  ///< of the history
};

}  // namespace sph
