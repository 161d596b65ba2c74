#include "sph/plan/row_order.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "pairs/list_slack.hpp"
#include "pairs/occupied.hpp"

namespace sph {
namespace {

int curve_bits(const decomp::CellGrid& grid) {
  const decomp::Int3& cells = grid.cells();
  return static_cast<int>(
      std::bit_width(static_cast<std::uint64_t>(std::max({cells[0], cells[1], cells[2]}))));
}

/// By bucket, then by id. `start`, zeros, becomes the first place of each occupied bucket, and the end.
std::vector<std::uint32_t> counting_sort(const std::vector<std::size_t>& bucket, const Occupied& occupied,
                                         const std::uint64_t* id, std::vector<std::uint32_t>& start) {
  const std::size_t n = bucket.size();
  std::vector<std::uint32_t> bin(n), order(n);
  for (std::size_t i = 0; i < n; ++i) ++start[(bin[i] = occupied.before(bucket[i])) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t first = start[bin[i]];
    std::uint32_t k = at[bin[i]]++;
    for (; k > first && id[order[k - 1]] > id[i]; --k) order[k] = order[k - 1];
    order[k] = static_cast<std::uint32_t>(i);
  }
  return order;
}

}  // namespace

RowOrder::Sorted RowOrder::sort(ParticleSet& set, const decomp::JaggedPartition& partition, decomp::Rank rank,
                                std::int64_t reach) {
  const decomp::CellGrid& grid = partition.grid();
  Particles& particles = set.particles;
  const std::size_t d = static_cast<std::size_t>(particles.dim()), n = particles.owned();
  const std::int64_t* x = particles.data<Field::position>();
  const auto* group = particles.data<Field::group>();
  const decomp::Box own = partition.cells(rank);
  decomp::Box inner = partition.quanta(rank);
  const auto slack = static_cast<std::int64_t>(2 * list_slack(grid, own, reach) * static_cast<double>(reach));
  const std::int64_t depth = reach + slack + 1;
  for (std::size_t a = 0; a < d; ++a) inner.lo[a] += depth, inner.hi[a] -= depth;
  const std::int64_t nx = own.hi[0] - own.lo[0], ny = own.hi[1] - own.lo[1];
  const auto own_count = static_cast<std::size_t>(nx * ny * (d == 3 ? own.hi[2] - own.lo[2] : 1));
  // Few rows in many cells: their places along the curve of the whole grid, which are in the same order.
  const int bits = curve_bits(grid);
  const bool dense = Occupied::dense(4 * own_count, n);
  const std::size_t cells = dense ? own_count : std::size_t{1} << (static_cast<int>(d) * bits);
  if (!dense) curve_ = {};
  if (dense && curve_.empty()) curve_ = decomp::hilbert_places(grid.dim(), bits, own);

  std::vector<std::size_t> bucket(n);
  Occupied occupied(4 * cells, n);
  std::int64_t to_face = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < n; ++i) {
    decomp::Int3 p{};
    for (std::size_t a = 0; a < d; ++a) p[a] = x[i * d + a];
    const decomp::Int3 c = grid.cell_of(p);
    const auto place = [&]() -> std::size_t {
      if (!dense) return decomp::hilbert_key(grid.dim(), bits, c);
      return curve_[static_cast<std::size_t>(((c[2] - own.lo[2]) * ny + c[1] - own.lo[1]) * nx + c[0] -
                                             own.lo[0])];
    };
    bool interior = true;
    for (std::size_t a = 0; a < d; ++a) interior = interior && p[a] >= inner.lo[a] && p[a] < inner.hi[a];
    const std::size_t row_class = (interior ? 0u : 2u) + (set.stays[group[i]] ? 1u : 0u);
    for (std::size_t a = 0; a < d && row_class % 2 == 0; ++a)
      if (const std::int64_t low = p[a] - grid.origin()[a]; !grid.periodic()[a])
        to_face = std::min({to_face, low, grid.length()[a] - 1 - low});
    bucket[i] = row_class * cells + place();
    occupied.mark(bucket[i]);
  }
  std::vector<std::uint32_t> start(occupied.number() + 1, 0);
  std::vector<std::uint32_t> order = counting_sort(bucket, occupied, particles.data<Field::id>(), start);
  for (std::size_t c = 0; c < 4; ++c)
    set.ranges[c] = {start[occupied.before(c * cells)], start[occupied.before((c + 1) * cells)], 0};
  particles.table().reorder(order);
  return {std::move(order), to_face};
}

}  // namespace sph
