#include "start/hydrostatic.hpp"

#include <algorithm>
#include <cmath>

#include "sph/core/error.hpp"
#include "sph/laws/background.hpp"

namespace sph {

HydrostaticColumn::HydrostaticColumn(const Scene& scene)
    : pull_(scene.domain.gravity), scene_(&scene), step_(scene.start.spacing) {
  double square = 0;
  for (const double g : pull_) square += g * g;
  gravity_ = std::sqrt(square);
  Double3 corner{};
  for (std::size_t a = 0; a < 3; ++a)
    corner[a] = pull_[a] > 0 ? scene.domain.upper[a] : scene.domain.lower[a];
  const double lowest = height(corner);
  const std::vector<Layer>& layers = scene.start.layers;
  double pressure = layers.empty() ? 0 : layers.front().pressure;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Group& fluid = scene.groups[static_cast<std::size_t>(layers[k].group)];
    const double bottom = k + 1 < layers.size() ? layers[k + 1].top : lowest;
    Part part{&fluid, layers[k].top, pressure};
    if (fluid.eos.law->pressure_below == nullptr && !is_body(fluid)) {
      part.below.push_back(pressure + outer(part, 0));
      if (fluid.eos.law->needs_pressure && !(part.below.back() > 0))
        throw InputError(scene.file + ": start.pressure: the layer \"" + fluid.name +
                         "\" begins without pressure, where it is all gas; give domain.surface_pressure");
      const auto nodes = static_cast<std::size_t>(std::max(0.0, (layers[k].top - bottom) / step_));
      for (std::size_t n = 0; n < nodes; ++n)
        part.below.push_back(descend(*part.fluid, part.below.back(), step_));
    }
    parts_.push_back(std::move(part));
    pressure = at_depth(parts_.back(), layers[k].top - bottom);
  }
}

double HydrostaticColumn::height(const Double3& x) const {
  double h = 0;
  for (std::size_t a = 0; a < 3; ++a) h -= pull_[a] * x[a];
  return h / gravity_;
}

double HydrostaticColumn::operator()(const Double3& x) const {
  const double y = height(x);
  std::size_t k = 0;
  while (k + 1 < parts_.size() && y < parts_[k + 1].top) ++k;
  return at_depth(parts_[k], parts_[k].top - y);
}

double HydrostaticColumn::at_depth(const Part& part, double depth) const {
  const Group& fluid = *part.fluid;
  // A body is as dense as its group in its reference state, whatever presses on it there.
  if (is_body(fluid)) return part.pressure + fluid.density * pull_on(fluid) * depth;
  if (fluid.eos.law->pressure_below == nullptr) {
    const double nodes = static_cast<double>(part.below.size() - 1);
    const double node = std::clamp(std::floor(depth / step_), 0.0, nodes);
    double p = part.below[static_cast<std::size_t>(node)], rest = depth - node * step_;
    for (; rest > step_; rest -= step_) p = descend(*part.fluid, p, step_);  // below the domain
    return descend(*part.fluid, p, rest) - outer(part, depth);
  }
  return fluid.eos.law->pressure_below(fluid, {part.pressure, outer(part, 0), pull_on(fluid), depth});
}

double HydrostaticColumn::pull_on(const Group& fluid) const {
  if (fluid.eos.law->kind == EosKind::bubbly) return gravity_;  // whose pressure is all of it here
  return gravity_ * weight_share(*scene_, fluid, fluid.density);
}

double HydrostaticColumn::outer(const Part& part, double depth) const {
  Double3 x{};
  for (std::size_t a = 0; a < 3; ++a) x[a] = -pull_[a] / gravity_ * (part.top - depth);
  return outer_pressure(*scene_, *part.fluid, x);
}

// Eight steps of the classical Runge-Kutta method for a way of one spacing or less: 1e-10 of the pressure,
// unless it doubles within a spacing.
double HydrostaticColumn::descend(const Group& fluid, double p, double way) const {
  constexpr int steps = 8;
  const double dd = way / steps;
  const double pull = pull_on(fluid);
  const auto slope = [&](double pressure) { return fluid.eos.law->density(fluid, pressure) * pull; };
  for (int k = 0; k < steps; ++k) {
    const double k1 = slope(p), k2 = slope(p + 0.5 * dd * k1), k3 = slope(p + 0.5 * dd * k2),
                 k4 = slope(p + dd * k3);
    p += dd / 6 * (k1 + 2 * (k2 + k3) + k4);
  }
  return p;
}

}  // namespace sph
