#include "sph/models/cell_rows.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace sph {

CellRows::CellRows(const stokes::Grid& grid, const PositionScale& scale, std::vector<decomp::Box> boxes)
    : grid_(grid), scale_(scale), boxes_(std::move(boxes)) {}

decomp::Int3 CellRows::cell_of(const Particles& cells, std::size_t row) const {
  const auto d = static_cast<std::size_t>(grid_.dim);
  decomp::Int3 cell{};
  for (std::size_t a = 0; a < d; ++a) {
    const std::int64_t x = cells.data<Field::position>()[row * d + a] - scale_.origin[a];
    cell[a] = static_cast<std::int64_t>(std::floor(scale_.metres(x) / grid_.edge[a]));
  }
  return cell;
}

std::vector<decomp::Rank> CellRows::owners(const Particles& cells) const {
  std::vector<decomp::Rank> out(cells.owned(), 0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const decomp::Int3 cell = cell_of(cells, i);
    for (std::size_t r = 0; r < boxes_.size(); ++r)
      if (boxes_[r].contains(cell)) out[i] = static_cast<decomp::Rank>(r);
  }
  return out;
}

void CellRows::find(const Particles& cells, const stokes::Patch& patch) {
  places_.resize(cells.owned());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const decomp::Int3 cell = cell_of(cells, i);
    if (!patch.own.contains(cell))
      throw std::logic_error("a cell of the grid is on a rank that does not own it");
    places_[i] = patch.at(cell);
  }
}

void CellRows::load(const Particles& cells, Field field, stokes::Field& to, std::size_t k) const {
  const double* from = cells.table().as<double>(cells.column(field));
  const auto n = static_cast<std::size_t>(components(info(field).shape, grid_.dim));
  for (std::size_t i = 0; i < places_.size(); ++i) to[static_cast<std::size_t>(places_[i])] = from[i * n + k];
}

void CellRows::store(const stokes::Field& from, Field field, Particles& cells, std::size_t k) const {
  auto* to = reinterpret_cast<double*>(cells.table().column(cells.column(field)).data());
  const auto n = static_cast<std::size_t>(components(info(field).shape, grid_.dim));
  for (std::size_t i = 0; i < places_.size(); ++i) to[i * n + k] = from[static_cast<std::size_t>(places_[i])];
}

}  // namespace sph
