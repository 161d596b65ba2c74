// The pairs of fluids and solids: full lists, which carry nothing.
#pragma once

#include <vector>

#include "sph/models/physics.hpp"
#include "sph/pairs/set_pair.hpp"
#include "sph/pairs/sph_lists.hpp"

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
  void count(const RowRanges& ranges, std::span<std::uint32_t> entries) const override;

 private:
  Physics* physics_;
  SphLists lists_;
  std::vector<bool> is_wall_;  ///< by group
};

}  // namespace sph
