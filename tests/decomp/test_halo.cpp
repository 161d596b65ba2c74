#include <gtest/gtest.h>

#include <utility>

#include "decomp/halo.hpp"
#include "decomp/poison.hpp"
#include "decomp/test_particles.hpp"

namespace {

using namespace decomp_test;

constexpr std::int64_t reach = Scene::edge;
constexpr std::uint64_t cuts_per_scene = 4;

using Copy = std::pair<Gid, Int3>;  ///< a particle and where this copy of it is

std::vector<Int3> all_shifts(const CellGrid& grid) {
  std::vector<Int3> shifts;
  const auto steps = [&](int a) { return std::int64_t{a < grid.dim() && grid.periodic()[a]}; };
  for (std::int64_t i = -steps(0); i <= steps(0); ++i)
    for (std::int64_t j = -steps(1); j <= steps(1); ++j)
      for (std::int64_t k = -steps(2); k <= steps(2); ++k)
        shifts.push_back({i * grid.length()[0], j * grid.length()[1], k * grid.length()[2]});
  return shifts;
}

Int3 sum(const Int3& a, const Int3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// Within `reach` of some quantum of the half-open box, on every axis.
bool near_box(const Box& box, const Int3& x, int dim) {
  for (int a = 0; a < dim; ++a)
    if (x[a] < box.lo[a] - reach || x[a] > box.hi[a] - 1 + reach) return false;
  return true;
}

bool partners(const Int3& a, const Int3& b) {
  std::int64_t r2 = 0;
  for (int k = 0; k < 3; ++k) r2 += (a[k] - b[k]) * (a[k] - b[k]);
  return r2 <= reach * reach;
}

/// One rank's view of a scene, with ids and positions of the halo refreshed.
struct Fixture {
  const Scene& scene;
  const Comm& comm;
  JaggedPartition partition;
  Table table;
  HaloPlan plan;

  Fixture(const Scene& s, const Comm& c, std::uint64_t seed)
      : scene(s),
        comm(c),
        partition(random_partition(s, c.size(), seed)),
        table(fill_table(s, partition, c.rank())),
        plan(c, partition, reach, s.dim, 1, table) {
    plan.refresh(table, std::vector<int>{0, 1});
  }

  [[nodiscard]] Gid id(std::size_t row) const { return table.as<Gid>(0)[row]; }
  [[nodiscard]] Int3 x(std::size_t row) const { return position_in(table, row, scene.dim); }
  [[nodiscard]] std::vector<Copy> copies(std::size_t first, std::size_t last) const {
    std::vector<Copy> found;
    for (std::size_t r = first; r < last; ++r) found.emplace_back(id(r), x(r));
    std::sort(found.begin(), found.end());
    return found;
  }
};

/// Runs the check on each scene under several random cuts.
template <class Check>
void on_all_scenes(Check&& check) {
  const Comm comm(MPI_COMM_WORLD);
  for (const Scene& scene : scenes())
    for (std::uint64_t seed = 0; seed < cuts_per_scene; ++seed) {
      SCOPED_TRACE(scene.name + ", cuts " + std::to_string(seed) + ", rank " + std::to_string(comm.rank()));
      Fixture f(scene, comm, 77 * seed + 5);
      check(f);
    }
}

TEST(HaloPlan, holds_exactly_the_images_within_reach) {
  on_all_scenes([](const Fixture& f) {
    const Box own = f.partition.quanta(f.comm.rank());
    std::vector<Copy> expected;
    for (Gid id = 0; id < f.scene.particles; ++id) {
      const Int3 x = position_of(f.scene, id);
      for (const Int3& shift : all_shifts(f.partition.grid())) {
        const bool original = shift == Int3{} && owner_of(f.partition, x) == f.comm.rank();
        if (!original && near_box(own, sum(x, shift), f.scene.dim)) expected.emplace_back(id, sum(x, shift));
      }
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(f.copies(f.table.owned(), f.table.rows()), expected);
  });
}

TEST(HaloPlan, misses_no_partner_and_tells_the_boundary_from_the_interior) {
  on_all_scenes([](const Fixture& f) {
    const std::vector<Copy> here = f.copies(0, f.table.rows());
    const std::vector<std::uint8_t> boundary = f.plan.boundary(f.table.owned());
    std::vector<Int3> image;
    for (const Int3& shift : all_shifts(f.partition.grid()))
      for (Gid id = 0; id < f.scene.particles; ++id) image.push_back(sum(position_of(f.scene, id), shift));
    for (std::size_t r = 0; r < f.table.owned(); ++r) {
      const Int3 x = f.x(r);
      for (std::size_t k = 0; k < image.size(); ++k)
        if (partners(x, image[k])) {
          EXPECT_TRUE(std::binary_search(here.begin(), here.end(), Copy(k % f.scene.particles, image[k])))
              << "id " << f.id(r) << " misses " << k % f.scene.particles;
        }
      if (boundary[r] == 0) {
        for (std::size_t h = f.table.owned(); h < f.table.rows(); ++h)
          EXPECT_FALSE(partners(x, f.x(h))) << "interior id " << f.id(r) << " sees halo id " << f.id(h);
      }
    }
  });
}

TEST(HaloPlan, carries_every_width) {
  on_all_scenes([](Fixture& f) {
    f.plan.refresh(f.table, all_columns(f.table));
    for (std::size_t r = 0; r < f.table.rows(); ++r) EXPECT_EQ(wrong_value(f.table, r, f.id(r)), "");
  });
}

/// Positions and ids side by side, in memory of the caller's.
TEST(HaloPlan, carries_rows_that_are_kept_elsewhere) {
  on_all_scenes([](Fixture& f) {
    constexpr std::size_t width = 5;
    const auto dim = static_cast<std::size_t>(f.scene.dim);
    std::vector<std::int64_t> rows(f.table.rows() * width, -1);
    for (std::size_t r = 0; r < f.table.owned(); ++r) {
      const Int3 x = f.x(r);
      std::copy_n(x.begin(), dim, rows.begin() + static_cast<std::ptrdiff_t>(r * width));
      rows[r * width + 4] = static_cast<std::int64_t>(f.id(r));
    }
    const HaloPlan::Rows of{reinterpret_cast<std::byte*>(rows.data()), width * sizeof(std::int64_t), true};
    f.plan.begin(std::span(&of, 1));
    f.plan.end();
    for (std::size_t r = 0; r < f.table.rows(); ++r) {
      const Int3 x = f.x(r);
      for (std::size_t a = 0; a < dim; ++a) EXPECT_EQ(rows[r * width + a], x[a]);
      EXPECT_EQ(rows[r * width + 4], static_cast<std::int64_t>(f.id(r)));
    }
  });
}

TEST(HaloPlan, counts_what_it_sends) {
  on_all_scenes([](Fixture& f) {
    EXPECT_EQ(f.plan.rows_received() + f.plan.rows_copied(), f.table.halo());
    EXPECT_EQ(f.comm.sum(static_cast<std::int64_t>(f.plan.rows_sent())),
              f.comm.sum(static_cast<std::int64_t>(f.plan.rows_received())));
    const std::size_t before = f.plan.bytes_sent();
    EXPECT_EQ(before, f.plan.rows_sent() * (8 + 8 * static_cast<std::size_t>(f.scene.dim)));
    f.plan.refresh(f.table, std::vector<int>{3, 5});
    EXPECT_EQ(f.plan.bytes_sent() - before, f.plan.rows_sent() * (4 + 8));
  });
}

TEST(HaloPlan, lets_the_owner_compute_while_messages_travel) {
  on_all_scenes([](Fixture& f) {
    std::vector<int> columns = all_columns(f.table);
    columns.erase(columns.begin(), columns.begin() + 2);
    for (int version = 0; version < 5; ++version) {
      f.plan.begin(f.table, columns);
      for (std::size_t r = 0; r < f.table.owned(); ++r) {
        write_values(f.table, r, f.id(r), version + 1);
        f.plan.progress();
      }
      if (version % 2 == 0) f.plan.wait();
      f.plan.end();
      for (std::size_t r = 0; r < f.table.owned(); ++r)
        EXPECT_EQ(wrong_value(f.table, r, f.id(r), version + 1), "");
      for (std::size_t r = f.table.owned(); r < f.table.rows(); ++r)
        EXPECT_EQ(wrong_value(f.table, r, f.id(r), version), "");
    }
  });
}

TEST(HaloPlan, poisons_rows_under_way) {
  if (!poisons()) GTEST_SKIP() << "this program does not poison";
  on_all_scenes([](Fixture& f) {
    const auto byte_of = [&](std::size_t r) { return f.table.column(2).data()[r]; };
    f.plan.refresh(f.table, all_columns(f.table));
    for (std::size_t r = 0; r < f.table.owned(); ++r) write_values(f.table, r, f.id(r), 1);
    f.plan.begin(f.table, std::vector<int>{2});
    std::size_t poisoned = 0;
    for (std::size_t r = f.table.owned(); r < f.table.rows(); ++r) poisoned += byte_of(r) == std::byte{0xFF};
    EXPECT_GE(poisoned, f.plan.rows_received());
    f.plan.end();
  });
}

TEST(HaloPlan, subset_refreshes_the_kept_rows_alone) {
  on_all_scenes([](Fixture& f) {
    f.plan.refresh(f.table, all_columns(f.table));
    const auto kept = [](Gid id) { return splitmix(id) % 3 == 0; };
    std::vector<std::uint8_t> keep(f.table.rows());
    for (std::size_t r = 0; r < f.table.rows(); ++r) keep[r] = kept(f.id(r)) ? 1 : 0;
    HaloPlan part = f.plan.subset(keep);
    EXPECT_EQ(part.rows_received() + part.rows_copied(),
              static_cast<std::size_t>(
                  std::count(keep.begin() + static_cast<std::ptrdiff_t>(f.table.owned()), keep.end(), 1)));
    EXPECT_EQ(part.bytes_sent(), 0U);

    const std::vector<Copy> before = f.copies(f.table.owned(), f.table.rows());
    for (std::size_t r = 0; r < f.table.owned(); ++r) write_values(f.table, r, f.id(r), 1);
    part.refresh(f.table, all_columns(f.table));
    EXPECT_EQ(f.copies(f.table.owned(), f.table.rows()), before);
    for (std::size_t r = f.table.owned(); r < f.table.rows(); ++r)
      EXPECT_EQ(wrong_value(f.table, r, f.id(r), keep[r]), "");

    const std::vector<std::uint8_t> boundary = f.plan.boundary(f.table.owned());
    const std::vector<std::uint8_t> part_boundary = part.boundary(f.table.owned());
    for (std::size_t r = 0; r < f.table.owned(); ++r) EXPECT_EQ(part_boundary[r], boundary[r] & keep[r]);
  });
}

TEST(HaloPlan, serves_two_refreshes_at_once) {
  on_all_scenes([](Fixture& f) {
    HaloPlan other = f.plan.subset(std::vector<std::uint8_t>(f.table.rows(), 1));
    const std::vector<int> a{2, 3, 4, 5, 6}, b{7, 8, 9, 10};
    f.plan.begin(f.table, a);
    other.begin(f.table, b);
    other.end();
    f.plan.end();
    for (std::size_t r = 0; r < f.table.rows(); ++r) EXPECT_EQ(wrong_value(f.table, r, f.id(r)), "");
  });
}

TEST(HaloPlan, without_peers_does_nothing) {
  Table table = make_table(2);
  table.resize(3, 0);
  HaloPlan plan;
  plan.refresh(table, all_columns(table));
  EXPECT_EQ(plan.rows_sent() + plan.rows_received() + plan.rows_copied() + plan.bytes_sent(), 0U);
  EXPECT_EQ(plan.subset(std::vector<std::uint8_t>(3, 1)).rows_sent(), 0U);
  EXPECT_EQ(plan.boundary(3), (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(HaloPlan, refuses_misuse) {
  const Comm comm(MPI_COMM_WORLD);
  const Scene scene = scenes()[1];
  Fixture f(scene, comm, 1);
  const std::vector<int> columns{0};
  EXPECT_THROW(f.plan.end(), std::logic_error);
  f.plan.begin(f.table, columns);
  EXPECT_THROW(f.plan.begin(f.table, columns), std::logic_error);
  f.plan.end();
  f.table.resize(f.table.owned(), f.table.halo() + 1);
  EXPECT_THROW(f.plan.begin(f.table, columns), std::logic_error);
  EXPECT_THROW(HaloPlan(comm, f.partition, reach, 2, 0, f.table), std::logic_error);
}

TEST(HaloPlan, reports_a_row_outside_its_box) {
  const Comm comm(MPI_COMM_WORLD);
  const Scene scene = scenes()[1];
  const JaggedPartition partition = random_partition(scene, comm.size(), 3);
  Table table = make_table(2);
  table.resize(1, 0);
  const CellGrid& grid = partition.grid();
  set_position(table, 0, 2, {grid.origin()[0] + grid.length()[0], grid.origin()[1], 0});  // not wrapped
  EXPECT_THROW(HaloPlan(comm, partition, reach, 2, 1, table), GuardError);
}

}  // namespace
