#include "sph/models/body_forces.hpp"

#include <algorithm>
#include <cmath>

namespace sph {

BodyForces::BodyForces(const SphConstants& constants)
    : constants_(&constants),
      surface_(constants.scene->kernel.shape, constants.scene->dim),
      expands_(std::ranges::any_of(constants.scene->groups,
                                   [](const Group& g) { return g.heat.material.expansion > 0; })) {}

std::optional<Double3> BodyForces::common(const Particles& p, const Step& step) const {
  const Scene& scene = *constants_->scene;
  const bool weighed = expands_ || scene.domain.background.density > 0,
             pulled = scene.domain.central_pull != 0;
  const bool controlled = scene.terms.shifting && scene.open();
  if (weighed || pulled || controlled || step.given != nullptr || p.get<Field::grain_pull>() != nullptr)
    return std::nullopt;
  return scene.domain.gravity;
}

Double3 BodyForces::operator()(const Particles& p, std::size_t i, const Step& step) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const Scene& scene = *constants_->scene;
  const std::int64_t* x = p.get<Field::position>();
  const double pull = scene.domain.central_pull, control = tension_control(p, i);
  const double* grains = p.get<Field::grain_pull>();
  Double3 acceleration = scene.domain.gravity;
  if (expands_ || scene.domain.background.density > 0) {
    const std::uint32_t group = p.get<Field::group>()[i];
    const GroupTable::Weight& of = constants_->groups.weight;
    double weight = of.share[group] - of.borne[group] / p.get<Field::density>()[i];
    if (expands_) {
      const HeatMaterial& m = scene.groups[group].heat.material;
      weight -= m.expansion * (p.get<Field::temperature>()[i] - m.reference_temperature);
    }
    for (double& g : acceleration) g *= weight;
  }
  for (std::size_t a = 0; a < d; ++a) {
    if (step.given != nullptr) acceleration[a] += step.given[i * d + a];
    if (grains != nullptr) acceleration[a] += grains[i * d + a];
    if (pull != 0)
      acceleration[a] -= pull * (constants_->scale.metres(x[i * d + a]) - scene.domain.pull_centre[a]);
    if (control != 0) acceleration[a] += control * p.get<Field::spread>()[i * (d + 2) + a];
  }
  return acceleration;
}

// 1 - |grad C| / |S| with the gradient that belongs to the particle's C. Negative where S is too small for
// that: were such particles not drawn back inwards, those with too large an S would take the surface outwards
// with them. Inside C is 1 +- 0.01 and all of S is disorder, hence the margin; spray is left alone.
double BodyForces::disordered_share(const Particles& p, std::size_t i) const {
  constexpr double inside = 0.985, margin = 0.007, spray = 0.6;
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double h = constants_->scene->kernel.smoothing_length;
  const double* spread = p.get<Field::spread>() + i * (d + 2);
  const double volume =
      p.get<Field::mass>()[i] / p.get<Field::density>()[i] * constants_->row_scale.inverse_volume;
  const double concentration = h * spread[d] + volume * constants_->own_concentration;
  double square = 0;
  for (std::size_t a = 0; a < d; ++a) square += spread[a] * spread[a];
  if (square == 0 || concentration < spray) return 0;
  const double length = h * std::sqrt(square);
  return concentration < inside ? std::fmax(-1.0, 1 - surface_(concentration) / length)
                                : std::fmax(0.0, 1 - surface_(concentration + margin) / length);
}

// Under tension particles draw together and leave voids. In the form -(p_j - p_i) instead of -(p_j + p_i) the
// force of a constant pressure on disordered particles pushes them apart (Sun et al. 2018, tensile
// instability control): the difference to the pair force is 2 p_i V_i S_i. Not antisymmetric, so only where a
// free surface leaves no other way, and of fluids alone: bodies have bonds, and would gain momentum.
double BodyForces::tension_control(const Particles& p, std::size_t i) const {
  const Scene& scene = *constants_->scene;
  if (!scene.terms.shifting || !scene.open() || is_body(scene.groups[p.get<Field::group>()[i]])) return 0;
  const double pressure = p.get<Field::pressure>()[i];
  if (pressure >= 0) return 0;
  return 2 * pressure / p.get<Field::density>()[i] * std::fmax(0.0, disordered_share(p, i));
}

}  // namespace sph
