// Keys of [contact], [[wall]] and [[stage]].
#pragma once

#include "keys/conditions.hpp"
#include "keys/law_keys.hpp"

namespace sph::keys {

inline constexpr auto pair_keys = std::to_array<Key>({
    {"groups", TwoGroups{R"(the names of two groups, like ["sand", "glass"])", true},
     "Both names may be the same.", at<&ContactPair::groups>, required},
    {"friction", Number{dimension::none, not_negative}, "Coulomb's mu between the two.",
     at<&ContactPair::friction>, Default{"the smaller of the two"}},
    {"rolling_friction", Number{dimension::none, not_negative}, "mu_r between the two.",
     at<&ContactPair::rolling_friction>, Default{"the smaller of the two"}},
    {"restitution", Number{dimension::none, {.least = 0, .most = 1, .above_least = true}}, "Between the two.",
     at<&ContactPair::restitution>, of_restitution, Default{"the smaller of the two"}},
});
inline constexpr Table<ContactPair> contact_pair{
    {"contact.pair", true, "Replaces what two groups make of each other; at least one value is given.",
     pair_keys}};

inline constexpr auto contact_keys = std::to_array<Key>({
    {"law", law_words<ContactLaw>,
     "\"linear\": springs; \"hertz\": Hertz and Mindlin, elastic spheres; \"walton_braun\": latched springs, "
     "k_n while a contact loads, k_n / e^2 as it unloads.",
     at<&ContactControl::law>, required},
    {"normal_damping", Number{dimension::rate, not_negative}, "gamma_n of the linear law, for all contacts.",
     at<&ContactControl::normal_damping>, of_inertia, Default{"from the restitution of the groups"}},
    {"tangential_damping", Number{dimension::none, up_to(1, "it is a fraction of the normal dashpot,")},
     "Dashpot along the contact plane, as a fraction of the normal one.",
     at<&ContactControl::tangential_damping>, of_dashpots},
    {"rolling_damping", Number{dimension::none, up_to(1, "it is a fraction of the critical dashpot,")},
     "Dashpot of the rolling resistance, as a fraction of the critical one.",
     at<&ContactControl::rolling_damping>, of_inertia},
    {"pull", Flag{}, "A dashpot may pull while a contact opens.", at<&ContactControl::pull>, of_dashpots},
    {"largest_overlap",
     Number{dimension::none,
            {.least = 0, .most = 0.5, .above_least = true, .is = "it is in radii of the smaller grain,"}},
     "In radii of the smaller grain: beyond it the run stops.", at<&ContactControl::largest_overlap>},
    {"pair", Inner{&contact_pair}, "Two groups that differ from what is usual."},
});
inline constexpr Table<ContactControl> contact{
    {"contact", false, "One law for all contacts, of grains and with walls.", contact_keys}};

inline constexpr auto drag_keys = std::to_array<Key>({
    {"law", law_words<DragLaw>,
     "\"stokes\": a sphere alone in a creeping flow; \"di_felice\": any Reynolds number and porosity; "
     "\"gidaspow\": Ergun in beds, Wen and Yu where grains are few; \"richardson_zaki\" and \"beetstra\": "
     "slow "
     "flow at any porosity; \"none\": fluid and grains do not act on each other.",
     at<&DragControl::law>, required},
    {"own_disturbance", Flag{},
     "Takes out what a grain itself does to the fluid that it is dragged by, without which one grain settles "
     "too fast.",
     at<&DragControl::own_disturbance>},
    {"packed_fraction",
     Number{dimension::none, {.least = 0.1, .most = 1, .is = "it is a share of the volume,"}},
     "phi_m: viscosity rises with the share phi of grains as 1 + 2.5 phi / (1 - phi / phi_m), with 0.05 at "
     "least below the line.",
     at<&DragControl::packed_fraction>, of_suspensions},
});
inline constexpr Table<DragControl> drag{{"drag", false,
                                          "Grains in a fluid or in melts, both averaged over a kernel: the "
                                          "force of the fluid on the grains and theirs on it.",
                                          drag_keys}};

inline constexpr Where of_boxes = where("shape", "box");
inline constexpr Where of_planes = where("shape", "plane", "; a box has lower and upper");
inline constexpr Where unless_box =
    unless("shape", "box", "a box rests; leave a side open and give it a [[wall]] of its own");

inline constexpr auto wall_keys = std::to_array<Key>({
    {"name", Text{}, "A letter, then letters, digits, _ or -.", at<&Wall::name>, required},
    {"material", NameOf{"group", false, true}, "A group of grains, with or without diameter.",
     index_at<&Wall::group>, required},
    {"shape", Words{wall_shape_words},
     "\"box\": a plane on each side without period, facing inwards, called box_x0, box_x1, box_y0, ... of "
     "a wall \"box\". It rests."},
    {"point", Vector{dimension::length}, "Any point of the plane.", at<&Wall::point>, of_planes, required},
    {"normal", Vector{dimension::none}, "Of any length, to the side of the grains, 0 along a period.",
     at<&Wall::normal>, of_planes, required},
    {"velocity", Vector{dimension::speed},
     "The part along the normal moves the plane, the rest drags grains.", unless_box, Default{"0"}},
    {"force", Number{dimension::force, positive},
     "Instead of velocity: a servo moves the plane along its normal until the grains press on it with this.",
     at<&Wall::force>, unless_box},
    {"servo_gain", Number{dimension::speed_per_force, positive}, "Of a servo: speed per excess of force.",
     at<&Wall::servo_gain>, unless_box, Default{"required of a servo"}},
    {"largest_speed", Number{dimension::speed, positive}, "Of a servo.", at<&Wall::largest_speed>, unless_box,
     Default{"required of a servo"}},
    {"lower", Vector{dimension::length}, "Of a box, within the domain.", of_boxes, required},
    {"upper", Vector{dimension::length}, "Of a box.", of_boxes, required},
    {"open",
     Special{"an array of sides", R"(["z1"])",
             R"({"type": "array", "items": {"enum": ["x0", "x1", "y0", "y1", "z0", "z1"]}})"},
     "Sides of a box that are left out.", of_boxes},
});
inline constexpr Table<Wall> wall{
    {"wall", true, "Planes; grains stay on the side to which the normal points.", wall_keys}};

inline constexpr auto stage_wall_keys = std::to_array<Key>({
    {"name", NameOf{"wall"}, "The wall that changes.", index_at<&WallChange::wall>, required},
    {"velocity", Vector{dimension::speed}, "Its velocity from now on.", at<&WallChange::velocity>},
    {"force", Number{dimension::force, positive}, "Of a wall with servo_gain: it is a servo from now on.",
     at<&WallChange::force>},
    {"remove", Flag{}, "The wall goes, and does not come back.", Default{"false"}},
});
inline constexpr Table<WallChange> stage_wall{
    {"stage.wall", true, "One of velocity, force and remove = true.", stage_wall_keys}};

inline constexpr auto stage_keys = std::to_array<Key>({
    {"name", Text{}, "A letter, then letters, digits, _ or -.", at<&WallStage::name>, required},
    {"begin", Number{dimension::time, not_negative}, "Later than the stage before.", at<&WallStage::begin>,
     required},
    {"wall", Inner{&stage_wall}, "What changes.", Default{"required"}},
});
inline constexpr Table<WallStage> stage{
    {"stage", true, "From a time on, some walls behave otherwise.", stage_keys}};

}  // namespace sph::keys
