// Guards of grains: what is out of range is stopped in the step it happens, or refused before the first, and
// one message names grain, place, step and key, whoever owns the grain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grain_fixture.hpp"
#include "models/stability.hpp"
#include "sph/core/error.hpp"
#include "sph/core/findings.hpp"

namespace sph {
namespace {

using test::StartGrain;

const std::string bare = R"(
dimension = 3
[domain]
lower = [0, 0, 0]
upper = [0.08, 0.08, 0.02]
[contact]
law = "linear"
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = 0.001
normal_stiffness = 100
restitution = 0.1
friction = 0.5
[[wall]]
name = "floor"
material = "sand"
point = [0, 0, 0]
normal = [0, 0, 1]
[time]
dt = 5e-6
steps = 1
[start]
file = "set later"
)";

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

template <class Error, class Work>
std::string message_of(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    // All ranks say the same.
    EXPECT_EQ(world().broadcast(std::string(error.what()), 0), error.what());
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

/// What ends a run of these grains.
template <class Error = GuardError>
std::string end_of(const std::vector<StartGrain>& grains, const std::vector<std::string>& overrides = {},
                   int steps = 20) {
  const test::StartFile file(world(), grains);
  Scene scene = parse_scene(bare, "bare", overrides);
  scene.start.file = file.path();
  return message_of<Error>([&] {
    Simulation s(world(), scene);
    for (int k = 0; k < steps; ++k) s.step();
  });
}

TEST(GrainGuards, StartSpeedsAreRefused) {
  const StartGrain slow{"sand", {0.03, 0.03, 0.01}, {80, 0, 0}, {}, 0.0005};
  const StartGrain fast{"sand", {0.01, 0.01, 0.01}, {0, 0, 90}, {}, 0.0005};
  // 0.4359 mm = sqrt(4 * 0.2 - 0.2^2) r in 5 us
  StartGrain another = fast;
  another.x[0] = 0.05;
  const std::string text = end_of<InputError>({slow, fast, another});
  EXPECT_SAYS(text, "bare: start: grain 1 has a speed of 90 m/s");
  EXPECT_SAYS(text, "0.00045 m in a step, and could pass others unseen beyond 0.000435");
  EXPECT_SAYS(text, "time.dt");
}

TEST(GrainGuards, WallSpeedsAreRefused) {
  const auto refused = [](const std::string& more, const std::vector<std::string>& overrides) {
    return message_of<InputError>([&] { check_time_step(parse_scene(bare + more, "bare", overrides)); });
  };
  EXPECT_SAYS(refused("", {"wall.floor.velocity=[0, 0, -1e5]"}),
              "bare: wall.velocity: wall \"floor\" at 100000 m/s");
  const std::string stage =
      "[[stage]]\nname = \"go\"\nbegin = 1\n[[stage.wall]]\nname = \"floor\"\nvelocity = [0, 0, 88]\n";
  EXPECT_SAYS(refused(stage, {}), "stage \"go\": velocity: wall \"floor\" at 88 m/s");
  EXPECT_SAYS(refused("", {"wall.floor.force=1", "wall.floor.servo_gain=1", "wall.floor.largest_speed=1e3"}),
              "wall.largest_speed");
  EXPECT_SAYS(refused("[[mesh]]\nname = \"plate\"\nmaterial = \"sand\"\nfile = \"none.stl\"\n"
                      "amplitude = [0.03, 0, 0.04]\nfrequency = 300\n",
                      {}),
              "mesh.amplitude: mesh \"plate\" at 94.2478 m/s");
  // Along the plane it moves nothing.
  EXPECT_NO_THROW(check_time_step(parse_scene(bare, "bare", {"wall.floor.velocity=[1e5, 0, -1]"})));
}

// A contact with what is lighter than a grain wants shorter steps than one between grains.
TEST(GrainGuards, StepsBearLightMeshes) {
  const auto check = [](const char* mass) {
    check_time_step(parse_scene(bare +
                                    "[[mesh]]\nname = \"lid\"\nmaterial = \"sand\"\nfile = "
                                    "\"none.stl\"\ndirection = [0, 0, -1]\nlargest_speed = 1\nmass = " +
                                    mass,
                                "bare", {}));
  };
  EXPECT_NO_THROW(check("1e-5\n"));
  EXPECT_SAYS(message_of<InputError>([&] { check("1e-9\n"); }),
              "bare: time.dt: 5e-06 s is above the limit of a stable contact");
}

// Places are numbers of quanta, of which there are 2^63.
TEST(GrainGuards, WallsStayWhereDistancesAreNumbers) {
  const std::vector<StartGrain> grains{{"sand", {0.01, 0.01, 0.01}, {0, 0, 0}, {}, 0.0005}};
  EXPECT_SAYS(end_of<InputError>(grains, {"wall.floor.point=[0, 0, -9]"}),
              "bare: wall \"floor\": point has a coordinate of -9 m, so far away");
  EXPECT_SAYS(end_of(grains, {"wall.floor.point=[0, 0, -7.9999]", "wall.floor.velocity=[0, 0, -5]"}),
              "step 3: wall \"floor\" is at z = -8 m, so far away");
  // One that is there no more stays where it is.
  const test::StartFile file(world(), grains);
  Scene scene = parse_scene(
      bare + "[[stage]]\nname = \"open\"\nbegin = 5e-6\n[[stage.wall]]\nname = \"floor\"\nremove = true\n",
      "bare", {"wall.floor.point=[0, 0, -7.9999]", "wall.floor.velocity=[0, 0, -5]"});
  scene.start.file = file.path();
  Simulation s(world(), scene);
  for (int k = 0; k < 20; ++k) s.step();
  EXPECT_LT(s.global().walls[0].offset[2], 0);
}

TEST(GrainGuards, SpeedIsStoppedInItsStep) {
  std::vector<StartGrain> grains;
  for (int k = 0; k < 20; ++k)
    grains.push_back({"sand", {0.002 + 0.0037 * k, 0.01, 0.01}, {0, 0, 0}, {}, 0.0005});
  const std::string text = end_of(grains, {"domain.gravity=[0, 0, 4e6]"});
  EXPECT_SAYS(text, "step 4: grain 0 at (0.002, 0.01, 0.011) m has a speed of 100 m/s: it moves 0.0005 m");
  // Beyond the range of fixed point the place is still where it came from.
  EXPECT_SAYS(end_of(grains, {"domain.gravity=[0, 0, 1e200]"}), "not finite");
  EXPECT_SAYS(end_of(grains, {"domain.gravity=[0, 0, 1e30]"}), "step 0: grain 0 at (0.002, 0.01, 0.01) m");
}

TEST(GrainGuards, OverlapNamesItsPair) {
  const auto grains = [](double gap, double speed) {
    std::vector<StartGrain> out;
    for (int k = 0; k < 10; ++k) {
      out.push_back({"sand", {0.074 - 0.007 * k, 0.01, 0.01}, {0, 0, -speed}, {}, 0.0005});
      out.push_back({"sand", {0.074 - 0.007 * k, 0.01, 0.01 - 0.001 - gap}, {0, 0, 0}, {}, 0.0005});
    }
    return out;
  };
  const std::string text = end_of(grains(1e-5, 20), {"group.sand.restitution=1"});
  EXPECT_SAYS(text, "step 2: grain 0 at (0.074, 0.01, 0.0098");
  EXPECT_SAYS(text, ") m and grain 1: an overlap of ");
  EXPECT_SAYS(text, "contact.largest_overlap allows, 0.0001 m");
  EXPECT_SAYS(
      end_of<InputError>(grains(-2e-4, 0)),
      "grain 0 (line 2) and grain 1 (line 3) overlap by 0.4 radii; contact.largest_overlap allows 0.2");
  EXPECT_SAYS(end_of<InputError>({{"sand", {0.01, 0.01, 0.0003}, {0, 0, 0}, {}, 0.0005}}),
              "grain 0 (line 2) lies 0.4 radii deep in wall \"floor\"; contact.largest_overlap allows 0.2");
}

TEST(GrainGuards, ForceNamesItsContact) {
  // The dashpot of an impact, far above the springs: c v = 0.026 * 70 N against 0.06 N.
  std::vector<StartGrain> grains{{"sand", {0.06, 0.01, 0.01}, {0, 0, -1}, {}, 0.0005},
                                 {"sand", {0.02, 0.01, 0.01}, {70, 0, 0}, {}, 0.0005},
                                 {"sand", {0.0211, 0.01, 0.01}, {0, 0, 0}, {}, 0.0005}};
  std::string text = end_of(grains, {"contact.largest_overlap=0.5"});
  EXPECT_SAYS(text, "step 1: grain 1 at (0.02035, 0.01, 0.01) m and grain 2: a contact force of ");
  EXPECT_SAYS(text, "beyond the range of the sums, ");
  grains[1] = {"sand", {0.02, 0.01, 0.0006}, {0, 0, -70}, {}, 0.0005};
  text = end_of(grains, {"contact.largest_overlap=0.5"});
  EXPECT_SAYS(text, "grain 1 at (0.02, 0.01, 0.00025) m and wall \"floor\": a contact force of ");
}

// 5,184 terms below the range of a term, whose sum on the wall is beyond that of 64 bits.
TEST(GrainGuards, WallSumIsGuarded) {
  std::vector<StartGrain> grains;
  for (int i = 0; i < 72; ++i)
    for (int j = 0; j < 72; ++j)
      grains.push_back(
          {"sand", {0.001 + 0.00105 * i, 0.001 + 0.00105 * j, 0.000475}, {0, 0, -2.05}, {}, 0.0005});
  const std::string text = end_of(grains, {"group.sand.friction="});
  EXPECT_SAYS(text, "step 0: the force on wall \"floor\", ");
  EXPECT_SAYS(text, "along z, is beyond the range of the sums, 256 N");
  // With half as many it is not, and halves of the sum make the whole.
  grains.resize(grains.size() / 2);
  const test::StartFile file(world(), grains);
  Scene scene = parse_scene(bare, "bare", {"group.sand.friction="});
  scene.start.file = file.path();
  Simulation s(world(), scene);
  s.step();
  const double newton = s.grains()->walls().newton(s.global().walls[0].force[2]);
  const double gained = s.grains()->walls().newton(1) > 0 ? test::grain(s, 0).v[2] + 2.05 : 0;
  const double mass = 2500 * 4.0 / 3.0 * std::acos(-1.0) * 0.0005 * 0.0005 * 0.0005;
  EXPECT_NEAR(newton, -2592 * gained * mass / 5e-6, 1e-9 * std::fabs(newton));
}

// A torque is at most (mu + mu_r) r |F|: quanta follow.
TEST(GrainGuards, TorquesStayInRange) {
  const decomp::Comm self(MPI_COMM_SELF);
  const test::StartFile file(self, {{"sand", {0.01, 0.01, 0.00052}, {0, 0, -0.8}, {0, 3000, 0}, 0.0005}});
  Scene scene = parse_scene(bare, "bare",
                            {"group.sand.rolling_friction=100", "group.sand.restitution=0.9", "time.dt="});
  scene.start.file = file.path();
  Simulation s(self, scene);
  const double before = kinetic_energy(s);
  double least = before;
  for (int k = 0; k < 1600; ++k) {
    s.step();
    ASSERT_LT(kinetic_energy(s), 1.001 * before) << k;
    least = std::min(least, kinetic_energy(s));
  }
  EXPECT_LT(least, 0.3 * before);  // they met
}

TEST(GrainGuards, StiffRollingIsPartOfTheLimit) {
  const std::string text = message_of<InputError>(
      [] { check_time_step(parse_scene(bare, "bare", {"group.sand.rolling_friction=1000"})); });
  EXPECT_SAYS(text, "time.dt: 5e-06 s is above the limit of a stable contact");
}

TEST(GrainGuards, NoTimeStepIsRefused) {
  const std::string text = message_of<InputError>([] {
    check_time_step(
        parse_scene(bare, "bare", {"contact.law=walton_braun", "group.sand.restitution=1e-160", "time.dt="}));
  });
  EXPECT_SAYS(text, "leaves no time step (0 s)");
}

TEST(GrainGuards, SoEndlessATimeStepIsRefused) {
  const std::string text = message_of<InputError>([] {
    check_time_step(parse_scene(bare, "bare", {"group.sand.normal_stiffness=1e-320", "time.dt="}));
  });
  EXPECT_SAYS(text, "leaves no time step (inf s)");
}

TEST(Findings, LowestIdSpeaks) {
  Findings mine;
  EXPECT_EQ(mine.agree(world()), "");
  const auto rank = static_cast<std::uint64_t>(world().rank());
  const std::uint64_t huge = std::uint64_t{1} << 63;
  mine.add(huge + 7 - rank, [&] { return "of " + std::to_string(rank); });
  mine.add(huge + 9, [] { return std::string("later"); });
  const std::string last = "of " + std::to_string(world().size() - 1);
  EXPECT_EQ(mine.agree(world()), last);
  if (rank == 0) mine.add(3, [] { return std::string("three"); });
  EXPECT_EQ(mine.agree(world()), "three");
  mine.begin_stage();
  mine.add(1, [] { return std::string("what follows"); });
  EXPECT_EQ(mine.agree(world()), "three");
  EXPECT_EQ(message_of<GuardError>([&] { mine.stop(world(), step_text(5)); }), "step 5: three");
}

}  // namespace
}  // namespace sph
