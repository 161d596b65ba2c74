#include "sph/pairs/wall_ways.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sph {
namespace {

constexpr std::size_t block_rows = 64;  ///< which are near each other

}  // namespace

struct WallWays::Grain {
  std::array<std::int64_t, 3> x, then;
  double radius;
};

// It was listed where the gap was less than the skin. Of another, what is missing in the gap now.
double WallWays::to_plane(std::size_t plane, const Grain& grain, const PlaneNow& now) const {
  const PlaneNow& then = then_.planes[plane];
  if (!then.present) return 0;
  const double gap_then = distance_from(then, grain.then.data(), quantum_) - grain.radius;
  if (gap_then < skin_ - rounding_) return 0;
  return skin_ - (distance_from(now, grain.x.data(), quantum_) - grain.radius);
}

// Facets are at rest in the frame of their mesh.
double WallWays::to_mesh(std::size_t mesh, const Grain& grain, const MeshNow& now) const {
  const MeshNow& then = then_.meshes[mesh];
  if (!then.listed) return 0;
  const Point3 a = then.in_frame(grain.then.data(), quantum_), b = now.in_frame(grain.x.data(), quantum_);
  const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
  return std::sqrt(x * x + y * y + z * z);
}

double WallWays::look(const Particles& grains, const WaysApart& ways, const WallsNow& now) const {
  if (now.planes.empty() && now.meshes.empty()) return 0;
  const RowPlaces x = grains.places();
  const double* radius = grains.data<Field::radius>();
  std::vector<std::uint32_t> planes;
  double most = 0;
  for (std::size_t first = 0; first < grains.owned(); first += block_rows) {
    const std::size_t last = std::min(first + block_rows, grains.owned());
    find_near(now.planes, {x, first, last}, *std::max_element(radius + first, radius + last) + skin_,
              quantum_, planes);
    if (planes.empty() && now.meshes.empty()) continue;
    for (std::size_t i = first; i < last; ++i) {
      Grain grain{{}, {}, radius[i]};
      for (std::size_t a = 0; a < 3; ++a) {
        grain.x[a] = x(i, a);
        grain.then[a] = grain.x[a] - ways.way(i, a, grain.x[a]);
      }
      for (const std::uint32_t w : planes) most = std::max(most, to_plane(w, grain, now.planes[w]));
      for (std::size_t m = 0; m < now.meshes.size(); ++m)
        most = std::max(most, to_mesh(m, grain, now.meshes[m]));
    }
  }
  return most + rounding_;
}

}  // namespace sph
