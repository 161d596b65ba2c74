// Is there a free surface? Shifting spares it; where there is none the volume of the fluid is known.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "keys/scene_resolve.hpp"
#include "scene/lattice_rows.hpp"
#include "scene/painting.hpp"

namespace sph {
namespace {

bool is_empty(const RowPart& part) { return part.group < 0; }

/// A lattice that was found to be full, and its outermost points where nothing repeats.
class Edges {
 public:
  Edges(const Scene& scene, const Lattice& lattice)
      : scene_(scene), lattice_(lattice), whole_(scene, lattice) {}

  [[nodiscard]] bool bare(std::int64_t y, std::int64_t z, const RowPart& row) {
    if (ends(1, {0, y - 1, z}) || ends(1, {0, y + 1, z}) || ends(2, {0, y, z - 1}) || ends(2, {0, y, z + 1}))
      return std::ranges::any_of(whole_.parts(y, z),
                                 [&](const RowPart& part) { return !is_wall(part.group); });
    if (scene_.domain.periodic[0]) return false;
    return !is_wall(painted_group(scene_, lattice_.point({row.first, y, z}))) ||
           !is_wall(painted_group(scene_, lattice_.point({row.end - 1, y, z})));
  }

 private:
  /// Whether there is no row any more, next to one along an axis.
  [[nodiscard]] bool ends(std::size_t axis, const decomp::Int3& row) const {
    if (axis >= static_cast<std::size_t>(scene_.dim) || scene_.domain.periodic[axis]) return false;
    const RowPart beside = filled_part(scene_, lattice_, row[1], row[2]);
    return beside.first >= beside.end;
  }
  [[nodiscard]] bool is_wall(int group) const {
    return group >= 0 && scene_.groups[static_cast<std::size_t>(group)].kind == GroupKind::wall;
  }

  const Scene& scene_;
  const Lattice& lattice_;
  LatticeRows whole_;
};

}  // namespace

bool has_free_surface(const Scene& scene) {
  const Start& start = scene.start;
  const Domain& domain = scene.domain;
  bool all_periodic = true;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    all_periodic = all_periodic && domain.periodic[a];
  if (!start.file.empty()) return start.free_surface.value_or(!all_periodic);
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (domain.periodic[a] &&
        (start.lattice.lower[a] > domain.lower[a] || start.lattice.upper[a] < domain.upper[a]))
      return true;

  const Lattice lattice(scene);
  LatticeRows quick(scene, lattice, LatticeRows::Bays::that_empty), whole(scene, lattice);
  Edges edges(scene, lattice);
  const std::int64_t deep = scene.dim == 3 ? lattice.count(2) : 1;
  for (std::int64_t k = 0; k < deep; ++k)
    for (std::int64_t j = 0; j < lattice.count(1); ++j) {
      const std::int64_t y = lattice.first(1) + j, z = scene.dim == 3 ? lattice.first(2) + k : 0;
      const std::vector<RowPart>& parts = quick.parts(y, z);
      if (parts.empty()) continue;
      const RowPart row{parts.front().first, parts.back().end};
      if (std::ranges::any_of(parts, is_empty) && std::ranges::any_of(whole.parts(y, z), is_empty))
        return true;
      if (edges.bare(y, z, row)) return true;
    }
  return false;
}

}  // namespace sph
