// The lists of a set of fluids and solids.
#pragma once

#include <utility>
#include <vector>

#include "sph/pairs/fluid_blocks.hpp"
#include "sph/pairs/neighbour_lists.hpp"

namespace sph {

struct SphLists {
  SphLists(int lanes, std::vector<bool> is_fluid_group)
      : all(lanes), bonds(lanes), walls(lanes), fluid(std::move(is_fluid_group)) {}

  NeighbourLists all;
  NeighbourLists bonds;  ///< those that bonds may join; empty where there are none
  NeighbourLists walls;  ///< those between what moves and walls; empty where no sum is over them alone
  FluidBlocks fluid;
};

}  // namespace sph
