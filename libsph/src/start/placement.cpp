#include "sph/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "start/initial_fields.hpp"
#include "start/placement_file.hpp"
#include "start/placement_tile.hpp"

namespace sph {
namespace {

/// Points of a lattice in index space. Square: cell centres. Hexagonal (2D): rows of alternating offset with
/// the same area per point as the square lattice of that spacing.
class Lattice {
 public:
  explicit Lattice(const Scene& scene) : start_(scene.start), dim_(static_cast<std::size_t>(scene.dim)) {
    step_.fill(scene.spacing);
    if (start_.lattice == LatticeKind::hexagonal) {
      if (scene.dim != 2) throw InputError("start.lattice: \"hexagonal\" exists in 2D only; use \"square\"");
      // a^2 sqrt(3)/2 = spacing^2
      step_[0] = scene.spacing * std::sqrt(2 / std::sqrt(3.0));
      step_[1] = step_[0] * (0.5 * std::sqrt(3.0));
    }
    for (std::size_t a = 0; a < dim_; ++a) {
      // A margin of one point: whether a point is inside is decided on its coordinate.
      first_[a] =
          static_cast<std::int64_t>(std::floor((start_.lower[a] - start_.lattice_origin[a]) / step_[a])) - 1;
      count_[a] =
          static_cast<std::int64_t>(std::ceil((start_.upper[a] - start_.lattice_origin[a]) / step_[a])) + 1 -
          first_[a];
    }
  }
  [[nodiscard]] std::int64_t first(std::size_t axis) const { return first_[axis]; }
  [[nodiscard]] std::int64_t count(std::size_t axis) const { return count_[axis]; }
  /// Lattice index just below a coordinate.
  [[nodiscard]] std::int64_t below(std::size_t axis, double x) const {
    return static_cast<std::int64_t>(std::floor((x - start_.lattice_origin[axis]) / step_[axis])) - 1;
  }
  [[nodiscard]] Double3 point(const decomp::Int3& k) const {
    Double3 x{};
    for (std::size_t a = 0; a < dim_; ++a)
      x[a] = start_.lattice_origin[a] + (static_cast<double>(k[a]) + 0.5) * step_[a];
    if (start_.lattice == LatticeKind::hexagonal && (k[1] & 1) != 0) x[0] += 0.5 * step_[0];
    return x;
  }
  [[nodiscard]] bool inside(const Double3& x) const {
    for (std::size_t a = 0; a < dim_; ++a)
      if (x[a] < start_.lower[a] || x[a] >= start_.upper[a]) return false;
    return true;
  }
  [[nodiscard]] std::uint64_t id(const decomp::Int3& k) const {
    std::uint64_t n = 0;
    for (std::size_t a = dim_; a-- > 0;)
      n = n * static_cast<std::uint64_t>(count_[a]) + static_cast<std::uint64_t>(k[a] - first_[a]);
    return n;
  }

 private:
  const Start& start_;
  std::size_t dim_;
  Double3 step_{};
  decomp::Int3 first_{}, count_{1, 1, 1};
};

bool contains(const Region& r, const Double3& x, std::size_t dim) {
  if (r.shape == RegionShape::everywhere) return true;
  double distance2 = 0;
  for (std::size_t a = 0; a < dim; ++a) {
    if (r.shape == RegionShape::box && (x[a] < r.lower[a] || x[a] >= r.upper[a])) return false;
    distance2 += (x[a] - r.centre[a]) * (x[a] - r.centre[a]);
  }
  return r.shape == RegionShape::box || distance2 < r.radius * r.radius;
}

/// The last region that contains the point; -1 leaves it empty.
int painted_group(const Scene& scene, const Double3& x) {
  for (auto r = scene.start.regions.rbegin(); r != scene.start.regions.rend(); ++r)
    if (contains(*r, x, static_cast<std::size_t>(scene.dim))) return r->group;
  return -1;
}

}  // namespace

void place_particles(const Scene& scene, const PositionScale& scale, Distribution& distribution,
                     Particles& particles) {
  if (!scene.start.file.empty()) {
    place_particles_from_file(scene, scale, distribution, particles);
    return;
  }
  if (!scene.start.tile.file.empty()) {
    place_tiles(scene, scale, distribution, particles);
    return;
  }
  const Lattice lattice(scene);
  const std::size_t d = static_cast<std::size_t>(scene.dim);
  const decomp::CellGrid& grid = distribution.grid();
  const decomp::Box own = distribution.own_cells();

  decomp::Int3 lo{}, hi{1, 1, 1};
  for (std::size_t a = 0; a < d; ++a) {
    const int axis = static_cast<int>(a);
    const std::int64_t margin = 2 + static_cast<std::int64_t>(std::ceil(scene.start.jitter));
    const bool first_part = own.lo[a] == 0, last_part = own.hi[a] == grid.cells()[a];
    lo[a] = lattice.first(a);
    hi[a] = lattice.first(a) + lattice.count(a);
    if (!first_part || grid.periodic()[a])
      lo[a] = std::max(lo[a], lattice.below(a, scale.metres(grid.line(axis, own.lo[a]))) - margin);
    if (!last_part || grid.periodic()[a])
      hi[a] = std::min(hi[a], lattice.below(a, scale.metres(grid.line(axis, own.hi[a]))) + margin + 2);
    // A jittered particle may cross a periodic face.
    if (grid.periodic()[a] && scene.start.jitter > 0 && (first_part || last_part)) {
      lo[a] = lattice.first(a);
      hi[a] = lattice.first(a) + lattice.count(a);
    }
  }
  decomp::Int3 k{};
  for (k[2] = lo[2]; k[2] < hi[2]; ++k[2])
    for (k[1] = lo[1]; k[1] < hi[1]; ++k[1])
      for (k[0] = lo[0]; k[0] < hi[0]; ++k[0]) {
        const Double3 x = lattice.point(k);
        if (!lattice.inside(x)) continue;
        const int group = painted_group(scene, x);
        if (group < 0) continue;
        NewParticle p{lattice.id(k), x, {}, static_cast<std::uint32_t>(group), 0, 0};
        const Group& g = scene.groups[p.group];
        if (g.kind != GroupKind::wall && !g.grain.fixed) displace_by_jitter(scene, p);
        decomp::Int3 q{};
        for (std::size_t a = 0; a < d; ++a) q[a] = scale.quanta(p.position[a]);
        q = grid.wrap(q);
        if (!own.contains(grid.cell_of(q))) continue;
        if (g.kind == GroupKind::grain) p.radius = random_radius(scene, p);
        set_initial_fields(scene, p);
        append(scene, p, q, particles);
      }
}

}  // namespace sph
