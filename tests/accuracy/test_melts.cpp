// Slow flow with composition and heat against published benchmarks: van Keken et al. (1997), Blankenbach et al.
// (1989); salt fingers against their dispersion relation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/output/monitors.hpp"

namespace {

struct Row {
  double time;
  std::vector<double> values;
};

/// The columns of the scene's one monitor, after each step.
std::vector<Row> rows_of(const char* scene, const std::vector<std::string>& overrides = {}) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene(std::string(PEPERITE_ACCURACY_DIR "/") + scene, overrides));
  const sph::Monitors monitors(s);
  std::vector<Row> rows;
  while (s.global().time < *s.scene().time.until) {
    s.step();
    rows.push_back({s.global().time, monitors.values(s)});
  }
  return rows;
}

constexpr std::size_t speed = 2;

TEST(Melts, VanKeken1a) {
  const std::vector<Row> rows = rows_of("van_keken.toml");
  const auto at = [&](double t) {
    return std::ranges::find_if(rows, [&](const Row& r) { return r.time >= t; })->values[speed];
  };
  EXPECT_NEAR(PINNED(std::log(at(20) / at(5)) / 15), 0.0111, 0.03 * 0.0111);
  const auto fastest = std::ranges::max_element(rows, {}, [](const Row& r) { return r.values[speed]; });
  EXPECT_NEAR(PINNED(fastest->values[speed]), 0.00309, 0.02 * 0.00309);
  EXPECT_NEAR(PINNED(fastest->time), 209, 0.02 * 209);
}

// Heat that comes in below is the Nusselt number.
TEST(Melts, Blankenbach1a) {
  const Row last = rows_of("blankenbach.toml").back();
  EXPECT_NEAR(PINNED(last.values[4]), 4.884409, 0.003 * 4.884409);
  EXPECT_NEAR(PINNED(last.values[speed]), 42.864947, 0.001 * 42.864947);
  EXPECT_NEAR(last.values[5], -last.values[4], 1e-3);
}

TEST(Melts, Blankenbach1b) {
  const Row last = rows_of("blankenbach.toml", {"domain.gravity=[0, -1e5]", "time.until=0.1"}).back();
  EXPECT_NEAR(PINNED(last.values[4]), 10.534095, 0.005 * 10.534095);
  EXPECT_NEAR(PINNED(last.values[speed]), 193.214540, 0.003 * 193.214540);
}

// From a wave that is high enough to become the one cell, until v_rms swings by less than 0.5 %.
TEST(Melts, Blankenbach1c) {
  const Row last =
      rows_of("blankenbach.toml", {"domain.gravity=[0, -1e6]", "melt.wave_height=0.4", "time.until=0.05"})
          .back();
  EXPECT_NEAR(PINNED(last.values[4]), 21.972465, 0.02 * 21.972465);
  EXPECT_NEAR(PINNED(last.values[speed]), 833.989770, 0.01 * 833.989770);
}

// Of cos(2 pi x) sin(pi z / H) in the composition: each mode grows by itself.
TEST(Melts, SaltFingers) {
  constexpr double pi = std::numbers::pi, height = 1.75, heat = 6000, salt = 3000;
  const double k2 = 4 * pi * pi, all2 = k2 + pi * pi / (height * height), all4 = all2 * all2;
  // K^4 s^2 + (K^6 + (heat - salt) k^2) s - salt K^2 k^2 = 0
  const double half = 0.5 * (all4 * all2 + (heat - salt) * k2);
  const double exact = (std::sqrt(half * half + all4 * salt * all2 * k2) - half) / all4;

  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/salt_fingers.toml", {}));
  const auto amplitude = [&] {
    const sph::Particles& cells = s.particles(s.melt()->set());
    double sum = 0;
    for (std::size_t i = 0; i < cells.owned(); ++i) {
      const double x = s.scale().metres(cells.data<sph::Field::position>()[2 * i]);
      const double z = s.scale().metres(cells.data<sph::Field::position>()[2 * i + 1]);
      sum += cells.data<sph::Field::composition>()[i] * std::cos(2 * pi * x) * std::sin(pi * z / height);
    }
    return sum;
  };
  measure::run_until(s, 0.06);  // the mode that decays, at 129, is gone
  const double first = amplitude(), begin = s.global().time;
  measure::run_until(s, 0.12);
  EXPECT_NEAR(PINNED(std::log(amplitude() / first) / (s.global().time - begin) / exact), 1, 0.01);
}

}  // namespace
