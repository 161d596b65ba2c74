// Between grains and a grid: what is put down is all there, ways are the difference of what is put down at their ends, and
// walls and periods neither take nor give anything.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/random.hpp"
#include "decomp/exact_sum.hpp"
#include "sph/models/grain_grid.hpp"
#include "stokes/partition.hpp"

namespace sph {
namespace {

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

constexpr std::int64_t width = std::int64_t{5} << 56;  // of the domain [quanta]: positions are no doubles

/// A cube of 8^3 cells, each rank with all of it, periodic along x.
struct Cube {
  Cube() {
    stokes::Grid g;
    g.dim = 3;
    g.cells = {8, 8, 8};
    g.edge = {0.125, 0.125, 0.125};
    using stokes::Side;
    g.sides = {{{Side::periodic, Side::periodic},
                {Side::free_slip, Side::no_slip},
                {Side::no_slip, Side::free_slip}}};
    const std::vector<decomp::Box> boxes = stokes::even_boxes(g, world().size());
    owners.emplace(g, boxes[static_cast<std::size_t>(world().rank())]);
    PositionScale scale;
    scale.quantum = 1.0 / width;
    grid.emplace(world(), g, scale, decomp::Int3{width, width, width}, boxes);
    const decomp::CellGrid cells(3, {}, {width, width, width}, {true, false, false}, width / 8);
    grid->follow(decomp::JaggedPartition(cells, 0, 1, decomp::uniform_cuts(world().size(), 8, 8)), 0.125);
    own = decomp::JaggedPartition(cells, 0, 1, decomp::uniform_cuts(world().size(), 8, 8))
              .quanta(world().rank());
  }
  /// This rank's of 200 places.
  [[nodiscard]] std::vector<decomp::Int3> places() const {
    std::vector<decomp::Int3> out;
    for (std::uint64_t id = 0; id < 200; ++id) {
      decomp::Int3 x{};
      for (std::size_t a = 0; a < 3; ++a)
        x[a] = static_cast<std::int64_t>(0.4999 * (uniform_minus_one_to_one(1, id, a) + 1) * width) + 1;
      if (own.contains(x)) out.push_back(x);
    }
    return out;
  }
  /// Over all ranks.
  [[nodiscard]] double sum(const stokes::Field& f) const {
    decomp::ExactSum total;
    stokes::for_lines(*owners, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
      for (std::ptrdiff_t k = first; k < first + n; ++k) total.add(f[static_cast<std::size_t>(k)]);
    });
    decomp::ExactSum::all_reduce(world(), std::span(&total, 1));
    return total.value();
  }

  std::optional<stokes::Patch> owners;
  std::optional<GrainGrid> grid;
  decomp::Box own;
};

TEST(GrainGrid, WhatIsPutDownIsAllThere) {
  Cube cube;
  GrainGrid::Deposit centre = cube.grid->make_deposit();
  std::int64_t mine = 0;
  for (const decomp::Int3& x : cube.places()) {
    cube.grid->spread(cube.grid->kernel(x.data()), centres, 1000.3, centre);
    mine += 1000;
  }
  stokes::Field f;
  const GrainGrid::Folded folded{&centre, centres, &f, 1};
  cube.grid->fold(std::span(&folded, 1), *cube.owners);
  EXPECT_EQ(cube.sum(f), static_cast<double>(world().sum(mine)));
  EXPECT_EQ(world().sum(mine), 200 * 1000);
}

TEST(GrainGrid, WaysAreTheDifferenceOfTheirEnds) {
  Cube cube;
  constexpr double unit = 0x1p-40;
  std::array<GrainGrid::Deposit, 5> sums;
  for (GrainGrid::Deposit& d : sums) d = cube.grid->make_deposit();
  std::uint64_t n = 0;
  for (const decomp::Int3& to : cube.places()) {
    decomp::Int3 from = to;
    for (std::size_t a = 0; a < 3; ++a) {
      from[a] += static_cast<std::int64_t>(uniform_minus_one_to_one(2, n, a) * (width / 8));
      if (a > 0) from[a] = std::clamp<std::int64_t>(from[a], 0, width - 1);
    }
    ++n;
    const GridKernel before = cube.grid->kernel(from.data()), after = cube.grid->kernel(to.data());
    cube.grid->spread(before, centres, 1 / unit, sums[0]);
    cube.grid->spread(after, centres, 1 / unit, sums[1]);
    cube.grid->spread_way(before, after, 1 / unit, {&sums[2], &sums[3], &sums[4]});
  }
  std::array<stokes::Field, 5> f;
  const std::array<GrainGrid::Folded, 5> folded{{{&sums[0], centres, f.data(), unit},
                                                 {&sums[1], centres, &f[1], unit},
                                                 {&sums[2], 0, &f[2], unit, true},
                                                 {&sums[3], 1, &f[3], unit, true},
                                                 {&sums[4], 2, &f[4], unit, true}}};
  cube.grid->fold(folded, *cube.owners);
  const stokes::Patch& p = *cube.owners;
  // Faces above the rank's cells are others', but for walls, where nothing passes.
  std::array<stokes::Field, 3> seen;
  const std::array<GrainGrid::Copied, 3> copied{{{&f[2], 0, GrainGrid::Behind::flux, seen.data()},
                                                 {&f[3], 1, GrainGrid::Behind::flux, &seen[1]},
                                                 {&f[4], 2, GrainGrid::Behind::flux, &seen[2]}}};
  cube.grid->copy(copied, p);
  const stokes::Patch& g = cube.grid->patch();
  double largest = 0, moved = 0;
  for (std::int64_t z = p.own.lo[2]; z < p.own.hi[2]; ++z)
    for (std::int64_t y = p.own.lo[1]; y < p.own.hi[1]; ++y)
      for (std::int64_t x = p.own.lo[0]; x < p.own.hi[0]; ++x) {
        if (!g.own.contains({x, y, z})) continue;
        const auto k = static_cast<std::size_t>(p.at(x, y, z));
        double out = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          const auto at = static_cast<std::size_t>(g.at(x, y, z)),
                     next = at + static_cast<std::size_t>(g.stride[a]);
          out += seen[a][next] - seen[a][at];
        }
        largest = std::max(largest, std::fabs(f[1][k] - f[0][k] + out));
        moved = std::max(moved, std::fabs(out));
      }
  std::array<double, 2> all{largest, moved};
  world().max(all);
  EXPECT_LT(all[0], 1e-9);
  EXPECT_GT(all[1], 0.1);
}

TEST(GrainGrid, WeightsAreTheSameAPeriodAway) {
  const Cube cube;
  for (const decomp::Int3& x : cube.places())
    for (const std::int64_t periods : {-1, 1}) {
      const decomp::Int3 image{x[0] + periods * width, x[1], x[2]};
      const GridKernel here = cube.grid->kernel(x.data()), there = cube.grid->kernel(image.data());
      EXPECT_EQ(there.centre[0].first, here.centre[0].first + 8 * periods);
      EXPECT_EQ(there.face[0].weight, here.face[0].weight);
      EXPECT_EQ(there.centre[0].weight, here.centre[0].weight);
    }
}

TEST(GrainGrid, MeansOfLinearFieldsAreExactAwayFromWalls) {
  Cube cube;
  stokes::Field f(cube.owners->size, 0.0);
  for (std::int64_t z = cube.owners->own.lo[2]; z < cube.owners->own.hi[2]; ++z)
    for (std::int64_t y = cube.owners->own.lo[1]; y < cube.owners->own.hi[1]; ++y)
      for (std::int64_t x = cube.owners->own.lo[0]; x < cube.owners->own.hi[0]; ++x)
        f[static_cast<std::size_t>(cube.owners->at(x, y, z))] =
            2.0 * static_cast<double>(y) - static_cast<double>(z);
  stokes::Field seen;
  const GrainGrid::Copied copied{&f, 1, GrainGrid::Behind::velocity, &seen};
  cube.grid->copy(std::span(&copied, 1), *cube.owners);
  for (const decomp::Int3& x : cube.places()) {
    const double y = static_cast<double>(x[1]) * 8 / width, z = static_cast<double>(x[2]) * 8 / width;
    if (y < 2 || y > 6 || z < 2 || z > 6) continue;
    const GridKernel k = cube.grid->kernel(x.data());
    EXPECT_NEAR(cube.grid->mean(k, 1, seen), 2 * y - (z - 0.5), 1e-12);
    EXPECT_NEAR(cube.grid->slope(k, 1, seen, 1), 2 * 8, 1e-10);
    EXPECT_NEAR(cube.grid->slope(k, 1, seen, 2), -8, 1e-10);
  }
}

}  // namespace
}  // namespace sph
