// Rows of the halo that are not packed yet, and copies that are out of date, are loud where somebody reads
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "decomp/poison.hpp"
#include "pairs/poison_rows.hpp"
#include "sph/pairs/fusions.hpp"
#include "sph/step/simulation.hpp"

namespace sph {
namespace {

constexpr const char* box = R"(
precision = "PRECISION"
[domain]
lower = [0, 0]
upper = [20, 20]
periodic = [true, true]
[kernel]
h_over_dx = 1
[[group]]
name = "melt"
kind = "fluid"
density = 1000
sound_speed = 10
[start]
spacing = 1
jitter = 0.2
velocity = [1, 0.3]
[[start.region]]
group = "melt"
[time]
steps = 1
)";

Scene scene_in(const std::string& precision) {
  std::string text = box;
  return parse_scene(text.replace(text.find("PRECISION"), 9, precision), "box", {});
}

/// Sums of the first pass that are no numbers, had the boundary been computed as the interior is: before the
/// halo is packed.
std::int64_t bad_sums(const Simulation& s, bool packed) {
  auto& particles = const_cast<Particles&>(s.particles());  // the sums alone are written
  decomp::LargeVector<std::byte> rows;
  const Fusion& fusion = *s.plan().sums.front().stages.front().fusion;
  const PassContext context = s.physics()->constants().context(particles, s.lists(), rows, s.global().dt);
  fusion.pack(context, 0, particles.rows());
  if (!packed) poison_rows(context, fusion.row_bytes, particles.owned(), particles.rows());
  std::int64_t bad = 0;
  for (const RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
    const RowRange& range = s.sets().front().ranges[static_cast<std::size_t>(c)];
    fusion.run(context, range);
    for (std::size_t i = range.first; i < range.last; ++i)
      if (!std::isfinite(particles.data<Field::divergence>()[i])) ++bad;
  }
  return bad;
}

TEST(Poison, a_row_that_reads_the_halo_too_early_is_found) {
  if (!decomp::poisons()) GTEST_SKIP() << "this program does not poison";
  const decomp::Comm comm(MPI_COMM_WORLD);
  for (const std::string precision : {"double", "mixed"}) {
    Simulation s(comm, scene_in(precision));
    s.step();
    s.refresh_halo(s.plan().sums.front().stages.front().refresh);
    EXPECT_EQ(bad_sums(s, true), 0);
    const RowRange& boundary = s.sets().front().ranges[static_cast<std::size_t>(RowClass::boundary_movers)];
    EXPECT_GT(bad_sums(s, false), static_cast<std::int64_t>(boundary.rows() / 2)) << precision;
  }
}

TEST(Poison, copies_that_are_out_of_date_are_no_numbers) {
  if (!decomp::poisons()) GTEST_SKIP() << "this program does not poison";
  const decomp::Comm comm(MPI_COMM_WORLD);
  Simulation s(comm, scene_in("double"));
  s.step();
  const Particles& p = s.particles();
  ASSERT_GT(p.rows(), p.owned());
  for (std::size_t i = p.owned(); i < p.rows(); ++i)
    ASSERT_TRUE(std::isnan(p.data<Field::velocity>()[2 * i]));
  s.refresh_halo({Field::velocity});
  for (std::size_t i = p.owned(); i < p.rows(); ++i)
    ASSERT_TRUE(std::isfinite(p.data<Field::velocity>()[2 * i]));
}

TEST(Poison, a_start_leaves_nothing_of_the_state_out) {
  if (!decomp::poisons()) GTEST_SKIP() << "this program does not poison";
  const decomp::Comm comm(MPI_COMM_WORLD);
  for (const std::string name : {"grains_in_melt", "grains_pour", "bodies2d"}) {
    const Simulation s(comm, read_scene(PEPERITE_TEST_DIR "/scenes/" + name + ".toml", {}));
    for (const ParticleSet& set : s.sets())
      for (const Field f : state_of(set.particles.fields()).list()) {
        if (info(f).type != Type::f64) continue;
        const std::size_t values = set.particles.owned() * width(f, set.particles.dim()) / sizeof(double);
        const double* x = set.particles.table().as<double>(set.particles.column(f));
        for (std::size_t k = 0; k < values; ++k)
          ASSERT_FALSE(std::isnan(x[k])) << name << ' ' << info(f).name;
      }
  }
}

TEST(Poison, fresh_rows_are_no_numbers) {
  if (!decomp::poisons()) GTEST_SKIP() << "this program does not poison";
  decomp::Table table;
  const int c = table.add_column("x", sizeof(double));
  table.resize(3, 0);
  for (int k = 0; k < 3; ++k) table.as<double>(c)[k] = k;
  table.resize(2, 0);
  table.resize(2, 2);
  EXPECT_EQ(table.as<double>(c)[1], 1);
  EXPECT_TRUE(std::isnan(table.as<double>(c)[2]));
  EXPECT_TRUE(std::isnan(table.as<double>(c)[3]));
}

}  // namespace
}  // namespace sph
