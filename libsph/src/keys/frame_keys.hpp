// Keys of [kernel], [domain] and [time].
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

inline constexpr auto kernel_keys = std::to_array<Key>({
    {"shape", Words{kernel_shape_words}, "The quintic has a radius of 3 h, the other two of 2 h.",
     at<&KernelControl::shape>},
    {"h_over_dx", Number{dimension::none, positive},
     "Smoothing length h in spacings, 0.5 to 4; 1.0 to 1.2 is usual for the quintic.",
     Default{"required, or smoothing_length"}},
    {"smoothing_length", Number{dimension::length, positive}, "h itself.",
     at<&KernelControl::smoothing_length>, Default{"required, or h_over_dx"}},
    {"least_growth", Number{dimension::none, {.least = 0.05, .most = 1}},
     "The kernel of a particle of an ideal gas is as wide as the particle is large, from least_growth h to "
     "largest_growth h. Tubes of rows that stay rows want 1.",
     at<&KernelControl::least_growth>, of_gases, Default{"0.05; 1 beside walls"}},
    {"largest_growth", Number{dimension::none, {.least = 1, .most = 20}},
     "Gas thinner than largest_growth^-D of what it was at the start keeps its heat: a point blast of R/dx "
     "= 20, 40, 80 wants 3, 5, 8. Periods and cells follow it. Walls must be thicker than the widest "
     "kernel; beside them one h, with which blasts lose kinetic energy, is the default.",
     at<&KernelControl::largest_growth>, of_gases,
     Default{"3, less where a period is too short for it; 1 beside walls"}},
});
inline constexpr Table<KernelControl> kernel{
    {"kernel", false, "The kernel of fluids and solids; one of h_over_dx and smoothing_length is required.",
     kernel_keys}};

inline constexpr auto domain_keys = std::to_array<Key>({
    {"lower", Vector{dimension::length}, "Particles that leave the domain end the run, or see leaves.",
     at<&Domain::lower>, required},
    {"upper", Vector{dimension::length}, "Above lower in each direction.", at<&Domain::upper>, required},
    {"periodic", Flags{},
     "A period must be at least three cells of kernel radius (of grains: largest diameter) times 1 + "
     "decomposition.skin long.",
     at<&Domain::periodic>, Default{"none"}},
    {"leaves",
     Special{
         R"("stop", "delete" or an array of faces)", R"(["x1", "y1"])",
         R"({"anyOf": [{"enum": ["stop", "delete"]}, {"type": "array", "items": {"enum": ["x0", "x1", "y0", "y1", "z0", "z1"]}}]})"},
     "What a particle does that leaves the domain: \"stop\" ends the run, \"delete\" takes it out at the end "
     "of the "
     "step, an array says through which faces it does, at the lower (0) or upper (1) end of an axis. Bodies "
     "with "
     "lagrangian = \"total\" and fixed grains always end the run.",
     of_openings, Default{"\"stop\""}},
    {"gravity", Vector{dimension::acceleration}, "Also serves as a body force along a period.",
     at<&Domain::gravity>},
    {"central_pull", Number{dimension::rate_squared, not_negative},
     "Acceleration -central_pull (x - pull_centre) of fluids without walls.", at<&Domain::central_pull>,
     of_fluids},
    {"pull_centre", Vector{dimension::length}, "Of central_pull.", of_fluids, Default{"0"}},
    {"surface_pressure", Number{dimension::pressure, not_negative},
     "The atmosphere, added in every equation of state.", at<&Domain::surface_pressure>,
     sph_only("grains have no equation of state")},
    {"background_density", Number{dimension::density, positive},
     "rho_b: gravity acts as g (1 - rho_b / rho_0), on gas as it is, pressures are the excess over that of a "
     "background at "
     "rest, "
     "which gas feels too. Densities and moduli of liquids and solids are then those in place, and their "
     "sound "
     "need not be fast against sqrt(g H). Fluids and updated solids without free surface, grains and ideal "
     "gases; not \"ida\".",
     at<&Domain::background, &Background::density>, of_fluids, Default{"none"}},
    {"background_surface", Number{dimension::length},
     "Height against gravity where the background's pressure is surface_pressure.", of_fluids,
     Default{"required of bubbly fluids"}},
});
inline constexpr auto reset_keys = std::to_array<Key>({
    {"lower", Vector{dimension::length}, "A corner of the box: lower <= x < upper.", at<&Reset::lower>,
     required},
    {"upper", Vector{dimension::length}, "Its other corner.", at<&Reset::upper>, required},
    {"temperature", Number{dimension::temperature, not_negative}, "Of fluids and solids in it.",
     at<&Reset::temperature>, Default{"as it is; one of the four is required"}},
    {"gas_content",
     Number{dimension::none,
            {.least = 0, .most = 1, .below_most = true, .is = "it is a mass per mass of liquid,"}},
     "m of bubbly fluids in it.", at<&Reset::gas_content>, Default{"as it is"}},
    {"pressure", Number{dimension::pressure, not_negative},
     "Of fluids in it, above that of the surface, at constant volume: as much mass comes in as that takes. "
     "Not of ideal "
     "gases.",
     at<&Reset::pressure>, Default{"as it is"}},
    {"inflow", curve_of_time,
     "What comes into the fluids in it, together [kg/s; in two dimensions of a metre of depth], at constant "
     "volume, as from a pump; "
     "0 or more, straight between times. There must be fluid in the box as long as any is to come, which "
     "grows by it and is not split. Not of ideal gases.",
     Default{"none"}},
    {"until", Number{dimension::time, positive}, "Then the box does nothing any more.", at<&Reset::until>,
     Default{"the end"}},
    {"rise_time", Number{dimension::time, not_negative},
     "For so long the pressure grows from 0, and what has more keeps it.", at<&Reset::rise_time>},
});
inline constexpr Table<Reset> reset{
    {"reset", true,
     "A box in which particles have another temperature, gas content or pressure after each step, or more "
     "mass: what flows "
     "along a "
     "period comes in as new, a chamber feeds what leaves it. Velocity stays; a budget counts what comes in.",
     reset_keys}};

inline constexpr Table<Domain> domain{
    {"domain", false, "The box that holds everything, and its gravity.", domain_keys}};

inline constexpr auto time_keys = std::to_array<Key>({
    {"dt", Number{dimension::time, positive}, "A fixed step, instead of cfl.", at<&TimeControl::dt>,
     Default{"from cfl; of grains a fraction of the shortest contact"}},
    {"cfl", Number{dimension::none, positive}, "dt = cfl h / (c + u).", at<&TimeControl::cfl>,
     sph_only("grains have no speed of sound; give dt, or neither")},
    {"until", Number{dimension::time, not_negative}, "Stop at the first step with t >= until.",
     at<&TimeControl::until>, Default{"required, or steps"}},
    {"steps", Whole{}, "Stop after so many steps; with until too, the first of both ends.",
     at<&TimeControl::steps>, Default{"required, or until"}},
});
inline constexpr Table<TimeControl> time{
    {"time", false, "Step and end; one of until and steps is required.", time_keys}};

}  // namespace sph::keys
