// [group.strength]: what an updated-Lagrangian solid bears.
#include <fmt/format.h>

#include "keys/scene_resolve.hpp"
#include "sph/laws/yielding.hpp"

namespace sph {
namespace {

using StrengthReader = Reader<keys::strength>;

/// Where cohesion falls faster than stress can leave a spacing's width of elastic rock it breaks at once, and takes
/// more than the fracture energy.
void check_softening(const StrengthReader& table, const Group& group, const Scene& scene) {
  const Strength& s = *group.solid.strength;
  if (!s.fracture_energy) {
    if (s.residual_cohesion > 0)
      table.fail("residual_cohesion", fmt::format("is {} Pa", s.residual_cohesion),
                 "cohesion stays what it is: give fracture_energy too");
    return;
  }
  if (!(s.residual_cohesion < s.cohesion))
    table.fail("residual_cohesion",
               fmt::format("is {} Pa, and cohesion {} Pa", s.residual_cohesion, s.cohesion),
               "less must be left, for a fracture to take energy");
  const double cos = Yielding(group, scene.dim, scene.start.spacing).constants(0).cos_friction;
  const double lost = (s.cohesion - s.residual_cohesion) * cos;
  const double least = lost * lost * scene.start.spacing / (2 * group.solid.shear_modulus);
  if (*s.fracture_energy < least)
    table.fail(
        "fracture_energy", fmt::format("is {} N/m", *s.fracture_energy),
        fmt::format("a spacing's width of rock has {:.3g} N/m of elastic energy when it yields: give more, "
                    "or a smaller start.spacing",
                    least));
}

}  // namespace

void read_strength(const GroupReader& table, Group& group, const Scene& scene) {
  if (!table.has("strength") || group.kind != GroupKind::solid) return;
  if (group.solid.lagrangian == Lagrangian::total)
    table.fail("strength", "is of a total-Lagrangian solid", "updated ones alone yield: remove it");
  if (scene.terms.formulation == Formulation::ida)
    table.fail("strength", "is given with formulation = \"ida\"", "that has none: remove it");
  const auto inner = table.table<keys::strength>();
  Strength& s = group.solid.strength.emplace();
  inner.read(s);
  if (s.dilatancy_angle > s.friction_angle)
    inner.fail("dilatancy_angle",
               fmt::format("is {}, and friction_angle {}", s.dilatancy_angle, s.friction_angle),
               "it must not be larger, or yielding would give energy");
  const double tip = cone_tip(Yielding(group, scene.dim, scene.start.spacing).constants(0));
  if (s.tensile_strength && *s.tensile_strength > tip)
    inner.fail(
        "tensile_strength", fmt::format("is {} Pa", *s.tensile_strength),
        fmt::format("cohesion and friction bear {:.4g} Pa of tension: give less, or leave it out", tip));
  check_softening(inner, group, scene);
  inner.finish();
}

}  // namespace sph
