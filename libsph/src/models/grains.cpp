#include "sph/models/grains.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "models/grain_constants.hpp"
#include "pairs/for_rows.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/models/models.hpp"
#include "sph/models/sph_constants.hpp"
#include "start/start_overlaps.hpp"

namespace sph {
namespace {

double next_power_of_two(double x) { return std::ldexp(1.0, std::ilogb(x) + 1); }

struct GrainDrift {
  static constexpr FieldSet reads{Field::velocity};
  static constexpr FieldSet writes{Field::position};
  double quantum;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    std::int64_t* x = p.get<Field::position>();
    const double* v = p.get<Field::velocity>();
    const double quanta = step.global.dt / quantum;
    for_movers(step.ranges, [&](std::size_t i) {
      for (std::size_t k = i * 3; k < i * 3 + 3; ++k) x[k] = moved_by(x[k], round_to_quanta(v[k] * quanta));
    });
  }
};

}  // namespace

FieldSet grain_fields(const Scene& scene) {
  FieldSet fields{Field::id, Field::position, Field::velocity, Field::mass, Field::group, Field::radius};
  if (contact_fusion(scene).spins) fields |= FieldSet{Field::spin};
  if (scene.output.average_time > 0) fields |= FieldSet{Field::velocity_mean};
  return fields;
}

Grains::Grains(std::size_t set, const Scene& scene, const PositionScale& scale)
    : Model(set),
      SetPair(set),
      scene_(&scene),
      scale_(scale),
      wrap_(wrap_of(scene, scale)),
      fusion_(contact_fusion(scene)),
      lists_(fusion_.parities),
      alone_(!scene.has_matter()) {
  for (const Group& g : scene.groups) fixed_.push_back(g.grain.fixed);
  dt_ = grain_step(scene);
  longest_move_ = longest_grain_move(scene);
  find_constants();
  find_quanta();
}

void Grains::find_constants() {
  const std::size_t n = scene_->groups.size();
  constants_.resize(n * n * 8);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      std::ranges::copy(constants_of(*scene_, a, b, dt_),
                        constants_.begin() + static_cast<std::ptrdiff_t>((a * n + b) * 8));
}

// A force term stays below 2^50 quanta up to four times the elastic force at the largest overlap allowed: the
// rest is for dashpots. 4096 terms then fit a 64-bit sum. A torque is at most (mu + mu_r) r |F|, |F| at most
// sqrt(3) 2^50 quanta where the guard of forces lets it pass: below 2^51 quanta, and 4096 of them fit too.
void Grains::find_quanta() {
  double radius = 0;
  for (const Group& g : scene_->groups) radius = std::max(radius, g.grain.largest_radius);
  const double overlap = scene_->contact.largest_overlap * radius;
  const double force = stiffest_contact(*scene_, radius) * overlap;
  force_quantum_ = std::ldexp(next_power_of_two(4 * force), -50);
  double friction = 1;
  for (std::size_t a = 0; a < scene_->groups.size(); ++a)
    for (std::size_t b = a; b < scene_->groups.size(); ++b) {
      const std::array<double, 8> k = constants_of(*scene_, a, b, 0);
      friction = std::max(friction, k[4] + k[5]);
    }
  torque_quantum_ = std::ldexp(next_power_of_two(8 * force * radius * friction), -50);
}

// Alone, contacts and walls of a block of rows, then at once the kick and drift of its grains: one stage. In
// company they drift when the others do, since forces between sets want all where they are at one time.
Plan Grains::plan() {
  Plan plan;
  append(plan.drift, {"walls", decomp::Region::update, {}, {}, [this](StepState& s, Side) {
                        set_stage(s.global);
                        if (!alone_) move_walls(s.global);
                      }});
  if (!alone_) {
    append(plan.drift, local_stage("drift of grains", GrainDrift{scale_.quantum}));
    plan.drift.back().stages.front().moves = [this](const GlobalState& global) {
      return std::max(longest_drift(global), longest_wall_way(global));
    };
  }
  append(plan.sums, {"contacts to forget", decomp::Region::contacts, {}, {}, [this](StepState& s, Side) {
                       begin_step(s.particles, s.global);
                     }});
  const FieldSet writes = alone_ ? reads() : reads().without({Field::position});
  append(plan.kick, {alone_ ? "contacts, kick, drift" : "contacts, kick", decomp::Region::contacts, reads(),
                     writes, [this](StepState& s, Side side) {
                       sweep(s.particles, side == Side::interior ? lists_.interior() : lists_.boundary(),
                             s.ranges, s.global.dt);
                       s.maxima.speed = larger(std::sqrt(sweep_.speed2), s.maxima.speed);
                       // Of others, accelerations limit the time step; of contacts their stiffness does.
                       const double most = std::sqrt(sweep_.acceleration2);
                       if (alone_ || !std::isfinite(most))
                         s.maxima.acceleration = larger(most, s.maxima.acceleration);
                     }});
  return plan;
}

FieldSet Grains::reads() const {
  FieldSet fields{Field::position, Field::velocity};
  if (fusion_.spins) fields |= FieldSet{Field::spin};
  return fields;
}

// Walls as the scene describes them.
double Grains::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  global.walls.resize(scene_->walls.size());
  for (std::size_t w = 0; w < global.walls.size(); ++w) global.walls[w].velocity = scene_->walls[w].velocity;
  check_start_speeds(comm, *scene_, particles);
  if (alone_) return dt_;
  // What drifts first needs to know how far.
  double speed2 = 0;
  const double* v = particles.data<Field::velocity>();
  for (std::size_t i = 0; i < particles.owned(); ++i)
    speed2 =
        std::max(speed2, v[i * 3] * v[i * 3] + v[i * 3 + 1] * v[i * 3 + 1] + v[i * 3 + 2] * v[i * 3 + 2]);
  std::array<double, 1> largest{std::sqrt(speed2)};
  comm.max(largest);
  global.max_speed = std::max(global.max_speed, largest[0]);
  return dt_;
}

void Grains::check_start(const decomp::Comm& comm, const StepState& s) const {
  refuse_overlaps(comm, *scene_, scale_, s.particles, lists_, planes(s.global));
}

Grains::WallNow Grains::wall_now(std::size_t wall, const GlobalState& global) const {
  const Wall& w = scene_->walls[wall];
  WallNow now{true, w.velocity, w.force};
  for (const WallStage& s : scene_->stages) {
    if (s.begin > global.time) break;
    for (const WallChange& c : s.walls) {
      if (c.wall != static_cast<int>(wall)) continue;
      now.present = now.present && !c.remove;
      if (c.velocity) now.velocity = *c.velocity, now.force.reset();
      if (c.force) now.force = c.force;
    }
  }
  return now;
}

void Grains::set_stage(GlobalState& global) const {
  for (std::size_t w = 0; w < global.walls.size(); ++w) {
    const WallNow now = wall_now(w, global);
    if (!now.force) global.walls[w].velocity = now.velocity;
  }
}

std::vector<PlaneNow> Grains::planes(const GlobalState& global) const {
  std::vector<PlaneNow> out;
  for (std::size_t w = 0; w < scene_->walls.size(); ++w) {
    const Wall& wall = scene_->walls[w];
    PlaneNow plane{{},
                   wall.normal,
                   global.walls[w].velocity,
                   static_cast<std::uint32_t>(wall.group),
                   wall_now(w, global).present};
    for (std::size_t a = 0; a < 3; ++a)
      plane.point[a] = scale_.quanta(wall.point[a]) + global.walls[w].offset[a];
    out.push_back(plane);
  }
  return out;
}

void Grains::begin_step(const Particles& particles, const GlobalState& global) {
  sweep_ = {};
  counters_.ended += lists_.forget_parted(particles.data<Field::id>());
  planes_ = planes(global);
  wall_force_.assign(6 * planes_.size(), 0);
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
          scene_->contact.pull ? -std::numeric_limits<double>::infinity() : 0.0,
          {scene_->gravity[0], scene_->gravity[1], scene_->gravity[2]},
          scene_->contact.largest_overlap,
          alone_};
}

void Grains::sweep(Particles& particles, std::span<const ContactBlock> blocks, const RowRanges& ranges,
                   double dt) {
  ContactSweep now;
  fusion_.sweep(context(particles, dt), blocks, ranges, now);
  sweep_.speed2 = now.speed2 <= sweep_.speed2 ? sweep_.speed2 : now.speed2;
  sweep_.acceleration2 = now.acceleration2 <= sweep_.acceleration2 ? sweep_.acceleration2 : now.acceleration2;
  sweep_.strong.add(now.strong);
  sweep_.deep.add(now.deep);
  counters_.created += now.created;
  counters_.ended += now.ended;
}

// A tangential velocity drags the grains; the plane itself moves along its normal only.
void Grains::move_walls(GlobalState& global) const {
  for (std::size_t w = 0; w < global.walls.size(); ++w) {
    WallState& state = global.walls[w];
    const Double3& normal = scene_->walls[w].normal;
    double along = 0;
    for (std::size_t a = 0; a < 3; ++a) along += state.velocity[a] * normal[a];
    for (std::size_t a = 0; a < 3; ++a)
      state.offset[a] += round_to_quanta(along * normal[a] * global.dt / scale_.quantum);
  }
}

void Grains::push_walls(GlobalState& global, std::span<const std::int64_t> wall_force) const {
  for (std::size_t w = 0; w < global.walls.size(); ++w) {
    WallState& state = global.walls[w];
    const Wall& wall = scene_->walls[w];
    double pressed = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      state.force[a] = wall_force[3 * w + a];
      pressed -= wall_force_newton(state.force[a]) * wall.normal[a];
    }
    const WallNow now = wall_now(w, global);
    if (!now.force || !now.present) continue;
    const double wanted = wall.servo_gain * (*now.force - pressed);
    const double speed = std::clamp(wanted, -wall.largest_speed, wall.largest_speed);
    for (std::size_t a = 0; a < 3; ++a) state.velocity[a] = speed * wall.normal[a];
  }
}

std::optional<double> Grains::longest_way(const Particles& particles, const GlobalState& global) const {
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

// In company stages say how far grains and walls drift.
double Grains::path(const GlobalState& global, double speed) const {
  return alone_ ? std::max(1.0001 * speed * global.dt, longest_wall_way(global)) : 0.0;
}

double Grains::longest_wall_way(const GlobalState& global) const {
  double speed2 = 0;
  for (const WallState& w : global.walls)
    speed2 = std::max(speed2, w.velocity[0] * w.velocity[0] + w.velocity[1] * w.velocity[1] +
                                  w.velocity[2] * w.velocity[2]);
  return 1.0001 * std::sqrt(speed2) * global.dt;
}

}  // namespace sph
