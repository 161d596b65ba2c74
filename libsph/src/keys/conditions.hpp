// What a scene must be to have some keys. They are asked once the names and kinds of its groups are known.
#pragma once

#include "keys/key.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/scene/scene.hpp"

namespace sph::keys {

inline constexpr Special curve_of_time{
    "a value, or an array of times and values", R"([["0 s", 1.0], ["2 s", 3.0]])",
    R"({"type": ["number", "string", "array"], "items": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": ["number", "string"]}}})"};

inline constexpr Special corners_of_polygon{
    "an array of corners", R"([[0, 0], ["3 m", 0], ["1 m", "2 m"]])",
    R"({"type": "array", "minItems": 3, "items": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": ["number", "string"]}}})"};

/// Scenes of fluids and solids; `why` those of grains alone have no such key.
constexpr Condition sph_only(std::string_view why) {
  return {[](const Scene& s) { return s.has_matter(); }, "fluids and solids", why};
}
inline constexpr Condition of_fluids = sph_only("it is of fluids");
inline constexpr Condition of_grains{[](const Scene& s) { return s.has_grains(); }, "grains",
                                     "only scenes of grains have it, with a [[group]] of kind = \"grain\""};
inline constexpr Condition of_grains_alone{
    [](const Scene& s) { return s.of_grains(); }, "grains alone",
    "only scenes of grains alone have it, where every [[group]] has kind = \"grain\""};
inline constexpr Condition of_mixtures{
    [](const Scene& s) { return s.has_grains_in_flow(); }, "grains in a fluid or in melts",
    "only scenes with groups of kind = \"grain\" and \"fluid\", or \"melt\", have it"};
inline constexpr Condition of_suspensions{[](const Scene& s) { return s.is_suspension(); }, "grains in melts",
                                          "only scenes with groups of kind = \"grain\" and \"melt\" have it"};
inline constexpr Condition of_inertia{[](const Scene& s) { return !s.has_melt(); }, "grains with inertia",
                                      "grains in melts have no inertia that a dashpot could take: remove it"};
inline constexpr Condition of_melts{[](const Scene& s) { return s.has_melt(); }, "melts",
                                    "only scenes with a [[group]] of kind = \"melt\" have it"};
inline constexpr Condition of_lattices{
    [](const Scene& s) { return s.start.file.empty() && s.start.tile.file.empty(); }, "lattices",
    "the particles come from start.file or start.tile"};
inline constexpr Condition of_viscous_forms{
    [](const Scene& s) { return s.terms.formulation != Formulation::ida && !has_dry_bodies(s); },
    "fluids and updated solids, not \"ida\"",
    "formulation = \"ida\" and total-Lagrangian solids have none: remove it"};
inline constexpr Condition of_flows{
    [](const Scene& s) { return s.terms.formulation != Formulation::ida && !s.has_kind(GroupKind::solid); },
    "fluids, not \"ida\"", "it is for scenes without solids, and formulation = \"ida\" has none: remove it"};
inline constexpr Condition of_inlets{[](const Scene& s) { return s.has_matter() && !s.has_grains(); },
                                     "fluids without grains", "it is of fluids, in scenes without grains"};
inline constexpr Condition of_openings{
    [](const Scene& s) { return of_inlets.holds(s) || s.of_grains(); }, "fluids or grains alone",
    "it is of fluids in scenes without grains, or of grains in scenes without fluids"};
inline constexpr Condition of_gases{[](const Scene& s) { return has_eos(s, EosKind::ideal_gas); },
                                    "ideal gases", "only scenes with eos = \"ideal_gas\" have it"};
inline constexpr Condition of_added_terms{
    [](const Scene& s) {
      return s.terms.formulation == Formulation::conservative && !s.total_lagrangian() &&
             !has_eos(s, EosKind::ideal_gas);
    },
    "liquids and updated-Lagrangian solids",
    "it is of liquids and updated-Lagrangian solids, and formulation = \"ida\" has none"};
inline constexpr Condition of_added_stresses{
    [](const Scene& s) { return of_added_terms.holds(s) && s.has_kind(GroupKind::solid); },
    "updated-Lagrangian solids, not \"ida\"", "it is of updated-Lagrangian solids"};
inline constexpr Condition of_total{[](const Scene& s) { return s.total_lagrangian(); },
                                    "total-Lagrangian solids",
                                    "only scenes of solids with lagrangian = \"total\" have it"};
inline constexpr Condition of_dashpots{
    [](const Scene& s) {
      return !s.has_melt() && (s.grains.contact.law == nullptr || s.grains.contact.law->dashpot);
    },
    "laws with a dashpot, not in melts",
    "the contact law of the scene has no dashpot, or its grains no inertia: remove it"};
inline constexpr Condition of_restitution{
    [](const Scene& s) {
      const ContactLaw* law = s.grains.contact.law;
      return !s.grains.contact.normal_damping && !(s.has_melt() && (law == nullptr || law->dashpot));
    },
    "contacts without normal_damping, dashpots not in melts",
    "contact.normal_damping stands instead of it, or grains in melts have no inertia"};

}  // namespace sph::keys
