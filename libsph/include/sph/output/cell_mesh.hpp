// The cells of melts in snapshots as a mesh: they are the particles with the lowest ids, whose order is the grid's, x
// fastest. So a snapshot that is sorted by id shows its first rows in the shape of the grid, and the rest as
// particles of their own, without writing anything twice.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "decomp/types.hpp"
#include "sph/core/fields.hpp"

namespace sph {

class State;

struct CellMesh {
  decomp::Int3 cells{1, 1, 1};
  std::array<double, 3> origin{};         ///< lower corner of the domain [m]
  std::array<double, 3> edge{1, 1, 1};    ///< of a cell [m]
  FieldSet cell_fields, particle_fields;  ///< what cells have, and what the other particles
  [[nodiscard]] std::int64_t count() const { return cells[0] * cells[1] * cells[2]; }
};

/// None if the scene has no melts, or more particles than its snapshots sort.
[[nodiscard]] std::optional<CellMesh> cell_mesh(const State& state);

}  // namespace sph
