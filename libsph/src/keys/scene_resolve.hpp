// The steps from a TOML tree to a Scene, one per table; scene_toml.cpp calls them in order.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "keys/toml_reader.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

using TopReader = Reader<keys::top>;
using GroupReader = Reader<keys::group>;
using StartReader = Reader<keys::start>;
using KernelReader = Reader<keys::kernel>;
using DomainReader = Reader<keys::domain>;
using TermsReader = Reader<keys::terms>;

/// Growth of the kernels of ideal gases, where `kernel` does not say it.
void set_growth(Scene& scene);
void fit_growth(const KernelReader& kernel, Scene& scene, double cells);
/// Refuses what has no meaning beside an ideal gas, once all is read.
void check_ideal_gas(const TopReader& top, const DomainReader& domain, const StartReader& start,
                     const TermsReader& terms, const Scene& scene);

/// Names and kinds of all [[group]].
[[nodiscard]] std::vector<Group> read_group_names(const TopReader& top);
/// The materials of the groups of `scene`; walls without material values take those of the first fluid.
void read_groups(const TopReader& top, Scene& scene);
/// [group.permeability], [group.heat] and [group.viscosity_law] of one, and what of all groups they want.
void read_exchange(const GroupReader& table, Group& group);
void check_exchange(const std::vector<GroupReader>& tables, const Scene& scene);
/// [group.strength] of one whose moduli are known.
void read_strength(const GroupReader& table, Group& group, const Scene& scene);
/// What a solid that may be rigid has of its own, ...
void read_rigid(const GroupReader& table, Group& group, int dim);
void check_parts(const std::vector<GroupReader>& tables, const std::vector<Group>& groups);
/// ... and its bulk modulus [Pa] where it gives none: it is as fast as the fastest fluid.
[[nodiscard]] double stiffness_of_rigid(const GroupReader& table, const Group& group,
                                        const std::vector<Group>& groups);
/// Those of grains, which depend on the contact law.
void read_grain_groups(const TopReader& top, Scene& scene);

/// The `name` of an element: a letter followed by letters, digits, _ or -; none of those before it has it.
/// `what` it is ("group") for the message.
[[nodiscard]] std::string read_name(const TableReader& table, std::string_view what,
                                    const std::vector<std::string>& earlier);

/// A law as the reader sees it.
struct LawWord {
  std::string_view word;
  std::span<const LawKey> keys;
};
/// The constants of a law, from its keys in a [[group]]; refuses those that only other laws of its sort have,
/// among which `choice` ("contact.law") chooses.
[[nodiscard]] LawConstants read_law_constants(const GroupReader& table, std::string_view choice,
                                              const LawWord& law, const std::vector<LawWord>& all);
/// Terms that a number in [terms] switches on.
void read_added_terms(const TermsReader& table, Terms& terms);
/// `"a", "b" or "c"`
[[nodiscard]] std::string either(const std::vector<std::string>& words);

/// [contact] but for its pairs, which name groups.
void read_contact_law(const Reader<keys::contact>& table, Scene& scene);
/// [[contact.pair]], once groups and contact law of `scene` are known. Ends the table.
[[nodiscard]] std::vector<ContactPair> read_contact_pairs(const Reader<keys::contact>& table);

/// [drag], and what of the scene grains in a fluid cannot be combined with.
void read_drag(const TopReader& top, const Reader<keys::drag>& table, Scene& scene);
/// [[start.grains]]
[[nodiscard]] std::vector<GrainFill> read_fills(const StartReader& start, const Scene& scene);

/// [[wall]] and [[stage]], once domain and groups are known; stages name walls of `scene`.
[[nodiscard]] std::vector<Wall> read_walls(const TopReader& top, const Scene& scene);
[[nodiscard]] std::vector<WallStage> read_stages(const TopReader& top, const Scene& scene);
/// [[mesh]], whose names are those of walls too
[[nodiscard]] std::vector<MeshWall> read_meshes(const TopReader& top, const Scene& scene);
/// Where their files are, from the folder of the scene, and what they hold when a run begins.
void find_meshes(const TopReader& top, Scene& scene);
/// Refuses what is no readable file.
void check_file(const TableReader& table, std::string_view key, const std::string& path);
/// As it is where its length is 1, so that a scene that is written out and read back keeps its bits; nothing if it is 0.
[[nodiscard]] std::optional<Double3> unit_vector(Double3 of);

/// Groups of melts, [melt] and the spacing.
void read_melt(const TopReader& top, const DomainReader& domain, const StartReader& start, Scene& scene);
/// Refuses what the grid of melts cannot be, once all is read.
void check_melt_grid(const StartReader& start, const Scene& scene);

/// [domain], once the dimension is known.
void read_domain(const DomainReader& table, Scene& scene);
/// [[reset]], once the groups are.
void read_resets(const TopReader& top, Scene& scene);
/// domain.leaves
void read_leaves(const DomainReader& table, Scene& scene);
/// [[inlet]], [[insertion]] and [[outlet]], once all else is read.
void read_openings(const TopReader& top, const DomainReader& domain, Scene& scene);
/// Refuses what a background cannot bear, once all is read.
void check_background(const DomainReader& domain, const Scene& scene);

/// Of the meshes that regions of the start name. Left: of a scene that only says what a file is of.
enum class MeshFiles { read, leave };
/// [start], once dimension, domain, groups and spacing of `scene` are known.
void read_start(const StartReader& table, Scene& scene, MeshFiles meshes);
/// [terms], once the groups are known.
void read_terms(const TermsReader& table, Scene& scene);
void check_implicit_viscosity(const TermsReader& terms, const Scene& scene);
void check_still_step(const TermsReader& terms, const Scene& scene);
/// Refuses constants that pairs cannot multiply, once all is read.
void check_ranges(const TopReader& top, const DomainReader& domain, const StartReader& start,
                  const TermsReader& terms, const Scene& scene);

/// [decomposition], once dimension and gravity are known.
[[nodiscard]] Decomposition read_decomposition(const Reader<keys::decomposition>& table, const Scene& scene);

/// [output] and [[monitor]], once the groups are known.
[[nodiscard]] OutputControl read_output(const TopReader& top, const Reader<keys::output>& table,
                                        const Scene& scene);

/// True if the start leaves a surface where matter meets nothing: an empty lattice point inside, or movers at
/// an edge that is neither periodic nor walled. Large lattices are sampled.
[[nodiscard]] bool has_free_surface(const Scene& scene);

}  // namespace sph
