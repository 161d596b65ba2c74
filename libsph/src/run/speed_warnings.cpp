#include "run/speed_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sph/laws/eos/law.hpp"

namespace sph {
namespace {

double length(const Double3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

struct Speed {
  std::string key;
  double value = 0;
};

/// The largest speed that the scene says.
Speed fastest_at_start(const Scene& scene, double file_speed) {
  Speed fastest{"start.velocity", 0};
  const auto consider = [&](const std::string& key, double value) {
    if (value > fastest.value) fastest = {key, value};
  };
  if (!scene.start.file.empty()) consider("start.file", file_speed);
  if (scene.start.velocity.kind == InitialVelocity::uniform)
    consider("start.velocity", length(scene.start.velocity.uniform));
  if (scene.start.velocity.kind == InitialVelocity::taylor_green)
    consider("start.flow_speed", scene.start.velocity.flow_speed);
  for (const Group& g : scene.groups) consider("group." + g.name + ".velocity", length(g.wall.velocity));
  return fastest;
}

/// Of all fluids together: they stand on each other.
double fluid_height(const Scene& scene, const std::vector<Height>& heights) {
  Height all;
  for (std::size_t g = 0; g < heights.size(); ++g) {
    if (scene.groups[g].kind != GroupKind::fluid) continue;
    all.low = std::min(all.low, heights[g].low);
    all.high = std::max(all.high, heights[g].high);
  }
  return std::max(all.high - all.low, 0.0);
}

double fall_of(const Scene& scene, double height) {
  Double3 g = scene.domain.gravity;
  for (std::size_t a = 0; a < 3; ++a)
    if (scene.domain.periodic[a]) g[a] = 0;
  double weight = 0;  // that a background leaves
  for (const Group& matter : scene.groups)
    if (is_matter(matter))
      weight = std::max(weight, std::fabs(1 - scene.domain.background.density / matter.density));
  return std::sqrt(length(g) * weight * height);
}

}  // namespace

std::string speed_warnings(const Scene& scene, const std::vector<Height>& heights, double file_speed) {
  constexpr double stiff_enough = 10, rounding = 1e-3;
  if (has_eos(scene, EosKind::ideal_gas)) return {};
  const Speed start = fastest_at_start(scene, file_speed);
  double stiffest = 0;
  for (const Group& g : scene.groups) stiffest = std::max(stiffest, sound_at_rest(g));
  if (!(stiffest > 0)) return {};  // nothing here is taken for stiff
  if (start.value >= stiffest)
    return fmt::format(
        "warning: {}: {:.4g} m/s is Mach {:.4g} in the stiffest group, whose c is {:.4g} m/s: check the "
        "unit\n",
        start.key, start.value, start.value / stiffest, stiffest);
  std::string out;
  const double height = fluid_height(scene, heights), fall = fall_of(scene, height);
  const double least = stiff_enough * std::max(start.value, fall);
  for (const Group& g : scene.groups) {
    const double c = sound_at_rest(g);
    if (g.kind != GroupKind::fluid || g.eos.law->kind != EosKind::barotropic || c >= least * (1 - rounding))
      continue;
    out += fmt::format(
        "warning: group.{}: its sound speed of {:.4g} m/s is below {} times {}: set it to {:.4g} m/s or "
        "more\n",
        g.name, c, stiff_enough,
        fall >= start.value ? fmt::format("sqrt(g H) = {:.4g} m/s, H = {:.4g} m", fall, height)
                            : fmt::format("the {:.4g} m/s of {}", start.value, start.key),
        least);
  }
  return out;
}

}  // namespace sph
