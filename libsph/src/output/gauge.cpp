#include "output/gauge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sph/scene/with_kernel.hpp"

namespace sph {
namespace {

/// Points of a level: from `at` against gravity as far as the domain goes.
std::vector<Double3> points_above(const Scene& scene, const Double3& at, double apart) {
  const Double3& g = scene.domain.gravity;
  const double size = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  double way = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    const double up = -g[a] / size;
    if (up != 0) way = std::min(way, ((up > 0 ? scene.domain.upper : scene.domain.lower)[a] - at[a]) / up);
  }
  std::vector<Double3> out;
  for (double s = 0; s <= way; s = apart * static_cast<double>(out.size())) {
    Double3 x = at;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) x[a] -= g[a] / size * s;
    out.push_back(x);
  }
  return out;
}

std::vector<Double3> points_between(const Monitor& monitor) {
  if (!monitor.to) return {*monitor.at};
  constexpr std::uint64_t usual = 11;
  const std::uint64_t n = monitor.points.value_or(usual);
  std::vector<Double3> out;
  for (std::uint64_t k = 0; k < n; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(n - 1);
    Double3 x{};
    for (std::size_t a = 0; a < 3; ++a) x[a] = (*monitor.at)[a] + s * ((*monitor.to)[a] - (*monitor.at)[a]);
    out.push_back(x);
  }
  return out;
}

}  // namespace

Gauge::Gauge(const Simulation& s, const Monitor& monitor)
    : scene_(&s.scene()),
      wrap_(s.wrap()),
      quantum_(s.scale().quantum),
      is_level_(monitor.kind == MonitorKind::level),
      d_(static_cast<std::size_t>(s.scene().dim)),
      normalisation_(kernel_normalisation(scene_->kernel.shape, scene_->dim)) {
  if (is_level_) apart_ = scene_->start.spacing / 2;
  for (const Double3& x : is_level_ ? points_above(*scene_, *monitor.at, apart_) : points_between(monitor)) {
    std::array<std::int64_t, 3> point{};
    for (std::size_t a = 0; a < d_; ++a) point[a] = wrap_(static_cast<int>(a), s.scale().quanta(x[a]));
    points_.push_back(point);
  }
  if (!is_level_) quantities_ = ParticleValues::count(s.particles()) - d_;
  sums_of_point_ = is_level_ ? 2 : 1 + d_ + d_ * (d_ + 1) / 2 + quantities_ * (1 + d_);
}

std::vector<std::string> Gauge::names(const Simulation& s, const Monitor& monitor) {
  if (monitor.kind == MonitorKind::level) return {"h"};
  std::vector<std::string> own = ParticleValues::names(s.particles()), out;
  own.erase(own.begin(), own.begin() + s.scene().dim);
  own.emplace_back("cover");
  const std::size_t points = points_between(monitor).size();
  for (std::size_t k = 1; k <= points; ++k)
    for (const std::string& name : own) out.push_back(points > 1 ? std::to_string(k) + "_" + name : name);
  return out;
}

void Gauge::add(const ParticleValues& of, std::size_t row, std::span<decomp::ExactSum> sums) const {
  const GroupKind kind = scene_->groups[of.group(row)].kind;
  const bool stands = kind == GroupKind::wall || kind == GroupKind::solid;
  if (kind != GroupKind::fluid && !(is_level_ && stands)) return;
  for (std::size_t k = 0; k < points_.size(); ++k)
    add_at(of, row, k, sums.subspan(k * sums_of_point_, sums_of_point_));
}

void Gauge::add_at(const ParticleValues& of, std::size_t row, std::size_t point,
                   std::span<decomp::ExactSum> sums) const {
  const Particles& p = of.particles();
  const double* widths = p.data<Field::smoothing_length>();
  const double h = widths != nullptr ? widths[row] : scene_->kernel.smoothing_length;
  std::array<double, 3> x{};
  double square = 0;
  for (std::size_t a = 0; a < d_; ++a) {
    std::int64_t r = of.quanta(row, a) - points_[point][a];
    const std::int64_t period = wrap_.period[a];
    if (period > 0 && 2 * r > period) r -= period;
    if (period > 0 && 2 * r < -period) r += period;
    x[a] = static_cast<double>(r) * quantum_ / h;
    square += x[a] * x[a];
  }
  const double q = std::sqrt(square);
  const double kernel = kernel_value(scene_->kernel.shape, scene_->dim, q);
  if (kernel == 0) return;
  const double volume = of.mass(row) / p.data<Field::density>()[row];
  const double w = volume * normalisation_ * kernel / (d_ == 2 ? h * h : h * h * h);
  if (is_level_) return sums[scene_->groups[of.group(row)].kind == GroupKind::fluid ? 0 : 1].add(w);
  std::size_t k = 0;
  sums[k++].add(w);
  // Lengths over the scene's h.
  const double scale = h / scene_->kernel.smoothing_length;
  for (std::size_t a = 0; a < d_; ++a) x[a] *= scale;
  for (std::size_t a = 0; a < d_; ++a) sums[k++].add(w * x[a]);
  for (std::size_t a = 0; a < d_; ++a)
    for (std::size_t b = a; b < d_; ++b) sums[k++].add(w * x[a] * x[b]);
  std::array<double, 16> values{};
  of.all(row, values);
  for (std::size_t n = 0; n < quantities_; ++n) {
    const double wq = w * values[d_ + n];
    sums[k++].add(wq);
    for (std::size_t a = 0; a < d_; ++a) sums[k++].add(wq * x[a]);
  }
}

void Gauge::append(std::span<const double> sums, std::vector<double>& to) const {
  if (is_level_) {
    to.push_back(level(sums));
    return;
  }
  for (std::size_t k = 0; k < points_.size(); ++k)
    append_point(sums.subspan(k * sums_of_point_, sums_of_point_), to);
}

// Means and covariances: what is fitted is mean(q) - slope.mean(x), slope C = cov(q, x).
void Gauge::append_point(std::span<const double> sums, std::vector<double>& to) const {
  constexpr double least_spread = 0.02, least_shape = 0.05;
  const double cover = sums[0];
  const auto d = static_cast<Eigen::Index>(d_);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> mean(d);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> c(d, d);
  std::size_t k = 1;
  for (Eigen::Index a = 0; a < d; ++a) mean[a] = sums[k++] / cover;
  for (Eigen::Index a = 0; a < d; ++a)
    for (Eigen::Index b = a; b < d; ++b) c(a, b) = c(b, a) = sums[k++] / cover - mean[a] * mean[b];
  const double spread = c.trace() / static_cast<double>(d);
  const bool slopes = cover > least_cover && spread > least_spread &&
                      c.determinant() > least_shape * (d == 2 ? spread * spread : spread * spread * spread);
  // Where the fluid ends before the point, a slope goes no further than what it was taken from.
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights =
      Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>::Zero(d);
  if (slopes) weights = c.inverse() * mean;
  for (std::size_t n = 0; n < quantities_; ++n) {
    const double q = sums[k++] / cover;
    double value = q;
    for (Eigen::Index a = 0; a < d; ++a) value -= weights[a] * (sums[k++] / cover - q * mean[a]);
    to.push_back(cover > least_cover ? value : std::numeric_limits<double>::quiet_NaN());
  }
  to.push_back(cover);
}

// What stands beside all of the line, but near the end of the domain, says nothing; on a plane it is 1/2 and what particles leave
// of that. Where it is more, the line ends in something.
double Gauge::level(std::span<const double> covers) const {
  constexpr double rough = 0.1, most = 0.9;
  double beside = 1;
  const auto of_end = static_cast<std::size_t>(std::ceil(scene_->support() / apart_));
  const std::size_t seen = points_.size() > of_end ? points_.size() - of_end : points_.size();
  for (std::size_t k = 0; k < seen; ++k) beside = std::min(beside, covers[2 * k + 1]);
  if (beside > most) return std::numeric_limits<double>::quiet_NaN();
  beside = std::max(beside, 0.5);
  const auto excess = [&](std::size_t point) {
    const double fluid = covers[2 * point], stands = covers[2 * point + 1];
    return std::min(fluid - 0.5 * (1 - stands), beside + rough - stands);
  };
  for (std::size_t k = points_.size(); k-- > 0;) {
    const double here = excess(k);
    if (here < 0) continue;
    const double beyond = k + 1 < points_.size() ? here / (here - excess(k + 1)) : 0.0;
    return apart_ * (static_cast<double>(k) + beyond);
  }
  return 0;
}

}  // namespace sph
