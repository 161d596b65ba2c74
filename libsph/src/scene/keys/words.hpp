// The words of the scene's enumerations, the default first where there is one.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "scene/keys/member.hpp"
#include "sph/scene.hpp"

namespace sph::keys {

struct Word {
  std::string_view text;
  int value;  ///< of the enumerator
  template <class E>
  constexpr Word(std::string_view t, E e) : text(t), value(static_cast<int>(e)) {}
};

/// The kind of a key that wants one of `words`; `of` is the type_mark of their enumeration.
struct Words {
  std::span<const Word> words;
  const void* of = nullptr;

  [[nodiscard]] constexpr bool has(std::string_view text) const {
    for (const Word& word : words)
      if (word.text == text) return true;
    return false;
  }
};

/// Of a [[wall]]; a box is read as its planes.
enum class WallShape { plane, box };

template <class E>
inline constexpr auto words = nullptr;
template <>
inline constexpr auto words<Formulation> = std::to_array<Word>({{"conservative", Formulation::conservative},
                                                                {"ida", Formulation::ida}});
template <>
inline constexpr auto words<Precision> = std::to_array<Word>({{"double", Precision::double_},
                                                              {"mixed", Precision::mixed}});
template <>
inline constexpr auto words<PressureWeights> = std::to_array<Word>({{"volume", PressureWeights::volume},
                                                                    {"density", PressureWeights::density}});
template <>
inline constexpr auto words<TensionForm> = std::to_array<Word>({{"stress", TensionForm::stress},
                                                                {"jump", TensionForm::jump}});
template <>
inline constexpr auto words<ViscosityForm> = std::to_array<Word>({{"laplacian", ViscosityForm::laplacian},
                                                                  {"symmetric", ViscosityForm::symmetric}});
template <>
inline constexpr auto words<KernelShape> = std::to_array<Word>({{"quintic", KernelShape::quintic},
                                                                {"wendland_c2", KernelShape::wendland_c2},
                                                                {"wendland_c4", KernelShape::wendland_c4}});
template <>
inline constexpr auto words<GroupKind> = std::to_array<Word>({{"fluid", GroupKind::fluid},
                                                              {"solid", GroupKind::solid},
                                                              {"wall", GroupKind::wall},
                                                              {"grain", GroupKind::grain}});
template <>
inline constexpr auto words<EosKind> = std::to_array<Word>({{"linear", EosKind::linear},
                                                            {"bubbly", EosKind::bubbly},
                                                            {"ideal_gas", EosKind::ideal_gas}});
template <>
inline constexpr auto words<Lagrangian> = std::to_array<Word>({{"updated", Lagrangian::updated},
                                                               {"total", Lagrangian::total}});
template <>
inline constexpr auto words<RegionShape> = std::to_array<Word>({{"everywhere", RegionShape::everywhere},
                                                                {"box", RegionShape::box},
                                                                {"ball", RegionShape::ball}});
template <>
inline constexpr auto words<LatticeKind> = std::to_array<Word>({{"square", LatticeKind::square},
                                                                {"hexagonal", LatticeKind::hexagonal}});
template <>
inline constexpr auto words<InitialPressure> =
    std::to_array<Word>({{"zero", InitialPressure::zero},
                         {"hydrostatic", InitialPressure::hydrostatic},
                         {"taylor_green", InitialPressure::taylor_green}});
template <>
inline constexpr auto words<CutRule> = std::to_array<Word>({{"fixed", CutRule::fixed},
                                                            {"literal", CutRule::literal},
                                                            {"quasi_newton", CutRule::quasi_newton},
                                                            {"hybrid", CutRule::hybrid},
                                                            {"chaos", CutRule::chaos},
                                                            {"replay", CutRule::replay}});
template <>
inline constexpr auto words<CostSource> = std::to_array<Word>({{"time", CostSource::time},
                                                               {"counts", CostSource::counts}});
template <>
inline constexpr auto words<MonitorKind> = std::to_array<Word>({{"particle", MonitorKind::particle},
                                                                {"group", MonitorKind::group},
                                                                {"energy", MonitorKind::energy},
                                                                {"momentum", MonitorKind::momentum},
                                                                {"wall", MonitorKind::wall},
                                                                {"contacts", MonitorKind::contacts}});
template <>
inline constexpr auto words<ContactLaw> = std::to_array<Word>({{"linear", ContactLaw::linear},
                                                               {"hertz", ContactLaw::hertz}});
template <>
inline constexpr auto words<WallShape> = std::to_array<Word>({{"plane", WallShape::plane},
                                                              {"box", WallShape::box}});

template <class E>
inline constexpr Words one_of{words<E>, &type_mark<E>};

constexpr std::string_view word_of(const Words& words, int value) {
  for (const Word& word : words.words)
    if (word.value == value) return word.text;
  return {};
}

}  // namespace sph::keys
