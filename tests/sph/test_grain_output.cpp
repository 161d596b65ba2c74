// What a scene of grains writes: monitors, and contacts and stresses in snapshots.
#include <cmath>

#include "grain_output_fixture.hpp"
#include "sph/inspect/inspect.hpp"

namespace sph::test {
namespace {

TEST_F(GrainOutput, MonitorsOfTwoGrainsOnAFloor) {
  Simulation s(world_, scene_of(springs, stack));
  EXPECT_EQ(value(s, "contacts_n"), 1);
  EXPECT_EQ(value(s, "contacts_walls"), 1);
  EXPECT_EQ(value(s, "contacts_z"), 1.5);
  expect_share(value(s, "energy_kinetic"), 0.5 * mass * 4);
  expect_share(value(s, "energy_rotational"), 0.2 * mass * 1e-4 * 25);
  expect_share(value(s, "energy_potential"), mass * 9.81 * (0.009 + 0.0275));
  expect_share(value(s, "energy_elastic"), 0.5 * 1000 * (1e-6 + 2.25e-6));
  EXPECT_EQ(value(s, "wall_vx"), 0.25);
  EXPECT_EQ(value(s, "wall_fz"), 0) << "no step yet";

  s.step();
  expect_share(value(s, "wall_fz"), -1);
  EXPECT_EQ(value(s, "wall_z"), 0);
}

TEST_F(GrainOutput, ElasticEnergyOfHertz) {
  Simulation s(world_, scene_of(hertz, stack));
  const double modulus = 2e6 / (1 - 0.0625) / 2;  // both sides give way
  const auto energy = [&](double radius, double overlap) {
    return 8.0 / 15 * modulus * std::sqrt(radius) * std::pow(overlap, 2.5);
  };
  expect_share(value(s, "energy_elastic"), energy(0.01, 1e-3) + energy(0.005, 1.5e-3));
}

TEST_F(GrainOutput, FixedGrainsAreLikeWalls) {
  Simulation s(world_, scene_of(springs + glued, header + "7,0.11,0.1,0.0275,0,0,0,sand,0.01,0,0,0\n" +
                                                     "3,0.11,0.1,0.009,0,0,0,glued,0.01,0,0,0\n"));
  EXPECT_EQ(value(s, "contacts_n"), 0);
  EXPECT_EQ(value(s, "contacts_walls"), 1);
  EXPECT_EQ(value(s, "contacts_z"), 1);
  expect_share(value(s, "energy_potential"), mass * 9.81 * 0.0275);
  expect_share(value(s, "energy_elastic"), 0.5 * 1000 * 2.25e-6);
}

TEST_F(GrainOutput, ContactsAndStressOfTwoGrainsOnAFloor) {
  const std::filesystem::path file = scratch_.path() / "a.h5";
  Simulation s(world_, scene_of(springs, stack));
  write(s, file);
  EXPECT_EQ(read<std::uint64_t>(file, "contacts/id", Element::u64), (std::vector<std::uint64_t>{3, 3}));
  EXPECT_EQ(read<std::uint64_t>(file, "contacts/partner", Element::u64),
            (std::vector<std::uint64_t>{7, wall_key}));
  const auto overlap = read<double>(file, "contacts/overlap", Element::f64);
  const auto force = read<double>(file, "contacts/force", Element::f64);
  const auto point = read<double>(file, "contacts/point", Element::f64);
  const double wanted_force[]{0, 0, -1.5, 0, 0, 1};
  const double wanted_point[]{0.11, 0.1, 0.01825, 0.11, 0.1, 0};
  expect_share(overlap.at(0), 1.5e-3);
  expect_share(overlap.at(1), 1e-3);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(force.at(k), wanted_force[k], 1e-6);
    EXPECT_NEAR(point.at(k), wanted_point[k], 1e-8);
  }
  EXPECT_EQ(read<double>(file, "particles/coordination", Element::f64), (std::vector<double>{2, 1}));
  const auto stress = read<double>(file, "particles/stress", Element::f64);
  ASSERT_EQ(stress.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(stress[k], k % 6 == 2 ? stress[k] : 0, 1e-6);
  expect_share(stress[2], -(1 * 0.009 + 1.5 * 0.00925) / volume);
  expect_share(stress[8], -1.5 * 0.00925 / volume);
  EXPECT_NE(describe(file).find("contacts 2"), std::string::npos);
  EXPECT_NE(describe(file).find("stress, coordination"), std::string::npos) << describe(file);
}

// After two steps the grains have come closer than the skin of their lists: the next step would rebuild
// first.
TEST_F(GrainOutput, FindsAContactThatNoListHasYet) {
  Scene scene = scene_of(springs, header + "1,0.0600,0.1,0.1,2.5,0,0,sand,0.01,0,0,0\n" +
                                      "2,0.0816,0.1,0.1,-2.5,0,0,sand,0.01,0,0,0\n");
  scene.time.dt = 2e-4;
  Simulation s(world_, scene);
  s.step();
  EXPECT_EQ(value(s, "contacts_n"), 0);
  s.step();
  EXPECT_EQ(value(s, "contacts_n"), 1);
  expect_share(value(s, "energy_elastic"), 0.5 * 1000 * 4e-4 * 4e-4);
}

TEST_F(GrainOutput, AGrainAtRestWeighsOnTheFloor) {
  Simulation s(world_, scene_of(springs, header + "1,0.05,0.1,0.00992,0.25,0,0,sand,0.01,0,0,0\n"));
  for (int n = 0; n < 600; ++n) s.step();
  expect_share(value(s, "wall_fz"), -mass * 9.81);
  expect_share(value(s, "energy_elastic"), 0.5 * (mass * 9.81) * (mass * 9.81) / 1000);
}

}  // namespace
}  // namespace sph::test
