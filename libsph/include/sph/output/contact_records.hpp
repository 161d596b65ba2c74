// The contacts of grains at the present moment, for output: those that overlap now, whatever they did in the
// last step, which is a function of the state alone. A contact is seen from its lower id to its partner, a
// wall being the partner of its grain; every rank that sees it computes the same bits.
//   force   on `id`: -(F n + t), F the elastic normal force at the present overlap, without dashpot, t the
//           tangential spring as the contact's history has it (zero if it did not touch in the last step)
//   energy  of its springs: normal k_n d^2/2, or Hertz 8/15 E* sqrt(R*) d^(5/2); tangential t^2/(2 k_t),
//           with Hertz k_t = 8 G* sqrt(R* d) at the present overlap and t fallen with it as the law lets it
//           fall (pairs/friction.hpp); rolling m^2/(2 k_r) likewise
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "sph/step/simulation.hpp"

namespace sph {

struct ContactRecord {
  std::uint64_t id, partner;       ///< id < partner; the key of a wall is wall_key | its index
  std::uint32_t row, partner_row;  ///< on this rank, copies of the halo included; of a wall its index
  bool counted;                    ///< by this rank: it owns `id`. True on exactly one rank
  bool fixed;                      ///< one of the two is a fixed grain
  double overlap;                  ///< > 0 [m]
  Double3 normal;                  ///< from id to partner
  Double3 force;                   ///< on id; its opposite acts on the partner [N]
  /// From the centre of each to the point of contact [m]: the middle of the overlap, or on the wall.
  double arm, partner_arm;
  double energy;  ///< [J]

  [[nodiscard]] bool with_wall() const { return (partner & wall_key) != 0; }
};

/// Visits the contacts of this rank's grains; one between an owned row and a copy in the halo is also visited
/// where the copy is owned. In no particular order. Simulation::refresh_contacts() comes first; not
/// collective.
void for_each_contact(const Simulation& simulation, const std::function<void(const ContactRecord&)>& visit);

}  // namespace sph
