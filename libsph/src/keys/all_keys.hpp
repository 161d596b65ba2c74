// The keys of the top level, and the list of all tables in the order in which references show them.
#pragma once

#include "keys/frame_keys.hpp"
#include "keys/grain_keys.hpp"
#include "keys/group_keys.hpp"
#include "keys/melt_keys.hpp"
#include "keys/mesh_keys.hpp"
#include "keys/opening_keys.hpp"
#include "keys/run_keys.hpp"
#include "keys/start_keys.hpp"
#include "keys/term_keys.hpp"

namespace sph::keys {

inline constexpr auto top_keys = std::to_array<Key>({
    {"include",
     Special{"the path of a scene, or an array of paths", R"(["materials.toml", "domain.toml"])",
             R"({"type": ["string", "array"], "items": {"type": "string"}})"},
     "Files that this one adds to, relative to it. What comes last counts, the file itself after what it "
     "includes: tables are merged key by key, and so are elements of arrays of tables that have the same "
     "`name`; other elements are appended, and any other value is replaced. A file that is included twice "
     "counts at its "
     "first place. --set acts last."},
    {"title", Text{}, "Name of the run.", at<&Scene::name>, Default{"the file's name"}},
    {"dimension", Whole{2, 3}, "Grains are spheres, in 3.", at<&Scene::dim>, Default{"2; of grains 3"}},
    {"formulation", Words{formulation_words},
     "\"conservative\": quiet, conserves momentum; \"ida\": the equations of Ida's paper to the letter, "
     "for comparison.",
     at<&Scene::terms, &Terms::formulation>,
     sph_only("it is of SPH; grains follow from [contact], melts from [melt]")},
    {"precision", Words{precision_words}, "Arithmetic of pairs: \"mixed\" is single, on double state.",
     at<&Scene::terms, &Terms::precision>, sph_only("contacts are always computed in double")},
    {"domain", Inner{&domain}, "Where everything happens.", Default{"required"}},
    {"kernel", Inner{&kernel}, "Of fluids and solids.",
     sph_only("there is no kernel where nothing is a fluid or a solid"),
     Default{"required of fluids and solids"}},
    {"contact", Inner{&contact}, "The law of contacts.", of_grains, Default{"required of grains"}},
    {"drag", Inner{&drag}, "Of grains in a fluid or in melts.", of_mixtures, Default{"required of them"}},
    {"melt", Inner{&melt_table}, "Slow flow.", of_melts},
    {"group", Inner{&group}, "The materials.", Default{"required"}},
    {"wall", Inner{&wall}, "Planes and boxes that hold grains.", of_grains},
    {"stage", Inner{&stage}, "Changes of the walls.", of_grains},
    {"mesh", Inner{&mesh}, "Walls of triangles; fluids would pass through them.", of_grains_alone},
    {"reset", Inner{&reset}, "Boxes where matter is renewed.", of_fluids},
    {"inlet", Inner{&inlet}, "Where fluid comes in.", of_inlets},
    {"insertion", Inner{&insertion}, "Where grains come in.", of_grains_alone},
    {"outlet", Inner{&outlet}, "Where particles leave.", of_openings},
    {"start", Inner{&start}, "The first state.", Default{"required"}},
    {"terms", Inner{&terms}, "What acts between particles.",
     sph_only("they are of SPH; grains follow from [contact], melts from [melt]")},
    {"time", Inner{&time}, "Steps and end.", Default{"required"}},
    {"decomposition", Inner{&decomposition}, "Speed on several ranks."},
    {"output", Inner{&output}, "Files of the run."},
    {"monitor", Inner{&monitor}, "Columns of series.csv."},
});
inline constexpr Table<Scene> top{{"", false, "Above the first table.", top_keys}};

inline constexpr std::array<const KeyTable*, 36> all{
    &top,           &domain,          &kernel,       &reset,         &inlet,    &insertion,     &outlet,
    &group,         &becomes,         &permeability, &viscosity_law, &strength, &motion,        &heat,
    &heat_transfer, &radiation,       &start,        &region,        &layer,    &tile,          &fill,
    &terms,         &surface_tension, &contact,      &contact_pair,  &drag,     &melt_table,    &melt_side,
    &wall,          &stage,           &stage_wall,   &mesh,          &time,     &decomposition, &output,
    &monitor};

}  // namespace sph::keys
