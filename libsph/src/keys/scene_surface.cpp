// Is there a free surface? Shifting spares it; where there is none the volume of the fluid is known.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "keys/scene_resolve.hpp"
#include "scene/painting.hpp"

namespace sph {
namespace {

constexpr std::int64_t samples_2d = 512;
constexpr std::int64_t samples_3d = 64;

}  // namespace

bool has_free_surface(const Scene& scene) {
  const Start& start = scene.start;
  const LatticeFill& lattice = start.lattice;
  const Domain& domain = scene.domain;
  const auto axes = static_cast<std::size_t>(scene.dim);
  bool all_periodic = true;
  for (std::size_t a = 0; a < axes; ++a) all_periodic = all_periodic && domain.periodic[a];
  if (!start.file.empty()) return start.free_surface.value_or(!all_periodic);

  const std::int64_t most = scene.dim == 2 ? samples_2d : samples_3d;
  std::array<std::int64_t, 3> points{1, 1, 1}, samples{1, 1, 1};
  for (std::size_t a = 0; a < axes; ++a) {
    if (domain.periodic[a] && (lattice.lower[a] > domain.lower[a] || lattice.upper[a] < domain.upper[a]))
      return true;
    points[a] =
        std::max<std::int64_t>(1, std::llround((lattice.upper[a] - lattice.lower[a]) / start.spacing));
    samples[a] = std::min(points[a], most);
  }
  const auto index = [&](std::size_t a, std::int64_t k) {
    return samples[a] == 1 ? 0 : k * (points[a] - 1) / (samples[a] - 1);
  };
  std::array<std::int64_t, 3> k{};
  for (k[2] = 0; k[2] < samples[2]; ++k[2])
    for (k[1] = 0; k[1] < samples[1]; ++k[1])
      for (k[0] = 0; k[0] < samples[0]; ++k[0]) {
        Double3 x{};
        bool edge = false;
        for (std::size_t a = 0; a < axes; ++a) {
          x[a] = lattice.lower[a] + (static_cast<double>(index(a, k[a])) + 0.5) * start.spacing;
          edge = edge || (!domain.periodic[a] && (k[a] == 0 || k[a] == samples[a] - 1));
        }
        const int group = painted_group(scene, x);
        if (group < 0) return true;
        if (edge && scene.groups[static_cast<std::size_t>(group)].kind != GroupKind::wall) return true;
      }
  return false;
}

}  // namespace sph
