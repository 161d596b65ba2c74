// All rows of a rank binned by cell (its own box and one layer around it), with float positions in the order
// of the bins: the candidates of a particle are 3 (2D) or 9 (3D) contiguous runs that SIMD can filter.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "decomp/grid.hpp"
#include "pairs/occupied.hpp"
#include "sph/particles.hpp"

namespace sph {

class CellBins {
 public:
  static constexpr std::size_t padding = 16;  ///< readable, never matching entries after the last

  /// Positions are held relative to the corner of the bins in units of `radius` quanta.
  CellBins(const Particles& particles, const decomp::CellGrid& grid, const decomp::Box& own,
           std::int64_t radius)
      : grid_(grid), dim_(particles.dim()), occupied_(0) {
    decomp::Int3 corner{};
    for (int a = 0; a < 3; ++a) {
      lo_[a] = a < dim_ ? own.lo[a] - 1 : 0;
      extent_[a] = a < dim_ ? own.hi[a] - own.lo[a] + 2 : 1;
      corner[a] = grid.origin()[a] + lo_[a] * grid.edge()[a];
    }
    occupied_ = Occupied(static_cast<std::size_t>(extent_[0] * extent_[1] * extent_[2]));
    const std::size_t rows = particles.rows(), d = static_cast<std::size_t>(dim_);
    const std::int64_t* x = particles.data<Field::position>();
    cell_.resize(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      cell_[i] = static_cast<std::uint32_t>(index(x + i * d));
      occupied_.mark(cell_[i]);
    }
    start_.assign(occupied_.number() + 1, 0);
    std::vector<std::uint32_t> bin(rows);
    for (std::size_t i = 0; i < rows; ++i) ++start_[(bin[i] = occupied_.before(cell_[i])) + 1];
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    row_.resize(rows + padding);
    for (std::size_t a = 0; a < d; ++a) x_[a].assign(rows + padding, 1e9f);
    std::vector<std::uint32_t> at(start_.begin(), start_.end() - 1);
    const double unit = 1 / static_cast<double>(radius);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::uint32_t k = at[bin[i]]++;
      row_[k] = static_cast<std::uint32_t>(i);
      for (std::size_t a = 0; a < d; ++a)
        x_[a][k] = static_cast<float>(static_cast<double>(x[i * d + a] - corner[a]) * unit);
    }
    position_.resize(rows);
    for (std::uint32_t k = 0; k < rows; ++k) position_[row_[k]] = k;
  }

  [[nodiscard]] std::uint32_t cell(std::size_t row) const { return cell_[row]; }
  [[nodiscard]] std::uint32_t place(std::size_t row) const {
    return position_[row];
  }  ///< of a row in the bins
  [[nodiscard]] const std::vector<std::uint32_t>& rows() const { return row_; }
  [[nodiscard]] const float* x(int axis) const { return x_[axis].data(); }
  /// Squared list radius with room for the rounding of positions to float: a list may hold more than it
  /// must, since a partner beyond the support adds exactly nothing.
  [[nodiscard]] float limit() const {
    const float extent = static_cast<float>(std::max({extent_[0], extent_[1], extent_[2]}));
    const float r = 1.0f + 1e-5f + 1e-6f * extent;
    return r * r;
  }

  struct Run {
    std::uint32_t first, last;
  };
  /// The runs of candidates of a cell; returns how many.
  [[nodiscard]] int runs(std::uint32_t cell, Run (&out)[9]) const {
    const std::int64_t z = cell / (extent_[0] * extent_[1]), y = cell / extent_[0] % extent_[1],
                       x = cell % extent_[0];
    int n = 0;
    for (std::int64_t k = std::max<std::int64_t>(z - 1, 0); k <= std::min(z + 1, extent_[2] - 1); ++k)
      for (std::int64_t j = std::max<std::int64_t>(y - 1, 0); j <= std::min(y + 1, extent_[1] - 1); ++j) {
        const std::size_t line = static_cast<std::size_t>((k * extent_[1] + j) * extent_[0]);
        const std::size_t first = static_cast<std::size_t>(std::max<std::int64_t>(x - 1, 0));
        const std::size_t last = static_cast<std::size_t>(std::min(x + 1, extent_[0] - 1));
        out[n++] = {start_[occupied_.before(line + first)], start_[occupied_.before(line + last + 1)]};
      }
    return n;
  }

 private:
  /// Halo copies of a periodic image lie outside the domain: they go to the layer just outside the box.
  [[nodiscard]] std::int64_t index(const std::int64_t* x) const {
    std::int64_t at = 0, stride = 1;
    for (int a = 0; a < dim_; ++a) {
      const std::int64_t t = x[a] - grid_.origin()[a], last = grid_.cells()[a] - 1;
      std::int64_t c = t < 0 ? -1 : t >= grid_.length()[a] ? last + 1 : std::min(t / grid_.edge()[a], last);
      if (!grid_.periodic()[static_cast<std::size_t>(a)]) c = std::clamp<std::int64_t>(c, 0, last);
      at += std::clamp<std::int64_t>(c - lo_[a], 0, extent_[a] - 1) * stride;
      stride *= extent_[a];
    }
    return at;
  }

  const decomp::CellGrid& grid_;
  int dim_;
  decomp::Int3 lo_{}, extent_{1, 1, 1};
  Occupied occupied_;                 ///< cells that hold rows
  std::vector<std::uint32_t> cell_;   ///< of a row
  std::vector<std::uint32_t> start_;  ///< of the bin of each occupied cell, and the end
  std::vector<std::uint32_t> row_, position_;
  std::vector<float> x_[3];
};

}  // namespace sph
