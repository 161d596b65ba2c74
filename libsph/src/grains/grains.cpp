#include "sph/grains.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sph/contact/restitution.hpp"
#include "sph/contact/time_step.hpp"
#include "sph/fixed_point.hpp"
#include "sph/grain_mass.hpp"

namespace sph {
namespace {

double in_series(double a, double b) { return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0.0; }

/// Constants of materials a and b in the order of ContactConstants.
std::array<double, 8> constants_of(const Scene& scene, std::size_t a, std::size_t b) {
  const GrainMaterial &m = scene.groups[a].grain, &n = scene.groups[b].grain;
  const ContactControl& control = scene.contact;
  double friction = std::min(m.friction, n.friction);
  double rolling = std::min(m.rolling_friction, n.rolling_friction);
  double restitution = std::min(m.restitution, n.restitution);
  for (const ContactPair& p : control.pairs) {
    const bool same = p.groups == std::array{static_cast<int>(a), static_cast<int>(b)} ||
                      p.groups == std::array{static_cast<int>(b), static_cast<int>(a)};
    if (!same) continue;
    friction = p.friction.value_or(friction);
    rolling = p.rolling_friction.value_or(rolling);
    restitution = p.restitution.value_or(restitution);
  }
  double stiffness, shear;
  if (control.law == ContactLaw::hertz) {
    const auto compliance = [](const GrainMaterial& g) {
      return (1 - g.poisson_ratio * g.poisson_ratio) / g.young_modulus;
    };
    const auto shear_compliance = [](const GrainMaterial& g) {  // (2 - nu) / G, G = E / (2 (1 + nu))
      return (2 - g.poisson_ratio) * 2 * (1 + g.poisson_ratio) / g.young_modulus;
    };
    stiffness = 1 / (compliance(m) + compliance(n));
    shear = 1 / (shear_compliance(m) + shear_compliance(n));
  } else {
    stiffness = in_series(m.normal_stiffness, n.normal_stiffness);
    shear = in_series(m.tangential_stiffness, n.tangential_stiffness);
  }
  const double damping =
      control.normal_damping ? *control.normal_damping : damping_of(control.law, control.pull, restitution);
  return {stiffness,
          shear,
          damping,
          control.tangential_damping,
          friction,
          rolling,
          control.pull ? -std::numeric_limits<double>::infinity() : 0.0,
          control.rolling_damping};
}

/// Of all pairs, of two grains of that radius at the largest overlap allowed: dF/d(delta) [N/m].
double stiffest_contact(const Scene& scene, double radius) {
  double stiffest = 0;
  for (std::size_t a = 0; a < scene.groups.size(); ++a)
    for (std::size_t b = a; b < scene.groups.size(); ++b) {
      const double k = constants_of(scene, a, b)[0];
      const double patch = std::sqrt(radius * scene.contact.largest_overlap * radius);
      stiffest = std::max(stiffest, scene.contact.law == ContactLaw::hertz ? 2 * k * patch : k);
    }
  return stiffest;
}

double next_power_of_two(double x) { return std::ldexp(1.0, std::ilogb(x) + 1); }

}  // namespace

// Linear: 25 steps in the shortest contact. Hertz: 0.15 of the least Rayleigh time. The limit is that of one
// contact of the two lightest grains at the largest overlap.
GrainTimeSteps grain_time_steps(const Scene& scene) {
  double mass = std::numeric_limits<double>::infinity(), rayleigh = mass, radius = mass, damping = 0;
  for (const Group& g : scene.groups) {
    if (g.grain.least_radius <= 0 || g.grain.fixed) continue;
    mass = std::min(mass, grain_mass(g.density, g.grain.least_radius));
    radius = std::min(radius, g.grain.least_radius);
    if (scene.contact.law == ContactLaw::hertz)
      rayleigh = std::min(rayleigh, rayleigh_time(g.grain.least_radius, g.density, g.grain.young_modulus,
                                                  g.grain.poisson_ratio));
  }
  const double stiffness = stiffest_contact(scene, radius);
  for (std::size_t a = 0; a < scene.groups.size(); ++a)
    damping = std::max(damping, constants_of(scene, a, a)[2]);
  double zeta = 0.5 * damping;  // 2 zeta, 2 sqrt(5/6) zeta or gamma_n
  if (scene.contact.normal_damping) zeta *= std::sqrt(0.5 * mass / stiffness);
  GrainTimeSteps steps;
  steps.limit = linear_stable_step(stiffness, 0.5 * mass, zeta);
  if (scene.contact.law == ContactLaw::hertz) {
    steps.recommended = 0.15 * rayleigh;
    steps.advised = 0.2 * rayleigh;
  } else {
    steps.recommended = linear_contact_time(stiffness, 0.5 * mass) / 25;
    steps.advised = packing_step(stiffness, mass);
  }
  steps.recommended = std::min(steps.recommended, 0.5 * steps.limit);
  return steps;
}

Grains::Grains(const Scene& scene, const PositionScale& scale)
    : scene_(&scene), scale_(scale), fusion_(contact_fusion(scene)), lists_(fusion_.history) {
  for (const Group& g : scene.groups) fixed_.push_back(g.grain.fixed);
  find_constants();
  find_quanta();
  dt_ = scene.time.dt.value_or(grain_time_steps(scene).recommended);
}

void Grains::find_constants() {
  const std::size_t n = scene_->groups.size();
  constants_.resize(n * n * 8);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      std::ranges::copy(constants_of(*scene_, a, b),
                        constants_.begin() + static_cast<std::ptrdiff_t>((a * n + b) * 8));
}

// A force term stays below 2^50 quanta up to four times the elastic force at the largest overlap allowed: the
// rest is for dashpots. 4096 terms then fit a 64-bit sum.
void Grains::find_quanta() {
  double radius = 0;
  for (const Group& g : scene_->groups) radius = std::max(radius, g.grain.largest_radius);
  const double overlap = scene_->contact.largest_overlap * radius;
  const double force = stiffest_contact(*scene_, radius) * overlap;
  force_quantum_ = std::ldexp(next_power_of_two(4 * force), -50);
  torque_quantum_ = std::ldexp(next_power_of_two(8 * force * radius), -50);
}

FieldSet Grains::reads() const {
  FieldSet fields{Field::position, Field::velocity};
  if (fusion_.spins) fields |= FieldSet{Field::spin};
  return fields;
}

std::vector<WallState> Grains::first_walls() const {
  std::vector<WallState> walls(scene_->walls.size());
  for (std::size_t w = 0; w < walls.size(); ++w) walls[w].velocity = scene_->walls[w].velocity;
  return walls;
}

namespace {

/// A wall's part in a stage, the latest change that has begun winning.
struct WallNow {
  bool present = true;
  Double3 velocity{};
  std::optional<double> force;
};

WallNow wall_now(const Scene& scene, std::size_t wall, double time) {
  const Wall& w = scene.walls[wall];
  WallNow now{true, w.velocity, w.force};
  for (const Stage& s : scene.stages) {
    if (s.begin > time) break;
    for (const WallChange& c : s.walls) {
      if (c.wall != static_cast<int>(wall)) continue;
      now.present = now.present && !c.remove;
      if (c.velocity) now.velocity = *c.velocity, now.force.reset();
      if (c.force) now.force = c.force;
    }
  }
  return now;
}

}  // namespace

void Grains::set_stage(GlobalState& global) const {
  for (std::size_t w = 0; w < global.walls.size(); ++w) {
    const WallNow now = wall_now(*scene_, w, global.time);
    if (!now.force) global.walls[w].velocity = now.velocity;
  }
}

std::vector<PlaneNow> Grains::planes(const GlobalState& global, double time) const {
  std::vector<PlaneNow> out;
  for (std::size_t w = 0; w < scene_->walls.size(); ++w) {
    const Wall& wall = scene_->walls[w];
    PlaneNow plane{{},
                   wall.normal,
                   global.walls[w].velocity,
                   static_cast<std::uint32_t>(wall.group),
                   wall_now(*scene_, w, time).present};
    for (std::size_t a = 0; a < 3; ++a)
      plane.point[a] = scale_.quanta(wall.point[a]) + global.walls[w].offset[a];
    out.push_back(plane);
  }
  return out;
}

ContactCensus Grains::rebuild(const Particles& particles, const decomp::CellGrid& grid,
                              const decomp::Box& own_cells, std::int64_t reach, double skin,
                              const RowRanges& ranges, const GlobalState& global,
                              const decomp::Payload& payload, std::span<const std::uint32_t> order) {
  // A wall that a later stage brings near must be listed in time: walls are looked for where they are now.
  // One that a stage has just removed had contacts in the last step: the next sweep ends them.
  lists_.build(particles, grid, own_cells, reach, skin, scale_.quantum, ranges, fixed_,
               planes(global, global.time - 2 * global.dt));
  const ContactCensus found = lists_.unpack(particles, payload, order);
  counters_.carried += static_cast<std::int64_t>(found.count);
  sums_.assign(particles.rows() * (fusion_.spins ? 8 : 4), 0);
  const std::int64_t* x = particles.data<Field::position>();
  reference_.assign(x, x + particles.owned() * 3);
  wall_reference_.clear();
  for (const WallState& w : global.walls) wall_reference_.push_back(w.offset);
  return found;
}

void Grains::begin_step(const GlobalState& global) {
  sweep_ = {};
  planes_ = planes(global, global.time);
  wall_force_.assign(3 * planes_.size(), 0);
}

ContactContext Grains::context(Particles& particles, double dt) {
  return {&particles,
          &lists_,
          constants_.data(),
          static_cast<std::uint32_t>(scene_->groups.size()),
          planes_,
          wall_force_.data(),
          sums_.data(),
          scale_.quantum,
          force_quantum_,
          torque_quantum_,
          dt,
          {scene_->gravity[0], scene_->gravity[1], scene_->gravity[2]},
          scene_->contact.largest_overlap};
}

void Grains::sweep(Particles& particles, std::span<const ContactBlock> blocks, const RowRanges& ranges,
                   double dt) {
  ContactSweep now;
  fusion_.sweep(context(particles, dt), blocks, ranges, now);
  sweep_.speed2 = now.speed2 <= sweep_.speed2 ? sweep_.speed2 : now.speed2;
  sweep_.acceleration2 = now.acceleration2 <= sweep_.acceleration2 ? sweep_.acceleration2 : now.acceleration2;
  sweep_.force = std::max(sweep_.force, now.force);
  sweep_.overlap = std::max(sweep_.overlap, now.overlap);
  counters_.created += now.created;
  counters_.ended += now.ended;
}

void Grains::move_walls(GlobalState& global, std::span<const std::int64_t> wall_force) const {
  for (std::size_t w = 0; w < global.walls.size(); ++w) {
    WallState& state = global.walls[w];
    const Wall& wall = scene_->walls[w];
    // A tangential velocity drags the grains; the plane itself moves along its normal only.
    double along = 0, pressed = 0;
    for (std::size_t a = 0; a < 3; ++a) along += state.velocity[a] * wall.normal[a];
    for (std::size_t a = 0; a < 3; ++a) {
      state.offset[a] += round_to_quanta(along * wall.normal[a] * global.dt / scale_.quantum);
      state.force[a] = wall_force[3 * w + a];
      pressed -= wall_force_newton(state.force[a]) * wall.normal[a];
    }
    const WallNow now = wall_now(*scene_, w, global.time);
    if (!now.force || !now.present) continue;
    const double wanted = wall.servo_gain * (*now.force - pressed);
    const double speed = std::clamp(wanted, -wall.largest_speed, wall.largest_speed);
    for (std::size_t a = 0; a < 3; ++a) state.velocity[a] = speed * wall.normal[a];
  }
}

double Grains::longest_way(const Particles& particles, const GlobalState& global) const {
  const std::int64_t* x = particles.data<Field::position>();
  double way2 = 0;
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    double w2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double w = static_cast<double>(x[i * 3 + a] - reference_[i * 3 + a]);
      w2 += w * w;
    }
    way2 = std::max(way2, w2);
  }
  for (std::size_t w = 0; w < global.walls.size(); ++w) {
    double w2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double d = static_cast<double>(global.walls[w].offset[a] - wall_reference_[w][a]);
      w2 += d * d;
    }
    way2 = std::max(way2, w2);
  }
  return 1.0001 * std::sqrt(way2) * scale_.quantum;
}

std::int64_t Grains::touching_pairs() const {
  std::int64_t n = 0;
  for (std::uint8_t bits : lists_.pairs().touching) n += std::popcount(bits);
  return n;
}

double Grains::fastest_wall(const GlobalState& global) const {
  double speed2 = 0;
  for (const WallState& w : global.walls)
    speed2 = std::max(speed2, w.velocity[0] * w.velocity[0] + w.velocity[1] * w.velocity[1] +
                                  w.velocity[2] * w.velocity[2]);
  return std::sqrt(speed2);
}

}  // namespace sph
