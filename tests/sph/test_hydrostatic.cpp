// Still layers under their own weight: the pressure they start with against the equation that it solves.
#include <gtest/gtest.h>

#include <cmath>

#include "sph/core/error.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "start/hydrostatic.hpp"

namespace sph {
namespace {

// Water over foaming magma over dense rock.
constexpr const char* layers = R"(
[domain]
lower = [0, -60]
upper = [10, 10]
gravity = [0, -9.8]
surface_pressure = "1 bar"
[kernel]
h_over_dx = 1.2
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 1500
[[group]]
name = "magma"
kind = "fluid"
eos = "bubbly"
density = 2500
bulk_modulus = "10 GPa"
gas_content = 0.001
gas_rt = 5e5
solubility_pressure = "1 GPa"
[[group]]
name = "rock"
kind = "fluid"
density = 3000
bulk_modulus = "10 GPa"
[start]
spacing = 0.5
pressure = "hydrostatic"
[[start.layer]]
group = "water"
top = 2
[[start.layer]]
group = "magma"
top = -1.3
[[start.layer]]
group = "rock"
top = -40.1
[[start.region]]
group = "magma"
[time]
steps = 1
)";

double density(const Group& g, double absolute) {
  return g.eos.law->kind == EosKind::bubbly ? bubbly_eos(g, g.bubbly.gas_content).density(absolute)
                                            : g.density * (1 + absolute / g.eos.bulk_modulus);
}

TEST(Hydrostatic, Layers_carry_what_lies_above_them_each_by_its_own_equation_of_state) {
  const Scene scene = parse_scene(layers, "layers", {});
  const HydrostaticColumn column(scene);
  // Steps of a thousandth of a spacing, by the midpoint rule.
  const double step = 5e-4, surface = scene.domain.surface_pressure;
  double p = surface;
  for (int n = 0; n < 130000; ++n) {
    const double y = 2 - (n + 0.5) * step;
    const Group& g = scene.groups[y > -1.3 ? 0 : y > -40.1 ? 1 : 2];
    const double middle = p + 0.5 * step * 9.8 * density(g, p);
    p += step * 9.8 * density(g, middle);
    if (n % 1000 == 999) {
      ASSERT_NEAR(column({3, 2 - (n + 1) * step, 0}), p - surface, 2e-6 * p) << y;
    }
  }
  EXPECT_EQ(column({0, 2, 0}), 0);
  EXPECT_LT(column({0, 3, 0}), 0) << "above the surface";
}

TEST(Hydrostatic, Of_liquids_alone_is_the_closed_form) {
  const Scene scene = parse_scene(layers, "water", {"start.layer.1.group=water", "start.layer.2.top=-99"});
  const HydrostaticColumn column(scene);
  const double k = scene.groups[0].eos.bulk_modulus;
  EXPECT_NEAR(column({0, -30, 0}), (k + 1e5) * std::expm1(1000 * 9.8 * 32 / k), 1e-6);
}

TEST(Hydrostatic, Magma_without_pressure_on_it_is_refused) {
  const Scene scene = parse_scene(layers, "bare", {"domain.surface_pressure=0", "start.layer.0.group=magma"});
  EXPECT_THROW(HydrostaticColumn{scene}, InputError);
}

}  // namespace
}  // namespace sph
