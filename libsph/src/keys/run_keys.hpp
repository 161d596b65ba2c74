// Keys of [decomposition], [output] and [[monitor]]: they change the speed and the files of a run, never its
// particles.
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

constexpr Whole at_most(std::int64_t most) { return {0, most}; }
inline constexpr Whole count = at_most(std::numeric_limits<int>::max());

inline constexpr auto decomposition_keys = std::to_array<Key>({
    {"cut_axes",
     Special{
         "an array of two axes", R"(["x", "y"])",
         R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"enum": ["x", "y", "z", 0, 1, 2]}})"},
     "Axes that are cut between ranks.", Default{"both in 2D, those across gravity in 3D"}},
    {"skin",
     Number{dimension::none,
            up_to(2, "it is a fraction of the kernel's radius (of grains: the largest diameter),")},
     "Margin of the neighbour lists, in kernel radii, of grains in largest diameters.",
     at<&Decomposition::skin>,
     Default{"0.1; 0.2 of ideal gases; 0.2 to 0.3 of grains, the more alike the more"}},
    {"rebuild_every", count,
     "0: lists are rebuilt when neighbours may have gone apart by the skin; n: also every n steps.",
     at<&Decomposition::rebuild_every>},
    {"overlap", Flag{}, "Compute while messages travel.", at<&Decomposition::overlap>},
    {"balance", Words{cut_rule_words},
     "Where the cuts lie. \"quasi_newton\": follow the measured cost; \"hybrid\": the best cuts for a "
     "fitted cost of each cell; \"literal\": the rule of Furuichi and Nishiura as printed; \"fixed\": "
     "stay; \"chaos\": random at every rebuild (for tests); \"replay\": as recorded.",
     at<&Decomposition::cuts>},
    {"cost", Words{cost_source_words}, "What is balanced: measured time, or counts of particles and pairs.",
     at<&Decomposition::cost>},
    {"chaos_seed", Whole{}, "Of balance = \"chaos\".", at<&Decomposition::chaos_seed>},
    {"slow_rank", count, "For tests of the balance: this rank takes longer.", at<&Decomposition::slow_rank>},
    {"slowness",
     Number{dimension::none, {.least = 1, .most = 1000, .is = "it multiplies the time of one rank,"}},
     "slow_rank takes so many times as long.", at<&Decomposition::slowness>},
    {"record", File{}, "Write the cuts of every rebuild to it. A run that goes on adds to it.",
     at<&Decomposition::record>},
    {"replay", File{}, "The file for balance = \"replay\".", at<&Decomposition::replay>},
});
inline constexpr Table<Decomposition> decomposition{
    {"decomposition", false, "How the work is shared between ranks; no key of it changes a particle.",
     decomposition_keys}};

inline constexpr auto output_keys = std::to_array<Key>({
    {"snapshot_interval", Number{dimension::time, not_negative}, "Time of the scene; 0: only the last state.",
     at<&OutputControl::snapshot_interval>},
    {"series_interval", Number{dimension::time, not_negative},
     "Time of the scene between lines of series.csv; 0: every step.", at<&OutputControl::series_interval>},
    {"checkpoint_interval", Number{dimension::time, not_negative}, "Time of the clock; 0: only the last.",
     at<&OutputControl::checkpoint_interval>},
    {"status_interval", Number{dimension::time, not_negative}, "Time of the clock between status lines.",
     at<&OutputControl::status_interval>},
    {"average_time", Number{dimension::time, not_negative},
     "Window of the running averages in snapshots; 0: none.", at<&OutputControl::average_time>},
    {"average_space", Flag{}, "Averages over neighbours of the same group in snapshots.",
     at<&OutputControl::average_space>, sph_only("it averages with the kernel, and grains have none")},
    {"contacts", Flag{},
     "Snapshots hold the contacts with their forces, and the stress of the grains, xx yy zz xy yz xz.",
     at<&OutputControl::contacts>, of_grains},
    {"sort_limit", Whole{}, "Rows up to which snapshots are sorted by id.", at<&OutputControl::sort_limit>},
    {"compression", at_most(9),
     "Snapshots hold their rows compressed, without loss, at this level of gzip, 1 to 9; 0: as they are.",
     at<&OutputControl::compression>},
    {"checkpoint_files", at_most(65536), "0: one per 512 ranks.", at<&OutputControl::checkpoint_files>},
});
inline constexpr Table<OutputControl> output{{"output", false, "When files are written.", output_keys}};

inline constexpr auto monitor_keys = std::to_array<Key>({
    {"name", Text{}, "Letters, digits, _ and -.", at<&Monitor::name>, Default{"the kind"}},
    {"kind", Words{monitor_kind_words},
     "\"group\": averages over it. \"flux\": what passes a rectangle. Of fluids: \"gauge\": what is at a "
     "point, or along a line; \"level\": how "
     "high above a point the surface is. Of grains: \"wall\": its place, its velocity and the force of the "
     "grains on it; \"body\": the same of a rigid solid, with its rotation and torque; \"contacts\": their "
     "number, that with walls, and the mean of a grain. Of melts \"melt\". Of heat \"budget\": "
     "what there is, and "
     "what came from outside.",
     at<&Monitor::kind>, required},
    {"id", Whole{}, "The particle with this id.", at<&Monitor::id>, where("kind", "particle"),
     Default{"required of a particle, or nearest_to"}},
    {"nearest_to", Vector{dimension::length},
     "The particle nearest to this point at the start, lowest id on ties.", at<&Monitor::nearest_to>,
     where("kind", "particle"), Default{"required of a particle, or id"}},
    {"group", NameOf{"group"}, "The group that is averaged, or the rigid body that is watched.",
     index_at<&Monitor::group>, among("kind", "group", "body"), required},
    {"wall", NameOf{"wall"}, "The wall that is watched.", index_at<&Monitor::wall>, where("kind", "wall"),
     required},
    {"at", Vector{dimension::length}, "The point of the gauge; a level is measured from it, against gravity.",
     at<&Monitor::at>, among("kind", "gauge", "level"), required},
    {"to", Vector{dimension::length}, "The other end of a line of gauges.", at<&Monitor::to>,
     where("kind", "gauge"), Default{"none: one point"}},
    {"points", Whole{2, 1000}, "On the line, both ends included.", at<&Monitor::points>,
     where("kind", "gauge"), Default{"11, with `to`"}},
    {"lower", Vector{dimension::length}, "A corner of the rectangle, in 2D an end of the line.",
     at<&Monitor::lower>, where("kind", "flux"), required},
    {"upper", Vector{dimension::length},
     "The corner across: the same along the one axis that the rectangle is normal to.", at<&Monitor::upper>,
     where("kind", "flux"), required},
});
inline constexpr Table<Monitor> monitor{{"monitor", true, "Columns of series.csv.", monitor_keys}};

}  // namespace sph::keys
