// What rigid bodies are at the start: masses, centres, inertia and motion of their particles, by exact sums.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "decomp/exact_sum.hpp"
#include "sph/core/error.hpp"
#include "sph/models/rigid_bodies.hpp"
#include "sph/models/rigid_motion.hpp"

namespace sph {
namespace {

/// Of one body: sums over its particles, arms about one of them, then about the centre of mass.
struct Sums {
  static constexpr std::size_t mass = 0, moment = 1, momentum = 4, heaviness = 7, count = 8;  ///< first round
  static constexpr std::size_t inertia = 0, angular_momentum = 6, count_about = 9;  ///< second round
};

[[noreturn]] void refuse(const Scene& scene, const std::string& name, std::string_view what) {
  throw InputError(fmt::format("{}: group.{}.rigid: {}", scene.file, name, what));
}

class RigidStart {
 public:
  RigidStart(const decomp::Comm& comm, const SphConstants& constants, const std::vector<int>& body_of,
             const std::vector<const RigidMaterial*>& kind, Particles& particles)
      : comm_(comm),
        constants_(constants),
        body_of_(body_of),
        kind_(kind),
        p_(particles),
        d_(static_cast<std::size_t>(particles.dim())) {
    for (const Group& g : constants.scene->groups)
      if (is_rigid(g) && g.solid.body.part_of < 0) name_.push_back(g.name);
  }

  [[nodiscard]] std::vector<BodyState> bodies() {
    std::vector<BodyState> out(kind_.size());
    choose_origins();
    check_extent();
    find_centres(out);
    find_inertia(out);
    for (std::size_t b = 0; b < out.size(); ++b) begin_motion(b, out[b]);
    return out;
  }

 private:
  template <class Function>
  void for_rows(Function function) {
    const auto* group = p_.data<Field::group>();
    for (std::size_t i = 0; i < p_.owned(); ++i)
      if (const int b = body_of_[group[i]]; b >= 0) function(i, static_cast<std::size_t>(b));
  }

  /// Where the particle of the lowest id is: of periodic images of the others the nearest to it are meant. And how it
  /// moves: the mean of what moves alike is that then, to the last bit.
  void choose_origins() {
    std::vector<std::int64_t> lowest(kind_.size(), std::numeric_limits<std::int64_t>::min());
    const std::uint64_t* id = p_.data<Field::id>();
    for_rows([&](std::size_t i, std::size_t b) {
      lowest[b] = std::max(lowest[b], -static_cast<std::int64_t>(id[i]));
    });
    comm_.max(std::span<std::int64_t>(lowest));
    for (std::size_t b = 0; b < lowest.size(); ++b)
      if (lowest[b] == std::numeric_limits<std::int64_t>::min())
        refuse(*constants_.scene, name_[b], "the start has no particle of it; give it a region");
    origin_.assign(3 * kind_.size(), 0);
    std::vector<std::int64_t> bits(origin_.size(), 0);  // that one rank has, and the others none of
    for_rows([&](std::size_t i, std::size_t b) {
      for (std::size_t a = 0; a < d_ && -static_cast<std::int64_t>(id[i]) == lowest[b]; ++a) {
        origin_[3 * b + a] = p_.data<Field::position>()[i * d_ + a];
        bits[3 * b + a] = std::bit_cast<std::int64_t>(p_.data<Field::velocity>()[i * d_ + a]);
      }
    });
    comm_.sum(std::span<std::int64_t>(origin_));
    comm_.sum(std::span<std::int64_t>(bits));
    for (const std::int64_t b : bits) velocity_.push_back(std::bit_cast<double>(b));
  }

  [[nodiscard]] Vector3 from_origin(std::size_t i, std::size_t b) const {
    Vector3 out = Vector3::Zero();
    for (std::size_t a = 0; a < d_; ++a) {
      std::int64_t way = p_.data<Field::position>()[i * d_ + a] - origin_[3 * b + a];
      if (const std::int64_t period = constants_.wrap.period[a]; period > 0) {
        way %= period;
        if (way > period / 2) way -= period;
        if (way < -(period / 2)) way += period;
      }
      out[static_cast<Eigen::Index>(a)] = constants_.scale.metres(way);
    }
    return out;
  }

  void check_extent() {
    std::vector<double> most(6 * kind_.size(), -std::numeric_limits<double>::infinity());
    for_rows([&](std::size_t i, std::size_t b) {
      const Vector3 x = from_origin(i, b);
      for (std::size_t a = 0; a < 3; ++a) {
        const double at = x[static_cast<Eigen::Index>(a)];
        most[6 * b + a] = std::fmax(most[6 * b + a], at);
        most[6 * b + 3 + a] = std::fmax(most[6 * b + 3 + a], -at);
      }
    });
    comm_.max(std::span<double>(most));
    for (std::size_t b = 0; b < kind_.size(); ++b)
      for (std::size_t a = 0; a < d_; ++a)
        if (const std::int64_t period = constants_.wrap.period[a];
            period > 0 && !(most[6 * b + a] + most[6 * b + 3 + a] <
                            0.5 * static_cast<double>(period) * constants_.scale.quantum))
          refuse(
              *constants_.scene, name_[b],
              fmt::format("the body is half a period long in {} or longer; lengthen the domain", "xyz"[a]));
  }

  void find_centres(std::vector<BodyState>& out) {
    std::vector<decomp::ExactSum> sums(Sums::count * out.size());
    const double *mass = p_.data<Field::mass>(), *v = p_.data<Field::velocity>();
    const auto* group = p_.data<Field::group>();
    for_rows([&](std::size_t i, std::size_t b) {
      decomp::ExactSum* s = sums.data() + Sums::count * b;
      const Vector3 x = from_origin(i, b);
      s[Sums::mass].add(mass[i]);
      s[Sums::heaviness].add(mass[i] * constants_.groups.weight.share[group[i]]);
      for (std::size_t a = 0; a < d_; ++a) {
        s[Sums::moment + a].add(mass[i] * x[static_cast<Eigen::Index>(a)]);
        s[Sums::momentum + a].add(mass[i] * (v[i * d_ + a] - velocity_[3 * b + a]));
      }
    });
    decomp::ExactSum::all_reduce(comm_, sums);
    mean_.resize(out.size());
    for (std::size_t b = 0; b < out.size(); ++b) {
      const decomp::ExactSum* s = sums.data() + Sums::count * b;
      out[b].shape.mass = s[Sums::mass].value();
      out[b].shape.heaviness = s[Sums::heaviness].value();
      for (std::size_t a = 0; a < 3; ++a) {
        const double mean = s[Sums::moment + a].value() / out[b].shape.mass;
        mean_[b][static_cast<Eigen::Index>(a)] = mean;
        out[b].motion.centre[a] = origin_[3 * b + a] + constants_.scale.quanta(mean);
        out[b].motion.velocity[a] = velocity_[3 * b + a] + s[Sums::momentum + a].value() / out[b].shape.mass;
        out[b].load.force[a] = out[b].shape.heaviness * constants_.scene->domain.gravity[a];  // not known yet
      }
    }
  }

  void find_inertia(std::vector<BodyState>& out) {
    std::vector<decomp::ExactSum> sums(Sums::count_about * out.size());
    std::vector<double> radius(out.size(), 0);
    const double *mass = p_.data<Field::mass>(), *v = p_.data<Field::velocity>();
    for_rows([&](std::size_t i, std::size_t b) {
      const Vector3 arm = from_origin(i, b) - mean_[b];
      for (std::size_t a = 0; a < d_; ++a)
        p_.data<Field::arm>()[i * d_ + a] = arm[static_cast<Eigen::Index>(a)];
      radius[b] = std::fmax(radius[b], arm.norm());
      add_inertia(mass[i], arm, {v[i * d_], v[i * d_ + 1], d_ == 3 ? v[i * d_ + 2] : 0.0},
                  sums.data() + Sums::count_about * b);
    });
    decomp::ExactSum::all_reduce(comm_, sums);
    comm_.max(std::span<double>(radius));
    for (std::size_t b = 0; b < out.size(); ++b) {
      const decomp::ExactSum* s = sums.data() + Sums::count_about * b;
      out[b].shape.radius = radius[b];
      for (std::size_t k = 0; k < 6; ++k) out[b].shape.inertia[k] = s[Sums::inertia + k].value();
      for (std::size_t a = 0; a < 3; ++a)
        out[b].motion.angular_momentum[a] = s[Sums::angular_momentum + a].value();
    }
  }

  void add_inertia(double mass, const Vector3& arm, const Vector3& v, decomp::ExactSum* s) const {
    const double square = arm.squaredNorm();
    for (int a = 0; a < 3; ++a) {
      s[Sums::inertia + static_cast<std::size_t>(a)].add(mass *
                                                         (d_ == 2 ? square : square - arm[a] * arm[a]));
      for (int c = a + 1; d_ == 3 && c < 3; ++c)
        s[Sums::inertia + static_cast<std::size_t>(symmetric_index(a, c, 3))].add(-mass * (arm[a] * arm[c]));
      s[Sums::angular_momentum + static_cast<std::size_t>(a)].add(mass * arm.cross(v)[a]);
    }
  }

  void begin_motion(std::size_t b, BodyState& body) const {
    const RigidMaterial& kind = *kind_[b];
    const Matrix3 inertia = inertia_of(body.shape);
    const double trace = inertia.trace();
    const bool thin = !(inertia.determinant() > 1e-12 * trace * trace * trace);
    if (thin && !kind.holds(RigidMaterial::rotation))
      refuse(
          *constants_.scene, name_[b],
          "the particles of the body lie in one line: it must be two across at least, or hold \"rotation\"");
    if (!thin) settle_spin(body, false);
    if (kind.motion) {
      check_motion(b, body, *kind.motion);
      take_speed(body, *kind.motion, {constants_.scale, constants_.wrap}, 0, 0);
      return settle_spin(body, true);
    }
    if (kind.velocity) body.motion.velocity = *kind.velocity;
    if (kind.spin) body.motion.spin = *kind.spin;
    // Twice: the first may take the speed over a power of two, and its unit with it.
    for (int k = 0; k < 2; ++k) round_motion(body, !kind.velocity, !kind.spin);
    settle_spin(body, true);
  }

  void check_motion(std::size_t b, const BodyState& body, const PrescribedMotion& motion) const {
    const Scene& scene = *constants_.scene;
    if (const auto dt = scene.time.dt; dt && !(*dt <= longest_step_of(motion)))
      refuse(scene, name_[b],
             fmt::format("motion.frequency is {:.6g} Hz, and time.dt {:.6g} s: it must be {:.6g} s at most",
                         motion.frequency, *dt, longest_step_of(motion)));
    const double away = from_axis(body, motion, {constants_.scale, constants_.wrap}, 0).norm();
    for (std::size_t a = 0; a < d_ && !motion.spin.empty(); ++a)
      if (const double period = constants_.scale.metres(constants_.wrap.period[a]);
          period > 0 && !(away < 0.5 * period))
        refuse(
            scene, name_[b],
            fmt::format("motion.centre is {:.6g} m from the body's, half a period in {} or more: which way "
                        "round it is is not known",
                        away, "xyz"[a]));
  }

  // Far above the rounding of the sums: the particles, which then have this motion, start the same body again.
  static void round_motion(BodyState& body, bool velocity, bool spin) {
    const double r = body.shape.radius,
                 most = vector_of(body.motion.velocity).norm() + vector_of(body.motion.spin).norm() * r;
    if (!std::isfinite(most)) return;
    const double unit = most > 0 ? std::ldexp(1.0, std::ilogb(most) - 40) : 1.0;
    const double unit_of_spin = r > 0 ? std::ldexp(unit, -std::ilogb(r)) : unit;
    // Of zeros the sign would be that of what was rounded away.
    for (double& v : body.motion.velocity)
      if (velocity) v = unit * std::nearbyint(v / unit) + 0.0;
    for (double& w : body.motion.spin)
      if (spin) w = unit_of_spin * std::nearbyint(w / unit_of_spin) + 0.0;
  }

  const decomp::Comm& comm_;
  const SphConstants& constants_;
  const std::vector<int>& body_of_;
  const std::vector<const RigidMaterial*>& kind_;
  Particles& p_;
  std::size_t d_;
  std::vector<std::string> name_;
  std::vector<std::int64_t> origin_;  ///< of each body [quanta]
  std::vector<double> velocity_;      ///< of the same particles
  std::vector<Vector3> mean_;         ///< its centre of mass from there [m]
};

}  // namespace

double RigidBodies::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  global.bodies = RigidStart(comm, *constants_, body_of_, kind_, particles).bodies();
  (void)follow(particles, global);
  note_maxima(global);
  for (std::size_t b = 0; b < kind_.size(); ++b)
    if (!(vector_of(global.bodies[b].motion.spin).norm() < std::numeric_limits<double>::max()))
      refuse(*constants_->scene, name_of(b), "the body has no finite spin; check its start");
  hardest_ = 0;  // forces are not known yet
  return longest_step();
}

}  // namespace sph
