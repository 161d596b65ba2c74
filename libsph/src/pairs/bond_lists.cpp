// A list holds all that may come near before the next one is made; bonds are those of the reference state, a quarter of
// them where they reach as far as 1.9 spacings. What is left out would have added 0.
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

void NeighbourLists::build(const Particles& particles, const NeighbourLists& all, const RowRanges& ranges,
                           double reach, const std::vector<double>& body) {
  const auto lanes = static_cast<std::size_t>(lanes_);
  const std::int64_t *x = particles.data<Field::position>(), *moved = particles.data<Field::displacement>();
  const auto* group = particles.data<Field::group>();
  const auto distance2 = particles.dim() == 2 ? reference_distance2<2> : reference_distance2<3>;
  const auto wanted = [&](std::size_t i, std::size_t j) {
    return i != j && (distance2(x, moved, i, j) <= reach * reach || body[group[i]] != body[group[j]]);
  };
  begin_.assign(1, 0);
  entries_.clear();
  pairs_ = 0;
  for (const RowRange& range : ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b) {
      const std::span<const std::uint32_t> from = all.block(b);
      const std::size_t start = entries_.size();
      std::size_t longest = 0;
      entries_.resize(start + from.size());
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t self = std::min(first + l, range.last - 1);
        std::size_t n = 0;
        for (std::size_t k = l; k < from.size(); k += lanes)
          if (wanted(self, from[k])) entries_[start + n++ * lanes + l] = from[k];
        pairs_ += n;
        longest = std::max(longest, n);
        for (; n * lanes < from.size(); ++n)
          entries_[start + n * lanes + l] = static_cast<std::uint32_t>(self);
      }
      entries_.resize(start + longest * lanes);
      begin_.push_back(entries_.size());
    }
}

}  // namespace sph
