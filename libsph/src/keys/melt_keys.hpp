// Keys of [melt] and [[melt.side]].
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

inline constexpr auto melt_side_keys = std::to_array<Key>({
    {"side", Words{melt_side_words}, "Of the domain: lower (0) or upper (1) along an axis without period.",
     at<&MeltSide::side>, required},
    {"slip", Flag{}, "Nothing holds the melt there; false: it is at rest.", at<&MeltSide::slip>},
    {"temperature", Number{dimension::temperature}, "It is kept.", at<&MeltSide::temperature>,
     Default{"none; without heat_flux no heat passes"}},
    {"heat_flux", Number{dimension::temperature_flux},
     "What comes in through the side, over the heat capacity of a volume.", at<&MeltSide::heat_flux>,
     Default{"0"}},
});
inline constexpr Table<MeltSide> melt_side{{"melt.side", true, "A side of the domain.", melt_side_keys}};

inline constexpr auto melt_table_keys = std::to_array<Key>({
    {"cells", Copies{},
     "Along each axis, m 2^k with the same k of 1 or more and m from 4 to 7: [64, 96]. At most 1.5 times as "
     "long as wide.",
     at<&MeltControl::cells>, required},
    {"tolerance",
     Number{dimension::none, {.least = 1e-12, .most = 0.1, .is = "it is a share of the forces,"}},
     "Of the flow: its residual over what drives it.", at<&MeltControl::tolerance>},
    {"most_iterations", Whole{1, 100000}, "Of a step: a run that needs more ends.",
     at<&MeltControl::most_iterations>},
    {"courant",
     Number{dimension::none, {.least = 0, .most = 0.5, .above_least = true, .is = "it is in cells,"}},
     "Largest way of the melt in a step, summed over the axes.", at<&MeltControl::courant>},
    {"diffusivity", Number{dimension::diffusivity, not_negative},
     "kappa of heat; 0: there is none. Steps are at most a tenth of the time in which it crosses the domain.",
     at<&MeltControl::diffusivity>},
    {"expansion", Number{dimension::per_temperature, not_negative},
     "alpha: rho = rho_0 (1 - alpha (T - T_0)).", at<&MeltControl::expansion>},
    {"reference_temperature", Number{dimension::temperature}, "T_0.",
     at<&MeltControl::reference_temperature>},
    {"viscosity_fall", Number{dimension::per_temperature, not_negative}, "b: eta = eta_0 exp(-b (T - T_0)).",
     at<&MeltControl::viscosity_fall>},
    {"profile", Words{melt_profile_words},
     "Of the temperature at the start: that of each group, or what is conducted along the last axis between "
     "its two "
     "sides, which have temperatures then.",
     at<&MeltControl::start, &MeltStart::profile>},
    {"mixture", Words{melt_mixture_words},
     "Of two melts at the start: each region is of its group, or the share of the second grows evenly along "
     "the "
     "last axis, from none at its lower to all at its upper side.",
     at<&MeltControl::start, &MeltStart::mixture>},
    {"wave_height", Number{dimension::length},
     "At the start everything is displaced along the last axis by wave_height cos(2 pi x / wave_length), in "
     "3D "
     "times cos(2 pi y / wave_length).",
     at<&MeltControl::start, &MeltStart::wave_height>},
    {"wave_length", Number{dimension::length, positive}, "Of that.",
     at<&MeltControl::start, &MeltStart::wave_length>, Default{"required with wave_height"}},
    {"side", Inner{&melt_side}, "Sides that are not slippery, or let heat pass."},
});
inline constexpr Table<MeltControl> melt_table{
    {"melt", false,
     "Melts flow slowly, without inertia, on a grid that fills the domain. Two melts mix in no other way "
     "than by the "
     "grid; density and the logarithm of viscosity follow their shares of a cell.",
     melt_table_keys}};

}  // namespace sph::keys
