// Skilling's transposed form of the Hilbert index: bit b of axis a is bit (b * dim + dim - 1 - a) of the key.
// The loops undo (or redo) the reflections and exchanges that each level of the curve applies to the lower
// bits, all levels of one axis at a time, without tables.
#include <utility>

#include "decomp/grid.hpp"

namespace decomp {

namespace {

using Axes = std::array<std::uint64_t, 3>;

/// One level: reflect the lower bits of axis 0, or exchange them with those of axis a.
void turn(Axes& x, int a, std::uint64_t level) {
  const std::uint64_t lower = level - 1;
  if ((x[a] & level) != 0) {
    x[0] ^= lower;
  } else {
    const std::uint64_t differ = (x[0] ^ x[a]) & lower;
    x[0] ^= differ;
    x[a] ^= differ;
  }
}

}  // namespace

std::uint64_t hilbert_key(int dim, int bits, const Int3& cell) {
  if (dim == 1) return static_cast<std::uint64_t>(cell[0]);
  Axes x{};
  for (int a = 0; a < dim; ++a) x[a] = static_cast<std::uint64_t>(cell[a]);
  const std::uint64_t top = (std::uint64_t{1} << bits) >> 1;
  for (std::uint64_t level = top; level > 1; level >>= 1)
    for (int a = 0; a < dim; ++a) turn(x, a, level);
  for (int a = 1; a < dim; ++a) x[a] ^= x[a - 1];
  std::uint64_t flip = 0;
  for (std::uint64_t level = top; level > 1; level >>= 1)
    if ((x[dim - 1] & level) != 0) flip ^= level - 1;
  for (int a = 0; a < dim; ++a) x[a] ^= flip;
  std::uint64_t key = 0;
  for (int b = bits - 1; b >= 0; --b)
    for (int a = 0; a < dim; ++a) key = key << 1 | (x[a] >> b & 1);
  return key;
}

Int3 hilbert_cell(int dim, int bits, std::uint64_t key) {
  if (dim == 1) return {static_cast<std::int64_t>(key), 0, 0};
  Axes x{};
  for (int b = 0; b < bits; ++b)
    for (int a = dim - 1; a >= 0; --a) {
      x[a] |= (key & 1) << b;
      key >>= 1;
    }
  const std::uint64_t flip = x[dim - 1] >> 1;
  for (int a = dim - 1; a > 0; --a) x[a] ^= x[a - 1];
  x[0] ^= flip;
  const std::uint64_t end = std::uint64_t{1} << bits;
  for (std::uint64_t level = 2; level < end; level <<= 1)
    for (int a = dim - 1; a >= 0; --a) turn(x, a, level);
  Int3 cell{};
  for (int a = 0; a < dim; ++a) cell[a] = static_cast<std::int64_t>(x[a]);
  return cell;
}

}  // namespace decomp
