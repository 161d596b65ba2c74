// The steps from a TOML tree to a Scene, one per table; scene_toml.cpp calls them in order.
#pragma once

#include <string>
#include <vector>

#include "scene/toml_reader.hpp"
#include "sph/scene.hpp"

namespace sph {

/// [[group]]: materials; walls without material values take those of the first fluid.
[[nodiscard]] std::vector<Group> read_groups(const TableReader& top, int dim);

/// The index of the group that `key` names, -1 if the key is absent.
[[nodiscard]] int read_group_name(const TableReader& table, std::string_view key,
                                  const std::vector<Group>& groups);

/// [start], once dimension, domain, groups and spacing of `scene` are known.
[[nodiscard]] Start read_start(const TableReader& table, const Scene& scene);

/// [decomposition], once dimension and gravity are known.
[[nodiscard]] Decomposition read_decomposition(const TableReader& table, const Scene& scene);

/// [output] and [[monitor]], once the groups are known.
[[nodiscard]] OutputControl read_output(const TableReader& top, const TableReader& table, const Scene& scene);

/// Words of enumerations, shared by the reader and to_toml.
[[nodiscard]] const Choices<Formulation>& formulation_words();
[[nodiscard]] const Choices<Precision>& precision_words();
[[nodiscard]] const Choices<KernelShape>& kernel_words();
[[nodiscard]] const Choices<GroupKind>& group_kind_words();
[[nodiscard]] const Choices<EosKind>& eos_words();
[[nodiscard]] const Choices<RegionShape>& region_words();
[[nodiscard]] const Choices<LatticeKind>& lattice_words();
[[nodiscard]] const Choices<CutRule>& cut_rule_words();
[[nodiscard]] const Choices<CostSource>& cost_words();
[[nodiscard]] const Choices<MonitorKind>& monitor_words();

/// True if the start leaves a surface where matter meets nothing: an empty lattice point inside, or movers at
/// an edge that is neither periodic nor walled. Large lattices are sampled.
[[nodiscard]] bool has_free_surface(const Scene& scene);

}  // namespace sph
