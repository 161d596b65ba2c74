// Which blocks of lists have a fluid among their rows or partners. In all others the sums of what solids and fluids do to
// each other are 0: in rock with a thin crack, nearly everywhere.
#pragma once

#include <cstdint>
#include <vector>

#include "sph/core/particles.hpp"
#include "sph/pairs/neighbour_lists.hpp"

namespace sph {

class FluidBlocks {
 public:
  explicit FluidBlocks(std::vector<bool> is_fluid_group) : is_fluid_(std::move(is_fluid_group)) {}

  /// Lists are new.
  void forget() { rows_.clear(); }
  /// Of the blocks of interior rows, whose partners are owned; then of those of the boundary, when the groups of halo rows
  /// are fresh. Costs next to nothing unless something has changed: what fails becomes fluid.
  void look_at_interior(const Particles&, const NeighbourLists&, const RowRanges&);
  void look_at_boundary(const Particles&, const NeighbourLists&, const RowRanges&);
  [[nodiscard]] bool known() const { return !rows_.empty(); }
  [[nodiscard]] bool is_fluid(std::size_t row) const { return rows_[row] == 1; }
  /// A fluid is among the block's rows.
  [[nodiscard]] bool is_in(std::size_t block) const { return blocks_[block] == Fluid::row; }
  /// ... or their partners.
  [[nodiscard]] bool is_beside(std::size_t block) const { return blocks_[block] != Fluid::none; }

 private:
  enum class Fluid : std::uint8_t { none, partner, row };
  bool look_at_rows(const Particles&, std::size_t first, std::size_t last);
  void mark(const NeighbourLists&, const RowRange&);

  std::vector<bool> is_fluid_;      ///< by group
  std::vector<std::uint8_t> rows_;  ///< 1 for fluids, as they were looked at last
  std::vector<Fluid> blocks_;
  bool boundary_is_old_ = true;
};

}  // namespace sph
