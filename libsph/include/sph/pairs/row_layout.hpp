// Where each value stands in a row of pair_rows.hpp.
#pragma once

#include <array>
#include <cstddef>

#include "sph/pairs/pair_values.hpp"

namespace sph {

/// Offsets, in scalars, of the values in a row: position first, then in the order of the enum; the stride is
/// a multiple of four, the unit of the transposed load.
template <int D, ValueSet S>
struct RowLayout {
  /// Beside its volume a mover needs no number of its own: walls have a negative volume.
  static constexpr bool volume_tells_mover = S.has(Value::volume) && S.has(Value::mover);
  [[nodiscard]] static constexpr int numbers_of(Value v) {
    return !S.has(v) || (v == Value::mover && volume_tells_mover) ? 0 : components(v, D);
  }
  /// A table, so that no offset is counted while a program runs.
  static constexpr auto offsets = [] {
    std::array<int, static_cast<std::size_t>(Value::count_) + 1> at{};
    at[0] = D;
    for (std::size_t k = 1; k < at.size(); ++k) at[k] = at[k - 1] + numbers_of(static_cast<Value>(k - 1));
    return at;
  }();
  [[nodiscard]] static constexpr int offset(Value v) { return offsets[static_cast<std::size_t>(v)]; }
  static constexpr int used = offset(Value::count_);
  static constexpr int stride = (used + 3) / 4 * 4;
};

}  // namespace sph
