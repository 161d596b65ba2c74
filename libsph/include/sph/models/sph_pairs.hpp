// The pairs of fluids and solids: full lists, which carry nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sph/models/physics.hpp"
#include "sph/pairs/set_pair.hpp"
#include "sph/pairs/sph_lists.hpp"
#include "sph/pairs/ways_apart.hpp"

namespace sph {

class SphPairs final : public SetPair {
 public:
  SphPairs(std::size_t set, Physics& physics);

  [[nodiscard]] SphLists& lists() { return lists_; }
  [[nodiscard]] const SphLists& lists() const { return lists_; }
  [[nodiscard]] FieldSet constants() const override {
    return {Field::id, Field::position, Field::displacement, Field::smoothing_length, Field::group};
  }
  [[nodiscard]] double least_skin(const GlobalState& global) const override;
  void rebuild(const Particles& particles, const ListSetting& setting, decomp::Payload& carried,
               std::span<const std::uint32_t> order) override;
  [[nodiscard]] std::optional<Look> look_at_ways(const Particles& particles,
                                                 const GlobalState& global) const override;
  [[nodiscard]] LookedAt looked_at() const override {
    return {{Field::position, Field::velocity, Field::group}};
  }
  void count(const RowRanges& ranges, std::span<std::uint32_t> entries) const override;

 private:
  Physics* physics_;
  SphLists lists_;
  std::vector<bool> is_wall_;  ///< by group
  bool ahead_;                 ///< it is known where velocities will have taken particles
  WaysApart ways_;
  double skin_ = 0;  ///< of the lists [m]
};

}  // namespace sph
