// Birch and Murnaghan's equation of state. Bits over ranks: hydrostatic.toml with it in tests/recorded.
#include "eos_fixture.hpp"
#include "sph/laws/eos/birch_murnaghan.hpp"

namespace sph {

TEST(BirchMurnaghan, IsOneLaw) {
  for (const double derivative : {3.5, 4.0, 6.0})
    test::expect_one_law<BirchMurnaghan>(test::fluid_of({derivative}), 0.92, 1.6);
  test::expect_still_rock<BirchMurnaghan>("bulk_modulus_derivative = 5");
}

TEST(BirchMurnaghan, AsPublished) {  // x = 1.5, K' = 5.2: p/K with 16 digits
  EXPECT_NEAR(BirchMurnaghan::pressure(test::fluid_of({5.2}), 4500) / 5e10, 1.170688138257503, 1e-14);
}

// Stretched it goes on to where it gives way; what no density has is 0, which a start refuses.
TEST(BirchMurnaghan, NoDensityIsMadeUp) {
  const Group rock = test::fluid_of({4.0});
  const double stretched = BirchMurnaghan::density(rock, BirchMurnaghan::pressure(rock, 0.75 * rock.density));
  EXPECT_NEAR(stretched / rock.density, 0.75, 1e-12);
  EXPECT_EQ(BirchMurnaghan::density(rock, -rock.eos.bulk_modulus), 0);
  EXPECT_EQ(BirchMurnaghan::density(test::fluid_of({3.01}), 100 * rock.eos.bulk_modulus), 0);
}

}  // namespace sph
