// Keys of [[group]] and its tables.
#pragma once

#include "keys/conditions.hpp"
#include "keys/law_keys.hpp"
#include "keys/motion_keys.hpp"

namespace sph::keys {

inline constexpr Range share_of_volume{.least = 0, .most = 1, .above_least = true, .below_most = true};
inline constexpr auto becomes_keys = std::to_array<Key>({
    {"group", NameOf{"group"},
     "The fluid or updated solid that a particle joins; a total-Lagrangian solid joins fluids, where it "
     "fails.",
     index_at<&Transition::group>, required},
    {"void_fraction_above", Number{dimension::none, share_of_volume},
     "The gas's share of the volume of a bubbly fluid at which it does: it fragments (0.7 to 0.8).",
     at<&Transition::void_fraction_above>,
     Default{"one of the four, or of the three of failure, is required"}},
    {"void_fraction_below", Number{dimension::none, share_of_volume}, "... or it collapses, or heals.",
     at<&Transition::void_fraction_below>, Default{"none"}},
    {"temperature_above", Number{dimension::temperature, positive}, "Where there is heat: it melts.",
     at<&Transition::temperature_above>, Default{"none"}},
    {"temperature_below", Number{dimension::temperature, positive}, "... or it freezes.",
     at<&Transition::temperature_below>, Default{"none"}},
    {"toughness", Number{dimension::none, positive},
     "Total-Lagrangian solids: K_Ic [Pa sqrt(m)], whatever the spacing. The particle whose largest tension, "
     "with the "
     "pressure of the fluid beside it, is the furthest beyond 0.7 K_Ic / sqrt(spacing) becomes fluid; bonds "
     "across the "
     "crack are cut.",
     at<&Transition::failure, &FailureLimits::toughness>, Default{"none"}},
    {"tensile_strength", Number{dimension::pressure, positive},
     "... or what a particle bears, at any spacing.",
     at<&Transition::failure, &FailureLimits::tensile_strength>, Default{"none"}},
    {"cohesion", Number{dimension::pressure, positive},
     "... and where (sigma_1 - sigma_3)/2 > c cos phi - (sigma_1 + sigma_3)/2 sin phi, of stresses above the "
     "pressure of "
     "the fluid beside it.",
     at<&Transition::failure, &FailureLimits::cohesion>, Default{"none"}},
    {"friction_angle",
     Number{dimension::none,
            {.least = 0, .most = 90, .below_most = true, .is = "it is an angle in degrees,"}},
     "phi in degrees.", at<&Transition::failure, &FailureLimits::friction_angle>},
    {"keeps", Words{conserved_words},
     "Of what fails: its mass, where the fluid is as dense as it was; or its volume, and the budget has what "
     "it lost; both at the pressure of the fluid beside it. \"both\": its mass and its volume, of a liquid "
     "as dense, "
     "and the pressure follows: tips suck, as the space that opens is filled by what flows in.",
     at<&Transition::keeps>},
    {"hold", Number{dimension::time, not_negative},
     "For so long without a break, against noise. The first row of the table that holds counts alone.",
     at<&Transition::hold>},
    {"average", Number{dimension::time, not_negative},
     "The limit is one of the running mean over so long, exponential, anew in each group; rows of one table "
     "that have "
     "one of the same quantity have the same. Of failure: a crack that is to grow slowly wants some 20 "
     "spacings over the speed "
     "of sound, or each particle that fails sends a wave that breaks the next ones.",
     at<&Transition::average>},
});
inline constexpr Table<Transition> becomes{
    {"group.becomes", true,
     "Particles of a group join another for good, or until its own table says otherwise. They keep mass, "
     "momentum, "
     "volatiles, enthalpy and pressure; density and temperature are then those of the other material.",
     becomes_keys}};

inline constexpr auto permeability_keys = std::to_array<Key>({
    {"law", Words{permeability_words},
     "Of psi, the gas's share of the volume. \"power\": coefficient psi^n (Klug & Cashman 1996: 6.3e-11 m2, "
     "n = 3.4); "
     "\"percolation\": coefficient (psi - threshold)^n above it (Rust & Cashman 2004: 1e-11 m2, 0.3, n = 2); "
     "\"kozeny_carman\": coefficient psi^3 / (1 - psi)^2, of spheres d^2/180.",
     at<&Permeability::law>},
    {"coefficient", Number{dimension::area, not_negative}, "0 is tight.", at<&Permeability::coefficient>,
     required},
    {"exponent", Number{dimension::none, positive}, "n.", at<&Permeability::exponent>,
     Default{"3.4; with \"percolation\" 2"}},
    {"threshold",
     Number{dimension::none, {.least = 0, .most = 1, .below_most = true, .is = "it is a share,"}},
     "Below it bubbles are not connected.", at<&Permeability::threshold>, where("law", "percolation")},
    {"closing_threshold",
     Number{dimension::none, {.least = 0, .most = 1, .below_most = true, .is = "it is a share,"}},
     "Bubbles that were connected stay so down to this psi, above which the law then counts (Rust & Cashman "
     "2004).",
     at<&Permeability::closing_threshold>, where("law", "percolation"), Default{"threshold"}},
    {"gas_viscosity", Number{dimension::viscosity, positive}, "eta_g.", at<&Permeability::gas_viscosity>},
    {"inertial_coefficient", Number{dimension::none, not_negative},
     "Gas that flows fast loses pressure to its inertia (Forchheimer): the gradient is eta_g v / k + rho_g "
     "v^2 / k_2 "
     "with k_2 = inertial_coefficient k^inertial_exponent in SI units (Rust & Cashman 2004: 1.5e8, 1.353). "
     "0: it "
     "does not.",
     at<&Permeability::inertial_coefficient>},
    {"inertial_exponent", Number{dimension::none, not_negative}, "See there.",
     at<&Permeability::inertial_exponent>},
});
inline constexpr Table<Permeability> permeability{
    {"group.permeability", false, "Gas flows through bubbly fluid.", permeability_keys}};

inline constexpr auto viscosity_law_keys = std::to_array<Key>({
    {"law", Words{viscosity_law_words},
     "Of the liquid. \"constant\": viscosity. \"exponential\": viscosity exp(-fall (T - "
     "reference_temperature)). "
     "\"vogel\": log10 eta = a + b / (T - c), with a, b, c of a melt's composition (Giordano et al. 2008). "
     "\"hess_dingwell\": of rhyolite, by T and the water dissolved in it (Hess & Dingwell 1996), of a bubbly "
     "fluid.",
     at<&ViscosityModel::law>},
    {"fall", Number{dimension::per_temperature, not_negative}, "Of \"exponential\".",
     at<&ViscosityModel::fall>, where("law", "exponential"), required},
    {"reference_temperature", Number{dimension::temperature}, "Of \"exponential\".",
     at<&ViscosityModel::reference_temperature>, where("law", "exponential"), required},
    {"a", Number{dimension::none}, "Of \"vogel\".", at<&ViscosityModel::vogel, &VogelConstants::a>,
     where("law", "vogel"), required},
    {"b", Number{dimension::temperature}, "Of \"vogel\".", at<&ViscosityModel::vogel, &VogelConstants::b>,
     where("law", "vogel"), required},
    {"c", Number{dimension::temperature}, "Of \"vogel\".", at<&ViscosityModel::vogel, &VogelConstants::c>,
     where("law", "vogel"), required},
    {"temperature", Number{dimension::temperature, positive}, "T of a scene without group.heat.",
     at<&ViscosityModel::temperature>, Default{"required without group.heat, but by \"constant\""}},
    {"crystals", Words{crystal_law_words},
     "\"einstein_roscoe\": times (1 - phi / maximum_packing)^-2.5, phi what of the mass is frozen between "
     "heat.solidus and liquidus.",
     at<&ViscosityModel::crystals>},
    {"maximum_packing", Number{dimension::none, up_to(1, "it is a share,")}, "Of crystals.",
     at<&ViscosityModel::maximum_packing>, where("crystals", "einstein_roscoe")},
    {"bubbles", Words{bubble_law_words},
     "Of a bubbly fluid, psi the gas's share of the volume. \"round\": over 1 - psi; \"stretched\": times "
     "(1 - psi)^(5/3).",
     at<&ViscosityModel::bubbles>},
    {"least", Number{dimension::viscosity, not_negative}, "It is never lower.", at<&ViscosityModel::least>},
    {"most", Number{dimension::viscosity, positive},
     "It is never higher. A million times the lowest is what implicit viscosity bears well.",
     at<&ViscosityModel::most>, Default{"none; required with crystals"}},
});
inline constexpr Table<ViscosityModel> viscosity_law{
    {"group.viscosity_law", false, "Viscosity of a fluid that follows its state.", viscosity_law_keys}};

inline constexpr auto heat_keys = std::to_array<Key>({
    {"specific_heat", Number{dimension::specific_heat, positive}, "c_p.", at<&HeatMaterial::specific_heat>,
     required},
    {"conductivity", Number{dimension::conductivity, not_negative},
     "k; between two materials the harmonic mean.", at<&HeatMaterial::conductivity>},
    {"latent_heat", Number{dimension::specific_energy, not_negative},
     "L, that melting takes, spread evenly from solidus to liquidus.", at<&HeatMaterial::latent_heat>},
    {"solidus", Number{dimension::temperature, positive}, "Where melting begins.", at<&HeatMaterial::solidus>,
     Default{"required with latent_heat"}},
    {"liquidus", Number{dimension::temperature, positive}, "Where it ends.", at<&HeatMaterial::liquidus>,
     Default{"required with latent_heat"}},
    {"expansion", Number{dimension::per_temperature, not_negative},
     "alpha: gravity acts on rho_0 (1 - alpha (T - reference_temperature)), which the pressure does not know "
     "(Boussinesq).",
     at<&HeatMaterial::expansion>},
    {"reference_temperature", Number{dimension::temperature}, "Of expansion.",
     at<&HeatMaterial::reference_temperature>, Default{"the group's temperature"}},
});
inline constexpr Table<HeatMaterial> heat{
    {"group.heat", false, "Heat of a fluid or a solid: all of them have it, or none.", heat_keys}};

inline constexpr auto heat_transfer_keys = std::to_array<Key>({
    {"coefficient", Number{dimension::heat_transfer, positive}, "h_c: q = h_c (temperature - T).",
     at<&WallTransfer::coefficient>, required},
    {"temperature", Number{dimension::temperature, not_negative}, "Of what is beyond the wall.",
     at<&WallTransfer::temperature>, required},
});
inline constexpr Table<WallTransfer> heat_transfer{
    {"group.heat_transfer", false, "Heat from a wall by a coefficient, of the temperature T of its face.",
     heat_transfer_keys}};

inline constexpr auto radiation_keys = std::to_array<Key>({
    {"emissivity",
     Number{dimension::none, {.least = 0, .most = 1, .above_least = true, .is = "it is a share,"}},
     "epsilon of the face: q = epsilon sigma (temperature^4 - T^4).", at<&WallRadiation::emissivity>,
     required},
    {"temperature", Number{dimension::temperature, not_negative}, "Of what the face sees.",
     at<&WallRadiation::temperature>, required},
});
inline constexpr Table<WallRadiation> radiation{
    {"group.radiation", false,
     "Heat that the face of a wall, at T, radiates and gets; heat_transfer adds to it.", radiation_keys}};

inline constexpr auto strength_keys = std::to_array<Key>({
    {"law", Words{strength_law_words},
     "\"mohr_coulomb\", with a cut-off of tension; \"drucker_prager\": the smooth cone that is as strong in "
     "triaxial "
     "compression, in 2D in plane strain.",
     at<&Strength::law>},
    {"cohesion", Number{dimension::pressure, not_negative}, "c.", at<&Strength::cohesion>, required},
    {"friction_angle",
     Number{dimension::none,
            {.least = 0, .most = 90, .below_most = true, .is = "it is an angle in degrees,"}},
     "phi in degrees.", at<&Strength::friction_angle>},
    {"dilatancy_angle",
     Number{dimension::none,
            {.least = 0, .most = 90, .below_most = true, .is = "it is an angle in degrees,"}},
     "psi in degrees, at most phi: how much shear opens the rock.", at<&Strength::dilatancy_angle>},
    {"tensile_strength", Number{dimension::pressure, not_negative},
     "It fails in tension as soon as that; beyond c / tan(phi) it has no meaning.",
     at<&Strength::tensile_strength>, Default{"c / tan(phi); without friction none"}},
    {"fracture_energy", Number{dimension::stiffness, positive},
     "G_f: what a shear band takes, per area, of cohesion until it is residual, at any start.spacing. "
     "Tensile "
     "strength falls with it.",
     at<&Strength::fracture_energy>, Default{"none: cohesion stays"}},
    {"residual_cohesion", Number{dimension::pressure, not_negative}, "What is left then.",
     at<&Strength::residual_cohesion>},
});
inline constexpr Table<Strength> strength{
    {"group.strength", false,
     "An updated-Lagrangian solid yields: where stress would be beyond this it flows.", strength_keys}};

inline constexpr Where bubbly = where("eos", "bubbly"), gas = where("eos", "ideal_gas");
inline constexpr Where solid = where("kind", "solid"), walls = where("kind", "wall");
inline constexpr Where grain = where("kind", "grain");
inline constexpr Where not_of_grains = unless("kind", "grain", "grains have no temperature");
inline constexpr Where matter = among("kind", "fluid", "solid");
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
     "gamma of an ideal gas.", at<&Group::eos, &Compressibility::gas, &GasMaterial::heat_ratio>, of_sph, gas,
     required},
    {"start_pressure", Number{dimension::pressure, positive},
     "Of an ideal gas at the start. A start.file may hold the specific energy u [J/kg] instead.",
     at<&Group::eos, &Compressibility::gas, &GasMaterial::start_pressure>, of_sph, gas, required},
    {"bulk_modulus", Number{dimension::pressure, positive}, "K; of a bubbly fluid that of its liquid.",
     at<&Group::eos, &Compressibility::bulk_modulus>, of_sph, elastic,
     Default{"required, or sound_speed; of a wall that of the first fluid; of a rigid solid as sound_speed"}},
    {"sound_speed", Number{dimension::speed, positive}, "c of the (bubble-free) material: K = rho_0 c^2.",
     of_sph, elastic, Default{"from bulk_modulus; of a rigid solid in a fluid that of the fastest fluid"}},
    {"viscosity", Number{dimension::viscosity, not_negative},
     "eta. Of a solid it damps vibrations and couples it to fluids, which slip past without; the heat of "
     "that of a gas stays in the gas. Of a melt that at melt.reference_temperature.",
     at<&Group::viscosity>, of_viscous, Default{"0; of a wall that of the first fluid; required of melts"}},
    {"viscosity_law", Inner{&viscosity_law},
     "Of a fluid whose viscosity follows its temperature, water, crystals or bubbles.", of_sph,
     where("kind", "fluid")},
    {"bulk_viscosity", Number{dimension::viscosity, not_negative}, "zeta of Ida eq. (9).",
     at<&Group::viscosity_law, &ViscosityModel::bulk>, of_sph,
     unless("eos", "ideal_gas", "an ideal gas has viscosity alone"),
     Default{"0; of a wall that of the first fluid"}},
    {"shear_modulus", Number{dimension::pressure, positive}, "mu of a solid.",
     at<&Group::solid, &SolidMaterial::shear_modulus>, of_sph, solid,
     Default{"required, or poisson_ratio; a rigid solid has none"}},
    {"poisson_ratio", Number{dimension::none},
     "nu, above -1. Of a solid below 0.5: mu = 3 K (1 - 2 nu) / (2 (1 + nu)). Of grains with Hertz's law "
     "at most 0.5.",
     Default{"required of solids, or shear_modulus; required by Hertz's law"}},
    {"lagrangian", Words{lagrangian_words},
     "Of a solid. \"updated\": stress follows the rate of strain (Jaumann), and bodies may meet fluids. "
     "\"total\": stress is a function of the deformation since the start (neo-Hooke), for bodies that do "
     "not break; touches walls and other bodies of the kind elastically; to a fluid it is a wall that moves "
     "and yields; kernel \"quintic\"; starts free of stress but for the pressure of the fluid. The particles "
     "of a "
     "group are one body.",
     at<&Group::solid, &SolidMaterial::lagrangian>, of_sph, solid},
    {"rigid", Flag{},
     "Of a solid with lagrangian = \"total\": it does not deform. The particles of the group move as one "
     "body by the "
     "sums of their forces; sound_speed, or bulk_modulus, is then how stiff its contacts are, if what it "
     "touches is as stiff.",
     at<&Group::solid, &SolidMaterial::body, &RigidMaterial::rigid>, of_sph, solid},
    {"part_of", NameOf{"group"},
     "Of a solid with lagrangian = \"total\": this group and it are one body. Rigid ones move together; "
     "particles of "
     "others, each with the material of its group, are bonded across their common face: layers, inclusions.",
     index_at<&Group::solid, &SolidMaterial::body, &RigidMaterial::part_of>, of_sph, solid},
    {"held",
     Special{R"(an array of "x", "y", "z" and "rotation")", R"(["x", "rotation"])",
             R"({"type": "array", "items": {"enum": ["x", "y", "z", "rotation"]}})"},
     "Of a rigid solid: no force changes these of its motions, which stay what they are at the start.",
     of_sph, solid, Default{"none: it is free"}},
    {"start_velocity", Vector{dimension::speed}, "Of a rigid solid: of its centre of mass at the start.",
     at<&Group::solid, &SolidMaterial::body, &RigidMaterial::velocity>, of_sph, solid,
     Default{"the mean of start.velocity"}},
    {"start_spin",
     Special{
         "an angular velocity, in 3D an array of three", "0.5",
         R"({"anyOf": [{"type": ["number", "string"]}, {"type": "array", "items": {"type": ["number", "string"]}}]})"},
     "Of a rigid solid: its angular velocity at the start [rad/s], in 2D about z.", of_sph, solid,
     Default{"that of start.velocity, or of the particles of a start.file"}},
    {"motion", Inner{&motion},
     "Of a rigid solid that moves as it is told: a piston, a stirrer, a plate that shakes. Its monitor "
     "\"body\" says "
     "what acts on it.",
     of_sph, solid, Default{"as forces move it"}},
    {"strength", Inner{&strength}, "Of an updated-Lagrangian solid that yields.", of_sph, solid,
     Default{"none: it is elastic"}},
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
    {"exsolution_time", Number{dimension::time, not_negative},
     "tau, in which what is dissolved follows the pressure: dw/dt = (min(m, m_d) - w) / tau. All starts in "
     "equilibrium.",
     at<&Group::bubbly, &BubblyMaterial::exsolution_time>, of_sph, bubbly, Default{"0: at once"}},
    {"water_diffusivity", Number{dimension::diffusivity, not_negative},
     "D of what is dissolved, w, of groups with an exsolution_time (without, w is a function of the "
     "pressure). It "
     "spreads between particles of groups with a D; they keep their volume, so where nothing moves pressures "
     "follow.",
     at<&Group::bubbly, &BubblyMaterial::water_diffusivity>, of_sph, bubbly, Default{"0: it stays"}},
    {"becomes", Inner{&becomes}, "When particles join another group.", of_sph, matter},
    {"permeability", Inner{&permeability}, "Gas flows through a bubbly fluid by Darcy's law.", of_sph,
     bubbly},
    {"gas_pressure", Number{dimension::pressure},
     "Of the gas beyond a wall that lets it pass, above the surface pressure. A wall without is tight.",
     at<&Group::wall, &WallMaterial::gas_pressure>, of_sph, walls},
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
    {"temperature", Number{dimension::temperature},
     "At the start, of melts and of what has heat; a wall keeps it. A wall without lets no heat pass.",
     at<&Group::heat, &GroupHeat::temperature>, not_of_grains,
     Default{"0 of melts; required of what has heat; of walls none"}},
    {"heat", Inner{&heat}, "A fluid or a solid has a temperature.", of_sph, matter},
    {"heat_flux", Number{dimension::heat_flux},
     "From a wall into what is beside it, instead of a temperature.", at<&Group::heat, &GroupHeat::wall_flux>,
     of_sph, walls},
    {"heat_transfer", Inner{&heat_transfer}, "From a wall into what is beside it, or back.", of_sph, walls},
    {"radiation", Inner{&radiation}, "The same by radiation.", of_sph, walls},
    {"restitution", Number{dimension::none, {.least = 0, .most = 1, .above_least = true}},
     "Of a head-on impact.", at<&Group::grain, &GrainMaterial::restitution>, of_restitution, grain, required},
    {"friction", Number{dimension::none, not_negative}, "Coulomb's mu.",
     at<&Group::grain, &GrainMaterial::friction>, grain},
    {"rolling_friction", Number{dimension::none, not_negative},
     "mu_r: the arm of the rolling resistance in effective radii r_1 r_2 / (r_1 + r_2), against walls in r.",
     at<&Group::grain, &GrainMaterial::rolling_friction>, grain},
});
inline constexpr Table<Group> group{
    {"group", true,
     "A material. Walls take what they do not say from the first fluid, or from the solid that they clamp.",
     group_keys, "groups"}};

}  // namespace sph::keys
