// The latched springs of Walton & Braun. Bits over ranks and restarts: the scene "latched" of tests/system.
#include "contact_law_checks.hpp"
#include "grain_fixture.hpp"
#include "sph/laws/contact/walton_braun.hpp"
#include "sph/output/contact_records.hpp"

namespace sph {
namespace {

TEST(WaltonBraun, KeepsWhatEveryLawKeeps) { test::expect_law<WaltonBraun>({1e5, 2e4}, 2e-3); }

TEST(WaltonBraun, RestitutionIsTheRootOfTheStiffnesses) {
  const PairConstants k = WaltonBraun::constants({{1e5, 2e4}, {3e5, 2e4}, 0.4, false, 0, 0});
  EXPECT_NEAR(std::sqrt(1.5e5 / k.stiffness), 0.4, 1e-15);  // k_1, in series, over k_2
}

constexpr const char* floor = R"(
domain = { lower = [0, 0, 0], upper = [0.01, 0.01, 0.01] }
contact = { law = "walton_braun", rolling_damping = 0 }
time = { dt = 1e-6, steps = 1 }
start = { file = "set later" }
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = 0.002
normal_stiffness = 1000
restitution = 0.5
rolling_friction = 0.3
[[wall]]
name = "floor"
material = "sand"
point = [0, 0.001, 0]
normal = [0, 1, 0]
)";

/// What the springs of a pair hold where it is now.
double held(test::Pair<WaltonBraun, NoFriction, RollingSpring> p) {
  p.look();
  const NormalForce<test::V> f = WaltonBraun::force(p.contact, p.k, p.memory);
  const double change = WaltonBraun::rolling_change(p.contact, p.k, f, p.memory)[0];
  const double overlap = p.contact.overlap[0], arm = p.k.rolling_friction[0] * p.contact.radius[0];
  if (!(overlap > 0 && f.elastic[0] > 0)) return 0;
  const double torque = change * test::norm(p.roll_spring)[0];
  return WaltonBraun::energy(p.contact, p.k, f)[0] +
         0.5 * torque * torque / (2.25 * f.elastic[0] / overlap * arm * arm);
}

// A whole run does with a contact that unloads under its rolling spring what the law alone does, and so does the
// record of its energy.
TEST(WaltonBraun, RunsRollAsTheLawDoes) {
  const decomp::Comm self(MPI_COMM_SELF);
  constexpr double radius = 0.001, above = 1.2e-6, spin = 100;
  Scene scene = parse_scene(floor, "floor", {});
  const test::StartFile file(self,
                             {{"sand", {0.005, 0.002 + above, 0.005}, {0, -0.5, 0}, {0, 0, spin}, radius}});
  scene.start.file = file.path();
  Simulation s(self, scene);
  test::Pair<WaltonBraun, NoFriction, RollingSpring> p;
  const double mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * 2500;
  const LawConstants sand{1000, 2000.0 / 7};
  const PairConstants k = WaltonBraun::constants({sand, sand, 0.5, false, 0, 0});
  p.wall = true;
  p.j.radius = radius;
  p.j.inverse_mass = 1 / mass;
  p.j.x[1] = radius + above;
  p.j.v[1] = -0.5;
  p.j.w[2] = spin;
  p.k.stiffness = k.stiffness;
  p.k.damping = k.damping;
  p.k.rolling_friction = 0.3;
  p.dt = 1e-6;
  double largest = 0;
  for (int n = 0; n < 1000; ++n) {
    s.step();
    p.step();
    largest = std::max(largest, std::abs(p.j.w[2][0] - spin));
    ASSERT_NEAR(test::grain(s, 0).w[2], p.j.w[2][0], 1e-6 * spin) << n;
    double energy = 0;
    s.refresh_contacts();
    for_each_contact(s, [&](const ContactRecord& c) { energy += c.energy; });
    ASSERT_NEAR(energy, held(p), 1e-6 * 0.125 * mass) << n;  // of the impact's
  }
  EXPECT_GT(largest, 0.5 * spin);
  EXPECT_NEAR(test::grain(s, 0).v[1], 0.25, 1e-3);
}

}  // namespace
}  // namespace sph
