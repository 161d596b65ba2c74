// Skilling's transposed form of the Hilbert index: bit b of axis a is bit (b * dim + dim - 1 - a) of the key.
// The loops undo (or redo) the reflections and exchanges that each level of the curve applies to the lower
// bits, all levels of one axis at a time, without tables.
#include <bit>
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

namespace {

/// A symmetry of the square or cube: bit a of a corner becomes bit axis[a], then those in `flip` are
/// inverted.
struct Symmetry {
  std::array<int, 3> axis{0, 1, 2};
  unsigned flip = 0;
  [[nodiscard]] unsigned operator()(unsigned corner) const {
    unsigned moved = flip;
    for (int a = 0; a < 3; ++a) moved ^= (corner >> a & 1u) << axis[a];
    return moved;
  }
  [[nodiscard]] Symmetry after(const Symmetry& first) const {
    Symmetry both{.flip = (*this)(first.flip)};
    for (int a = 0; a < 3; ++a) both.axis[a] = axis[first.axis[a]];
    return both;
  }
};

/// The curve of any order is made of 2^dim turned copies of the one of an order less: their corners in the
/// order of the curve, and how each copy is turned, read off the curve of order two.
struct Generator {
  int dim;
  std::array<unsigned, 8> corner{};
  std::array<Symmetry, 8> turned;

  explicit Generator(int d) : dim(d) {
    const auto at = [&](int bits, std::uint64_t key) {
      const Int3 cell = hilbert_cell(dim, bits, key);
      return static_cast<unsigned>((cell[0] & 1) | (cell[1] & 1) << 1 | (cell[2] & 1) << 2);
    };
    const unsigned children = 1u << dim;
    for (unsigned c = 0; c < children; ++c) corner[c] = at(1, c);
    for (unsigned c = 0; c < children; ++c) {
      turned[c].flip = at(2, c << dim);  // the curve begins in corner 0
      for (unsigned k = 0; k < children; ++k)
        if (std::has_single_bit(corner[k]))
          turned[c].axis[static_cast<std::size_t>(std::countr_zero(corner[k]))] =
              std::countr_zero(at(2, c << dim | k) ^ turned[c].flip);
    }
  }
};

struct Walk {
  Generator curve;
  const Box& box;
  std::vector<std::uint32_t> place;
  std::uint32_t next = 0;

  void visit(const Symmetry& turned, std::int64_t edge, const Int3& lo) {
    for (int a = 0; a < curve.dim; ++a)
      if (lo[a] >= box.hi[a] || lo[a] + edge <= box.lo[a]) return;
    if (edge == 1) {
      const std::int64_t nx = box.hi[0] - box.lo[0], ny = box.hi[1] - box.lo[1];
      place[static_cast<std::size_t>(((lo[2] - box.lo[2]) * ny + lo[1] - box.lo[1]) * nx + lo[0] -
                                     box.lo[0])] = next++;
      return;
    }
    for (std::size_t c = 0; c < std::size_t{1} << curve.dim; ++c) {
      const unsigned corner = turned(curve.corner[c]);
      Int3 at = lo;
      for (int a = 0; a < curve.dim; ++a) at[a] += (corner >> a & 1u) * (edge / 2);
      visit(turned.after(curve.turned[c]), edge / 2, at);
    }
  }
};

}  // namespace

std::vector<std::uint32_t> hilbert_places(int dim, int bits, const Box& box) {
  std::size_t cells = 1;
  for (int a = 0; a < 3; ++a) cells *= static_cast<std::size_t>(a < dim ? box.hi[a] - box.lo[a] : 1);
  Walk walk{Generator(dim), box, std::vector<std::uint32_t>(cells)};
  walk.visit({}, std::int64_t{1} << bits, {});
  return std::move(walk.place);
}

}  // namespace decomp
