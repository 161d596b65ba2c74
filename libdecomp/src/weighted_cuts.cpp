#include <algorithm>
#include <vector>

#include "decomp/partition.hpp"

namespace decomp {
namespace {

/// Cuts 0 = c_0 < ... < c_n = line.size() so that part k weighs about share[k] of the whole, no part thinner
/// than `width[k]` cells: each cut is the cell line nearest to its target among those that leave room.
std::vector<std::int64_t> share_out(const std::vector<std::int64_t>& line, const std::vector<int>& share,
                                    const std::vector<std::int64_t>& width) {
  const std::int64_t cells = static_cast<std::int64_t>(line.size());
  std::vector<double> before(line.size() + 1, 0);
  for (std::size_t k = 0; k < line.size(); ++k) before[k + 1] = before[k] + static_cast<double>(line[k]);
  double all_shares = 0;
  std::int64_t room_after = 0;
  for (std::size_t k = 0; k < share.size(); ++k) all_shares += share[k], room_after += width[k];
  std::vector<std::int64_t> cuts{0};
  double wanted = 0;
  for (std::size_t k = 0; k + 1 < share.size(); ++k) {
    wanted += share[k] / all_shares * before.back();
    room_after -= width[k];
    const std::int64_t lowest = cuts.back() + width[k], highest = cells - room_after;
    const auto at = std::lower_bound(before.begin(), before.end(), wanted);
    std::int64_t cut = at - before.begin();
    if (cut > 0 && wanted - before[static_cast<std::size_t>(cut - 1)] < *at - wanted) --cut;
    cuts.push_back(std::clamp(cut, lowest, highest));
  }
  cuts.push_back(cells);
  return cuts;
}

}  // namespace

Cuts weighted_cuts(int ranks, std::int64_t row_cells, std::int64_t column_cells,
                   std::span<const std::int64_t> weight) {
  const std::vector<int> shape = jagged_shape(ranks, row_cells, column_cells);
  std::vector<std::int64_t> line(static_cast<std::size_t>(row_cells), 0);
  const auto cell = [&](std::int64_t r, std::int64_t c) {
    return weight[static_cast<std::size_t>(r * column_cells + c)];
  };
  for (std::int64_t r = 0; r < row_cells; ++r)
    for (std::int64_t c = 0; c < column_cells; ++c) line[static_cast<std::size_t>(r)] += cell(r, c);
  Cuts cuts;
  cuts.row = share_out(line, shape, std::vector<std::int64_t>(shape.size(), JaggedPartition::min_width));
  for (std::size_t p = 0; p < shape.size(); ++p) {
    line.assign(static_cast<std::size_t>(column_cells), 0);
    for (std::int64_t r = cuts.row[p]; r < cuts.row[p + 1]; ++r)
      for (std::int64_t c = 0; c < column_cells; ++c) line[static_cast<std::size_t>(c)] += cell(r, c);
    const std::size_t columns = static_cast<std::size_t>(shape[p]);
    cuts.column.push_back(share_out(line, std::vector<int>(columns, 1),
                                    std::vector<std::int64_t>(columns, JaggedPartition::min_width)));
  }
  return cuts;
}

}  // namespace decomp
