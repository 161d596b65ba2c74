// The fluid, and walls, around each grain: lists of rows in the order of ids.
#include "pairs/candidates.hpp"
#include "pairs/id_rank.hpp"
#include "sph/models/drag.hpp"

namespace sph {

void Drag::rebuild(const Particles& grains, const ListSetting& setting, const decomp::Payload&,
                   std::span<const std::uint32_t>) {
  const auto timing = setting.timers.time(decomp::Region::lists);
  const Particles& fluid = *setting.other;
  const CellBins bins(fluid, setting.grid, setting.own_cells, setting.radius);
  const IdRank order(fluid.data<Field::id>(), fluid.rows());
  std::vector<std::uint32_t> tags(bins.rows().size());
  for (std::size_t k = 0; k < fluid.rows(); ++k) tags[k] = order.rank_of_row[bins.rows()[k]];
  const CandidateTable candidates{bins, tags.data()};
  const std::int64_t* x = grains.data<Field::position>();
  const auto* group = fluid.data<Field::group>();
  first_.assign(1, 0);
  entries_.clear();
  std::vector<std::uint32_t> found;
  CellBins::Runs runs;
  for (std::size_t i = 0; i < grains.rows(); ++i) {
    const std::span<const CellBins::Run> near = bins.runs_near(x + i * 3, runs);
    if (const std::size_t room = CandidateTable::room(near); room > found.size()) found.resize(2 * room);
    float at[3];
    for (int a = 0; a < 3; ++a) at[a] = bins.scaled(a, x[i * 3 + static_cast<std::size_t>(a)]);
    const std::size_t n = candidates.find<3, Keep::all>(near, at, bins.limit(), 0, found.data());
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n));
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t row = order.row_of_rank[found[k]];
      // A grain of another rank acts on the fluid of this one alone.
      const bool of_no_use = i >= grains.owned() && (row >= fluid.owned() || constants_->is_wall(group[row]));
      if (!of_no_use) entries_.push_back(row);
    }
    first_.push_back(entries_.size());
  }
}

void Drag::count(const RowRanges&, std::span<std::uint32_t> entries) const {
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i] += static_cast<std::uint32_t>(first_[i + 1] - first_[i]);
}

}  // namespace sph
