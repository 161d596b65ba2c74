#include "sph/models/grains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pairs/for_rows.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/models/grain_limits.hpp"
#include "sph/models/models.hpp"
#include "sph/models/suspension.hpp"
#include "sph/plan/plan.hpp"
#include "start/start_overlaps.hpp"

namespace sph {
namespace {

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
  if (scene.is_suspension()) fields |= Suspension::fields(scene);
  if (scene.output.average_time > 0) fields |= FieldSet{Field::velocity_mean};
  return fields;
}

Grains::Grains(std::size_t set, const decomp::Comm& comm, const Scene& scene, const PositionScale& scale)
    : Model(set),
      scene_(&scene),
      scale_(scale),
      fusion_(contact_fusion(scene)),
      alone_(!scene.has_matter()),
      dt_(scene.has_melt() ? any_step : grain_step(scene)),
      table_(scene, scene.has_melt() ? 0 : dt_),
      walls_(comm, scene, scale, table_.force_quantum()),
      pairs_(set, scene, scale, walls_) {}

// Alone, contacts and walls of a block of rows, then at once the kick and drift of its grains: one stage. In
// company they drift when the others do, since forces between sets want all where they are at one time.
Plan Grains::plan() {
  Plan plan;
  append(plan.drift, {"walls", decomp::Region::update, {}, {}, [this](StepState& s, Side) {
                        walls_.set_stage(s.global);
                        if (!alone_) walls_.move(s.global);
                      }});
  if (!alone_) {
    append(plan.drift, local_stage("drift of grains", GrainDrift{scale_.quantum}));
    plan.drift.back().stages.front().moves = [this](const GlobalState& global) {
      return std::max(longest_drift(global), walls_.longest_way(global));
    };
  }
  append(plan.sums, {"contacts to forget", decomp::Region::contacts, {}, {}, [this](StepState& s, Side) {
                       begin_step(s.particles, s.global);
                     }});
  const FieldSet writes = !alone_              ? pairs_.swept().without({Field::position})
                          : scene_->has_melt() ? pairs_.swept() | FieldSet{Field::contact_force, Field::way}
                                               : pairs_.swept();
  append(plan.kick, {!alone_              ? "contacts, kick"
                     : scene_->has_melt() ? "contacts, drift"
                                          : "contacts, kick, drift",
                     decomp::Region::contacts, pairs_.swept(), writes, [this](StepState& s, Side side) {
                       sweep(s,
                             side == Side::interior ? pairs_.lists().interior() : pairs_.lists().boundary());
                       s.maxima.speed = larger(std::sqrt(now_.sweep.speed2), s.maxima.speed);
                       // Of others, accelerations limit the time step; of contacts their stiffness does.
                       const double most = std::sqrt(now_.sweep.acceleration2);
                       if (alone_ || !std::isfinite(most))
                         s.maxima.acceleration = larger(most, s.maxima.acceleration);
                     }});
  plan.kick.back().stages.front().in_lines = true;
  return plan;
}

double Grains::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  walls_.start(global);
  if (scene_->has_melt()) return any_step;
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
  refuse_overlaps(comm, *scene_, scale_, s.particles, pairs_.lists(), walls_.now(s.global));
}

void Grains::begin_step(const Particles& particles, const GlobalState& global) {
  pairs_.forget_parted(particles);
  now_ = {.walls = walls_.now(global)};
  now_.facets = FacetContacts(now_.walls, scale_.quantum);
  now_.force.assign(6 * walls_.count(), 0);
}

ContactContext Grains::context(Particles& particles, double dt, const double* given) {
  return {&particles,
          &pairs_.lists(),
          {table_.data(), table_.groups(),
           scene_->grains.contact.pull ? -std::numeric_limits<double>::infinity() : 0.0},
          {now_.walls.planes, &now_.facets, walls_.count(), now_.force.data()},
          pairs_.sums(particles).data(),
          {scale_.quantum, table_.force_quantum(), table_.torque_quantum()},
          dt,
          {{scene_->domain.gravity[0], scene_->domain.gravity[1], scene_->domain.gravity[2]}, given},
          alone_ ? pairs_.ways().path() : std::numeric_limits<double>::infinity(),
          scene_->grains.contact.largest_overlap,
          alone_,
          {particles.data<Field::free_velocity>(), particles.data<Field::free_spin>(),
           particles.data<Field::mobility>(), particles.data<Field::contact_force>(),
           particles.data<Field::way>()}};
}

void Grains::sweep(const StepState& s, std::span<const ContactBlock> blocks) {
  ContactSweep now;
  fusion_.sweep(context(s.particles, s.global.dt, s.given), blocks, s.ranges, now);
  now_.sweep.speed2 = now.speed2 <= now_.sweep.speed2 ? now_.sweep.speed2 : now.speed2;
  now_.sweep.acceleration2 =
      now.acceleration2 <= now_.sweep.acceleration2 ? now_.sweep.acceleration2 : now.acceleration2;
  now_.sweep.strong.add(now.strong);
  now_.sweep.deep.add(now.deep);
  pairs_.add(now);
}

// In company stages say how far grains and walls drift. Each component of a way is rounded to a whole quantum.
double Grains::path(const GlobalState& global, double speed) const {
  return alone_ ? std::max(1.0001 * speed * global.dt, walls_.longest_way(global)) + 2 * scale_.quantum : 0.0;
}

}  // namespace sph
