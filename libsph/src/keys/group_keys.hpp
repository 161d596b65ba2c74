// Keys of [[group]] and group.fragmentation.
#pragma once

#include "keys/conditions.hpp"
#include "keys/law_keys.hpp"

namespace sph::keys {

inline constexpr auto fragmentation_keys = std::to_array<Key>({
    {"void_fraction",
     Number{dimension::none, {.least = 0, .most = 1, .above_least = true, .below_most = true}},
     "Above this volume fraction of gas a particle joins the other group for good.",
     at<&BubblyMaterial::fragmentation_void_fraction>, required},
    {"group", NameOf{"group"}, "The group that it joins, a fluid with the same equation of state.",
     index_at<&BubblyMaterial::fragments_to>, required},
});
inline constexpr Table<BubblyMaterial> fragmentation{
    {"group.fragmentation", false, "Bubbly fluid breaks.", fragmentation_keys}};

inline constexpr Where bubbly = where("eos", "bubbly"), gas = where("eos", "ideal_gas");
inline constexpr Where solid = where("kind", "solid"), walls = where("kind", "wall");
inline constexpr Where grain = where("kind", "grain"), melt = where("kind", "melt");
inline constexpr Where of_sph = unless(
    "kind", "grain", "it is of fluids and solids; grains have a contact law, melts flow slowly", "melt");
inline constexpr Where of_viscous =
    unless("kind", "grain", "it is of fluids and solids, and of melts; grains have a contact law");
inline constexpr Where elastic = unless("eos", "ideal_gas", "an ideal gas has heat_ratio and start_pressure");

inline constexpr auto group_keys = std::to_array<Key>({
    {"name", Text{}, "A letter, then letters, digits, _ or -.", at<&Group::name>, required},
    {"kind", Words{group_kind_words},
     "At least one group is a fluid, a solid, of grains or a melt: \"melt\" is slow flow without inertia on "
     "a grid, of one or two melts, and grains in them.",
     at<&Group::kind>, required},
    {"eos", law_words<EquationOfState>,
     "\"linear\": p = K (rho/rho_0 - 1). Fluids only: \"bubbly\", Ida eqs. (12)-(15), and \"ideal_gas\": p "
     "= (gamma - 1) rho u, with an energy equation; beside it there is no other matter but walls, which "
     "its heat does not enter, kernel \"quintic\", not \"ida\". \"birch_murnaghan\": of third order in the "
     "strain, for rocks and metals under pressure, whose K rises with it.",
     at<&Group::eos, &Compressibility::law>, of_sph},
    {"density", Number{dimension::density, positive},
     "rho_0, at zero pressure; of a bubbly fluid that of its liquid, of an ideal gas that at the start, of "
     "grains that of the material, of a melt that at melt.reference_temperature.",
     at<&Group::density>,
     Default{"required; of a wall that of the first fluid; of grains without diameter none"}},
    {"heat_ratio",
     Number{dimension::none,
            {.least = 1, .above_least = true, .is = "it is that of the heat capacities (1.4 for air),"}},
     "gamma of an ideal gas.", at<&Group::gas, &GasMaterial::heat_ratio>, of_sph, gas, required},
    {"start_pressure", Number{dimension::pressure, positive},
     "Of an ideal gas at the start. A start.file may hold the specific energy u [J/kg] instead.",
     at<&Group::gas, &GasMaterial::start_pressure>, of_sph, gas, required},
    {"bulk_modulus", Number{dimension::pressure, positive}, "K; of a bubbly fluid that of its liquid.",
     at<&Group::eos, &Compressibility::bulk_modulus>, of_sph, elastic,
     Default{"required, or sound_speed; of a wall that of the first fluid"}},
    {"sound_speed", Number{dimension::speed, positive}, "c of the (bubble-free) material: K = rho_0 c^2.",
     of_sph, elastic, Default{"from bulk_modulus"}},
    {"viscosity", Number{dimension::viscosity, not_negative},
     "eta. Of a solid it damps vibrations and couples it to fluids, which slip past without; the heat of "
     "that of a gas stays in the gas. Of a melt that at melt.reference_temperature.",
     at<&Group::viscosity>, of_viscous, Default{"0; of a wall that of the first fluid; required of melts"}},
    {"bulk_viscosity", Number{dimension::viscosity, not_negative}, "zeta of Ida eq. (9).",
     at<&Group::bulk_viscosity>, of_sph, unless("eos", "ideal_gas", "an ideal gas has viscosity alone"),
     Default{"0; of a wall that of the first fluid"}},
    {"shear_modulus", Number{dimension::pressure, positive}, "mu of a solid.",
     at<&Group::solid, &SolidMaterial::shear_modulus>, of_sph, solid, Default{"required, or poisson_ratio"}},
    {"poisson_ratio", Number{dimension::none},
     "nu, above -1. Of a solid below 0.5: mu = 3 K (1 - 2 nu) / (2 (1 + nu)). Of grains with Hertz's law "
     "at most 0.5.",
     Default{"required of solids, or shear_modulus; required by Hertz's law"}},
    {"lagrangian", Words{lagrangian_words},
     "Of a solid. \"updated\": stress follows the rate of strain (Jaumann), and bodies may meet fluids. "
     "\"total\": stress is a function of the deformation since the start (neo-Hooke), for bodies that do "
     "not break; conserves energy; beside walls and other bodies of the kind alone, which it touches "
     "elastically; kernel \"quintic\"; starts free of stress. The particles of a group are one body.",
     at<&Group::solid, &SolidMaterial::lagrangian>, of_sph, solid},
    {"gas_content",
     Number{dimension::none,
            {.least = 0,
             .most = 1,
             .above_least = true,
             .below_most = true,
             .is = "it is a mass per mass of liquid,"}},
     "m: mass of volatiles per mass of liquid.", at<&Group::bubbly, &BubblyMaterial::gas_content>, of_sph,
     bubbly, required},
    {"gas_rt", Number{dimension::specific_energy, positive}, "R T of the gas: p = rho_g R T.",
     at<&Group::bubbly, &BubblyMaterial::gas_rt>, of_sph, bubbly, required},
    {"solubility_pressure", Number{dimension::pressure, positive},
     "p_s: m_d = (p/p_s)^gamma can be dissolved.", at<&Group::bubbly, &BubblyMaterial::solubility_pressure>,
     of_sph, bubbly, required},
    {"solubility_exponent", Number{dimension::none, positive}, "gamma of the solubility.",
     at<&Group::bubbly, &BubblyMaterial::solubility_exponent>, of_sph, bubbly},
    {"fragmentation", Inner{&fragmentation}, "A bubbly fluid joins another group where it holds much gas.",
     of_sph, bubbly},
    {"clamps", NameOf{"group"},
     "A wall holds this total-Lagrangian solid: its particles are bonded to those of the solid, whose "
     "material it has.",
     index_at<&Group::wall, &WallMaterial::clamps>, of_sph, walls},
    {"velocity", Vector{dimension::speed},
     "Of the material of a wall, which slides in its own plane and stays where it is, or of fixed grains, "
     "which drag what touches them as a belt does.",
     Default{"0"}},
    {"slip", Flag{}, "Of a wall, instead of a velocity: no shear on what flows past; not with \"ida\".",
     of_sph, walls, Default{"false"}},
    {"diameter",
     Special{
         "a length, or an array of the least and the largest", R"("1 mm")",
         R"({"type": ["number", "string", "array"], "minItems": 2, "maxItems": 2, "items": {"type": ["number", "string"]}})"},
     "Of grains, spread evenly between the least and the largest [m]. A group without has no grains: it is "
     "a material of walls.",
     grain},
    {"fixed", Flag{}, "Grains glued in space, which never move.", at<&Group::grain, &GrainMaterial::fixed>,
     grain},
    {"temperature", Number{dimension::temperature}, "Of a melt at the start.",
     at<&Group::melt, &MeltMaterial::temperature>, melt},
    {"restitution", Number{dimension::none, {.least = 0, .most = 1, .above_least = true}},
     "Of a head-on impact.", at<&Group::grain, &GrainMaterial::restitution>, of_restitution, grain, required},
    {"friction", Number{dimension::none, not_negative}, "Coulomb's mu.",
     at<&Group::grain, &GrainMaterial::friction>, grain},
    {"rolling_friction", Number{dimension::none, not_negative},
     "mu_r: the arm of the rolling resistance in radii.", at<&Group::grain, &GrainMaterial::rolling_friction>,
     grain},
});
inline constexpr Table<Group> group{
    {"group", true,
     "A material. Walls take what they do not say from the first fluid, or from the solid that they clamp.",
     group_keys, "groups"}};

}  // namespace sph::keys
