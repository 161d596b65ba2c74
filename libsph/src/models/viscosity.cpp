// The implicit viscous step: v(t + dt) = v(t) + dt a with the viscous forces of v(t + dt), so that they limit
// no time step. For the change c = v(t + dt) - v(t)
//   (m - dt L) c = dt (F + m g + L v(t)),
// L the viscous operator (terms/viscous_operator.hpp), m - dt L symmetric and positive definite: conjugate
// gradients (conjugate_gradients.hpp) from c = 0, until the residual, a spurious impulse, is less than `tolerance` of
// the larger one of the impulses of viscous and of all other forces: so far momentum is conserved.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "models/conjugate_gradients.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/viscous_operator.hpp"

namespace sph {
namespace {

constexpr int most_iterations = 2000;

class ViscositySolver final : public Solver {
 public:
  static constexpr FieldSet reads = BodyForces::reads | FieldSet{Field::velocity, Field::mass, Field::group,
                                                                 Field::viscous_sums, Field::buffer};
  static constexpr FieldSet writes{Field::direction, Field::force};

  ViscositySolver(const Scene& scene, const BodyForces& body_forces)
      : scene_(&scene), body_forces_(&body_forces), tolerance_(scene.terms.viscous.tolerance) {}

  /// The first direction is the velocity itself, of walls that of their material.
  void begin(const View<reads, writes>& particles, const Step& step);
  /// After the operator was applied; none the first time.
  [[nodiscard]] std::span<decomp::ExactSum> products(const StepState& state) override;
  /// In the end Field::force holds the force with which the kick ends at v(t + dt). Throws GuardError when
  /// that takes too many iterations.
  [[nodiscard]] bool improve(StepState& state) override;

 private:
  void set_out(const View<reads, writes>&, const Step&);
  void finish(const View<reads, writes>&, const Step&);

  const Scene* scene_;
  const BodyForces* body_forces_;
  double tolerance_;
  int iteration_ = 0;
  double enough_ = 0;           ///< what the residual's square must not be above
  ConjugateGradients changes_;  ///< of velocities; beside them driving and viscous impulses squared
};

void ViscositySolver::begin(const View<reads, writes>& p, const Step& step) {
  const auto d = static_cast<std::size_t>(p.dim());
  double* direction = p.get<Field::direction>();
  const double* v = p.get<Field::velocity>();
  const auto* group = p.get<Field::group>();
  for_movers(step.ranges, [&](std::size_t i) { std::copy_n(v + i * d, d, direction + i * d); });
  for_walls(step.ranges, [&](std::size_t i) {
    std::copy_n(scene_->groups[group[i]].wall.velocity.begin(), d, direction + i * d);
  });
  iteration_ = 0;
}

std::span<decomp::ExactSum> ViscositySolver::products(const StepState& s) {
  if (iteration_ == 0) return {};
  const View<reads | writes, FieldSet{}> p(s.particles);
  const double dt = s.global.dt;
  const auto d = static_cast<std::size_t>(p.dim());
  const double* direction = p.get<Field::direction>();
  const double* viscous = p.get<Field::viscous_sums>();
  const double* mass = p.get<Field::mass>();
  const std::uint32_t* buffer = p.get<Field::buffer>();
  return changes_.multiply(s.ranges, direction, [&](std::size_t i, std::size_t k) {
    if (buffer != nullptr && buffer[i] != 0) return 0.0;
    return mass[i] * direction[k] - dt * viscous[i * (d + 1) + (k - i * d)];
  });
}

bool ViscositySolver::improve(StepState& s) {
  const View<reads, writes> p(s.particles);
  if (iteration_++ == 0) {
    set_out(p, s);
    return true;
  }
  if (changes_.is_first())
    enough_ = tolerance_ * tolerance_ * std::fmax(changes_.beside(0).value(), changes_.beside(1).value());
  if (!(changes_.square() > enough_)) {
    finish(p, s);
    return false;
  }
  if (iteration_ <= most_iterations && changes_.advance(s.ranges, p.get<Field::direction>())) return true;
  throw GuardError("step " + std::to_string(s.global.step) +
                   ": the implicit viscous step did not converge; reduce time.dt" +
                   (scene_->terms.precision == Precision::mixed
                        ? ", raise terms.viscosity_tolerance or set precision = \"double\""
                        : " or raise terms.viscosity_tolerance"));
}

void ViscositySolver::set_out(const View<reads, writes>& p, const Step& step) {
  const double dt = step.global.dt;
  const auto d = static_cast<std::size_t>(p.dim());
  changes_.clear(p.owned(), d);
  double* direction = p.get<Field::direction>();
  const double* viscous = p.get<Field::viscous_sums>();
  const double* force = p.get<Field::force>();
  const double* mass = p.get<Field::mass>();
  const std::uint32_t* buffer = p.get<Field::buffer>();
  for_movers(step.ranges, [&](std::size_t i) {
    if (buffer != nullptr && buffer[i] != 0) {  // led by openings: its velocity stays
      std::fill_n(&changes_.residual(i * d), d, 0.0);
      changes_.diagonal(i) = 1;
      return;
    }
    const Double3 body = (*body_forces_)(p, i, step);
    double driving = 0, dragging = 0;
    const double diagonal = mass[i] + dt * viscous[i * (d + 1) + d];
    for (std::size_t a = 0; a < d; ++a) {
      const std::size_t k = i * d + a;
      const double drive = dt * (force[k] + mass[i] * body[a]), drag = dt * viscous[i * (d + 1) + a];
      changes_.residual(k) = drive + drag;
      driving += drive * drive;
      dragging += drag * drag;
    }
    changes_.diagonal(i) = diagonal;
    changes_.beside(0).add(driving / diagonal);
    changes_.beside(1).add(dragging / diagonal);
  });
  changes_.begin(step.ranges, direction);
  for_walls(step.ranges, [&](std::size_t i) { std::fill_n(direction + i * d, d, 0.0); });
}

// Where a force was not finite the residual is not either, and the guard of the step will name the particle.
void ViscositySolver::finish(const View<reads, writes>& p, const Step& step) {
  const double dt = step.global.dt;
  const auto d = static_cast<std::size_t>(p.dim());
  double* force = p.get<Field::force>();
  const double* mass = p.get<Field::mass>();
  const bool finite = std::isfinite(changes_.square());
  for_movers(step.ranges, [&](std::size_t i) {
    const Double3 body = (*body_forces_)(p, i, step);
    for (std::size_t a = 0; a < d; ++a) {
      const std::size_t k = i * d + a;
      force[k] = finite ? mass[i] * (changes_.change(k) / dt - body[a]) : changes_.residual(k);
    }
  });
}

struct FirstDirection {
  static constexpr FieldSet reads = ViscositySolver::reads;
  static constexpr FieldSet writes = ViscositySolver::writes;
  std::shared_ptr<ViscositySolver> solver;

  void operator()(const View<reads, writes>& p, const Step& step) const { solver->begin(p, step); }
};

}  // namespace

void add_implicit_viscosity(Builder& b) {
  const Scene& s = b.scene();
  b.add_fields({Field::direction});
  const auto solver = std::make_shared<ViscositySolver>(s, b.body_forces());
  b.add_update("first direction", FirstDirection{solver});
  const bool symmetric = s.terms.viscous.form == ViscosityForm::symmetric;
  const Term drag = symmetric ? term<SymmetricViscousOperator> : term<ViscousOperator>;
  b.add_loop({{b.sums_over_pairs("viscosity", {drag})}, solver, ViscositySolver::writes});
}

}  // namespace sph
