// The words of the scene's enumerations, the default first where there is one.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "keys/member.hpp"
#include "sph/scene/scene.hpp"

namespace sph::keys {

struct Word {
  std::string_view text;
  int value;       ///< of the enumerator
  const void* of;  ///< type_mark of its enumeration
  template <class E>
  constexpr Word(std::string_view t, E e) : text(t), value(static_cast<int>(e)), of(&type_mark<E>) {}
  /// Of a law, by its place in the registry.
  constexpr Word(std::string_view t, int n, const void* mark) : text(t), value(n), of(mark) {}
};

/// The kind of a key that wants one of these.
struct Words {
  std::span<const Word> words{};
  std::span<const Word> (*of_laws)() = nullptr;  ///< instead, of a registry (law_keys.hpp)

  [[nodiscard]] constexpr std::span<const Word> all() const { return of_laws != nullptr ? of_laws() : words; }
  [[nodiscard]] constexpr bool has(std::string_view text) const {
    for (const Word& word : words)
      if (word.text == text) return true;
    return of_laws != nullptr;  // known when the program runs
  }
  template <class E>
  [[nodiscard]] constexpr bool are_of() const {
    return of_laws == nullptr && words.front().of == &type_mark<E>;
  }
  [[nodiscard]] std::string_view text_of(int value) const {
    for (const Word& word : all())
      if (word.value == value) return word.text;
    return {};
  }
};

/// Of a [[wall]]; a box is read as its planes.
enum class WallShape { plane, box };

inline constexpr auto formulation_words =
    std::to_array<Word>({{"conservative", Formulation::conservative}, {"ida", Formulation::ida}});
inline constexpr auto precision_words =
    std::to_array<Word>({{"double", Precision::double_}, {"mixed", Precision::mixed}});
inline constexpr auto pressure_weights_words =
    std::to_array<Word>({{"volume", PressureWeights::volume}, {"density", PressureWeights::density}});
inline constexpr auto tension_form_words =
    std::to_array<Word>({{"stress", TensionForm::stress}, {"jump", TensionForm::jump}});
inline constexpr auto conserved_words = std::to_array<Word>(
    {{"mass", Conserved::mass}, {"volume", Conserved::volume}, {"both", Conserved::both}});
inline constexpr auto viscosity_form_words =
    std::to_array<Word>({{"laplacian", ViscosityForm::laplacian}, {"symmetric", ViscosityForm::symmetric}});
inline constexpr auto viscosity_law_words =
    std::to_array<Word>({{"constant", ViscosityLaw::constant},
                         {"exponential", ViscosityLaw::exponential},
                         {"vogel", ViscosityLaw::vogel},
                         {"hess_dingwell", ViscosityLaw::hess_dingwell}});
inline constexpr auto crystal_law_words =
    std::to_array<Word>({{"none", CrystalLaw::none}, {"einstein_roscoe", CrystalLaw::einstein_roscoe}});
inline constexpr auto bubble_law_words = std::to_array<Word>(
    {{"none", BubbleLaw::none}, {"round", BubbleLaw::round}, {"stretched", BubbleLaw::stretched}});
inline constexpr auto permeability_words =
    std::to_array<Word>({{"power", PermeabilityLaw::power},
                         {"percolation", PermeabilityLaw::percolation},
                         {"kozeny_carman", PermeabilityLaw::kozeny_carman}});
inline constexpr auto kernel_shape_words = std::to_array<Word>({{"quintic", KernelShape::quintic},
                                                                {"wendland_c2", KernelShape::wendland_c2},
                                                                {"wendland_c4", KernelShape::wendland_c4}});
inline constexpr auto group_kind_words = std::to_array<Word>({{"fluid", GroupKind::fluid},
                                                              {"solid", GroupKind::solid},
                                                              {"wall", GroupKind::wall},
                                                              {"grain", GroupKind::grain},
                                                              {"melt", GroupKind::melt}});
inline constexpr auto lagrangian_words =
    std::to_array<Word>({{"updated", Lagrangian::updated}, {"total", Lagrangian::total}});
/// What of a rigid body's motion can be held.
inline constexpr std::array<std::string_view, 4> motion_names{"x", "y", "z", "rotation"};
inline constexpr auto strength_law_words = std::to_array<Word>(
    {{"mohr_coulomb", StrengthLaw::mohr_coulomb}, {"drucker_prager", StrengthLaw::drucker_prager}});
inline constexpr auto region_shape_words = std::to_array<Word>({{"everywhere", RegionShape::everywhere},
                                                                {"box", RegionShape::box},
                                                                {"ball", RegionShape::ball},
                                                                {"cylinder", RegionShape::cylinder},
                                                                {"cone", RegionShape::cone},
                                                                {"polygon", RegionShape::polygon},
                                                                {"mesh", RegionShape::mesh}});
inline constexpr auto lattice_kind_words = std::to_array<Word>(
    {{"square", LatticeKind::square}, {"hexagonal", LatticeKind::hexagonal}, {"fcc", LatticeKind::fcc}});
inline constexpr auto initial_pressure_words =
    std::to_array<Word>({{"zero", InitialPressure::zero},
                         {"uniform", InitialPressure::uniform},
                         {"hydrostatic", InitialPressure::hydrostatic},
                         {"taylor_green", InitialPressure::taylor_green}});
inline constexpr auto cut_rule_words = std::to_array<Word>({{"fixed", CutRule::fixed},
                                                            {"literal", CutRule::literal},
                                                            {"quasi_newton", CutRule::quasi_newton},
                                                            {"hybrid", CutRule::hybrid},
                                                            {"chaos", CutRule::chaos},
                                                            {"replay", CutRule::replay}});
inline constexpr auto cost_source_words =
    std::to_array<Word>({{"time", CostSource::time}, {"counts", CostSource::counts}});
inline constexpr auto monitor_kind_words = std::to_array<Word>({{"particle", MonitorKind::particle},
                                                                {"group", MonitorKind::group},
                                                                {"energy", MonitorKind::energy},
                                                                {"momentum", MonitorKind::momentum},
                                                                {"wall", MonitorKind::wall},
                                                                {"contacts", MonitorKind::contacts},
                                                                {"melt", MonitorKind::melt},
                                                                {"budget", MonitorKind::budget},
                                                                {"body", MonitorKind::body},
                                                                {"gauge", MonitorKind::gauge},
                                                                {"level", MonitorKind::level},
                                                                {"flux", MonitorKind::flux}});
inline constexpr auto melt_side_words = std::to_array<Word>({{"x0", MeltFace::x0},
                                                             {"x1", MeltFace::x1},
                                                             {"y0", MeltFace::y0},
                                                             {"y1", MeltFace::y1},
                                                             {"z0", MeltFace::z0},
                                                             {"z1", MeltFace::z1}});
inline constexpr auto melt_profile_words =
    std::to_array<Word>({{"groups", MeltProfile::groups}, {"conductive", MeltProfile::conductive}});
inline constexpr auto melt_mixture_words =
    std::to_array<Word>({{"groups", MeltMixture::groups}, {"linear", MeltMixture::linear}});
inline constexpr auto direction_words = std::to_array<Word>({{"+x", Direction::x_up},
                                                             {"-x", Direction::x_down},
                                                             {"+y", Direction::y_up},
                                                             {"-y", Direction::y_down},
                                                             {"+z", Direction::z_up},
                                                             {"-z", Direction::z_down}});
inline constexpr auto inlet_profile_words =
    std::to_array<Word>({{"uniform", InletProfile::uniform}, {"parabolic", InletProfile::parabolic}});
inline constexpr auto wall_shape_words =
    std::to_array<Word>({{"plane", WallShape::plane}, {"box", WallShape::box}});

}  // namespace sph::keys
