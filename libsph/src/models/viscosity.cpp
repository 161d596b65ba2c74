// The implicit viscous step: v(t + dt) = v(t) + dt a with the viscous forces of v(t + dt), so that they limit
// no time step. For the change c = v(t + dt) - v(t)
//   (m - dt L) c = dt (F + m g + L v(t)),
// L the viscous operator (terms/viscous_operator.hpp), m - dt L symmetric and positive definite: conjugate
// gradients, preconditioned by the diagonal, with the two dot products of an iteration in one reduction
// (Chronopoulos & Gear 1989). Dot products are exact sums of one term a particle, so the iterations are
// the same on any number of ranks. They start from c = 0 and stop when the residual, a spurious impulse, is
// less than `tolerance` of the larger one of the impulses of viscous and of all other forces: so far momentum
// is conserved.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "decomp/exact_sum.hpp"
#include "pairs/for_rows.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/viscous_operator.hpp"

namespace sph {
namespace {

constexpr int most_iterations = 2000;

/// By row and component.
struct KrylovVectors {
  std::vector<double> change;        ///< of the velocity
  std::vector<double> residual;      ///< of the equations
  std::vector<double> search;        ///< direction
  std::vector<double> image;         ///< the operator on the residual over the diagonal ...
  std::vector<double> search_image;  ///< ... and on the search direction
  void clear(std::size_t size) {
    for (std::vector<double>* v : {&change, &residual, &search, &image, &search_image}) v->assign(size, 0.0);
  }
};

class ViscositySolver final : public Solver {
 public:
  static constexpr FieldSet reads =
      BodyForces::reads | FieldSet{Field::velocity, Field::mass, Field::group, Field::viscous_sums};
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
  void finish(const View<reads, writes>&, const Step&) const;

  const Scene* scene_;
  const BodyForces* body_forces_;
  double tolerance_;
  int iteration_ = 0;
  double product_ = 0, length_ = 0, enough_ = 0;  ///< r.u, alpha and its bound, of the last iteration
  std::array<decomp::ExactSum, 4> sums_;          ///< r.u, w.u; driving and viscous impulses squared
  KrylovVectors vectors_;
  std::vector<double> diagonal_;  ///< by row
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
  sums_[0] = sums_[1] = {};
  for_movers(s.ranges, [&](std::size_t i) {
    double product = 0, curvature = 0;
    for (std::size_t a = 0; a < d; ++a) {
      const std::size_t k = i * d + a;
      vectors_.image[k] = mass[i] * direction[k] - dt * viscous[i * (d + 1) + a];
      product += vectors_.residual[k] * direction[k];
      curvature += vectors_.image[k] * direction[k];
    }
    sums_[0].add(product);
    sums_[1].add(curvature);
  });
  return std::span(sums_).first(iteration_ == 1 ? 4 : 2);
}

bool ViscositySolver::improve(StepState& s) {
  const View<reads, writes> p(s.particles);
  const auto d = static_cast<std::size_t>(p.dim());
  if (iteration_++ == 0) {
    set_out(p, s);
    return true;
  }
  const double product = sums_[0].value(), curvature = sums_[1].value();
  const bool first = iteration_ == 2;
  if (first) enough_ = tolerance_ * tolerance_ * std::fmax(sums_[2].value(), sums_[3].value());
  if (!(product > enough_)) {
    finish(p, s);
    return false;
  }
  const double old = first ? 0 : product / product_;
  const double along = first ? curvature : curvature - old * product / length_;
  if (iteration_ > most_iterations || !(along > 0))
    throw GuardError("step " + std::to_string(s.global.step) +
                     ": the implicit viscous step did not converge; reduce time.dt" +
                     (scene_->terms.precision == Precision::mixed
                          ? ", raise terms.viscosity_tolerance or set precision = \"double\""
                          : " or raise terms.viscosity_tolerance"));
  length_ = product / along;
  product_ = product;
  double* direction = p.get<Field::direction>();
  for_movers(s.ranges, [&](std::size_t i) {
    for (std::size_t k = i * d; k < (i + 1) * d; ++k) {
      vectors_.search[k] = direction[k] + old * vectors_.search[k];
      vectors_.search_image[k] = vectors_.image[k] + old * vectors_.search_image[k];
      vectors_.change[k] += length_ * vectors_.search[k];
      vectors_.residual[k] -= length_ * vectors_.search_image[k];
      direction[k] = vectors_.residual[k] / diagonal_[i];
    }
  });
  return true;
}

void ViscositySolver::set_out(const View<reads, writes>& p, const Step& step) {
  const double dt = step.global.dt;
  const auto d = static_cast<std::size_t>(p.dim());
  vectors_.clear(p.owned() * d);
  diagonal_.resize(p.owned());
  double* direction = p.get<Field::direction>();
  const double* viscous = p.get<Field::viscous_sums>();
  const double* force = p.get<Field::force>();
  const double* mass = p.get<Field::mass>();
  sums_[2] = sums_[3] = {};
  for_movers(step.ranges, [&](std::size_t i) {
    const Double3 body = (*body_forces_)(p, i);
    double driving = 0, dragging = 0;
    diagonal_[i] = mass[i] + dt * viscous[i * (d + 1) + d];
    for (std::size_t a = 0; a < d; ++a) {
      const std::size_t k = i * d + a;
      const double drive = dt * (force[k] + mass[i] * body[a]), drag = dt * viscous[i * (d + 1) + a];
      vectors_.residual[k] = drive + drag;
      direction[k] = vectors_.residual[k] / diagonal_[i];
      driving += drive * drive;
      dragging += drag * drag;
    }
    sums_[2].add(driving / diagonal_[i]);
    sums_[3].add(dragging / diagonal_[i]);
  });
  for_walls(step.ranges, [&](std::size_t i) { std::fill_n(direction + i * d, d, 0.0); });
}

// Where a force was not finite the residual is not either, and the guard of the step will name the particle.
void ViscositySolver::finish(const View<reads, writes>& p, const Step& step) const {
  const double dt = step.global.dt;
  const auto d = static_cast<std::size_t>(p.dim());
  double* force = p.get<Field::force>();
  const double* mass = p.get<Field::mass>();
  const bool finite = std::isfinite(sums_[0].value());
  for_movers(step.ranges, [&](std::size_t i) {
    const Double3 body = (*body_forces_)(p, i);
    for (std::size_t a = 0; a < d; ++a)
      force[i * d + a] =
          finite ? mass[i] * (vectors_.change[i * d + a] / dt - body[a]) : vectors_.residual[i * d + a];
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
