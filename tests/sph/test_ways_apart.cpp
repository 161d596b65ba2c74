// How long lists last where what flows flows together: bounds on ways against all pairs, and that no pair is missed.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "sph/pairs/ways_apart.hpp"
#include "sph/step/simulation.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

/// Of rows that start in a box of some reaches, go any way, and drift on.
RC_GTEST_PROP(WaysApart, are_bounds_of_all_pairs_and_not_wide_ones, ()) {
  const int dim = *rc::gen::inRange(2, 4), rows = *rc::gen::inRange(1, 60), size = *rc::gen::inRange(1, 8);
  const auto reach = std::int64_t{1} << *rc::gen::inRange(8, 52);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto d = static_cast<std::size_t>(dim), n = static_cast<std::size_t>(rows);
  const auto random = [&](std::size_t row, std::uint64_t what) {
    return uniform_minus_one_to_one(seed, row * 16 + what / 4, what % 4);
  };
  Particles p(dim, {Field::position, Field::velocity, Field::group});
  p.table().resize(n, 0);
  const auto long_reach = static_cast<double>(reach);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t a = 0; a < d; ++a)
      p.data<Field::position>()[i * d + a] = static_cast<std::int64_t>(size * long_reach * random(i, a));
  WaysApart ways;
  ways.begin(p, reach);
  std::vector<std::array<double, 3>> start(n), gone(n);
  const double time = 0.25 * long_reach;
  for (std::size_t i = 0; i < n; ++i) {
    p.data<Field::group>()[i] = random(i, 12) < 0.5 ? 1 : 0;
    for (std::size_t a = 0; a < d; ++a) {
      const auto way = static_cast<std::int64_t>(0.3 * long_reach * random(i, 4 + a));
      start[i][a] = static_cast<double>(p.data<Field::position>()[i * d + a]);
      p.data<Field::position>()[i * d + a] += way;
      const double v = p.data<Field::velocity>()[i * d + a] = random(i, 8 + a);
      gone[i][a] = static_cast<double>(way) + (p.data<Field::group>()[i] == 1 ? 0 : time * v);
    }
  }
  const auto size_of = [&](auto component) {
    double square = 0;
    for (std::size_t a = 0; a < d; ++a) square += component(a) * component(a);
    return std::sqrt(square);
  };
  double alone = 0, together = 0, wide = 0;
  for (std::size_t i = 0; i < n; ++i) {
    alone = std::max(alone, size_of([&](std::size_t a) { return gone[i][a]; }));
    for (std::size_t j = 0; j < i; ++j) {
      const auto way = [&](std::size_t a) { return start[i][a] + gone[i][a] - start[j][a] - gone[j][a]; };
      const double apart = size_of([&](std::size_t a) { return gone[i][a] - gone[j][a]; });
      if (size_of(way) < long_reach) together = std::max(together, apart);
      double most = 0;
      for (std::size_t a = 0; a < d; ++a) most = std::max(most, std::abs(way(a)));
      if (most < 2.001 * long_reach + 2) wide = std::max(wide, apart);
    }
  }
  const WaysApart::Ways found = ways.look(p, {false, true}, time);
  const double slack = 20 * std::max(1.0, long_reach * 0x1p-27);
  RC_ASSERT(found.alone >= alone);
  RC_ASSERT(found.alone <= alone + slack);
  RC_ASSERT(found.together >= together);
  // Of cells that are no wider than lists reach; few rows in a wide box have wider ones.
  if (std::pow(2 * size + 1, dim) < 2 * rows + 64)
    RC_ASSERT(found.together <= std::sqrt(static_cast<double>(dim)) * wide + slack);
}

constexpr const char* box = R"(
[domain]
lower = [0, 0]
upper = [30, 24]
periodic = [true, true]
[kernel]
h_over_dx = 1
[[group]]
name = "melt"
kind = "fluid"
density = 1000
sound_speed = 20
[start]
spacing = 1
file = "FILE"
[time]
steps = 1
[decomposition]
balance = "chaos"
)";

/// A lattice in disorder with velocities of a vortex, some particles' own, and of all alike.
std::vector<std::string> flow(const test::ScratchDirectory& scratch, const decomp::Comm& comm, double vortex,
                              double own, double common) {
  const std::filesystem::path path = scratch.path() / "flow.csv";
  comm.barrier();
  if (comm.rank() == 0) {
    std::ofstream out(path);
    out.precision(17);
    out << "id,x,y,vx,vy,group\n";
    for (int j = 0, id = 0; j < 24; ++j)
      for (int i = 0; i < 30; ++i, ++id) {
        const auto random = [&](std::uint64_t what) {
          return uniform_minus_one_to_one(5, static_cast<std::uint64_t>(id), what);
        };
        const double a = 2 * M_PI * (i + 0.5) / 30, b = 2 * M_PI * (j + 0.5) / 24;
        out << id << ',' << i + 0.5 + 0.2 * random(0) << ',' << j + 0.5 + 0.2 * random(1) << ','
            << common + vortex * std::sin(a) * std::cos(b) + own * random(2) << ','
            << 0.5 * common - vortex * std::cos(a) * std::sin(b) + own * random(3) << ",melt\n";
      }
  }
  comm.barrier();
  return {"start.file=" + path.string()};
}

Scene scene_of(std::vector<std::string> settings, const std::string& skin) {
  settings.push_back("decomposition.skin=" + skin);
  return parse_scene(box, "box", settings);
}

/// Pairs within the support that the lists of this rank's rows lack.
std::int64_t lost(const Simulation& s) {
  const Particles& p = s.particles();
  const auto lanes = static_cast<std::size_t>(s.lists().lanes());
  const std::int64_t* x = p.data<Field::position>();
  const double radius = s.scene().support() / s.scale().quantum;
  std::int64_t found = 0;
  for (const RowRange& range : s.sets().front().ranges)
    for (std::size_t i = range.first; i < range.last; ++i) {
      const auto block = s.lists().block(range.first_block + (i - range.first) / lanes);
      std::vector<bool> listed(p.rows(), false);
      for (std::size_t k = (i - range.first) % lanes; k < block.size(); k += lanes) listed[block[k]] = true;
      for (std::size_t j = 0; j < p.rows(); ++j) {
        const auto dx = static_cast<double>(x[j * 2] - x[i * 2]);
        const auto dy = static_cast<double>(x[j * 2 + 1] - x[i * 2 + 1]);
        found += j != i && !listed[j] && dx * dx + dy * dy < radius * radius ? 1 : 0;
      }
    }
  return found;
}

TEST(WaysApart, lists_hold_every_pair_after_each_step) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const test::ScratchDirectory scratch(comm);
  for (const double own : {0.0, 0.5, 3.0})
    for (const char* skin : {"0.02", "0.1", "0.6"}) {
      Simulation s(comm, scene_of(flow(scratch, comm, 4, own, 0), skin));
      for (int k = 0; k < 60; ++k) {
        s.step();
        s.refresh_halo({Field::position});
        ASSERT_EQ(lost(s), 0) << "after step " << k + 1 << ", skin " << skin << ", " << own << " m/s";
      }
    }
}

// Each of two pieces moves as one, so nothing near has gone apart while they approach each other, with the width of a cell
// between them or more.
TEST(WaysApart, pieces_that_meet_are_listed_in_time) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const test::ScratchDirectory scratch(comm);
  for (const char* skin : {"0.1", "0.25", "0.34"})
    for (int tenths = 36; tenths < 56; ++tenths) {
      const std::filesystem::path path = scratch.path() / "pieces.csv";
      comm.barrier();
      if (comm.rank() == 0) {
        std::ofstream out(path);
        out << "id,x,y,vx,vy,group\n";
        for (int id = 0; id < 240; ++id) {
          const int column = id / 24;
          out << id << ',' << 4.3 + column + (column < 5 ? 0 : 0.1 * tenths) << ',' << id % 24 + 0.5 << ','
              << (column < 5 ? 5 : -5) << ",0,melt\n";
        }
      }
      comm.barrier();
      Simulation s(comm, scene_of({"start.file=" + path.string(), "start.free_surface=true"}, skin));
      for (int k = 0; k < 16; ++k) {
        s.step();
        s.refresh_halo({Field::position});
        ASSERT_EQ(lost(s), 0) << "after step " << k + 1 << ", skin " << skin << ", gap " << 0.1 * tenths;
      }
    }
}

// What is further apart than ranks can see may not come near unseen: lists last until something has gone as far as that.
TEST(WaysApart, lists_of_what_moves_as_one_last_long) {
  const decomp::Comm comm(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const test::ScratchDirectory scratch(comm);
  const std::vector<std::string> settings = flow(scratch, comm, 0, 0, 8);
  Simulation often(self, scene_of(settings, "1")), s(comm, scene_of(settings, "0.1"));
  double way = 0;
  for (int k = 0; k < 100; ++k) {
    way += s.global().max_speed * s.global().dt;
    often.step(), s.step();
  }
  EXPECT_EQ(s.fingerprint(), often.fingerprint());
  const double half_skin = 0.5 * s.distribution().skin(),
               furthest = 0.5 * s.scene().support() + 2 * half_skin;
  EXPECT_GT(way, 3 * furthest);
  EXPECT_LT(static_cast<double>(s.rebuilds()), 0.5 * way / half_skin);
  EXPECT_GE(static_cast<double>(s.rebuilds()), std::floor(way / furthest));
}

}  // namespace
}  // namespace sph
