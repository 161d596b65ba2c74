// Lists of a part of the pairs of others, for sums to which all else would add 0. A list holds all that may come near before
// the next one is made: bonds are those of the reference state, a quarter of them where they reach as far as 1.9 spacings;
// of the partners of what moves only those beside a wall have any that are a wall's.
#include <algorithm>

#include "sph/pairs/neighbour_lists.hpp"

namespace sph {
namespace {

template <std::size_t D>
double reference_distance2(const std::int64_t* x, const std::int64_t* moved, std::size_t i, std::size_t j) {
  double square = 0;
  for (std::size_t a = 0; a < D; ++a) {
    const auto away =
        static_cast<double>((x[j * D + a] - moved[j * D + a]) - (x[i * D + a] - moved[i * D + a]));
    square += away * away;
  }
  return square;
}

}  // namespace

/// `possible(j)`: whether any row may want partner j; `wanted(i, j)`: whether row i does.
template <class Possible, class Wanted>
void NeighbourLists::keep(const NeighbourLists& all, const RowRanges& ranges, Possible possible,
                          Wanted wanted) {
  const auto lanes = static_cast<std::size_t>(lanes_);
  begin_.assign(1, 0);
  entries_.clear();
  pairs_ = 0;
  std::vector<std::uint32_t> kept;
  std::vector<std::size_t> length(lanes);
  for (const RowRange& range : ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b) {
      const std::span<const std::uint32_t> from = all.block(b);
      const auto row_of = [&](std::size_t lane) {
        return static_cast<std::uint32_t>(std::min(first + lane, range.last - 1));
      };
      kept.resize(std::max(kept.size(), from.size()));
      std::size_t longest = 0;
      const bool any = std::ranges::any_of(from, possible);
      for (std::size_t l = 0; l < lanes && any; ++l) {
        const std::uint32_t self = row_of(l);
        std::size_t n = 0;
        for (std::size_t k = l; k < from.size(); k += lanes)
          if (from[k] != self && wanted(self, from[k])) kept[n++ * lanes + l] = from[k];
        length[l] = n;
        pairs_ += n;
        longest = std::max(longest, n);
      }
      for (std::size_t l = 0; l < lanes; ++l)
        for (std::size_t n = length[l]; n < longest; ++n) kept[n * lanes + l] = row_of(l);
      entries_.insert(entries_.end(), kept.data(), kept.data() + longest * lanes);
      begin_.push_back(entries_.size());
    }
}

void NeighbourLists::build(const Particles& particles, const NeighbourLists& all, const RowRanges& ranges,
                           double reach, const std::vector<double>& body) {
  const std::int64_t *x = particles.data<Field::position>(), *moved = particles.data<Field::displacement>();
  const auto* group = particles.data<Field::group>();
  const auto distance2 = particles.dim() == 2 ? reference_distance2<2> : reference_distance2<3>;
  const auto any = [](std::size_t) { return true; };
  keep(all, ranges, any, [&](std::size_t i, std::size_t j) {
    return distance2(x, moved, i, j) <= reach * reach || body[group[i]] != body[group[j]];
  });
}

void NeighbourLists::build(const Particles& particles, const NeighbourLists& all, const RowRanges& ranges,
                           const std::vector<bool>& is_wall_group) {
  const auto* group = particles.data<Field::group>();
  std::vector<std::uint8_t> is_wall(particles.rows());
  for (std::size_t i = 0; i < is_wall.size(); ++i) is_wall[i] = is_wall_group[group[i]] ? 1 : 0;
  keep(
      all, ranges, [&](std::size_t j) { return is_wall[j] != 0; },
      [&](std::size_t i, std::size_t j) { return is_wall[j] > is_wall[i]; });
}

}  // namespace sph
