// A sphere that hits a rigid plane by the Hertz law, eight cases at once: Chung & Ooi's benchmark impacts.
#pragma once

#include <array>

#include "contact_fixture.hpp"
#include "sph/laws/contact/restitution.hpp"
#include "sph/laws/contact/time_step.hpp"
#include "sph/pairs/contact_pass.hpp"

namespace sph::test {

using HertzPair = Pair<HertzNormal>;

/// One lane's case.
struct Impact {
  Material material;
  double radius, normal_speed, tangential_speed = 0, spin = 0;
};

/// A sphere about to meet a rigid plane from above, `steps` to an undamped contact.
inline HertzPair on_plane(const std::array<Impact, 8>& cases, int steps) {
  HertzPair p;
  const auto each = [&](auto value) { return lanes([&](int l) { return value(cases[l]); }); };
  p.wall = true;
  p.j.radius = each([](const Impact& c) { return c.radius; });
  p.j.inverse_mass = each([](const Impact& c) { return 1 / c.material.mass(c.radius); });
  p.j.x[1] = p.j.radius;
  p.j.v[0] = each([](const Impact& c) { return c.tangential_speed; });
  p.j.v[1] = each([](const Impact& c) { return -c.normal_speed; });
  p.j.w[2] = each([](const Impact& c) { return c.spin; });
  p.k.stiffness = each([](const Impact& c) { return c.material.contact_modulus(); });
  p.k.shear_stiffness = each([](const Impact& c) { return c.material.contact_shear(); });
  p.k.damping =
      each([](const Impact& c) { return damping_of(HertzNormal::impact, false, c.material.restitution); });
  p.k.friction = each([](const Impact& c) { return c.material.friction; });
  p.dt = each([&](const Impact& c) {
    return hertz_contact_time(c.material.contact_modulus(), c.radius, c.material.mass(c.radius),
                              c.normal_speed) /
           steps;
  });
  return p;
}

}  // namespace sph::test
