// The order of a rank's rows in memory: by class (interior before boundary, movers before what stays), then
// by cell along the Hilbert curve, then by id. The boundary is a layer inside the faces shared with anyone,
// this rank's own periodic images included, as deep as lists can reach: particles deeper in have no partner
// in the halo, and are computed before it has arrived.
#pragma once

#include <cstdint>
#include <vector>

#include "decomp/partition.hpp"
#include "sph/plan/particle_set.hpp"

namespace sph {

class RowOrder {
 public:
  struct Sorted {
    std::vector<std::uint32_t> order;  ///< what is now in row r was in row order[r]
    std::int64_t to_face;              ///< of the movers, the nearest to a face that is no period [quanta]
  };
  /// Sorts the owned rows and finds the ranges of their classes. Lists reach as far as `reach` [quanta].
  Sorted sort(ParticleSet& set, const decomp::JaggedPartition& partition, decomp::Rank rank,
              std::int64_t reach);
  /// The partition is another one.
  void cuts_moved() { curve_.clear(); }

 private:
  std::vector<std::uint32_t>
      curve_;  ///< place along the Hilbert curve of each own cell, x fastest; where they are few
};

}  // namespace sph
