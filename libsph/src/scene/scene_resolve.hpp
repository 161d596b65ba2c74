// The steps from a TOML tree to a Scene, one per table; scene_toml.cpp calls them in order.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/toml_reader.hpp"
#include "sph/scene.hpp"

namespace sph {

/// The equation of state of a group that is an ideal gas.
void read_ideal_gas(const TableReader& table, Group& group);
/// Terms against shocks; their defaults depend on whether there is an ideal gas.
void read_growth(const TableReader& kernel, Scene& scene);
void fit_growth(const TableReader& kernel, Scene& scene, double cells);
void read_shock_terms(const TableReader& table, Scene& scene);
/// Refuses what has no meaning beside an ideal gas, once all is read.
void check_ideal_gas(const TableReader& top, const TableReader& domain, const TableReader& start,
                     const TableReader& terms, const Scene& scene);

/// [[group]]: materials; walls without material values take those of the first fluid.
[[nodiscard]] std::vector<Group> read_groups(const TableReader& top, int dim);

/// The index of the group called `name`, which stands in the value of `key`.
[[nodiscard]] int group_of_name(const TableReader& table, std::string_view key, const std::string& name,
                                const std::vector<Group>& groups);
/// The index of the group that `key` names, -1 if the key is absent.
[[nodiscard]] int read_group_name(const TableReader& table, std::string_view key,
                                  const std::vector<Group>& groups);

/// The `name` of an element: a letter followed by letters, digits, _ or -; none of those before it has it.
/// `what` it is ("group") for the message.
[[nodiscard]] std::string read_name(const TableReader& table, std::string_view what,
                                    const std::vector<std::string>& earlier);

/// True if any group has kind = "grain": all of them must then.
[[nodiscard]] bool describes_grains(const TableReader& top);

/// The tables in which scenes of grains and scenes of SPH differ.
struct SharedTables {
  const TableReader &top, &domain, &start, &time, &output;
};
/// Refuses what has a meaning in the other sort of scene only.
void refuse_foreign_keys(const SharedTables& tables, bool grains);

/// A law as the reader sees it.
struct LawWord {
  std::string_view word;
  std::span<const LawKey> keys;
};
/// The constants of a law, from its keys in a [[group]]; refuses those that only other laws of its sort have,
/// among which `choice` ("contact.law") chooses.
[[nodiscard]] LawConstants read_law_constants(const TableReader& table, std::string_view choice,
                                              const LawWord& law, const std::vector<LawWord>& all);
/// Terms that a number in [terms] switches on.
void read_added_terms(const TableReader& table, Scene& scene);
/// `"a", "b" or "c"`
[[nodiscard]] std::string either(const std::vector<std::string>& words);

/// [contact] but for its pairs, which name groups; the materials of grains depend on the law.
[[nodiscard]] ContactControl read_contact_law(const TableReader& table);
[[nodiscard]] std::vector<Group> read_grain_groups(const TableReader& top, const ContactControl& contact);
/// [[contact.pair]], once groups and contact law of `scene` are known. Ends the table.
[[nodiscard]] std::vector<ContactPair> read_contact_pairs(const TableReader& table, const Scene& scene);

/// [[wall]] and [[stage]], once domain and groups are known; stages name walls of `scene`.
[[nodiscard]] std::vector<Wall> read_walls(const TableReader& top, const Scene& scene);
[[nodiscard]] std::vector<WallStage> read_stages(const TableReader& top, const Scene& scene);

/// The index of the wall that `key` names.
[[nodiscard]] int read_wall_name(const TableReader& table, std::string_view key,
                                 const std::vector<Wall>& walls);

/// start.tile, and start.velocity of grains.
[[nodiscard]] Tile read_tile(const TableReader& start, const Scene& scene);
void read_grain_velocity(const TableReader& table, Start& start);

/// [start], once dimension, domain, groups and spacing of `scene` are known.
[[nodiscard]] Start read_start(const TableReader& table, const Scene& scene);

/// [decomposition], once dimension and gravity are known.
[[nodiscard]] Decomposition read_decomposition(const TableReader& table, const Scene& scene);

/// [output] and [[monitor]], once the groups are known.
[[nodiscard]] OutputControl read_output(const TableReader& top, const TableReader& table, const Scene& scene);

/// Words of enumerations, shared by the reader and to_toml.
[[nodiscard]] const Choices<Formulation>& formulation_words();
[[nodiscard]] const Choices<Precision>& precision_words();
[[nodiscard]] const Choices<PressureWeights>& pressure_weights_words();
[[nodiscard]] const Choices<TensionForm>& tension_form_words();
[[nodiscard]] const Choices<KernelShape>& kernel_words();
[[nodiscard]] const Choices<ViscosityForm>& viscosity_words();
[[nodiscard]] const Choices<GroupKind>& group_kind_words();
[[nodiscard]] const Choices<const EquationOfState*>& eos_words();
[[nodiscard]] const Choices<Lagrangian>& lagrangian_words();
[[nodiscard]] const Choices<RegionShape>& region_words();
[[nodiscard]] const Choices<LatticeKind>& lattice_words();
[[nodiscard]] const Choices<CutRule>& cut_rule_words();
[[nodiscard]] const Choices<CostSource>& cost_words();
[[nodiscard]] const Choices<MonitorKind>& monitor_words();
[[nodiscard]] const Choices<const ContactLaw*>& contact_law_words();

/// True if the start leaves a surface where matter meets nothing: an empty lattice point inside, or movers at
/// an edge that is neither periodic nor walled. Large lattices are sampled.
[[nodiscard]] bool has_free_surface(const Scene& scene);

}  // namespace sph
