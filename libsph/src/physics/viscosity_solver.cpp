#include "physics/viscosity_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "physics/for_rows.hpp"

namespace sph {
namespace {

constexpr int most_iterations = 2000;

}  // namespace

void ViscositySolver::begin(Particles& p, const RowRanges& ranges) {
  const auto d = static_cast<std::size_t>(p.dim());
  double* direction = p.data<Field::direction>();
  const double* v = p.data<Field::velocity>();
  const auto* group = p.data<Field::group>();
  for_movers(ranges, [&](std::size_t i) { std::copy_n(v + i * d, d, direction + i * d); });
  for_walls(ranges, [&](std::size_t i) {
    std::copy_n(physics_->wall_velocity(group[i]).begin(), d, direction + i * d);
  });
  iteration_ = 0;
}

std::span<decomp::ExactSum> ViscositySolver::products(const StepState& s) {
  if (iteration_ == 0) return {};
  const Particles& p = s.particles;
  const double dt = s.global.dt;
  const auto d = static_cast<std::size_t>(p.dim());
  const double* direction = p.data<Field::direction>();
  const double* viscous = p.data<Field::viscous_sums>();
  const double* mass = p.data<Field::mass>();
  sums_[0] = sums_[1] = {};
  for_movers(s.ranges, [&](std::size_t i) {
    double product = 0, curvature = 0;
    for (std::size_t a = 0; a < d; ++a) {
      const std::size_t k = i * d + a;
      image_[k] = mass[i] * direction[k] - dt * viscous[i * (d + 1) + a];
      product += residual_[k] * direction[k];
      curvature += image_[k] * direction[k];
    }
    sums_[0].add(product);
    sums_[1].add(curvature);
  });
  return std::span(sums_).first(iteration_ == 1 ? 4 : 2);
}

bool ViscositySolver::improve(StepState& s) {
  Particles& p = s.particles;
  const RowRanges& ranges = s.ranges;
  const GlobalState& global = s.global;
  const auto d = static_cast<std::size_t>(p.dim());
  if (iteration_++ == 0) {
    set_out(p, ranges, global.dt);
    return true;
  }
  const double product = sums_[0].value(), curvature = sums_[1].value();
  const bool first = iteration_ == 2;
  if (first) enough_ = tolerance_ * tolerance_ * std::fmax(sums_[2].value(), sums_[3].value());
  if (!(product > enough_)) {
    finish(p, ranges, global.dt);
    return false;
  }
  const double old = first ? 0 : product / product_;
  const double along = first ? curvature : curvature - old * product / length_;
  if (iteration_ > most_iterations || !(along > 0))
    throw GuardError("step " + std::to_string(global.step) +
                     ": the implicit viscous step did not converge; reduce time.dt, raise "
                     "terms.viscosity_tolerance or set precision = \"double\"");
  length_ = product / along;
  product_ = product;
  double* direction = p.data<Field::direction>();
  for_movers(ranges, [&](std::size_t i) {
    for (std::size_t k = i * d; k < (i + 1) * d; ++k) {
      search_[k] = direction[k] + old * search_[k];
      search_image_[k] = image_[k] + old * search_image_[k];
      change_[k] += length_ * search_[k];
      residual_[k] -= length_ * search_image_[k];
      direction[k] = residual_[k] / diagonal_[i];
    }
  });
  return true;
}

void ViscositySolver::set_out(Particles& p, const RowRanges& ranges, double dt) {
  const auto d = static_cast<std::size_t>(p.dim());
  for (std::vector<double>* v : {&change_, &residual_, &search_, &image_, &search_image_})
    v->assign(p.owned() * d, 0.0);
  diagonal_.resize(p.owned());
  double* direction = p.data<Field::direction>();
  const double* viscous = p.data<Field::viscous_sums>();
  const double* force = p.data<Field::force>();
  const double* mass = p.data<Field::mass>();
  sums_[2] = sums_[3] = {};
  for_movers(ranges, [&](std::size_t i) {
    const Double3 body = physics_->body_acceleration(p, i);
    double driving = 0, dragging = 0;
    diagonal_[i] = mass[i] + dt * viscous[i * (d + 1) + d];
    for (std::size_t a = 0; a < d; ++a) {
      const std::size_t k = i * d + a;
      const double drive = dt * (force[k] + mass[i] * body[a]), drag = dt * viscous[i * (d + 1) + a];
      residual_[k] = drive + drag;
      direction[k] = residual_[k] / diagonal_[i];
      driving += drive * drive;
      dragging += drag * drag;
    }
    sums_[2].add(driving / diagonal_[i]);
    sums_[3].add(dragging / diagonal_[i]);
  });
  for_walls(ranges, [&](std::size_t i) { std::fill_n(direction + i * d, d, 0.0); });
}

// Where a force was not finite the residual is not either, and the guard of the step will name the particle.
void ViscositySolver::finish(Particles& p, const RowRanges& ranges, double dt) const {
  const auto d = static_cast<std::size_t>(p.dim());
  double* force = p.data<Field::force>();
  const double* mass = p.data<Field::mass>();
  const bool finite = std::isfinite(sums_[0].value());
  for_movers(ranges, [&](std::size_t i) {
    const Double3 body = physics_->body_acceleration(p, i);
    for (std::size_t a = 0; a < d; ++a)
      force[i * d + a] = finite ? mass[i] * (change_[i * d + a] / dt - body[a]) : residual_[i * d + a];
  });
}

void Physics::build_implicit_viscosity(bool walls) {
  if (walls) fields_ |= FieldSet{Field::wall_slope};
  const auto solver = std::make_shared<ViscositySolver>(*this, scene_->terms.viscosity_tolerance);
  add_update("first direction", {Field::wall_slope, Field::direction},
             [this, walls, solver](Particles& p, const RowRanges& ranges, const GlobalState&) {
               if (walls) find_walls(p, ranges);
               solver->begin(p, ranges);
             });
  const bool symmetric = scene_->terms.viscosity == ViscosityForm::symmetric;
  const Term drag = symmetric ? Term::symmetric_viscous_operator : Term::viscous_operator;
  plan_.sums.push_back(
      {{sums_over_pairs("viscosity", {drag}, Rows::movers)}, solver, {Field::direction, Field::force}});
  fields_ |= FieldSet{Field::direction};
}

}  // namespace sph
