// The latched springs of Walton & Braun. Bits over ranks and restarts: the scene "latched" of tests/system.
#include "contact_law_checks.hpp"
#include "sph/contact/walton_braun.hpp"

namespace sph {

TEST(WaltonBraun, KeepsWhatEveryLawKeeps) { test::expect_law<WaltonBraun>({1e5, 2e4}, 2e-3); }

TEST(WaltonBraun, RestitutionIsTheRootOfTheStiffnesses) {
  const PairConstants k = WaltonBraun::constants({{1e5, 2e4}, {3e5, 2e4}, 0.4, false, 0, 0});
  EXPECT_NEAR(std::sqrt(1.5e5 / k.stiffness), 0.4, 1e-15);  // k_1, in series, over k_2
}

}  // namespace sph
