// The part of a scene of grains that no other scene has, as TOML.
#include <fmt/format.h>

#include <cstddef>

#include "keys/scene_writer.hpp"
#include "sph/laws/contact/law.hpp"

namespace sph {
namespace {

/// A box comes back as its planes.
void write_wall(SceneWriter& out, const Wall& wall) {
  out.table(keys::wall, wall);
  out.text("shape", "plane");
  if (!wall.force) out.vector("velocity", wall.velocity);
}

}  // namespace

/// A radius is half the diameter that was read, and twice that is the diameter, both exactly.
void write_material(SceneWriter& out, const Group& group, const ContactLaw& law) {
  out.table(keys::group, group);
  for (std::size_t k = 0; k < law.keys.size(); ++k) out.number(law.keys[k].name, group.grain.constants[k]);
  const double least = 2 * group.grain.least_radius, largest = 2 * group.grain.largest_radius;
  if (least < largest)
    out.raw("diameter", fmt::format("[{}, {}]", SceneWriter::real(least), SceneWriter::real(largest)));
  else if (largest > 0)
    out.number("diameter", largest);
  if (group.grain.fixed) out.vector("velocity", group.wall.velocity);
}

void write_contacts(SceneWriter& out, const Scene& scene) {
  out.table(keys::contact, scene.grains.contact);
  for (const ContactPair& pair : scene.grains.contact.pairs) out.table(keys::contact_pair, pair);
}

void write_drag(SceneWriter& out, const Scene& scene) {
  const DragControl& drag = scene.grains.drag;
  if (drag.law->resistance != nullptr) return out.table(keys::drag, drag);
  out.header(keys::drag);
  out.text("law", drag.law->word);
}

void write_walls(SceneWriter& out, const Scene& scene) {
  for (const Wall& wall : scene.grains.walls) write_wall(out, wall);
  for (const WallStage& stage : scene.grains.stages) {
    out.table(keys::stage, stage);
    for (const WallChange& change : stage.walls) {
      out.table(keys::stage_wall, change);
      if (change.remove) out.raw("remove", "true");
    }
  }
}

}  // namespace sph
