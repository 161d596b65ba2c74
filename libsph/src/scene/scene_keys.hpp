// Every key of a scene, by table: what is not listed here is a misspelling. A new key needs an entry here, a
// reader, a line in to_toml and one in the commented reference scene.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace sph {

struct KeyTable {
  std::string_view name;  ///< as in the header of the table, empty for the top level
  std::span<const std::string_view> keys;
};

namespace scene_keys {

using Word = std::string_view;

inline constexpr auto top_list = std::to_array<Word>(
    {"title", "dimension", "formulation", "precision", "kernel", "domain", "group", "start", "terms", "time",
     "decomposition", "output", "monitor", "contact", "wall", "stage"});
inline constexpr auto kernel_list =
    std::to_array<Word>({"shape", "smoothing_length", "h_over_dx", "least_growth", "largest_growth"});
inline constexpr auto domain_list = std::to_array<Word>(
    {"lower", "upper", "periodic", "gravity", "central_pull", "pull_centre", "surface_pressure"});
inline constexpr auto group_list = std::to_array<Word>({"name",
                                                        "kind",
                                                        "eos",
                                                        "density",
                                                        "bulk_modulus",
                                                        "sound_speed",
                                                        "viscosity",
                                                        "bulk_viscosity",
                                                        "poisson_ratio",
                                                        "shear_modulus",
                                                        "heat_ratio",
                                                        "start_pressure",
                                                        "gas_content",
                                                        "gas_rt",
                                                        "solubility_pressure",
                                                        "solubility_exponent",
                                                        "fragmentation",
                                                        "velocity",
                                                        "slip",
                                                        "lagrangian",
                                                        "clamps",
                                                        "diameter",
                                                        "young_modulus",
                                                        "normal_stiffness",
                                                        "tangential_stiffness",
                                                        "restitution",
                                                        "friction",
                                                        "rolling_friction",
                                                        "fixed"});
inline constexpr auto fragmentation_list = std::to_array<Word>({"void_fraction", "group"});
inline constexpr auto start_list = std::to_array<Word>(
    {"lattice", "spacing", "origin", "lower", "upper", "region", "jitter", "seed", "file", "velocity",
     "flow_speed", "flow_length", "pressure", "surface_height", "layer", "free_surface", "tile"});
inline constexpr auto layer_list = std::to_array<Word>({"group", "top"});
inline constexpr auto region_list =
    std::to_array<Word>({"group", "shape", "lower", "upper", "centre", "radius"});
inline constexpr auto terms_list = std::to_array<Word>(
    {"density_diffusion", "artificial_viscosity", "quadratic_viscosity", "artificial_conduction", "shifting",
     "viscosity", "implicit_viscosity", "viscosity_tolerance", "pressure_weights", "surface_tension",
     "hourglass", "largest_stretch"});
inline constexpr auto surface_tension_list = std::to_array<Word>({"between", "coefficient", "form"});
inline constexpr auto time_list = std::to_array<Word>({"dt", "cfl", "until", "steps"});
inline constexpr auto decomposition_list =
    std::to_array<Word>({"cut_axes", "skin", "rebuild_every", "overlap", "balance", "cost", "chaos_seed",
                         "slow_rank", "slowness", "record", "replay"});
inline constexpr auto output_list =
    std::to_array<Word>({"snapshot_interval", "series_interval", "checkpoint_interval", "status_interval",
                         "average_time", "average_space", "sort_limit", "checkpoint_files", "contacts"});
inline constexpr auto monitor_list =
    std::to_array<Word>({"name", "kind", "id", "nearest_to", "group", "wall"});
inline constexpr auto contact_list = std::to_array<Word>(
    {"law", "normal_damping", "tangential_damping", "rolling_damping", "pull", "largest_overlap", "pair"});
inline constexpr auto contact_pair_list =
    std::to_array<Word>({"groups", "friction", "rolling_friction", "restitution"});
inline constexpr auto wall_list =
    std::to_array<Word>({"name", "material", "shape", "point", "normal", "velocity", "force", "servo_gain",
                         "largest_speed", "lower", "upper", "open"});
inline constexpr auto stage_list = std::to_array<Word>({"name", "begin", "wall"});
inline constexpr auto stage_wall_list = std::to_array<Word>({"name", "velocity", "force", "remove"});
inline constexpr auto tile_list = std::to_array<Word>({"file", "repeat"});

inline constexpr KeyTable top{"", top_list};
inline constexpr KeyTable kernel{"kernel", kernel_list};
inline constexpr KeyTable domain{"domain", domain_list};
inline constexpr KeyTable group{"group", group_list};
inline constexpr KeyTable fragmentation{"group.fragmentation", fragmentation_list};
inline constexpr KeyTable start{"start", start_list};
inline constexpr KeyTable layer{"start.layer", layer_list};
inline constexpr KeyTable region{"start.region", region_list};
inline constexpr KeyTable terms{"terms", terms_list};
inline constexpr KeyTable surface_tension{"terms.surface_tension", surface_tension_list};
inline constexpr KeyTable time{"time", time_list};
inline constexpr KeyTable decomposition{"decomposition", decomposition_list};
inline constexpr KeyTable output{"output", output_list};
inline constexpr KeyTable monitor{"monitor", monitor_list};
inline constexpr KeyTable contact{"contact", contact_list};
inline constexpr KeyTable contact_pair{"contact.pair", contact_pair_list};
inline constexpr KeyTable wall{"wall", wall_list};
inline constexpr KeyTable stage{"stage", stage_list};
inline constexpr KeyTable stage_wall{"stage.wall", stage_wall_list};
inline constexpr KeyTable tile{"start.tile", tile_list};

inline constexpr std::array all{top,   kernel, domain,        group,  fragmentation,   start,   region,
                                terms, time,   decomposition, output, monitor,         contact, contact_pair,
                                wall,  stage,  stage_wall,    tile,   surface_tension, layer};

}  // namespace scene_keys
}  // namespace sph
