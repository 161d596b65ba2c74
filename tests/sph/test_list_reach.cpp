// Lists must hold every pair that a pass takes, and rows that are computed before the halo has arrived none
// of the halo: whatever the skin, the speeds and the ranks.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "sph/core/error.hpp"
#include "sph/step/simulation.hpp"
#include "state_fixture.hpp"

namespace sph {
namespace {

constexpr const char* streams = R"(
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
sound_speed = 10
[start]
spacing = 1
file = "FILE"
[time]
steps = 1
[decomposition]
balance = "fixed"
)";

std::string text_with(const std::filesystem::path& file) {
  std::string text = streams;
  return text.replace(text.find("FILE"), 4, file.string());
}

/// Slabs three spacings high, in disorder, that run against each other.
std::filesystem::path write_streams(const test::ScratchDirectory& scratch, const decomp::Comm& comm,
                                    double speed) {
  const std::filesystem::path path = scratch.path() / "streams.csv";
  if (comm.rank() == 0) {
    std::ofstream out(path);
    out.precision(17);
    out << "id,x,y,vx,vy,group\n";
    for (int j = 0, id = 0; j < 24; ++j)
      for (int i = 0; i < 30; ++i, ++id)
        out << id << ',' << i + 0.5 + 0.2 * uniform_minus_one_to_one(7, static_cast<std::uint64_t>(id), 0)
            << ',' << j + 0.5 + 0.2 * uniform_minus_one_to_one(7, static_cast<std::uint64_t>(id), 1) << ','
            << (j / 3 % 2 == 0 ? speed : -speed) << ",0,melt\n";
  }
  comm.barrier();
  return path;
}

std::string after(const decomp::Comm& comm, const std::filesystem::path& file, int steps,
                  const std::vector<std::string>& overrides) {
  Simulation s(comm, parse_scene(text_with(file), "streams", overrides));
  for (int k = 0; k < steps; ++k) s.step();
  return s.fingerprint();
}

// Passes take pairs where they were half a step ago: beyond the skin in all but the largest, and in the
// fastest stream beyond the default.
TEST(ListReach, no_skin_changes_the_bits_however_fast_the_flow) {
  const decomp::Comm comm(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const test::ScratchDirectory scratch(comm);
  for (const double speed : {1.0, 5.0, 50.0}) {
    const std::filesystem::path file = write_streams(scratch, comm, speed);
    for (const std::string precision : {"precision=double", "precision=mixed"}) {
      const std::string wanted = after(self, file, 25, {precision, "decomposition.skin=1"});
      for (const std::string skin : {"0", "1e-4", "0.002", "0.05", "0.2"})
        EXPECT_EQ(after(comm, file, 25, {precision, "decomposition.skin=" + skin}), wanted)
            << speed << " m/s, skin " << skin << ", " << precision;
    }
  }
}

// Wall particles stay where they are, but their pairs are taken with the velocity of their material.
TEST(ListReach, holds_the_pairs_of_a_wall_that_slides_faster_than_the_fluid) {
  const decomp::Comm comm(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const test::ScratchDirectory scratch(comm);
  const auto run = [&](const decomp::Comm& on, const std::string& skin) {
    std::string text = text_with("none");
    text.replace(
        text.find("file = \"none\""), 13,
        "jitter = 0.2\n[[start.region]]\ngroup = \"melt\"\n[[start.region]]\ngroup = \"lid\"\nshape = "
        "\"box\"\nlower = [0, 0]\nupper = [30, 4]\n[[group]]\nname = \"lid\"\nkind = "
        "\"wall\"\nvelocity = [20, 0]");
    Simulation s(
        on, parse_scene(text, "lid",
                        {"time.dt=0.01", "decomposition.rebuild_every=3", "decomposition.skin=" + skin}));
    for (int k = 0; k < 10; ++k) s.step();
    return s.fingerprint();
  };
  const std::string wanted = run(self, "1");
  for (const std::string skin : {"0", "0.01", "0.2"}) EXPECT_EQ(run(comm, skin), wanted) << skin;
}

// The search in single precision lists what lies up to 1e-5 beyond the radius: a row as little outside the
// boundary then has a partner in the halo.
TEST(ListReach, no_interior_row_lists_the_halo) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const test::ScratchDirectory scratch(comm);
  const std::filesystem::path path = scratch.path() / "edge.csv";
  constexpr double reach = 3 * 1.2;  // of lists, kernel's radius and skin
  if (comm.rank() == 0) {
    std::ofstream out(path);
    out.precision(17);
    out << "id,x,y,vx,vy,group\n";
    int id = 0;
    for (const double face : {0.0, 15.0, 10.0, 20.0})  // of one, two or three ranks along x
      for (int k = 0; k < 30; ++k, id += 2) {
        out << id << ',' << (face > 0 ? face - 1e-9 : 30 - 1e-9) << ',' << 0.3 + 0.55 * k << ",0,0,melt\n";
        out << id + 1 << ',' << face + reach * (1 + k * 0.5e-6) << ',' << 0.3 + 0.55 * k << ",0,0,melt\n";
      }
  }
  comm.barrier();
  const Simulation s(comm, parse_scene(text_with(path), "edge", {"decomposition.skin=0.2"}));
  const auto& ranges = s.sets().front().ranges;
  const auto lanes = static_cast<std::size_t>(s.lists().lanes());
  std::int64_t interior = 0;
  for (const RowClass c : {RowClass::interior_movers, RowClass::interior_walls}) {
    const RowRange& range = ranges[static_cast<std::size_t>(c)];
    interior += static_cast<std::int64_t>(range.rows());
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b)
      for (const std::uint32_t j : s.lists().block(b)) ASSERT_LT(j, s.particles().owned());
  }
  EXPECT_GT(comm.sum(interior), 0);
}

// A domain that is narrow in y has one cell there, as long as the domain.
TEST(ListReach, is_free_in_a_domain_that_is_narrower_than_the_lists_reach) {
  const decomp::Comm comm(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const test::ScratchDirectory scratch(comm);
  const std::filesystem::path file = scratch.path() / "narrow.csv";
  if (comm.rank() == 0) {
    std::ofstream out(file);
    out << "id,x,y,vx,vy,group\n";
    for (int id = 0; id < 30; ++id) out << id << ',' << id + 0.5 << ',' << 1 + id % 2 << ",1,0,melt\n";
  }
  comm.barrier();
  const auto run = [&](const decomp::Comm& on, const std::string& skin) {
    return after(on, file, 3,
                 {"domain.periodic=[true, false]", "domain.upper=[30, 3]", "decomposition.skin=" + skin});
  };
  const std::string wanted = run(self, "0.2");
  for (const std::string skin : {"0", "0.5", "2"}) EXPECT_EQ(run(comm, skin), wanted) << skin;
}

TEST(ListReach, refuses_speeds_that_no_scene_means) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const test::ScratchDirectory scratch(comm);
  for (const double speed : {101.0, 1e100}) {
    const std::filesystem::path file = write_streams(scratch, comm, speed);
    EXPECT_THROW(Simulation(comm, parse_scene(text_with(file), "streams", {})), InputError) << speed;
  }
  const std::filesystem::path file = write_streams(scratch, comm, 50);
  EXPECT_THROW(Simulation(comm, parse_scene(text_with(file), "streams", {"time.dt=0.1"})), InputError);
}

}  // namespace
}  // namespace sph
