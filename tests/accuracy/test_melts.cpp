// Slow flow with composition and heat against published benchmarks: van Keken et al. (1997), Blankenbach et al. (1989).
#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
