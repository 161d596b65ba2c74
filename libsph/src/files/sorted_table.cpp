#include "files/sorted_table.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "decomp/migrate.hpp"

namespace sph {

void sort_by_id(const decomp::Comm& comm, decomp::Table& table, int keys) {
  const auto* id = table.as<std::uint64_t>(0);
  // Flipping the top bit makes the order of int64, which the reduction knows, that of the ids.
  constexpr std::uint64_t top = std::uint64_t{1} << 63;
  const auto key = [](std::uint64_t x) { return static_cast<std::int64_t>(x ^ top); };
  std::int64_t greatest = key(0);
  std::int64_t least_negated = key(0);
  for (std::size_t row = 0; row < table.owned(); ++row) {
    greatest = std::max(greatest, key(id[row]));
    least_negated = std::max(least_negated, key(~id[row]));
  }
  const std::uint64_t last = static_cast<std::uint64_t>(comm.max(greatest)) ^ top;
  const std::uint64_t first = ~(static_cast<std::uint64_t>(comm.max(least_negated)) ^ top);

  if (comm.size() > 1) {
    const std::uint64_t range = (last - first) / static_cast<std::uint64_t>(comm.size()) + 1;
    std::vector<decomp::Rank> owner(table.owned());
    for (std::size_t row = 0; row < owner.size(); ++row)
      owner[row] = static_cast<decomp::Rank>((id[row] - first) / range);
    decomp::redistribute(comm, owner, table, nullptr);
    id = table.as<std::uint64_t>(0);
  }
  std::vector<std::uint32_t> order(table.owned());
  std::iota(order.begin(), order.end(), 0U);
  const auto* second = keys > 1 ? table.as<std::uint64_t>(1) : id;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return id[a] != id[b] ? id[a] < id[b] : second[a] < second[b];
  });
  table.reorder(order);
}

void share_out(const decomp::Comm& comm, decomp::Table& table, std::int64_t unit) {
  const auto owned = static_cast<std::int64_t>(table.owned());
  const std::int64_t first = comm.exclusive_sum(owned);
  const std::int64_t units = (comm.sum(owned) + unit - 1) / unit;
  const std::int64_t share = (units + comm.size() - 1) / comm.size() * unit;
  std::vector<decomp::Rank> owner(table.owned());
  for (std::size_t row = 0; row < owner.size(); ++row)
    owner[row] = static_cast<decomp::Rank>((first + static_cast<std::int64_t>(row)) / share);
  const std::int64_t stay = std::ranges::count(owner, comm.rank());
  const std::int64_t before = stay > 0 ? std::max<std::int64_t>(0, first - comm.rank() * share) : 0;
  decomp::redistribute(comm, owner, table, nullptr);
  // Rows that stay come first there; these come after those of lower ranks.
  std::vector<std::uint32_t> order(table.owned());
  std::iota(order.begin(), order.end(), 0U);
  std::rotate(order.begin(), order.begin() + stay, order.begin() + stay + before);
  table.reorder(order);
}

}  // namespace sph
