#include "output/flux.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "sph/models/energies.hpp"

namespace sph {

Flux::Flux(const Simulation& s, const Monitor& monitor)
    : scene_(&s.scene()),
      wrap_(s.wrap()),
      quantum_(s.scale().quantum),
      d_(static_cast<std::size_t>(s.scene().dim)),
      normal_(normal_of(*monitor.lower, *monitor.upper, s.scene().dim)) {
  for (std::size_t a = 0; a < d_; ++a) {
    lower_[a] = s.scale().quanta(std::min((*monitor.lower)[a], (*monitor.upper)[a]));
    upper_[a] = s.scale().quanta(std::max((*monitor.lower)[a], (*monitor.upper)[a]));
  }
  place_ = (*monitor.lower)[normal_];
  find_clear_way(*monitor.lower, *monitor.upper);
}

void Flux::keep_from(double place) {
  const double way = std::fabs(place - place_),
               period = static_cast<double>(wrap_.period[normal_]) * quantum_;
  clear_ = std::min({clear_, way, period > 0 ? std::fabs(period - way) : way});
}

// What is led through a box comes or goes at one end of it, anything else anywhere in its box.
void Flux::find_clear_way(const Double3& one, const Double3& other) {
  const OpeningControl& openings = scene_->domain.openings;
  const auto beside = [&](const Double3& lower, const Double3& upper) {
    for (std::size_t a = 0; a < d_; ++a)
      if (a != normal_ && (std::min(one[a], other[a]) >= upper[a] || std::max(one[a], other[a]) < lower[a]))
        return false;
    return true;
  };
  const auto keep_from_box = [&](const Double3& lower, const Double3& upper) {
    if (lower[normal_] <= place_ && place_ < upper[normal_]) keep_from(place_);
    keep_from(lower[normal_]);
    keep_from(upper[normal_]);
  };
  for (const std::size_t side : {0, 1})
    if (openings.deletes[2 * normal_ + side])
      keep_from((side == 0 ? scene_->domain.lower : scene_->domain.upper)[normal_]);
  for (const Inlet& in : openings.inlets) {
    if (!beside(in.lower, in.upper)) continue;
    if (axis_of(in.direction) == normal_)
      keep_from((is_up(in.direction) ? in.lower : in.upper)[normal_]);
    else
      keep_from_box(in.lower, in.upper);
  }
  for (const Outlet& out : openings.outlets) {
    if (!beside(out.lower, out.upper)) continue;
    if (!out.pressure.empty() && axis_of(out.direction) == normal_)
      keep_from((is_up(out.direction) ? out.upper : out.lower)[normal_]);
    else
      keep_from_box(out.lower, out.upper);
  }
  for (const Insertion& in : openings.insertions)
    if (beside(in.lower, in.upper)) keep_from_box(in.lower, in.upper);
}

double Flux::weight(const ParticleValues& of, std::size_t row) const {
  const Particles& p = of.particles();
  for (std::size_t a = 0; a < d_; ++a) {
    const std::int64_t x = of.quanta(row, a);
    if (a != normal_ && (x < lower_[a] || x >= upper_[a])) return 0;
  }
  const double* widths = p.data<Field::smoothing_length>();
  const bool grain = scene_->groups[of.group(row)].kind == GroupKind::grain;
  const double size = grain               ? 2 * p.data<Field::radius>()[row]
                      : widths != nullptr ? widths[row]
                                          : scene_->kernel.smoothing_length;
  std::int64_t way = std::abs(of.quanta(row, normal_) - lower_[normal_]);
  const std::int64_t period = wrap_.period[normal_];
  if (period > 0) way = std::min(way, period - way);
  double reach = std::max(std::min(2 * size, clear_), 0.5 * size);
  // Within a period each particle counts once.
  if (period > 0) reach = std::min(reach, 0.5 * static_cast<double>(period) * quantum_);
  const double r = static_cast<double>(way) * quantum_ / reach;
  constexpr double peak = 15.0 / 16;  // the integral over -1..1 is 1
  return r < 1 ? peak / reach * (1 - r * r) * (1 - r * r) : 0;
}

void Flux::add(const ParticleValues& of, std::size_t row, std::span<decomp::ExactSum> to) const {
  const Group& group = scene_->groups[of.group(row)];
  if (is_held(group) || group.kind == GroupKind::melt) return;
  const double w = weight(of, row);
  if (w == 0) return;
  const Particles& p = of.particles();
  double volume = 0;
  if (group.kind == GroupKind::grain) {
    const double r = p.data<Field::radius>()[row];
    volume = 4 * std::numbers::pi / 3 * r * r * r;
  } else {
    volume = of.mass(row) / p.data<Field::density>()[row];
  }
  const double passing = w * of.velocity(row, normal_);
  to[0].add(of.mass(row) * passing);
  to[1].add(volume * passing);
}

}  // namespace sph
