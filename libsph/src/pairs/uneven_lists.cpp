// Lists of particles whose kernels differ in width. Each row looks around as far as it reaches itself, in
// cells finer than those of the decomposition, so that cost follows the reaches there are and not the
// largest; a partner that does not reach back is told.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pairs/id_rank.hpp"
#include "sph/pairs/neighbour_lists.hpp"

namespace sph {
namespace {

constexpr std::uint32_t no_partner = ~std::uint32_t{0};

/// Rows by cell; all in the order of the cells.
template <int D>
struct FineCells {
  std::array<std::int64_t, D> cells{};
  double edge = 1;
  std::vector<std::uint32_t> start, row;
  std::array<std::vector<double>, D> x;  ///< from the lowest corner [quanta]

  FineCells(const Particles& particles, std::span<const double> reach) {
    const std::size_t rows = particles.rows();
    const std::int64_t* position = particles.data<Field::position>();
    std::array<std::int64_t, D> lower{}, upper{};
    for (std::size_t a = 0; a < D; ++a) {
      lower[a] = upper[a] = position[a];
      for (std::size_t i = 1; i < rows; ++i) {
        lower[a] = std::min(lower[a], position[i * D + a]);
        upper[a] = std::max(upper[a], position[i * D + a]);
      }
    }
    // Half the reach of one that stands for the many, and not many more cells than rows.
    std::vector<double> some(reach.begin(), reach.end());
    std::nth_element(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(rows / 2), some.end());
    edge = 0.5 * some[rows / 2];
    double all;
    for (;; edge *= 1.25) {
      all = 1;
      for (std::size_t a = 0; a < D; ++a) {
        const double across = std::floor(static_cast<double>(upper[a] - lower[a]) / edge) + 1;
        cells[a] = static_cast<std::int64_t>(across);
        all *= across;
      }
      if (all <= 2 * static_cast<double>(rows) + 1000) break;
    }
    start.assign(static_cast<std::size_t>(all) + 1, 0);
    std::vector<std::uint32_t> cell(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      std::int64_t at = 0;
      for (std::size_t a = D; a-- > 0;)
        at = at * cells[a] + index(static_cast<double>(position[i * D + a] - lower[a]), a);
      cell[i] = static_cast<std::uint32_t>(at);
      ++start[cell[i] + 1];
    }
    for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    row.resize(rows);
    for (std::vector<double>& coordinate : x) coordinate.resize(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::uint32_t k = next[cell[i]]++;
      row[k] = static_cast<std::uint32_t>(i);
      for (std::size_t a = 0; a < D; ++a) x[a][k] = static_cast<double>(position[i * D + a] - lower[a]);
    }
  }

  [[nodiscard]] std::int64_t index(double away, std::size_t axis) const {
    return std::clamp(static_cast<std::int64_t>(std::floor(away / edge)), std::int64_t{0}, cells[axis] - 1);
  }

  /// Calls visit(place) for what may lie within `reach` of place k.
  template <class Visit>
  void around(std::size_t k, double reach, Visit visit) const {
    std::array<std::int64_t, 3> first{}, last{};
    for (std::size_t a = 0; a < D; ++a)
      first[a] = index(x[a][k] - reach, a), last[a] = index(x[a][k] + reach, a);
    for (std::int64_t z = first[2]; z <= last[2]; ++z)
      for (std::int64_t y = first[1]; y <= last[1]; ++y) {
        const std::int64_t line = (z * cells[1] + y) * cells[0];
        for (std::uint32_t c = start[static_cast<std::size_t>(line + first[0])];
             c < start[static_cast<std::size_t>(line + last[0]) + 1]; ++c)
          visit(c);
      }
  }
};

}  // namespace

template <int D>
void NeighbourLists::find(const Particles& particles, std::span<const double> reach,
                          const std::vector<std::uint32_t>& tag_of_row, RowRanges& ranges) {
  const std::size_t owned = particles.owned(), lanes = static_cast<std::size_t>(lanes_);
  const FineCells<D> cells(particles, reach);
  std::vector<std::uint64_t> first(owned + 1, 0);
  std::vector<std::uint32_t> seen, told(owned, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tell;  // row, tag of the partner that reaches it
  std::vector<std::uint32_t> place(particles.rows());
  for (std::uint32_t k = 0; k < place.size(); ++k) place[cells.row[k]] = k;
  for (std::uint32_t i = 0; i < particles.rows(); ++i) {
    const std::uint32_t k = place[i];
    const double square = reach[i] * reach[i];
    if (i < owned) first[i] = seen.size();
    cells.around(k, reach[i], [&](std::uint32_t c) {
      const std::uint32_t j = cells.row[c];
      if (j == i || (i >= owned && j >= owned)) return;
      double distance = 0;
      for (std::size_t a = 0; a < D; ++a)
        distance += (cells.x[a][c] - cells.x[a][k]) * (cells.x[a][c] - cells.x[a][k]);
      if (distance > square) return;
      if (i < owned) seen.push_back(tag_of_row[j]);
      if (j < owned && distance > reach[j] * reach[j]) {
        tell.emplace_back(j, tag_of_row[i]);
        ++told[j];
      }
    });
  }
  first[owned] = seen.size();
  std::vector<std::uint64_t> first_told(owned + 1, 0);
  for (std::size_t i = 0; i < owned; ++i) first_told[i + 1] = first_told[i] + told[i];
  std::vector<std::uint32_t> of_others(tell.size());
  {
    std::vector<std::uint64_t> next(first_told.begin(), first_told.end() - 1);
    for (const auto& [row, tag] : tell) of_others[next[row]++] = tag;
  }
  begin_.assign(1, 0);
  entries_.clear();
  pairs_ = seen.size() + tell.size();
  for (RowRange& range : ranges) {
    range.first_block = begin_.size() - 1;
    for (std::size_t row = range.first; row < range.last; row += lanes) {
      std::size_t longest = 0;
      const std::size_t last = std::min(row + lanes, range.last);
      for (std::size_t i = row; i < last; ++i)
        longest = std::max<std::size_t>(longest, first[i + 1] - first[i] + told[i]);
      const std::size_t at = entries_.size();
      entries_.resize(at + longest * lanes);
      std::fill(entries_.begin() + static_cast<std::ptrdiff_t>(at), entries_.end(), no_partner);
      for (std::size_t i = row; i < last; ++i) {
        std::size_t entry = at + (i - row);
        for (std::uint64_t k = first[i]; k < first[i + 1]; ++k, entry += lanes) entries_[entry] = seen[k];
        for (std::uint64_t k = first_told[i]; k < first_told[i + 1]; ++k, entry += lanes)
          entries_[entry] = of_others[k];
      }
      begin_.push_back(entries_.size());
    }
  }
}

void NeighbourLists::build(const Particles& particles, std::span<const double> reach, RowRanges& ranges,
                           decomp::Timers& timers) {
  IdRank ids = [&] {
    const auto timing = timers.time(decomp::Region::order);
    return IdRank(particles.data<Field::id>(), particles.rows());
  }();
  if (particles.rows() == 0) {
    begin_.assign(1, 0);
    entries_.clear();
    pairs_ = 0;
    for (RowRange& range : ranges) range.first_block = 0;
    return;
  }
  {
    const auto timing = timers.time(decomp::Region::lists);
    particles.dim() == 2 ? find<2>(particles, reach, ids.rank_of_row, ranges)
                         : find<3>(particles, reach, ids.rank_of_row, ranges);
  }
  const auto timing = timers.time(decomp::Region::order);
  finish(ids.row_of_rank, ranges, true);
}

}  // namespace sph
