// All rows of a rank binned by cell (its own box and the layers around it that the halo reaches: one, or two
// where the lists reach further than a cell), with float positions in the order of the bins: the candidates
// of a particle are 3 (2D) or 9 (3D) contiguous runs that SIMD can filter, or 5 or 25.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "decomp/grid.hpp"
#include "pairs/list_slack.hpp"
#include "pairs/occupied.hpp"
#include "sph/core/particles.hpp"

namespace sph {

/// The cells that are binned, x fastest, and the scale of positions in them.
class BinBox {
 public:
  /// Positions are held relative to the corner of the bins in units of `radius` quanta.
  BinBox(const decomp::CellGrid& grid, const decomp::Box& own, std::int64_t radius)
      : grid_(grid), layers_(layers(grid, radius)), unit_(1 / static_cast<double>(radius)) {
    for (int a = 0; a < 3; ++a) {
      lo_[a] = a < grid.dim() ? own.lo[a] - layers_ : 0;
      extent_[a] = a < grid.dim() ? own.hi[a] - own.lo[a] + 2 * layers_ : 1;
      corner_[a] = grid.origin()[a] + lo_[a] * grid.edge()[a];
    }
  }

  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(extent_[0] * extent_[1] * extent_[2]);
  }
  [[nodiscard]] float scaled(int axis, std::int64_t x) const {
    return static_cast<float>(static_cast<double>(x - corner_[axis]) * unit_);
  }

  /// Halo copies of a periodic image lie outside the domain: they go to the layers just outside the box.
  [[nodiscard]] std::size_t index(const std::int64_t* x) const {
    std::int64_t at = 0, stride = 1;
    for (int a = 0; a < grid_.dim(); ++a) {
      const std::int64_t t = x[a] - grid_.origin()[a], edge = grid_.edge()[a], beyond = t - grid_.length()[a];
      const std::int64_t last = grid_.cells()[a] - 1;
      std::int64_t c = t < 0         ? -((edge - 1 - t) / edge)
                       : beyond >= 0 ? last + 1 + beyond / edge
                                     : std::min(t / edge, last);
      if (!grid_.periodic()[static_cast<std::size_t>(a)]) c = std::clamp<std::int64_t>(c, 0, last);
      at += std::clamp<std::int64_t>(c - lo_[a], 0, extent_[a] - 1) * stride;
      stride *= extent_[a];
    }
    return static_cast<std::size_t>(at);
  }

  static constexpr int most_layers = 2, most_lines = (2 * most_layers + 1) * (2 * most_layers + 1);
  /// Calls visit(first, last) for each line along x of cells around one that its partners may be in.
  template <class Visit>
  void for_lines_around(std::size_t at, Visit&& visit) const {
    const auto cell = static_cast<std::int64_t>(at);
    const std::int64_t z = cell / (extent_[0] * extent_[1]), y = cell / extent_[0] % extent_[1],
                       x = cell % extent_[0];
    const auto from = [&](std::int64_t c) { return std::max<std::int64_t>(c - layers_, 0); };
    const auto to = [&](std::int64_t c, int axis) { return std::min(c + layers_, extent_[axis] - 1); };
    for (std::int64_t k = from(z); k <= to(z, 2); ++k)
      for (std::int64_t j = from(y); j <= to(y, 1); ++j) {
        const std::size_t line = static_cast<std::size_t>((k * extent_[1] + j) * extent_[0]);
        visit(line + static_cast<std::size_t>(from(x)), line + static_cast<std::size_t>(to(x, 0)));
      }
  }

 private:
  /// How many cells away a partner within `radius` may be.
  [[nodiscard]] static std::int64_t layers(const decomp::CellGrid& grid, std::int64_t radius) {
    std::int64_t edge = radius;
    for (int a = 0; a < grid.dim(); ++a)
      if (grid.cells()[a] > 1)
        edge = std::min(edge, grid.edge()[a]);  // a single cell may be a narrower domain
    const std::int64_t n = (radius + edge - 1) / edge;
    if (n > most_layers) throw std::logic_error("lists reach further than two cells");
    return n;
  }

  const decomp::CellGrid& grid_;
  std::int64_t layers_;
  double unit_;
  decomp::Int3 corner_{};  ///< of the bins [quanta]
  decomp::Int3 lo_{}, extent_{1, 1, 1};
};

class CellBins {
 public:
  static constexpr std::size_t padding = 16;  ///< readable, never matching entries after the last

  CellBins(const Particles& particles, const decomp::CellGrid& grid, const decomp::Box& own,
           std::int64_t radius)
      : box_(grid, own, radius),
        limit_(static_cast<float>(1 + list_slack(grid, own, radius))),
        occupied_(box_.cells(), particles.rows()) {
    const std::size_t rows = particles.rows(), d = static_cast<std::size_t>(particles.dim());
    const std::int64_t* x = particles.data<Field::position>();
    std::vector<std::size_t> cell_of_row(rows);
    for (std::size_t i = 0; i < rows; ++i) occupied_.mark(cell_of_row[i] = box_.index(x + i * d));
    start_.assign(occupied_.number() + 1, 0);
    cell_.resize(start_.size() - 1);
    bin_.resize(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::size_t cell = cell_of_row[i];
      bin_[i] = occupied_.before(cell);
      cell_[bin_[i]] = cell;
      ++start_[bin_[i] + 1];
    }
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    row_.resize(rows + padding);
    for (std::size_t a = 0; a < d; ++a) x_[a].assign(rows + padding, 1e9f);
    std::vector<std::uint32_t> at(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::uint32_t k = at[bin_[i]]++;
      row_[k] = static_cast<std::uint32_t>(i);
      for (std::size_t a = 0; a < d; ++a) x_[a][k] = box_.scaled(static_cast<int>(a), x[i * d + a]);
    }
    position_.resize(rows);
    for (std::uint32_t k = 0; k < rows; ++k) position_[row_[k]] = k;
  }

  [[nodiscard]] std::uint32_t bin(std::size_t row) const { return bin_[row]; }
  [[nodiscard]] std::uint32_t place(std::size_t row) const {
    return position_[row];
  }  ///< of a row in the bins
  [[nodiscard]] const std::vector<std::uint32_t>& rows() const { return row_; }
  [[nodiscard]] const float* x(int axis) const { return x_[axis].data(); }
  /// List radius with room for the rounding of positions to float (see list_slack): a list may hold more
  /// than it must, since a partner beyond the support adds exactly nothing.
  [[nodiscard]] float limit() const { return limit_; }

  struct Run {
    std::uint32_t first, last;
  };
  using Runs = Run[BinBox::most_lines];
  /// The runs of candidates of the rows in a bin; they lie in `out`.
  [[nodiscard]] std::span<const Run> runs(std::uint32_t bin, Runs& out) const {
    return runs_around(cell_[bin], out);
  }
  /// ... of a position, of whatever set of particles.
  [[nodiscard]] std::span<const Run> runs_near(const std::int64_t* x, Runs& out) const {
    return runs_around(box_.index(x), out);
  }
  /// A position as x() has those of the rows.
  [[nodiscard]] float scaled(int axis, std::int64_t x) const { return box_.scaled(axis, x); }

 private:
  [[nodiscard]] std::span<const Run> runs_around(std::size_t cell, Runs& out) const {
    std::size_t n = 0;
    box_.for_lines_around(cell, [&](std::size_t first, std::size_t last) {
      out[n++] = {start_[occupied_.before(first)], start_[occupied_.before(last + 1)]};
    });
    return {out, n};
  }

  BinBox box_;
  float limit_;
  Occupied occupied_;                 ///< cells that hold rows: their bins
  std::vector<std::size_t> cell_;     ///< of a bin
  std::vector<std::uint32_t> bin_;    ///< of a row
  std::vector<std::uint32_t> start_;  ///< of each bin, and the end
  std::vector<std::uint32_t> row_, position_;
  std::vector<float> x_[3];
};

}  // namespace sph
