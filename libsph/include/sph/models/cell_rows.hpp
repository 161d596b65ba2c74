// The cells of a grid as rows of a set of particles, which files, monitors and fingerprints look at like at any other:
// a row stands at the centre of its cell. Who has which is said by boxes, not by the particles' cuts.
#pragma once

#include <vector>

#include "sph/core/particles.hpp"
#include "stokes/grid.hpp"

namespace sph {

class CellRows {
 public:
  /// `boxes`: of all ranks.
  CellRows(const stokes::Grid& grid, const PositionScale& scale, std::vector<decomp::Box> boxes);

  [[nodiscard]] const std::vector<decomp::Box>& boxes() const { return boxes_; }
  [[nodiscard]] std::vector<decomp::Rank> owners(const Particles& cells) const;

  /// Looks for the place of each row in `patch`. Throws std::logic_error for a row that is not of its cells.
  void find(const Particles& cells, const stokes::Patch& patch);
  /// From and to the rows found last: the k-th component of a field.
  void load(const Particles& cells, Field field, stokes::Field& to, std::size_t k = 0) const;
  void store(const stokes::Field& from, Field field, Particles& cells, std::size_t k = 0) const;

 private:
  [[nodiscard]] decomp::Int3 cell_of(const Particles& cells, std::size_t row) const;

  stokes::Grid grid_;
  PositionScale scale_;
  std::vector<decomp::Box> boxes_;
  std::vector<std::ptrdiff_t> places_;
};

}  // namespace sph
