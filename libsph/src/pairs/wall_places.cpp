#include "sph/pairs/wall_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace sph {

std::string text_of_partner(const Scene& scene, std::uint64_t key) {
  if ((key & wall_key) == 0) return fmt::format("grain {}", key);
  const WallName name(key);
  if (!name.is_facet()) return fmt::format("wall \"{}\"", scene.grains.walls[name.wall].name);
  return fmt::format("facet {} of mesh \"{}\"", name.facet + 1, scene.grains.meshes[name.wall].name);
}

double distance_from(const PlaneNow& plane, const std::int64_t* x, double quantum) {
  double d = 0;
  for (std::size_t a = 0; a < 3; ++a) d += static_cast<double>(x[a] - plane.point[a]) * plane.normal[a];
  return d * quantum;
}

PlaceBox::PlaceBox(const RowPlaces& x, std::size_t first, std::size_t last) {
  lower.fill(std::numeric_limits<std::int64_t>::max());
  upper.fill(std::numeric_limits<std::int64_t>::min());
  for (std::size_t i = first; i < last; ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], x(i, a));
      upper[a] = std::max(upper[a], x(i, a));
    }
}

// At the corner that is nearest: what distance_from() computes is monotonic in each coordinate.
void find_near(std::span<const PlaneNow> planes, const PlaceBox& box, double reach, double quantum,
               std::vector<std::uint32_t>& out) {
  out.clear();
  for (std::uint32_t w = 0; w < planes.size(); ++w) {
    std::array<std::int64_t, 3> corner;
    for (std::size_t a = 0; a < 3; ++a) corner[a] = planes[w].normal[a] > 0 ? box.lower[a] : box.upper[a];
    if (planes[w].present && distance_from(planes[w], corner.data(), quantum) < reach) out.push_back(w);
  }
}

Point3 MeshNow::in_frame(const std::int64_t* x, double quantum) const {
  Point3 from, out{};
  for (std::size_t a = 0; a < 3; ++a) from[a] = static_cast<double>(x[a] - centre[a]) * quantum - way[a];
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) out[a] += rotation[b][a] * from[b];
  return out;
}

Point3 MeshNow::turned(const Point3& x) const {
  Point3 out{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) out[a] += rotation[a][b] * x[b];
  return out;
}

WallNumbers::WallNumbers(std::size_t planes, std::span<const MeshNow> meshes)
    : planes_(static_cast<std::uint32_t>(planes)), end_(planes_) {
  for (const MeshNow& mesh : meshes) {
    first_.push_back(end_);
    end_ += static_cast<std::uint32_t>(mesh.surface->size());
  }
}

WallNumbers::Facet WallNumbers::facet(std::uint32_t number) const {
  const auto after = std::ranges::upper_bound(first_, number);
  return {static_cast<std::size_t>(after - first_.begin()) - 1, number - *std::prev(after)};
}

std::uint64_t WallNumbers::key(std::uint32_t number) const {
  if (!is_facet(number)) return wall_key | number;
  const Facet f = facet(number);
  return wall_key | (std::uint64_t{f.mesh} + 1) << 32 | f.facet;
}

}  // namespace sph
