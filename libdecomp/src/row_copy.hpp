// Copies rows of a fixed width by index. The width is a run-time number, but the common ones get a loop of
// their own in which memcpy is a few moves: a call per row would cost more than the memory traffic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace decomp {

/// Calls copy(w) where w converts to `width` and is a constant for the common widths.
template <class Copy>
void with_row_width(std::size_t width, Copy&& copy) {
  switch (width) {
    case 1:
      return copy(std::integral_constant<std::size_t, 1>{});
    case 4:
      return copy(std::integral_constant<std::size_t, 4>{});
    case 8:
      return copy(std::integral_constant<std::size_t, 8>{});
    case 12:
      return copy(std::integral_constant<std::size_t, 12>{});
    case 16:
      return copy(std::integral_constant<std::size_t, 16>{});
    case 24:
      return copy(std::integral_constant<std::size_t, 24>{});
    case 32:
      return copy(std::integral_constant<std::size_t, 32>{});
    case 48:
      return copy(std::integral_constant<std::size_t, 48>{});
    case 64:
      return copy(std::integral_constant<std::size_t, 64>{});
    default:
      return copy(width);
  }
}

/// to[k] = from[rows[k]]
inline void gather_rows(std::byte* to, const std::byte* from, std::span<const std::uint32_t> rows,
                        std::size_t width) {
  with_row_width(width, [&](auto w) {
    for (std::size_t k = 0; k < rows.size(); ++k) std::memcpy(to + k * w, from + rows[k] * std::size_t{w}, w);
  });
}

/// to[rows[k]] = from[k]
inline void scatter_rows(std::byte* to, const std::byte* from, std::span<const std::uint32_t> rows,
                         std::size_t width) {
  with_row_width(width, [&](auto w) {
    for (std::size_t k = 0; k < rows.size(); ++k) std::memcpy(to + rows[k] * std::size_t{w}, from + k * w, w);
  });
}

/// data[to[k]] = data[from[k]]
inline void copy_rows(std::byte* data, std::span<const std::uint32_t> to, std::span<const std::uint32_t> from,
                      std::size_t width) {
  with_row_width(width, [&](auto w) {
    for (std::size_t k = 0; k < to.size(); ++k)
      std::memcpy(data + to[k] * std::size_t{w}, data + from[k] * std::size_t{w}, w);
  });
}

}  // namespace decomp
