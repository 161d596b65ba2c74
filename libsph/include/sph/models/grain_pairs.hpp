// The pairs of grains: half lists, whose contacts carry their history. Histories travel with the grains when rows move,
// and go back to their pairs; none may be lost or doubled on its way.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sph/core/findings.hpp"
#include "sph/models/grain_walls.hpp"
#include "sph/pairs/contact_context.hpp"
#include "sph/pairs/grain_ways.hpp"
#include "sph/pairs/set_pair.hpp"

namespace sph {

class GrainPairs final : public SetPair {
 public:
  /// `walls` stay where they are.
  GrainPairs(std::size_t set, const Scene& scene, const PositionScale& scale, const GrainWalls& walls);

  [[nodiscard]] FieldSet constants() const override {
    return {Field::id, Field::position, Field::radius, Field::mass, Field::group};
  }
  [[nodiscard]] bool carries() const override { return true; }
  [[nodiscard]] decomp::Payload send(const Particles& particles, decomp::Payload arrived) override;
  void rebuild(const Particles& particles, const ListSetting& setting, decomp::Payload& carried,
               std::span<const std::uint32_t> order) override;
  void count(const RowRanges& ranges, std::span<std::uint32_t> entries) const override;

  /// Rows are about to go and to come: contacts of the grains `gone` on any rank, by their ids ascending, are forgotten.
  /// Rows will be rows `order`, and after them `come` new ones. rebuild() must follow.
  void turn_over(const Particles& particles, std::span<const std::uint64_t> gone,
                 std::span<const std::uint32_t> order, std::size_t come);

  [[nodiscard]] ContactLists& lists() { return lists_; }
  [[nodiscard]] const ContactLists& lists() const { return lists_; }
  /// Fields of the halo that a sweep over them reads and that change with every step.
  [[nodiscard]] FieldSet swept() const;
  [[nodiscard]] ContactSums& sums(const Particles& particles);
  /// As ContactLists has it; between steps.
  [[nodiscard]] decomp::Payload pack(const Particles& particles) const;
  [[nodiscard]] std::optional<Look> look_at_ways(const Particles& particles,
                                                 const GlobalState& global) const override;
  [[nodiscard]] LookedAt looked_at() const override;

  /// Contacts each rank has seen begin, end and come back after rows had moved.
  struct Counters {
    std::int64_t created = 0, ended = 0, carried = 0;
  };
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] GrainWays& ways() { return ways_; }
  void forget_parted(const Particles& particles);
  void add(const ContactSweep& swept);

 private:
  /// Contacts that the lists do not hold though their pairs cannot have parted so far.
  void find_lost(const Particles& particles, const GlobalState& global, double skin, Findings& lost) const;
  [[nodiscard]] ContactCensus find_pairs(const Particles& particles, const ListSetting& setting,
                                         decomp::Payload& carried, std::span<const std::uint32_t> order);

  const Scene* scene_;
  PositionScale scale_;
  const GrainWalls* walls_;
  ContactLists lists_;
  std::vector<bool> fixed_;
  bool spins_;  ///< grains do
  mutable ContactSums
      sums_;  ///< zeros between steps; not there while contacts are packed, when memory is at its peak
  std::optional<decomp::Payload> held_;  ///< contacts of rows that are not those of the lists
  ContactCensus sent_;                   ///< of what travels
  GrainWays ways_;
  Counters counters_;
};

}  // namespace sph
