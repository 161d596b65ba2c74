#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "decomp/box_exchange.hpp"

namespace {

using decomp::Box;
using decomp::BoxExchange;
using decomp::cell_count;
using decomp::cell_values;
using decomp::Int3;

struct Case {
  Int3 cells;
  std::array<bool, 3> periodic;
  std::vector<Box> owned, wanted;
};

Box grown(Box box, const Int3& cells, const std::array<bool, 3>& periodic, std::int64_t by) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.hi[a] - box.lo[a] == cells[a] && cells[a] == 1) continue;  // an axis that is not used
    box.lo[a] -= by, box.hi[a] += by;
    if (!periodic[a])
      box.lo[a] = std::max<std::int64_t>(box.lo[a], 0), box.hi[a] = std::min(box.hi[a], cells[a]);
  }
  return box;
}

/// Slabs of random widths, some of them empty where there are more ranks than cells; boxes of copies are random too.
Case random_case(std::mt19937& random, int ranks) {
  const auto pick = [&](std::int64_t lo, std::int64_t hi) {
    return std::uniform_int_distribution<std::int64_t>(lo, hi)(random);
  };
  Case c;
  for (std::size_t a = 0; a < 3; ++a) c.cells[a] = pick(1, 7), c.periodic[a] = pick(0, 1) == 1;
  const auto axis = static_cast<std::size_t>(pick(0, 2));
  std::vector<std::int64_t> cuts{0, c.cells[axis]};
  for (int r = 1; r < ranks; ++r) cuts.push_back(pick(0, c.cells[axis]));
  std::ranges::sort(cuts);
  for (std::size_t r = 0; r < static_cast<std::size_t>(ranks); ++r) {
    Box box{{}, c.cells};
    box.lo[axis] = cuts[r], box.hi[axis] = cuts[r + 1];
    c.owned.push_back(box);
    Box wanted;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t least = c.periodic[a] ? -c.cells[a] : 0,
                         most = c.periodic[a] ? 2 * c.cells[a] : c.cells[a];
      wanted.lo[a] = pick(least, most);
      wanted.hi[a] = pick(wanted.lo[a], most);
    }
    c.wanted.push_back(wanted);
  }
  return c;
}

template <class Work>
void for_cells(const Box& box, Work work) {
  Int3 x;
  std::size_t k = 0;
  for (x[2] = box.lo[2]; x[2] < box.hi[2]; ++x[2])
    for (x[1] = box.lo[1]; x[1] < box.hi[1]; ++x[1])
      for (x[0] = box.lo[0]; x[0] < box.hi[0]; ++x[0]) work(x, k++);
}

/// Of the cell in the grid that x is an image of.
std::int64_t number_of(const Case& c, Int3 x) {
  for (std::size_t a = 0; a < 3; ++a) x[a] = ((x[a] % c.cells[a]) + c.cells[a]) % c.cells[a];
  return (x[2] * c.cells[1] + x[1]) * c.cells[0] + x[0];
}

TEST(BoxExchange, EveryCopyIsTheOwnersCell) {
  std::mt19937 random(1);
  const decomp::Comm comm(MPI_COMM_WORLD);
  const auto me = static_cast<std::size_t>(comm.rank());
  for (int round = 0; round < 200; ++round) {
    const Case c = random_case(random, comm.size());
    BoxExchange exchange(comm, c.cells, c.periodic, c.owned, c.wanted);
    std::vector<std::int64_t> own(cell_count(c.owned[me])), copies(cell_count(c.wanted[me]), -1);
    std::vector<float> own_pairs(2 * own.size()), pairs(2 * copies.size(), -1);
    for_cells(c.owned[me], [&](const Int3& x, std::size_t k) {
      own[k] = number_of(c, x);
      own_pairs[2 * k] = static_cast<float>(own[k]);
      own_pairs[2 * k + 1] = 0.5F * static_cast<float>(own[k]);
    });
    const std::array from{cell_values(std::span(own), c.owned[me]),
                          cell_values(std::span(own_pairs), c.owned[me], 2)};
    const std::array to{cell_values(std::span(copies), c.wanted[me]),
                        cell_values(std::span(pairs), c.wanted[me], 2)};
    exchange.copy(from, to);
    for_cells(c.wanted[me], [&](const Int3& x, std::size_t k) {
      ASSERT_EQ(copies[k], number_of(c, x));
      ASSERT_EQ(pairs[2 * k], static_cast<float>(number_of(c, x)));
      ASSERT_EQ(pairs[2 * k + 1], 0.5F * static_cast<float>(number_of(c, x)));
    });
  }
}

// Each copy holds a number of its own: what a cell gets is the sum over its copies on all ranks.
TEST(BoxExchange, FoldsSumUpAllCopies) {
  std::mt19937 random(2);
  const decomp::Comm comm(MPI_COMM_WORLD);
  const auto me = static_cast<std::size_t>(comm.rank());
  for (int round = 0; round < 200; ++round) {
    const Case c = random_case(random, comm.size());
    BoxExchange exchange(comm, c.cells, c.periodic, c.owned, c.wanted);
    const auto deposit = [&](std::size_t rank, std::size_t k) {
      return static_cast<std::int64_t>((rank + 1) * 1000003 + k * k);
    };
    std::vector<std::int64_t> all(cell_count({{}, c.cells}), 7);
    for (std::size_t r = 0; r < c.wanted.size(); ++r)
      for_cells(c.wanted[r], [&](const Int3& x, std::size_t k) {
        all[static_cast<std::size_t>(number_of(c, x))] += deposit(r, k);
      });
    std::vector<std::int64_t> own(cell_count(c.owned[me]), 7), copies(cell_count(c.wanted[me]));
    for (std::size_t k = 0; k < copies.size(); ++k) copies[k] = deposit(me, k);
    const std::array to{cell_values(std::span(copies), c.wanted[me])};
    const std::array from{cell_values(std::span(own), c.owned[me])};
    exchange.fold(to, from);
    for_cells(c.owned[me], [&](const Int3& x, std::size_t k) {
      ASSERT_EQ(own[k], all[static_cast<std::size_t>(number_of(c, x))]);
    });
  }
}

// One array with a halo around the cells that a rank owns.
TEST(BoxExchange, AHaloIsInTheArrayItself) {
  std::mt19937 random(3);
  const decomp::Comm comm(MPI_COMM_WORLD);
  const auto me = static_cast<std::size_t>(comm.rank());
  for (int round = 0; round < 100; ++round) {
    Case c = random_case(random, comm.size());
    for (std::size_t r = 0; r < c.owned.size(); ++r)
      c.wanted[r] = c.owned[r].empty() ? Box{} : grown(c.owned[r], c.cells, c.periodic, 1);
    BoxExchange exchange(comm, c.cells, c.periodic, c.owned, c.wanted);
    std::vector<std::int64_t> values(cell_count(c.wanted[me]), -1);
    for_cells(c.wanted[me], [&](const Int3& x, std::size_t k) {
      if (c.owned[me].contains(x)) values[k] = number_of(c, x);
    });
    const std::array array{cell_values(std::span(values), c.wanted[me])};
    exchange.copy(array, array);
    for_cells(c.wanted[me], [&](const Int3& x, std::size_t k) { ASSERT_EQ(values[k], number_of(c, x)); });
    std::vector<std::int64_t> ones(values.size(), 1), copies(cell_count({{}, c.cells}), 0);
    for (const Box& box : c.wanted)
      for_cells(box,
                [&](const Int3& x, std::size_t) { ++copies[static_cast<std::size_t>(number_of(c, x))]; });
    const std::array counted{cell_values(std::span(ones), c.wanted[me])};
    exchange.fold(counted, counted);
    for_cells(c.wanted[me], [&](const Int3& x, std::size_t k) {
      if (!c.owned[me].contains(x)) return;
      ASSERT_EQ(ones[k], copies[static_cast<std::size_t>(number_of(c, x))]);
    });
  }
}

}  // namespace
