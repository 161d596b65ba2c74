// Keys of [terms] and terms.surface_tension.
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

inline constexpr auto surface_tension_keys = std::to_array<Key>({
    {"between", TwoGroups{R"(the names of two groups of fluid, like ["melt", "gas"])"},
     "Two groups of fluid; both with what they become.", at<&InterfaceTension::between>, required},
    {"coefficient", Number{dimension::stiffness, not_negative}, "sigma.", at<&InterfaceTension::coefficient>,
     required},
    {"form", Words{tension_form_words},
     "\"stress\": in a layer as thick as the kernel, momentum is conserved pair by pair. \"jump\": of the "
     "pressure, from the curvature, for thin fluids (Oh < 0.1 or so), in which the stress stirs the "
     "interface; two fluids alone.",
     at<&InterfaceTension::form>},
});
inline constexpr Table<InterfaceTension> surface_tension{
    {"terms.surface_tension", false, "Of the interface between two groups of fluid.", surface_tension_keys}};

inline constexpr auto terms_keys = std::to_array<Key>({
    {"density_diffusion", Number{dimension::none, not_negative},
     "delta. Calms the pressure within each phase.", at<&Terms::density_diffusion>,
     Default{"0.1; none with \"ida\", of gases and of total-Lagrangian solids"}},
    {"artificial_viscosity", Number{dimension::none, not_negative},
     "alpha. Acts like a kinematic viscosity alpha h c / 8: keep it well below the real one.",
     at<&Terms::artificial_viscosity>, Default{"0; of ideal gases 1, against shocks"}},
    {"quadratic_viscosity", Number{dimension::none, not_negative},
     "beta. Keeps particles of strong shocks apart.", at<&Terms::gas, &GasTerms::quadratic_viscosity>,
     of_gases, Default{"2"}},
    {"artificial_conduction", Number{dimension::none, not_negative},
     "alpha_u. Smooths the energy where the start had a jump.", at<&Terms::gas, &GasTerms::conduction>,
     of_gases, Default{"0.3"}},
    {"motion", Flag{},
     "False: nothing moves, and heat and gas alone are exchanged. For what is slower than any flow.",
     at<&Terms::exchange, &ExchangeTerms::motion>},
    {"gas_escape", Flag{}, "Whether gas that flows (group.permeability) leaves through free surfaces.",
     at<&Terms::exchange, &ExchangeTerms::gas_escape>},
    {"viscous_heat", Flag{}, "What viscous friction takes from the motion heats (group.heat).",
     at<&Terms::exchange, &ExchangeTerms::viscous_heat>},
    {"implicit_conduction", Flag{},
     "Explicit conduction wants dt <= 0.25 h^2 rho c / k; with the temperatures of the end of the step, "
     "found by "
     "iterations, it limits none. A front that freezes should still pass a spacing in no less than two "
     "steps.",
     at<&Terms::exchange, &ExchangeTerms::implicit_conduction>},
    {"implicit_gas_flow", Flag{},
     "The same of gas that flows (group.permeability): steps then change no gas content by more than 5 % of "
     "the "
     "largest, and are at most 20 explicit limits long. Pays where the gas spreads faster than 0.4 c h.",
     at<&Terms::exchange, &ExchangeTerms::implicit_gas_flow>},
    {"exchange_tolerance",
     Number{dimension::none, {.least = 1e-12, .most = 0.01, .is = "it is a share of what a step changes,"}},
     "Of implicit conduction and gas flow: stop when the error is this share of what a step changes. Heat "
     "and gas "
     "are conserved to rounding with any.",
     at<&Terms::exchange, &ExchangeTerms::tolerance>},
    {"shifting", Flag{},
     "Keeps particles evenly spread, also where the pressure is negative, and a closed box as full as it "
     "was. Near a free surface, that is where the start leaves a lattice point inside empty, or has movers "
     "at an edge that is neither periodic nor walled, it acts along the surface alone. Its length follows "
     "how fast neighbours part, up to c/10 and to how much all velocities differ: the same in every frame, "
     "and 0 in rigid motion and at rest. It still stirs disordered fluids that come to rest.",
     at<&Terms::shifting>},
    {"viscosity", Words{viscosity_form_words},
     "How viscous forces are summed. \"laplacian\": the more accurate inside; \"symmetric\": right where "
     "viscosity jumps and at free surfaces, where the other damps waves at half their rate.",
     at<&Terms::viscous, &ViscousForces::form>, of_viscous_forms,
     Default{"\"laplacian\" where all groups are equally viscous, else \"symmetric\""}},
    {"implicit_viscosity", Flag{},
     "For scenes without solids. Explicit viscosity wants dt <= h^2 / (8 nu); viscous forces of the end of "
     "the step, found by iterations, limit no step (bulk_viscosity does). It pays where nu > 0.3 c h or "
     "so. Not with walls that slip; in mixed precision up to nu dt / h^2 = 1e5.",
     at<&Terms::viscous, &ViscousForces::implicit>, of_flows},
    {"viscosity_tolerance",
     Number{dimension::none, {.least = 1e-12, .most = 0.1, .is = "it is a share of the forces,"}},
     "Of implicit viscosity: stop when the error is this share of the forces; in mixed precision 1e-6 at "
     "least.",
     at<&Terms::viscous, &ViscousForces::tolerance>},
    {"pressure_weights", Words{pressure_weights_words},
     "For scenes without solids. \"density\" weighs each pressure by the other's density: quiet interfaces "
     "between fluids of different density.",
     at<&Terms::pressure_weights>, of_flows},
    {"hourglass", Number{dimension::none, up_to(1, "it is a share of the modulus,")},
     "Total-Lagrangian solids: stiffness against motion that the stress does not see, over K + 4/3 mu; "
     "with the default plates bend as they should.",
     at<&Terms::bonds, &BondTerms::hourglass>, of_total, Default{"1.75 mu over that, at most 1"}},
    {"bond_reach", Number{dimension::none, {.least = 1.5, .most = 6, .is = "it is a number of spacings,"}},
     "Total-Lagrangian solids: how far the bonds of a particle reach in the reference state, in spacings. "
     "1.9 for bodies "
     "on lattices, 2.4 where particles lie at random.",
     at<&Terms::bonds, &BondTerms::reach>, of_total,
     Default{"the kernel's radius; of solids that can fail 1.9"}},
    {"largest_stretch", Number{dimension::none, {.least = 1, .most = 2, .is = "it is a ratio of lengths,"}},
     "Total-Lagrangian solids: how far bonds may be stretched. Lists reach so much further; a "
     "bond that is longer ends the run.",
     at<&Terms::bonds, &BondTerms::largest_stretch>, of_total},
    {"surface_tension", Inner{&surface_tension}, "For scenes of fluids.", of_flows, Default{"none"}},
});
inline constexpr Table<Terms> terms{
    {"terms", false, "What acts between particles of fluids and solids.", terms_keys}};

}  // namespace sph::keys
