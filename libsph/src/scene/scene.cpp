#include "sph/scene/scene.hpp"

#include <algorithm>
#include <cstddef>

namespace sph {

bool can_become(const std::vector<Group>& groups, int from, int to) {
  if (from < 0) return false;
  std::vector<int> reached{from};
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (const Transition& row : groups[static_cast<std::size_t>(reached[k])].becomes)
      if (std::ranges::find(reached, row.group) == reached.end()) reached.push_back(row.group);
  return std::ranges::find(reached, to) != reached.end();
}

bool has_strength(const std::vector<Group>& groups) {
  return std::ranges::any_of(groups, [](const Group& g) { return g.solid.strength.has_value(); });
}

bool Scene::has_matter() const { return has_kind(GroupKind::fluid) || has_kind(GroupKind::solid); }

double Scene::largest_diameter() const {
  double largest = 0;
  for (const Group& g : groups) largest = std::max(largest, g.grain.largest_radius);
  return 2 * largest;
}

double Scene::kernel_radius() const {
  if (!has_matter()) return 0;
  return (kernel.shape == KernelShape::quintic ? 3 : 2) * kernel.smoothing_length;
}

double particle_volume(const Scene& scene) {
  double volume = 1;
  for (int a = 0; a < scene.dim; ++a) volume *= scene.start.spacing;
  return volume;
}

double Scene::bond_width() const {
  const double h = kernel.smoothing_length;
  return terms.bonds.reach && has_bonds(*this)
             ? std::min(*terms.bonds.reach * start.spacing * (h / kernel_radius()), h)
             : h;
}

double Scene::support() const {
  return has_melt() && !has_grains() ? start.spacing : std::max(kernel_radius(), largest_diameter());
}

double Scene::list_range() const {
  if (has_bonds(*this)) {
    const double bonds =
        bond_width() / kernel.smoothing_length * kernel_radius() * terms.bonds.largest_stretch;
    return std::max(support(), has_failure(*this) ? bonds / nearly_lost : bonds);
  }
  return support() * kernel.largest_growth;
}

bool Scene::has_gas_flow() const {
  return std::ranges::any_of(groups, [](const Group& g) { return g.bubbly.permeability.coefficient > 0; });
}

bool Scene::has_water_diffusion() const {
  return std::ranges::any_of(groups, [](const Group& g) { return g.bubbly.water_diffusivity > 0; });
}

bool Scene::has_heat() const {
  return std::ranges::any_of(groups, [](const Group& g) { return g.heat.material.specific_heat > 0; });
}

bool Scene::total_lagrangian() const {
  for (const Group& g : groups)
    if (g.solid.lagrangian == Lagrangian::total) return true;
  return false;
}

bool Scene::has_kind(GroupKind k) const {
  for (const Group& g : groups)
    if (g.kind == k) return true;
  return false;
}

bool has_wet_bodies(const Scene& scene) {
  return scene.total_lagrangian() && scene.has_kind(GroupKind::fluid);
}
bool has_dry_bodies(const Scene& scene) {
  return scene.total_lagrangian() && !scene.has_kind(GroupKind::fluid);
}
bool has_bonds(const Scene& scene) { return std::ranges::any_of(scene.groups, is_bonded); }
bool has_rigid_bodies(const Scene& scene) { return std::ranges::any_of(scene.groups, is_rigid); }
bool has_body_contacts(const Scene& scene) {
  return scene.has_kind(GroupKind::wall) || std::ranges::count_if(scene.groups, [](const Group& g) {
                                              return is_body(g) && g.solid.body.part_of < 0;
                                            }) > 1;
}
std::vector<int> rigid_bodies_of(const Scene& scene) {
  std::vector<int> bodies(scene.groups.size(), -1);
  int count = 0;
  for (std::size_t g = 0; g < bodies.size(); ++g)
    if (is_rigid(scene.groups[g]) && scene.groups[g].solid.body.part_of < 0) bodies[g] = count++;
  for (std::size_t g = 0; g < bodies.size(); ++g)
    if (const int whole = scene.groups[g].solid.body.part_of; is_rigid(scene.groups[g]) && whole >= 0)
      bodies[g] = bodies[static_cast<std::size_t>(whole)];
  return bodies;
}
bool has_failure(const Scene& scene) { return std::ranges::any_of(scene.groups, can_fail); }

int Scene::group_index(const std::string& group_name) const {
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (groups[k].name == group_name) return static_cast<int>(k);
  return -1;
}

bool OpeningControl::any() const {
  return !inlets.empty() || !outlets.empty() || !insertions.empty() ||
         std::ranges::find(deletes, true) != deletes.end();
}
bool OpeningControl::lead() const {
  return !inlets.empty() ||
         std::ranges::any_of(outlets, [](const Outlet& outlet) { return !outlet.pressure.empty(); });
}

std::vector<std::string> GrainScene::names() const {
  std::vector<std::string> all;
  for (const Wall& wall : walls) all.push_back(wall.name);
  for (const MeshWall& mesh : meshes) all.push_back(mesh.name);
  return all;
}

}  // namespace sph
