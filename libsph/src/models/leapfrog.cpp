// What moves particles: positions drift with the velocities of half a step ago, velocities are kicked by the
// sums of the forces; what changes a particle at the end of a step.
#include <cmath>
#include <optional>

#include "pairs/for_rows.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"

namespace sph {
namespace {

struct Drift {
  static constexpr FieldSet reads{Field::velocity};
  static constexpr FieldSet writes{Field::position, Field::displacement};
  PositionScale scale;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const std::size_t d = static_cast<std::size_t>(p.dim());
    std::int64_t* x = p.get<Field::position>();
    std::int64_t* u = p.get<Field::displacement>();
    const double* v = p.get<Field::velocity>();
    const double quanta_per_metre = 1 / scale.quantum;
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      for (std::size_t k = r.first * d; k < r.last * d; ++k)
        x[k] += round_to_quanta(v[k] * step.global.dt * quanta_per_metre);
      if (u == nullptr) continue;
      for (std::size_t k = r.first * d; k < r.last * d; ++k)
        u[k] += round_to_quanta(v[k] * step.global.dt * quanta_per_metre);
    }
  }
};

struct Kick {
  static constexpr FieldSet reads =
      BodyForces::reads | FaultView::reads |
      FieldSet{Field::force, Field::mass, Field::smoothing_length, Field::buffer};
  static constexpr FieldSet writes{Field::velocity};
  const SphConstants* constants;
  const BodyForces* body_forces;
  bool rigid;  ///< there are rigid bodies, which move as a whole

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const std::optional<Double3> common = body_forces->common(p, step);
    const bool alike =
        common && !rigid && p.get<Field::buffer>() == nullptr && p.get<Field::smoothing_length>() == nullptr;
    const Squares most = !alike         ? kick_each(p, step)
                         : p.dim() == 2 ? kick_alike<2>(p, step, *common)
                                        : kick_alike<3>(p, step, *common);
    if (!std::isfinite(most.speed)) find_infinite(p, step);
    step.maxima.speed = larger(std::sqrt(most.speed), step.maxima.speed);
    step.maxima.acceleration = larger(std::sqrt(most.acceleration), step.maxima.acceleration);
  }

 private:
  /// The largest.
  struct Squares {
    double speed = 0, acceleration = 0;
  };

  /// Of particles on which nothing acts but their neighbours and `body`.
  template <std::size_t D>
  static Squares kick_alike(const View<reads, writes>& p, const Step& step, const Double3& body) {
    const double dt = step.global.dt;
    double* v = p.get<Field::velocity>();
    const double* force = p.get<Field::force>();
    const double* mass = p.get<Field::mass>();
    Squares most;
    for_movers(step.ranges, [&](std::size_t i) {
      const double inverse_mass = 1 / mass[i];
      double v2 = 0, a2 = 0;
      for (std::size_t a = 0; a < D; ++a) {
        const double acceleration = force[i * D + a] * inverse_mass + body[a];
        const double now = v[i * D + a] + acceleration * dt;
        v[i * D + a] = now;
        a2 += acceleration * acceleration;
        v2 += now * now;
      }
      most = {larger(v2, most.speed), larger(a2, most.acceleration)};
    });
    return most;
  }

  Squares kick_each(const View<reads, writes>& p, const Step& step) const {
    const std::size_t d = static_cast<std::size_t>(p.dim());
    const double dt = step.global.dt;
    double* v = p.get<Field::velocity>();
    const double* force = p.get<Field::force>();
    const double* mass = p.get<Field::mass>();
    const double* h = p.get<Field::smoothing_length>();
    const std::uint32_t* buffer = p.get<Field::buffer>();
    const auto* group = p.get<Field::group>();
    Squares most;
    for_movers(step.ranges, [&](std::size_t i) {
      if (rigid && is_rigid(constants->scene->groups[group[i]])) return;
      if (buffer != nullptr && buffer[i] != 0) return;  // led by openings
      const double inverse_mass = 1 / mass[i];
      const Double3 body = (*body_forces)(p, i, step);
      double v2 = 0, a2 = 0;
      for (std::size_t a = 0; a < d; ++a) {
        const double acceleration = force[i * d + a] * inverse_mass + body[a];
        v[i * d + a] += acceleration * dt;
        a2 += acceleration * acceleration;
        v2 += v[i * d + a] * v[i * d + a];
      }
      // How far it takes a particle is counted in its own h.
      const double finer = h != nullptr ? constants->scene->kernel.smoothing_length / h[i] : 1.0;
      most = {larger(v2, most.speed), larger(a2 * (finer * finer), most.acceleration)};
    });
    return most;
  }

  /// What is too fast to be squared is too fast.
  void find_infinite(const View<reads, writes>& p, const Step& step) const {
    const std::size_t d = static_cast<std::size_t>(p.dim());
    const double* v = p.get<Field::velocity>();
    for_movers(step.ranges, [&](std::size_t i) {
      double v2 = 0;
      for (std::size_t a = 0; a < d; ++a) v2 += v[i * d + a] * v[i * d + a];
      if (!std::isfinite(v2))
        find_fault(*constants, p, i, step, "has no finite speed; reduce time.dt or time.cfl");
    });
  }
};

struct WallVelocities {
  static constexpr FieldSet reads{Field::group};
  static constexpr FieldSet writes{Field::velocity};
  const Scene* scene;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    double* v = p.get<Field::velocity>();
    const auto* group = p.get<Field::group>();
    for_walls(step.ranges, [&](std::size_t i) {
      for (std::size_t a = 0; a < d; ++a) v[i * d + a] = scene->groups[group[i]].wall.velocity[a];
    });
  }
};

/// Without the excess pressure of a second viscosity.
struct Pressures {
  static constexpr FieldSet reads = Materials::reads;
  static constexpr FieldSet writes{Field::pressure};
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers})
      materials->derive_pressure(p, range_of(step.ranges, c).first, range_of(step.ranges, c).last);
  }
};

struct Sound {
  static constexpr FieldSet reads{Field::sound_speed};
  static constexpr FieldSet writes{};

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double* sound = p.get<Field::sound_speed>();
    for_movers(step.ranges, [&](std::size_t i) { step.maxima.sound = larger(sound[i], step.maxima.sound); });
  }
};

// a += dt/T (f - a), T the time since the start until that is the scene's window: from the plain mean to an
// exponential one. Nothing reads it but output.
struct Averages {
  static constexpr FieldSet reads{Field::velocity, Field::pressure};
  static constexpr FieldSet writes = output_averages;
  const Scene* scene;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const std::size_t d = static_cast<std::size_t>(p.dim());
    const double weight =
        step.global.dt / std::fmin(scene->output.average_time, step.global.time + step.global.dt);
    const double w = std::fmin(weight, 1.0);
    const auto follow = [&](double* mean, const double* value, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) mean[k] += w * (value[k] - mean[k]);
    };
    follow(p.get<Field::velocity_mean>(), p.get<Field::velocity>(), p.owned() * d);
    follow(p.get<Field::pressure_mean>(), p.get<Field::pressure>(), p.owned());
  }
};

}  // namespace

// The margin covers the rounding to quanta.
double longest_drift(const GlobalState& global) { return 1.0001 * global.max_speed * global.dt; }

void add_drift(Builder& b) { b.add_drift("drift", Drift{b.constants().scale}, longest_drift); }

void add_kick(Builder& b) {
  b.add_kick("kick", Kick{&b.constants(), &b.body_forces(), has_rigid_bodies(b.scene())});
  if (b.scene().has_kind(GroupKind::wall)) b.add_kick("walls' own velocity", WallVelocities{&b.scene()});
}

void add_pressures(Builder& b) { b.add_kick("pressures", Pressures{&b.materials()}); }

void add_sound(Builder& b) { b.add_kick("sound", Sound{}); }

void add_averages(Builder& b) {
  b.add_fields(output_averages);
  b.add_kick("averages", Averages{&b.scene()});
}

}  // namespace sph
