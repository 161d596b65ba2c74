// The part of a scene of grains that no other scene has, as TOML.
#include <fmt/format.h>

#include <cstddef>

#include "scene/scene_writer.hpp"
#include "sph/contact/law.hpp"

namespace sph {
namespace {

void write_contact(SceneWriter& out, const Scene& scene) {
  const ContactControl& c = scene.contact;
  out.header("[contact]");
  out.text("law", word(contact_law_words(), c.law));
  if (c.normal_damping) out.number("normal_damping", *c.normal_damping);
  out.number("tangential_damping", c.tangential_damping);
  out.number("rolling_damping", c.rolling_damping);
  out.flag("pull", c.pull);
  out.number("largest_overlap", c.largest_overlap);
  const auto name = [&](int group) {
    return SceneWriter::quoted(scene.groups[static_cast<std::size_t>(group)].name);
  };
  for (const ContactPair& pair : c.pairs) {
    out.header("[[contact.pair]]");
    out.raw("groups", fmt::format("[{}, {}]", name(pair.groups[0]), name(pair.groups[1])));
    if (pair.friction) out.number("friction", *pair.friction);
    if (pair.rolling_friction) out.number("rolling_friction", *pair.rolling_friction);
    if (pair.restitution) out.number("restitution", *pair.restitution);
  }
}

/// A radius is half the diameter that was read, and twice that is the diameter, both exactly.
void write_size(SceneWriter& out, const Group& group) {
  const double least = 2 * group.grain.least_radius, largest = 2 * group.grain.largest_radius;
  if (least == largest)
    out.number("diameter", largest);
  else
    out.raw("diameter", fmt::format("[{}, {}]", SceneWriter::real(least), SceneWriter::real(largest)));
  out.flag("fixed", group.grain.fixed);
  if (group.grain.fixed) out.vector("velocity", group.wall_velocity);
}

void write_material(SceneWriter& out, const Group& group, const ContactControl& contact) {
  const GrainMaterial& g = group.grain;
  out.header("[[group]]");
  out.text("name", group.name);
  out.text("kind", word(group_kind_words(), group.kind));
  if (group.density > 0) out.number("density", group.density);
  if (g.largest_radius > 0) write_size(out, group);
  for (std::size_t k = 0; k < contact.law->keys.size(); ++k)
    out.number(contact.law->keys[k].name, g.constants[k]);
  if (!contact.normal_damping) out.number("restitution", g.restitution);
  out.number("friction", g.friction);
  out.number("rolling_friction", g.rolling_friction);
}

/// A box comes back as its planes.
void write_wall(SceneWriter& out, const Scene& scene, const Wall& wall) {
  out.header("[[wall]]");
  out.text("name", wall.name);
  out.text("material", scene.groups[static_cast<std::size_t>(wall.group)].name);
  out.text("shape", "plane");
  out.vector("point", wall.point);
  out.vector("normal", wall.normal);
  if (wall.force)
    out.number("force", *wall.force);
  else
    out.vector("velocity", wall.velocity);
  if (wall.servo_gain > 0) {
    out.number("servo_gain", wall.servo_gain);
    out.number("largest_speed", wall.largest_speed);
  }
}

void write_stage(SceneWriter& out, const Scene& scene, const WallStage& stage) {
  out.header("[[stage]]");
  out.text("name", stage.name);
  out.number("begin", stage.begin);
  for (const WallChange& change : stage.walls) {
    out.header("[[stage.wall]]");
    out.text("name", scene.walls[static_cast<std::size_t>(change.wall)].name);
    if (change.velocity) out.vector("velocity", *change.velocity);
    if (change.force) out.number("force", *change.force);
    if (change.remove) out.flag("remove", true);
  }
}

}  // namespace

void write_grains(SceneWriter& out, const Scene& scene) {
  write_contact(out, scene);
  for (const Group& g : scene.groups) write_material(out, g, scene.contact);
  for (const Wall& wall : scene.walls) write_wall(out, scene, wall);
  for (const WallStage& stage : scene.stages) write_stage(out, scene, stage);
}

}  // namespace sph
