// Where two fluids meet: the pressure jump of a drop at rest (Laplace), still layers (accuracy.md A6) and the
// rise of bubble 1 of Hysing et al. (2009) to its largest velocity (A7). benchmarks/accuracy has finer and
// longer runs.
#include <gtest/gtest.h>

#include <utility>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

/// Mean pressure in the middle of a drop at rest less that far from it, over a second: the box is closed, so
/// the sound of the start stays in it.
double pressure_jump(const char* weights, double& speed) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/rising_bubble.toml",
                                          {"domain.gravity=[0, -0.01]", "start.surface_height=100",
                                           "start.region.2.centre=[0.5, 1]",
                                           std::string("terms.pressure_weights=") + weights}));
  double sum = 0;
  constexpr int times = 100;
  for (int k = 0; k < times; ++k) {
    measure::run_until(s, 0.5 + 0.01 * k);
    double in = 0, out = 0, n_in = 0, n_out = 0;
    for (const measure::Sample& q : measure::samples(s)) {
      if (measure::is_wall(s, q)) continue;
      const double r = std::hypot(q.x[0] - 0.5, q.x[1] - 1), p = q.p - 10 * (1 - q.x[1]);
      if (r < 0.15) in += p, ++n_in;
      if (r > 0.35) out += p, ++n_out;
      speed = std::max(speed, std::hypot(q.v[0], q.v[1]));
    }
    sum += in / n_in - out / n_out;
  }
  return sum / times;
}

TEST(Interface, PressureJumpOfADrop) {
  const double exact = 24.5 / 0.25;
  for (const auto& [weights, bound] : {std::pair{"volume", 0.015}, std::pair{"density", 0.05}}) {
    double speed = 0;
    const double jump = pressure_jump(weights, speed);
    std::printf(
        "drop at rest, R/dx = 10, weights by %s: pressure jump %.2f Pa (exact %.2f), fastest particle %.3f "
        "m/s\n",
        weights, jump, exact, speed);
    EXPECT_NEAR(PINNED(jump / exact), 1, bound);
    EXPECT_LE(PINNED(speed), 0.1);
  }
}

TEST(Interface, StillLayers) {
  const decomp::Comm comm(MPI_COMM_SELF);
  for (const auto& [light, bound] : {std::pair{"500", 1e-3}, std::pair{"1", 1e-2}}) {
    sph::Simulation s(comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/two_layers.toml",
                                            {std::string("group.light.density=") + light}));
    measure::run_until(s, 5 / std::sqrt(9.8));
    double speed = 0;
    for (const measure::Sample& q : measure::samples(s)) {
      if (measure::is_wall(s, q)) continue;
      speed = std::max(speed, std::hypot(q.v[0], q.v[1]));
      EXPECT_EQ(q.x[1] < 0.5, s.scene().groups[q.group].name == "heavy");
    }
    std::printf("still layers, %s:1000, t = 5 sqrt(H/g): fastest particle %.1e sqrt(gH)\n", light,
                speed / std::sqrt(9.8));
    EXPECT_LE(PINNED(speed / std::sqrt(9.8)), bound);
  }
}

TEST(Interface, RisingBubble) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/rising_bubble.toml", {}));
  // The mean velocity over 0.1 s, in which the sound of the closed box cancels, from the centre's way.
  double largest = 0, before = measure::mean_position(s, "bubble", 1), then = 0;
  for (int k = 1; k <= 12; ++k) {
    measure::run_until(s, 0.1 * k);
    const double now = measure::mean_position(s, "bubble", 1), t = s.global().time;
    largest = std::max(largest, (now - before) / (t - then));
    before = now, then = t;
  }
  std::printf("rising bubble 1, h = 1/40: largest velocity %.4f (0.2417 to 0.2421)\n", largest);
  EXPECT_NEAR(PINNED(largest), 0.2419, 0.03 * 0.2419);
}

}  // namespace
