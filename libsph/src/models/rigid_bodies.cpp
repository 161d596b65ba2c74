#include "sph/models/rigid_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/core/error.hpp"
#include "sph/core/kernels.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"
#include "sph/models/rigid_motion.hpp"

namespace sph {
namespace {

constexpr double largest_turn =
    0.5;  ///< of a body in a step: the midpoint rule converges well below it [rad]

/// Components 0 of a vector that has but two.
Vector3 vector_at(const double* x, std::size_t row, std::size_t d) {
  return {x[row * d], x[row * d + 1], d == 3 ? x[row * d + 2] : 0.0};
}

/// The unit of forces: what a particle feels at the largest modulus. Any other would do, within 2^30.
double force_unit(const Scene& scene) {
  double modulus = 1e-100;
  for (const Group& g : scene.groups) modulus = std::fmax(modulus, g.eos.bulk_modulus);
  double face = 1;
  for (int a = 1; a < scene.dim; ++a) face *= scene.start.spacing;
  return std::ldexp(1.0, std::ilogb(modulus * face));
}

/// Mean square of a coordinate under the quintic kernel, in h^2.
template <int D>
double spread_of_kernel() {
  constexpr double step = 1.0 / 256;
  double sum = 0, whole = 0;
  for (double q = 0.5 * step; q < Quintic::radius; q += step) {
    double shell = Quintic::value<D>(q);
    for (int a = 1; a < D; ++a) shell *= q;
    whole += shell;
    sum += shell * (q * q);
  }
  return sum / whole / D;
}

// The Laplacian of the velocity, as viscous forces are summed by default, is the divergence of mu grad v. What acts on the
// face of a body is mu (grad v + grad v^T) n, and of the velocities of a body that spins the second part is not 0 there:
// -mu omega x n. Over a closed face its force is 0 and its torque -2 mu volume omega. With n dS of a particle
//   V_b V_f sum_f W (x_f - x_b) 2 / m2,   m2 the mean square of a coordinate under W:
// integrated over the depth behind a flat face it is the face.
double twist_of(const Scene& scene) {
  if (!has_wet_bodies(scene) || scene.terms.viscous.form != ViscosityForm::laplacian) return 0;
  double viscosity = -1;
  for (const Group& g : scene.groups) {
    if (g.kind != GroupKind::fluid) continue;
    // Of several nobody knows which is beside the body.
    if (g.viscosity_law.varies() || (viscosity >= 0 && viscosity != g.viscosity)) return 0;
    viscosity = g.viscosity;
  }
  const double h = scene.kernel.smoothing_length, volume = particle_volume(scene);
  const double normalisation =
      scene.dim == 2 ? Quintic::normalisation<2> / (h * h) : Quintic::normalisation<3> / (h * h * h);
  const double m2 = scene.dim == 2 ? spread_of_kernel<2>() : spread_of_kernel<3>();
  return viscosity * (volume * volume) * normalisation * 2 / (m2 * h);
}

/// Bodies move on, and all that belongs to their particles follows.
struct Placement {
  static constexpr FieldSet reads{Field::arm, Field::group};
  static constexpr FieldSet writes{Field::position, Field::displacement, Field::velocity,
                                   Field::acceleration};
  const SphConstants* constants;
  std::vector<int> body_of;
  std::vector<const RigidMaterial*> kind;

  struct Now {
    Vector3 spin;
    Matrix3 half, whole;
  };

  void operator()(const View<reads, writes>& p, const Step& step) const {
    std::vector<Now> now;
    for (std::size_t b = 0; b < step.global.bodies.size(); ++b)
      now.push_back(move(step.global.bodies[b], *kind[b], step.global.time, step.global.dt));
    const auto* group = p.get<Field::group>();
    for_movers(step.ranges, [&](std::size_t i) {
      if (const int b = body_of[group[i]]; b >= 0)
        place(p, i, step.global.bodies[static_cast<std::size_t>(b)], now[static_cast<std::size_t>(b)]);
    });
  }

  Now move(BodyState& body, const RigidMaterial& of, double time, double dt) const {
    const int dim = constants->scene->dim;
    const bool held = of.holds(RigidMaterial::rotation);
    const Turning t = of.motion ? lead(body, *of.motion, {constants->scale, constants->wrap}, dim, time, dt)
                                : turning(body, dim, held, dt);
    for (std::size_t a = 0; a < 3; ++a)
      body.motion.centre[a] += constants->scale.quanta(body.motion.velocity[a] * dt);
    body.motion.turn = t.whole;
    body.motion.angle = t.angle;
    settle_spin(body, held);
    return {t.spin, rotation_of(t.half), rotation_of(t.whole)};
  }

  // The place is known but for whole periods: the particle keeps the image that it has.
  void place(const View<reads, writes>& p, std::size_t i, const BodyState& body, const Now& now) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const Vector3 arm = vector_at(p.get<Field::arm>(), i, d), there = now.whole * arm;
    const Vector3 speed = vector_of(body.motion.velocity) + now.spin.cross(now.half * arm);
    std::int64_t *x = p.get<Field::position>() + i * d, *u = p.get<Field::displacement>();
    double *v = p.get<Field::velocity>() + i * d, *frame = p.get<Field::acceleration>();
    const Vector3 pushed = vector_of(body.load.acceleration) +
                           vector_of(body.load.angular_acceleration).cross(there) +
                           now.spin.cross(now.spin.cross(there));
    for (std::size_t a = 0; a < d; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      std::int64_t way = body.motion.centre[a] + constants->scale.quanta(there[axis]) - x[a];
      if (const std::int64_t period = constants->wrap.period[a]; period > 0) {
        way %= period;
        if (way > period / 2) way -= period;
        if (way < -(period / 2)) way += period;
      }
      x[a] += way;
      if (u != nullptr) u[i * d + a] += way;
      v[a] = speed[axis];
      if (frame != nullptr) frame[i * d + a] = pushed[axis];
    }
  }
};

}  // namespace

RigidBodies::RigidBodies(std::size_t set, const SphConstants& constants, const BodyForces& body_forces)
    : Model(set),
      constants_(&constants),
      body_forces_(&body_forces),
      steps_(constants),
      body_of_(rigid_bodies_of(*constants.scene)),
      forces_(force_unit(*constants.scene)),
      torques_(force_unit(*constants.scene) * std::ldexp(1.0, std::ilogb(constants.scene->start.spacing))),
      twist_(twist_of(*constants.scene)) {
  for (const Group& g : constants.scene->groups)
    if (is_rigid(g) && g.solid.body.part_of < 0) kind_.push_back(&g.solid.body);
}

std::size_t RigidBodies::components() const { return constants_->scene->dim == 2 ? 3 : 6; }

void RigidBodies::reserve(Reduction& r) { in_ = r.add_sums(kind_.size() * components() * BodySums::digits); }

void RigidBodies::add_to(Builder& b) const {
  b.add_fields({Field::arm});
  // What drift has done to these particles counts for nothing: where they end is what lists have to know of.
  b.add_drift("bodies", Placement{constants_, body_of_, kind_}, [this](const GlobalState& global) {
    return std::fmax(0.0, farthest_move(global) - longest_drift(global));
  });
}

bool RigidBodies::report(const StepState& s, Reduction& r) {
  const BodyForces::Particles of_forces(s.particles);
  const auto d = static_cast<std::size_t>(s.particles.dim());
  const double *force = s.particles.data<Field::force>(), *mass = s.particles.data<Field::mass>(),
               *arm = s.particles.data<Field::arm>(), *beside = s.particles.data<Field::wall_sums>();
  const auto* group = s.particles.data<Field::group>();
  std::vector<Matrix3> turns;
  for (const BodyState& body : s.global.bodies) turns.push_back(rotation_of(body.motion.turn));
  const std::size_t n = components();
  const std::span<std::int64_t> sums = r[in_];
  bool good = true;
  for (std::size_t i = 0; i < s.particles.owned(); ++i) {
    if (body_of_[group[i]] < 0) continue;
    const auto b = static_cast<std::size_t>(body_of_[group[i]]);
    const Double3 pull = (*body_forces_)(of_forces, i, s);
    const Vector3 f = vector_at(force, i, d) + mass[i] * Vector3(pull[0], pull[1], d == 3 ? pull[2] : 0.0);
    const Vector3 way = turns[b] * vector_at(arm, i, d);
    Vector3 torque = way.cross(f);
    if (twist_ > 0)
      torque -= way.cross(vector_of(s.global.bodies[b].motion.spin)
                              .cross(twist_ * vector_at(beside + i * (2 + 2 * d) + 2 + d, 0, d)));
    bool held = true;
    for (std::size_t k = 0; k < n; ++k) {
      const bool of_force = k < d;
      const double x =
          of_force ? f[static_cast<Eigen::Index>(k)] : torque[static_cast<Eigen::Index>(d == 2 ? 2 : k - d)];
      const BodySums& of = of_force ? forces_ : torques_;
      held = held && of.holds(x);
      if (!held) break;
      of.add(x, std::span<std::int64_t, BodySums::digits>(
                    sums.subspan((b * n + k) * BodySums::digits, BodySums::digits)));
    }
    if (!held)
      find_fault(
          *constants_, FaultView(s.particles), i, s,
          fmt::format("feels a force of {:.3g} N, beyond all range; reduce time.dt or time.cfl", f.norm()));
    good = good && held;
  }
  return good;
}

void RigidBodies::act(const Reduction& r, GlobalState& global) {
  const auto d = static_cast<std::size_t>(constants_->scene->dim);
  const std::size_t n = components();
  const std::span<const std::int64_t> sums = r[in_];
  for (std::size_t b = 0; b < kind_.size(); ++b) {
    BodyLoad& load = global.bodies[b].load;
    for (std::size_t k = 0; k < n; ++k) {
      const std::span<const std::int64_t, BodySums::digits> sum(
          sums.subspan((b * n + k) * BodySums::digits, BodySums::digits));
      if (k < d)
        load.force[k] = forces_.value(sum);
      else
        load.torque[d == 2 ? 2 : k - d] = torques_.value(sum);
    }
    kick(b, global.bodies[b], global.time, global.dt);
  }
  note_maxima(global);
}

// The frame in which a fluid's pressure goes on into the body is that of means, as that of bodies that deform is
// (models/wetted.cpp).
void RigidBodies::kick(std::size_t body, BodyState& state, double time, double dt) const {
  const Scene& scene = *constants_->scene;
  const RigidMaterial& of = *kind_[body];
  const bool turns = !of.holds(RigidMaterial::rotation);
  BodyMotion& now = state.motion;
  const std::array<double, 3> spin = now.spin, velocity = now.velocity;
  std::array<double, 3> acceleration{}, turning{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!of.holds(a)) acceleration[a] = state.load.force[a] / state.shape.mass;
    now.velocity[a] += acceleration[a] * dt;
    if (turns) now.angular_momentum[a] += state.load.torque[a] * dt;
  }
  if (of.motion)
    take_speed(state, *of.motion, {constants_->scale, constants_->wrap}, time + dt, time + 1.5 * dt);
  settle_spin(state, !turns);
  if (!scene.has_kind(GroupKind::fluid) || dt == 0) return;
  for (std::size_t a = 0; a < 3; ++a) {
    if (of.motion) acceleration[a] = (now.velocity[a] - velocity[a]) / dt;
    if (of.motion || turns) turning[a] = (now.spin[a] - spin[a]) / dt;
  }
  double sound = 0;
  for (std::size_t g = 0; g < scene.groups.size(); ++g)
    if (scene.groups[g].kind == GroupKind::fluid) sound = std::fmax(sound, constants_->groups.sound_speed[g]);
  const double share = std::fmin(sound / scene.kernel.smoothing_length * dt, 1.0);
  for (std::size_t a = 0; a < 3; ++a) {
    state.load.acceleration[a] += share * (acceleration[a] - state.load.acceleration[a]);
    state.load.angular_acceleration[a] += share * (turning[a] - state.load.angular_acceleration[a]);
  }
}

void RigidBodies::note_maxima(const GlobalState& global) {
  fastest_ = hardest_ = 0;
  for (std::size_t k = 0; k < kind_.size(); ++k) {
    const BodyState& b = global.bodies[k];
    const double spin = vector_of(b.motion.spin).norm(), r = b.shape.radius;
    Vector3 force = vector_of(b.load.force);
    for (std::size_t a = 0; a < 3; ++a)
      if (kind_[k]->holds(a)) force[static_cast<Eigen::Index>(a)] = 0;
    fastest_ = std::fmax(fastest_, vector_of(b.motion.velocity).norm() + spin * r);
    const double led = kind_[k]->motion ? vector_of(b.load.acceleration).norm() : 0.0;
    hardest_ = std::fmax(hardest_, force.norm() / b.shape.mass + led + spin * spin * r);
  }
}

FieldSet RigidBodies::follow(Particles& p, const GlobalState& global) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const auto* group = p.data<Field::group>();
  const double* arm = p.data<Field::arm>();
  double* v = p.data<Field::velocity>();
  std::vector<Matrix3> turns;
  for (const BodyState& body : global.bodies) turns.push_back(rotation_of(body.motion.turn));
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (body_of_[group[i]] < 0) continue;
    const auto b = static_cast<std::size_t>(body_of_[group[i]]);
    const BodyMotion& now = global.bodies[b].motion;
    const Vector3 speed =
        vector_of(now.velocity) + vector_of(now.spin).cross(turns[b] * vector_at(arm, i, d));
    for (std::size_t a = 0; a < d; ++a) v[i * d + a] = speed[static_cast<Eigen::Index>(a)];
  }
  return {Field::velocity};
}

double RigidBodies::longest_step(const Reduction&) const { return longest_step(); }

double RigidBodies::longest_step() const {
  double dt = steps_.longest({fastest_, hardest_, 0, 0, 0, 0});
  for (const RigidMaterial* of : kind_)
    if (of->motion && !constants_->scene->time.dt) dt = std::fmin(dt, longest_step_of(*of->motion));
  return dt;
}

std::string RigidBodies::name_of(std::size_t body) const {
  for (const Group& g : constants_->scene->groups)
    if (&g.solid.body == kind_[body]) return g.name;
  return {};
}

void RigidBodies::guard_step(const Reduction&, const GlobalState& global) const {
  for (std::size_t k = 0; k < global.bodies.size(); ++k) {
    const double turn = vector_of(global.bodies[k].motion.spin).norm() * global.dt;
    if (!(turn <= largest_turn))
      throw GuardError(
          fmt::format("step {}: the rigid body \"{}\" would turn by {:.3g} in a step, more than {}; reduce "
                      "time.dt or time.cfl",
                      global.step, name_of(k), turn, largest_turn));
  }
}

double RigidBodies::longest_look_back(const GlobalState& global) const { return 0.5 * farthest_move(global); }

// What a place is rounded by comes on top.
double RigidBodies::farthest_move(const GlobalState& global) const {
  double way = 0;
  for (std::size_t k = 0; k < global.bodies.size(); ++k) {
    const RigidMaterial& of = *kind_[k];
    const BodyState& body = global.bodies[k];
    way = std::fmax(way, of.motion ? longest_path(body, *of.motion, {constants_->scale, constants_->wrap},
                                                  global.time, global.dt)
                                   : longest_path(body, constants_->scene->dim,
                                                  of.holds(RigidMaterial::rotation), global.dt));
  }
  return way + constants_->scale.metres(2);
}

}  // namespace sph
