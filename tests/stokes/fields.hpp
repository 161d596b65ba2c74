// What tests of fields on a staggered grid share: boxes of unit size, who has which of their cells, numbers of a cell
// that are the same on any rank, sums over all ranks, and the comparison of bits with those of one rank.
#pragma once

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "stokes/grid.hpp"

namespace test_stokes {

using stokes::Box;
using stokes::Field;
using stokes::Grid;
using stokes::Int3;
using stokes::Patch;
using stokes::Side;

inline Grid unit_box(int dim, const Int3& cells, Side side) {
  Grid g;
  g.dim = dim;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
    g.cells[a] = cells[a];
    g.edge[a] = 1.0 / static_cast<double>(cells[a]);
    g.sides[a] = {side, side};
  }
  return g;
}
inline Grid unit_box(int dim, std::int64_t n, Side side) { return unit_box(dim, Int3{n, n, n}, side); }

/// work(index, cell) for this rank's cells.
template <class Work>
void for_cells(const Patch& p, Work work) {
  stokes::for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t y, std::int64_t z) {
    for (std::int64_t i = 0; i < n; ++i) work(first + i, Int3{p.own.lo[0] + i, y, z});
  });
}

/// work(index, lower corner of the cell) for this rank's cells.
template <class Work>
void for_corners(const Patch& p, Work work) {
  for_cells(p, [&](std::ptrdiff_t k, const Int3& x) {
    std::array<double, 3> corner{};
    for (std::size_t a = 0; a < 3; ++a) corner[a] = static_cast<double>(x[a]) * p.grid.edge[a];
    work(k, corner);
  });
}

/// In [-1, 1), of a cell and a stream of numbers.
inline double hashed(const Grid& g, const Int3& x, unsigned stream) {
  const auto number = static_cast<std::uint64_t>((x[2] * g.cells[1] + x[1]) * g.cells[0] + x[0]);
  std::uint64_t bits = (number << 32 | stream) + 0x9e3779b97f4a7c15ULL;
  for (const std::uint64_t factor : {0xbf58476d1ce4e5b9ULL, 0x94d049bb133111ebULL}) {
    bits ^= bits >> 31;
    bits *= factor;
  }
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

inline Field hashed_field(const Patch& p, unsigned stream, double middle, double amplitude) {
  Field f(p.size, 0.0);
  for_cells(p,
            [&](std::ptrdiff_t k, const Int3& x) { f[k] = middle + amplitude * hashed(p.grid, x, stream); });
  return f;
}
inline stokes::Velocity hashed_velocity(const Patch& p, unsigned stream, double amplitude) {
  stokes::Velocity u;
  for (unsigned a = 0; a < static_cast<unsigned>(p.grid.dim); ++a)
    u[a] = hashed_field(p, 3 * stream + a + 1000, 0, amplitude);
  return u;
}

/// Over all ranks; term(index).
template <class Term>
double sum_over_cells(const decomp::Comm& comm, const Patch& p, Term term) {
  std::array<decomp::ExactSum, 1> sum;
  for_cells(p, [&](std::ptrdiff_t k, const Int3&) { sum[0].add(term(k)); });
  decomp::ExactSum::all_reduce(comm, sum);
  return sum[0].value();
}

/// Cut across an axis at random, also into boxes of one tile and of none.
inline std::vector<Box> random_boxes(const Grid& g, std::size_t axis, int ranks, std::mt19937& random,
                                     std::int64_t tile = 1) {
  const std::int64_t tiles = g.cells[axis] / tile;
  std::vector<std::int64_t> cuts{0, tiles};
  for (int r = 1; r < ranks; ++r)
    cuts.push_back(static_cast<std::int64_t>(random() % static_cast<unsigned>(tiles + 1)));
  std::ranges::sort(cuts);
  std::vector<Box> boxes(static_cast<std::size_t>(ranks), g.box());
  for (std::size_t r = 0; r < boxes.size(); ++r) {
    boxes[r].lo[axis] = cuts[r] * tile;
    boxes[r].hi[axis] = cuts[r + 1] * tile;
  }
  return boxes;
}

/// How many of the rank's cells have other bits than those of the whole.
inline std::size_t other_bits(const Patch& part, const Field& got, const Patch& whole,
                              const Field& expected) {
  std::size_t wrong = 0;
  for_cells(part, [&](std::ptrdiff_t k, const Int3& x) {
    wrong += std::memcmp(&got[k], &expected[whole.at(x)], sizeof(double)) == 0 ? 0 : 1;
  });
  return wrong;
}

}  // namespace test_stokes
