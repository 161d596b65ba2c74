#include "sph/models/parts.hpp"

#include <algorithm>
#include <limits>

#include "sph/models/models.hpp"

namespace sph {

Parts::Parts(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale) {
  std::vector<bool> stays;
  for (const Group& g : scene.groups) stays.push_back(g.kind == GroupKind::wall || g.grain.fixed);
  if (scene.has_matter()) {
    physics.emplace(sets.size(), scene, scale);
    sph_pairs.emplace(sets.size(), *physics);
    sets.push_back({physics->built().fields(), stays});
    if (physics->models().openings) models.push_back(&*physics->models().openings);
    // How fast bodies start is looked at once they have one motion.
    if (physics->models().rigid) models.push_back(&*physics->models().rigid);
    models.push_back(&*physics);
    for (Model* m : physics->models().all()) models.push_back(m);
    pairs.push_back(&*sph_pairs);
  }
  if (scene.has_grains()) {
    grains.emplace(sets.size(), comm, scene, scale);
    sets.push_back({grain_fields(scene), stays});
    models.push_back(&*grains);
    pairs.push_back(&grains->pairs());
    if (scene.of_grains() && scene.domain.openings.any())
      models.push_back(
          &grain_openings.emplace(grains->set(), scene, scale, grains->walls(), grains->pairs()));
  }
  if (has_drag(scene)) {
    drag.emplace(physics->set(), grains->set(), scene, scale, physics->constants());
    sets[physics->set()].fields |= Drag::of_fluid;
    sets[grains->set()].fields |= Drag::of_grains;
    models.push_back(&*drag);
    pairs.push_back(&*drag);
  }
  if (scene.has_melt()) {
    melt = std::make_unique<Melt>(sets.size(), comm, scene, scale);
    sets.push_back({Melt::fields(scene), stays,
                    [rows = &melt->rows()](const Particles& cells) { return rows->owners(cells); }});
    models.push_back(&*melt);
  }
  if (scene.is_suspension()) {
    suspension.emplace(grains->set(), melt->set(), comm, scene, scale, *grains, *melt);
    models.push_back(&*suspension);
    pairs.push_back(&*suspension);
  }
  if (physics) {
    Plan of_fluid = physics->built().plan();
    if (drag) drag->add_porosity_to(of_fluid);
    append(plan, std::move(of_fluid), physics->set());
  }
  if (grains) append(plan, grains->plan(), grains->set());
  if (drag) append(plan, drag->force_plan());
  if (suspension)
    append(plan, suspension->plan());
  else if (melt)
    append(plan, melt->plan(), melt->set());
  for (Model* m : models) m->reserve(reduction);
}

double Parts::longest_step() const {
  double dt = std::numeric_limits<double>::infinity();
  for (const Model* m : models) dt = std::min(dt, m->longest_step(reduction));
  return dt;
}

}  // namespace sph
