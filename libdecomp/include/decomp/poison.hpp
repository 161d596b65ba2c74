// Memory that nobody may read yet, made loud: in builds with the option PEPERITE_POISON, and without NDEBUG,
// fresh rows, copies in the halo that are out of date or under way, and rows of the halo that are not packed
// yet have all bits set. As numbers these are NaN, as indices beyond every table.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

#include "decomp/table.hpp"

namespace decomp {

/// Does this build poison?
[[nodiscard]] bool poisons() noexcept;

/// Nothing in builds that do not.
inline void poison(std::byte* first, std::size_t bytes) noexcept {
  if (poisons() && bytes > 0) std::memset(first, 0xFF, bytes);
}

/// The halo's rows of these columns.
inline void poison_halo(Table& table, std::span<const int> columns) noexcept {
  for (const int c : columns) {
    Column& column = table.column(c);
    poison(column.data() + table.owned() * column.width(), table.halo() * column.width());
  }
}

}  // namespace decomp
