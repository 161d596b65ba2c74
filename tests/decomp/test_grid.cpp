// Cell grid and Hilbert curve against brute force.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "decomp/grid.hpp"

namespace {

using decomp::CellGrid;
using decomp::InputError;
using decomp::Int3;

TEST(Grid, CountsCellsAndGivesTheLastOneTheRemainder) {
  const CellGrid grid(2, {-7, 100, 0}, {103, 40, 0}, {false, true, false}, 10);
  EXPECT_EQ(grid.cells(), (Int3{10, 4, 1}));
  EXPECT_EQ(grid.edge()[0], 10);
  EXPECT_EQ(grid.line(0, 0), -7);
  EXPECT_EQ(grid.line(0, 9), 83);
  EXPECT_EQ(grid.line(0, 10), 96);  // 13 quanta wide
  EXPECT_EQ(grid.line(1, 4), 140);
  EXPECT_EQ(grid.cell_of({95, 100, 0}), (Int3{9, 0, 0}));
}

TEST(Grid, ADomainSmallerThanAnEdgeHasOneCell) {
  const CellGrid grid(1, {0, 0, 0}, {9, 0, 0}, {}, 10);
  EXPECT_EQ(grid.cells(), (Int3{1, 1, 1}));
  EXPECT_EQ(grid.line(0, 1), 9);
  EXPECT_TRUE(grid.inside({8, 0, 0}));
  EXPECT_FALSE(grid.inside({9, 0, 0}));
}

TEST(Grid, RefusesWhatCannotWork) {
  EXPECT_THROW(CellGrid(2, {}, {29, 30, 0}, {true, true, false}, 10), InputError);
  EXPECT_NO_THROW(CellGrid(2, {}, {30, 30, 0}, {true, true, false}, 10));
  EXPECT_NO_THROW(CellGrid(2, {}, {30, 30, 0}, {true, true, true}, 10));  // unused axis: ignored
  EXPECT_THROW(CellGrid(4, {}, {30, 30, 30}, {}, 10), InputError);
  EXPECT_THROW(CellGrid(2, {}, {30, 0, 0}, {}, 10), InputError);
  EXPECT_THROW(CellGrid(2, {}, {30, 30, 0}, {}, 0), InputError);
  EXPECT_THROW(CellGrid(1, {1, 0, 0}, {CellGrid::max_coordinate, 0, 0}, {}, 10), InputError);
}

TEST(Grid, PositionsOutsideGoToTheEdgeCells) {
  const CellGrid grid(3, {10, 10, 10}, {35, 35, 35}, {false, false, true}, 10);
  EXPECT_EQ(grid.cell_of({9, -1000, 10}), (Int3{0, 0, 0}));
  EXPECT_EQ(grid.cell_of({45, 100000, 44}), (Int3{2, 2, 2}));
}

RC_GTEST_PROP(Grid, CellIsTheOneBetweenItsLines, ()) {
  const auto origin = *rc::gen::inRange<std::int64_t>(-1000, 1000);
  const auto length = *rc::gen::inRange<std::int64_t>(30, 500);
  const bool periodic = *rc::gen::arbitrary<bool>();
  const CellGrid grid(1, {origin, 0, 0}, {length, 0, 0}, {periodic, false, false}, 10);
  for (std::int64_t x = origin - 2 * length; x < origin + 3 * length; ++x) {
    const Int3 w = grid.wrap({x, 0, 0});
    const std::int64_t c = grid.cell_of(w)[0];
    RC_ASSERT(c >= 0 && c < grid.cells()[0]);
    if (periodic) RC_ASSERT((w[0] - x) % length == 0);
    if (!periodic) RC_ASSERT(w[0] == x);
    const bool in_domain = w[0] >= origin && w[0] < origin + length;
    RC_ASSERT(grid.inside(w) == (periodic || in_domain));
    RC_ASSERT(in_domain || !periodic);
    if (in_domain)
      RC_ASSERT(grid.line(0, c) <= w[0] && w[0] < grid.line(0, c + 1));
    else
      RC_ASSERT(c == (w[0] < origin ? 0 : grid.cells()[0] - 1));
  }
}

TEST(Hilbert, IsABijectionOfUnitSteps) {
  for (int dim = 1; dim <= 3; ++dim)
    for (int bits = 0; bits <= (dim == 3 ? 4 : 6); ++bits) {
      const std::uint64_t cells = std::uint64_t{1} << (dim * bits);
      std::vector<bool> seen(cells, false);
      Int3 before{};
      for (std::uint64_t key = 0; key < cells; ++key) {
        const Int3 cell = decomp::hilbert_cell(dim, bits, key);
        ASSERT_EQ(decomp::hilbert_key(dim, bits, cell), key) << dim << ' ' << bits;
        std::uint64_t index = 0;
        std::int64_t distance = 0;
        for (int a = 0; a < 3; ++a) {
          ASSERT_TRUE(cell[a] >= 0 && cell[a] < (a < dim ? std::int64_t{1} << bits : 1));
          index = (index << bits) + static_cast<std::uint64_t>(a < dim ? cell[a] : 0);
          distance += std::abs(cell[a] - before[a]);
        }
        index >>= bits * (3 - dim);
        ASSERT_FALSE(seen[index]);
        seen[index] = true;
        ASSERT_EQ(distance, key == 0 ? 0 : 1);
        before = cell;
      }
    }
}

RC_GTEST_PROP(Hilbert, PlacesAreTheOrderOfTheKeys, ()) {
  const int dim = *rc::gen::inRange(1, 4), bits = *rc::gen::inRange(0, dim == 3 ? 5 : 7);
  decomp::Box box{{0, 0, 0}, {1, 1, 1}};
  for (int a = 0; a < dim; ++a) {
    box.lo[a] = *rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << bits);
    box.hi[a] = *rc::gen::inRange<std::int64_t>(box.lo[a], std::int64_t{1} << bits) + 1;
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  for (std::int64_t z = box.lo[2]; z < box.hi[2]; ++z)
    for (std::int64_t y = box.lo[1]; y < box.hi[1]; ++y)
      for (std::int64_t x = box.lo[0]; x < box.hi[0]; ++x)
        keys.emplace_back(decomp::hilbert_key(dim, bits, {x, y, z}), static_cast<std::uint32_t>(keys.size()));
  std::ranges::sort(keys);
  const std::vector<std::uint32_t> places = decomp::hilbert_places(dim, bits, box);
  RC_ASSERT(places.size() == keys.size());
  for (std::uint32_t k = 0; k < keys.size(); ++k) RC_ASSERT(places[keys[k].second] == k);
}

RC_GTEST_PROP(Hilbert, RoundTripsAtFullWidth, (std::uint64_t word)) {
  RC_ASSERT(decomp::hilbert_key(2, 32, decomp::hilbert_cell(2, 32, word)) == word);
  const std::uint64_t key = word >> 1;  // 63 bits
  RC_ASSERT(decomp::hilbert_key(3, 21, decomp::hilbert_cell(3, 21, key)) == key);
}

}  // namespace
