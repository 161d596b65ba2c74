#include "sph/scene/time_curve.hpp"

#include <algorithm>
#include <cmath>

namespace sph {

double value_at(const TimeCurve& curve, double time) {
  std::size_t k = 0;
  while (k < curve.size() && curve[k][0] <= time) ++k;
  if (k == 0) return curve.front()[1];
  if (k == curve.size()) return curve.back()[1];
  const auto& [t0, a] = curve[k - 1];
  const auto& [t1, b] = curve[k];
  return a + (b - a) * ((time - t0) / (t1 - t0));
}

double integral_of(const TimeCurve& curve, double time) {
  double sum = 0, from = 0;
  const auto add = [&](double to) {
    sum += 0.5 * (value_at(curve, from) + value_at(curve, to)) * (to - from);
    from = to;
  };
  for (const auto& [t, value] : curve)
    if (t > from && t < time) add(t);
  add(time);
  return sum;
}

double peak_between(const TimeCurve& curve, double from, double to) {
  if (curve.empty()) return 0;
  double peak = std::max(std::fabs(value_at(curve, from)), std::fabs(value_at(curve, to)));
  for (const auto& [t, value] : curve)
    if (t > from && t < to) peak = std::max(peak, std::fabs(value));
  return peak;
}

}  // namespace sph
