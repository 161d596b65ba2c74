// Solids that do not deform: `rigid` of [[group]] and what goes with it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keys/prescribed_motion.hpp"
#include "keys/scene_resolve.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {
namespace {

std::array<bool, 4> read_held(const GroupReader& table, int dim) {
  std::array<bool, 4> held{};
  const std::optional<KeyValue> value = table.value("held");
  if (!value) return held;
  const char* wanted = R"(give an array of "x", "y", "z" (in 3D) and "rotation")";
  for (const toml_tree::Node& one : value->array(wanted)) {
    const auto* word = std::get_if<std::string>(&one.value);
    const auto at = word == nullptr ? keys::motion_names.end() : std::ranges::find(keys::motion_names, *word);
    if (at == keys::motion_names.end() || (*at == "z" && dim == 2))
      table.fail("held", "names a motion that the body does not have", wanted);
    held[static_cast<std::size_t>(at - keys::motion_names.begin())] = true;
  }
  return held;
}

std::optional<Double3> read_spin(const GroupReader& table, int dim) {
  const std::optional<KeyValue> value = table.value("start_spin");
  if (!value) return std::nullopt;
  if (dim == 3) return table.vector("start_spin", dimension::rate);
  return Double3{0, 0, value->number_in(value->node(), dimension::rate)};
}

void read_prescribed(const GroupReader& table, RigidMaterial& body) {
  using Name = GroupReader::Name<>;
  for (const Name key : {Name("held"), Name("start_velocity"), Name("start_spin")})
    table.only_if(false, key, "motion says how the body moves");
  const auto inner = table.table<keys::motion>();
  PrescribedMotion& motion = body.motion.emplace();
  inner.read(motion);
  read_motion(inner, motion);
  inner.finish();
}

}  // namespace

double stiffness_of_rigid(const GroupReader& table, const Group& group, const std::vector<Group>& groups) {
  double sound = 0;
  for (const Group& g : groups)
    if (g.kind == GroupKind::fluid) sound = std::fmax(sound, sound_at_rest(g));
  if (!(sound > 0))
    table.fail_missing("sound_speed",
                       "give it in m/s, or bulk_modulus in Pa: how stiff contacts of the body are");
  return group.density * sound * sound;
}

void read_rigid(const GroupReader& table, Group& group, int dim) {
  RigidMaterial& body = group.solid.body;
  using Name = GroupReader::Name<>;
  if (!body.rigid) {
    for (const Name key : {Name("held"), Name("start_velocity"), Name("start_spin"), Name("motion")})
      table.only_if(false, key, "only groups with rigid = true have it");
    table.only_if(is_bonded(group), "part_of", "only solids with lagrangian = \"total\" have it");
    return;
  }
  if (table.has("lagrangian") && group.solid.lagrangian == Lagrangian::updated)
    table.fail("rigid", "is true with lagrangian = \"updated\"", "set lagrangian = \"total\"");
  group.solid.lagrangian = Lagrangian::total;
  for (const Name key : {Name("poisson_ratio"), Name("shear_modulus")})
    table.only_if(false, key, "a rigid body does not deform: remove it");
  table.only_if(false, "strength", "a rigid body does not deform: remove it");
  table.only_if(false, "becomes", "a rigid body stays what it is: remove it");
  if (group.viscosity > 0)
    table.fail("viscosity", fmt::format("is {}", group.viscosity),
               "a rigid body does not deform, and drags fluids by their own viscosity: remove it");
  body.held = read_held(table, dim);
  body.spin = read_spin(table, dim);
  if (table.has("motion")) read_prescribed(table, body);
  if (body.part_of < 0) return;
  table.only_if(false, "motion", "the group that it is part of says so");
  table.only_if(false, "held", "the group that it is part of says so");
  table.only_if(false, "start_velocity", "the group that it is part of says so");
  table.only_if(false, "start_spin", "the group that it is part of says so");
}

void check_parts(const std::vector<GroupReader>& tables, const std::vector<Group>& groups) {
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Group& g = groups[k];
    if (g.solid.body.part_of < 0) continue;
    const Group& whole = groups[static_cast<std::size_t>(g.solid.body.part_of)];
    if (&whole == &g || !is_body(whole) || is_rigid(whole) != is_rigid(g) || whole.solid.body.part_of >= 0)
      tables[k].fail("part_of", fmt::format("names \"{}\"", whole.name),
                     is_rigid(g)
                         ? "it must name another rigid group that is itself no part of one"
                         : "it must name another solid with lagrangian = \"total\" that deforms and is "
                           "itself no part of one");
  }
}

}  // namespace sph
