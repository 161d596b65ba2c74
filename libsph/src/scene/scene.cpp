#include "sph/scene.hpp"

#include <algorithm>
#include <cstddef>

#include "sph/eos/law.hpp"

namespace sph {

double Scene::support() const {
  if (of_grains()) {
    double largest = 0;
    for (const Group& g : groups) largest = std::max(largest, g.grain.largest_radius);
    return 2 * largest;
  }
  return kernel == KernelShape::quintic ? 3 * smoothing_length : 2 * smoothing_length;
}

double Scene::list_range() const {
  return support() * (total_lagrangian() ? terms.largest_stretch : largest_growth);
}

bool Scene::total_lagrangian() const {
  for (const Group& g : groups)
    if (g.lagrangian == Lagrangian::total) return true;
  return false;
}

bool Scene::has_kind(GroupKind k) const {
  for (const Group& g : groups)
    if (g.kind == k) return true;
  return false;
}

bool Scene::has_eos(EosKind kind) const {
  for (const Group& g : groups)
    if (g.eos->kind == kind) return true;
  return false;
}

int Scene::group_index(const std::string& group_name) const {
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (groups[k].name == group_name) return static_cast<int>(k);
  return -1;
}

}  // namespace sph
