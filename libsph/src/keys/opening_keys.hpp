// Keys of [[inlet]], [[insertion]] and [[outlet]].
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

inline constexpr auto inlet_keys = std::to_array<Key>({
    {"lower", Vector{dimension::length}, "A corner of the box: lower <= x < upper.", at<&Inlet::lower>,
     required},
    {"upper", Vector{dimension::length},
     "Its other corner. Along the direction it is a whole number of spacings long, at least as far as the "
     "kernel "
     "reaches.",
     at<&Inlet::upper>, required},
    {"direction", Words{direction_words}, "Where it flows.", at<&Inlet::direction>, required},
    {"group", NameOf{"group"}, "The fluid that comes in, with which the start fills the box.",
     index_at<&Inlet::group>, required},
    {"velocity", curve_of_time,
     "Mean over the box [m/s], 0 or more, straight between times; the pressure is then that of what is "
     "beside.",
     Default{"required, or pressure"}},
    {"pressure", curve_of_time,
     "At the middle of the box [Pa], above that of the surface; what is beside then says how fast it flows "
     "in.",
     Default{"from what is beside"}},
    {"profile", Words{inlet_profile_words},
     "Of the velocity across the box: \"parabolic\" is 0 at faces that are no period, 3/2 of the mean "
     "between two.",
     at<&Inlet::profile>},
    {"temperature", Number{dimension::temperature, not_negative}, "Of what comes in, where there is heat.",
     at<&Inlet::temperature>, Default{"that of the group"}},
    {"gas_content",
     Number{dimension::none,
            {.least = 0, .most = 1, .below_most = true, .is = "it is a mass per mass of liquid,"}},
     "m of bubbly fluid that comes in.", at<&Inlet::gas_content>, Default{"that of the group"}},
});
inline constexpr Table<Inlet> inlet{{"inlet", true,
                                     "A box full of fluid that flows in through the end of the box. Each "
                                     "particle that does is followed by a new one "
                                     "at its beginning. Behind the box is nothing, or a wall.",
                                     inlet_keys}};

inline constexpr auto outlet_keys = std::to_array<Key>({
    {"lower", Vector{dimension::length}, "A corner of the box: lower <= x < upper.", at<&Outlet::lower>,
     required},
    {"upper", Vector{dimension::length}, "Its other corner.", at<&Outlet::upper>, required},
    {"pressure", curve_of_time,
     "At the middle of the box [Pa], above that of the surface: fluid in the box is led on to its end, and "
     "takes sound "
     "out.",
     of_fluids, Default{"none: what is in the box after a step is deleted"}},
    {"direction", Words{direction_words}, "With a pressure: where it flows.", at<&Outlet::direction>,
     of_fluids, Default{"required with a pressure"}},
    {"settle_time", Number{dimension::time, positive},
     "In so long the pressure comes back to what is given. Waves that are slow against it are thrown back.",
     at<&Outlet::settle_time>, of_fluids, Default{"1000 h over the fastest sound of a fluid"}},
    {"every", Number{dimension::time, positive},
     "Grains in the box are deleted so often. Lists of neighbours are made anew whenever grains are, so that "
     "a box that they "
     "need a while to cross costs less so.",
     at<&Outlet::every>, of_grains, Default{"after each step"}},
});
inline constexpr Table<Outlet> outlet{
    {"outlet", true, "A box in which fluids, updated solids and grains are deleted; budgets count them.",
     outlet_keys}};

inline constexpr auto insertion_keys = std::to_array<Key>({
    {"lower", Vector{dimension::length}, "A corner of the box, in the domain.", at<&Insertion::lower>,
     required},
    {"upper", Vector{dimension::length}, "Its other corner. Grains are all in the box when they come.",
     at<&Insertion::upper>, required},
    {"group", NameOf{"group"}, "The grains that come in.", index_at<&Insertion::group>, required},
    {"rate", curve_of_time,
     "Mass per time [kg/s], 0 or more, straight between times. What finds no place in the box does not come.",
     required},
    {"velocity", Vector{dimension::speed}, "With which they come.", at<&Insertion::velocity>},
    {"every", Number{dimension::time, positive},
     "What comes in so long a time is put into the box at once, at its beginning.", at<&Insertion::every>,
     Default{"in which grains of this velocity fall out of the box"}},
});
inline constexpr Table<Insertion> insertion{
    {"insertion", true,
     "A box in which grains appear: at random places where they touch neither each other nor what is there.",
     insertion_keys}};

}  // namespace sph::keys
