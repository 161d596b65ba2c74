#include "sph/scene/positions.hpp"

#include <algorithm>
#include <cmath>

namespace sph {

PositionScale position_scale(const Scene& scene) {
  double extent = 0;
  for (int a = 0; a < scene.dim; ++a)
    extent = std::max({extent, std::abs(scene.domain.lower[static_cast<std::size_t>(a)]),
                       std::abs(scene.domain.upper[static_cast<std::size_t>(a)])});
  PositionScale scale;
  // The next power of two above both bounds. A bond of a body that turns upside down is displaced by its
  // length then and now.
  const double longest = scene.total_lagrangian() ? scene.support() + scene.list_range() : scene.list_range();
  scale.quantum = std::ldexp(1.0, std::max(std::ilogb(extent) + 1 - 60, std::ilogb(longest) + 1 - 50));
  for (std::size_t a = 0; a < 3; ++a) scale.origin[a] = scale.quanta(scene.domain.lower[a]);
  return scale;
}

// 2^29 units across the support, so that its square and the skin stay within 31 bits.
int row_position_shift(const Scene& scene, const PositionScale& scale) {
  const double longest = scene.total_lagrangian() ? scene.support() : scene.list_range();
  return std::max(std::ilogb(longest / scale.quantum) + 1 - 29, 0);
}

std::array<std::int64_t, 3> domain_length(const Scene& scene, const PositionScale& scale) {
  std::array<std::int64_t, 3> length{};
  // Whole units of the rows along a period, or a pair in single precision would depend on whose image was
  // taken.
  const int bits = scene.terms.precision == Precision::mixed ? row_position_shift(scene, scale) : 0;
  for (std::size_t a = 0; a < 3; ++a) {
    length[a] = scale.quanta(scene.domain.upper[a]) - scale.origin[a];
    if (scene.domain.periodic[a]) length[a] = (length[a] >> bits) << bits;
  }
  return length;
}

Wrap wrap_of(const Scene& scene, const PositionScale& scale) {
  Wrap wrap{scale.origin, {}};
  const std::array<std::int64_t, 3> length = domain_length(scene, scale);
  for (std::size_t a = 0; a < 3; ++a)
    if (scene.domain.periodic[a]) wrap.period[a] = length[a];
  return wrap;
}

bool is_deleted(const Scene& scene, const PositionScale& scale, const Group& group,
                const std::int64_t* position) {
  if (group.kind == GroupKind::grain ? group.grain.fixed : !is_matter(group) || is_body(group)) return false;
  bool outside = false;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    if (scene.domain.periodic[a]) continue;
    const bool below = position[a] < scale.origin[a];
    if (!below && position[a] < scale.quanta(scene.domain.upper[a])) continue;
    if (!scene.domain.openings.deletes[2 * a + (below ? 0 : 1)]) return false;
    outside = true;
  }
  return outside;
}

}  // namespace sph
