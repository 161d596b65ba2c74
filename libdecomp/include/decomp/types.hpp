// Basic types of the decomposition. Lengths are integers: positions are counted in quanta of the scene,
// so every comparison, wrap and image shift in this library is exact and the same on every rank.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace decomp {

using Gid = std::uint64_t;  ///< global id of a particle; never depends on ranks
using Rank = int;
using Int3 = std::array<std::int64_t, 3>;  ///< coordinates [quanta] or cell indices; unused axes are 0

inline constexpr int max_axes = 3;

/// Half-open box lo <= x < hi on three axes (cells or quanta, as the user says).
struct Box {
  Int3 lo{};
  Int3 hi{};
  [[nodiscard]] bool contains(const Int3& x) const {
    for (int a = 0; a < max_axes; ++a)
      if (x[a] < lo[a] || x[a] >= hi[a]) return false;
    return true;
  }
  [[nodiscard]] bool empty() const { return lo[0] >= hi[0] || lo[1] >= hi[1] || lo[2] >= hi[2]; }
  friend bool operator==(const Box&, const Box&) = default;
};

/// The request cannot be met (too many ranks for the grid, bad cuts file, ...): bad input, exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A promise was broken while running (lost particle, late message): physics guard, exit code 3.
struct GuardError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace decomp
