// Which valid word a misspelt one may have meant.
#include <gtest/gtest.h>

#include "core/nearest.hpp"

namespace sph {
namespace {

TEST(Nearest, CapitalsAreNoMistakesButDecideTies) {
  const std::vector<std::string> keys{"kind", "density", "viscosity", "gas_rt"};
  EXPECT_EQ(nearest("Density", keys), "density");
  EXPECT_EQ(nearest("DENSITY", keys), "density");
  EXPECT_EQ(nearest("VISCOSTY", keys), "viscosity");
  EXPECT_EQ(nearest("Gas_RT", keys), "gas_rt");
  EXPECT_EQ(nearest("RT", keys), "");
  const std::vector<std::string> groups{"sand", "SAND", "Sane"};
  EXPECT_EQ(nearest("Sand", groups), "sand");
  EXPECT_EQ(nearest("SANd", groups), "SAND");
  EXPECT_EQ(nearest("sane", groups), "Sane");  // the right letters before the right size of them
}

TEST(Nearest, SayNothingWhereNoWordIsNear) {
  EXPECT_EQ(nearest("ABC", {"xyz", "pressure"}), "");
  EXPECT_EQ(suggestion("ABC", {"xyz", "pressure"}), "valid: xyz, pressure");
  EXPECT_EQ(suggestion("Xyz", {"xyz", "pressure"}), "did you mean \"xyz\"?");
}

}  // namespace
}  // namespace sph
