// The one-dimensional mode: a periodic strip of 9 spacings (apps/volcano/column.toml) is as any wider one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;

struct Course {
  double mass, gas, lost, sideways;
};

/// Of a strip so many spacings wide, over its width, after 200 steps.
Course course(int across, const std::vector<std::string>& more) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const std::string width = std::to_string(across * 0.25);
  std::vector<std::string> settings{"domain.upper=[" + width + ", 12]", "start.upper=[" + width + ", 12]",
                                    "start.region.1.upper=[" + width + ", 10]",
                                    "start.region.2.upper=[" + width + ", 12]"};
  settings.insert(settings.end(), more.begin(), more.end());
  sph::Simulation s(comm, sph::read_scene(PEPERITE_TEST_DIR "/../apps/volcano/column.toml", settings));
  const sph::Monitors monitors(s);
  for (int k = 0; k < 200; ++k) s.step();
  const std::vector<double> row = monitors.values(s);
  double sideways = 0;
  for (std::size_t i = 0; i < s.particles().owned(); ++i)
    sideways = std::max(sideways, std::abs(s.particles().data<Field::velocity>()[2 * i]));
  comm.max(std::span(&sideways, 1));
  const double n = across;
  return {row[0] / n, row[1] / n, row[2] / n, sideways};
}

TEST(OneDimension, IsAStripOfNineSpacings) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"kernel.h_over_dx=0.99", "decomposition.skin=0"}}) {
    const Course narrow = course(9, more), wide = course(16, more);
    EXPECT_NEAR(narrow.mass, wide.mass, 1e-6 * wide.mass);
    EXPECT_NEAR(narrow.gas, wide.gas, 1e-6 * wide.gas);
    EXPECT_NEAR(narrow.lost, wide.lost, 1e-3 * std::abs(wide.lost));
    EXPECT_LT(narrow.lost, 0);
    EXPECT_LT(narrow.sideways, 1e-6);
  }
}

}  // namespace
