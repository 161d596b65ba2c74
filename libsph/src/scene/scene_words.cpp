// Words of the scene's enumerations.
#include "scene/scene_resolve.hpp"
#include "sph/contact/law.hpp"
#include "sph/eos/law.hpp"

namespace sph {

const Choices<Formulation>& formulation_words() {
  static const Choices<Formulation> words{{"conservative", Formulation::conservative},
                                          {"ida", Formulation::ida}};
  return words;
}
const Choices<Precision>& precision_words() {
  static const Choices<Precision> words{{"double", Precision::double_}, {"mixed", Precision::mixed}};
  return words;
}
const Choices<PressureWeights>& pressure_weights_words() {
  static const Choices<PressureWeights> words{{"volume", PressureWeights::volume},
                                              {"density", PressureWeights::density}};
  return words;
}
const Choices<TensionForm>& tension_form_words() {
  static const Choices<TensionForm> words{{"stress", TensionForm::stress}, {"jump", TensionForm::jump}};
  return words;
}
const Choices<ViscosityForm>& viscosity_words() {
  static const Choices<ViscosityForm> words{{"laplacian", ViscosityForm::laplacian},
                                            {"symmetric", ViscosityForm::symmetric}};
  return words;
}
const Choices<KernelShape>& kernel_words() {
  static const Choices<KernelShape> words{{"quintic", KernelShape::quintic},
                                          {"wendland_c2", KernelShape::wendland_c2},
                                          {"wendland_c4", KernelShape::wendland_c4}};
  return words;
}
const Choices<GroupKind>& group_kind_words() {
  static const Choices<GroupKind> words{{"fluid", GroupKind::fluid},
                                        {"solid", GroupKind::solid},
                                        {"wall", GroupKind::wall},
                                        {"grain", GroupKind::grain}};
  return words;
}
const Choices<const EquationOfState*>& eos_words() {
  static const Choices<const EquationOfState*> words = [] {
    Choices<const EquationOfState*> all;
    for (const EquationOfState* law : equations_of_state()) all.emplace_back(law->word, law);
    return all;
  }();
  return words;
}
const Choices<Lagrangian>& lagrangian_words() {
  static const Choices<Lagrangian> words{{"updated", Lagrangian::updated}, {"total", Lagrangian::total}};
  return words;
}
const Choices<RegionShape>& region_words() {
  static const Choices<RegionShape> words{
      {"everywhere", RegionShape::everywhere}, {"box", RegionShape::box}, {"ball", RegionShape::ball}};
  return words;
}
const Choices<LatticeKind>& lattice_words() {
  static const Choices<LatticeKind> words{{"square", LatticeKind::square},
                                          {"hexagonal", LatticeKind::hexagonal}};
  return words;
}
const Choices<CutRule>& cut_rule_words() {
  static const Choices<CutRule> words{
      {"fixed", CutRule::fixed},   {"literal", CutRule::literal}, {"quasi_newton", CutRule::quasi_newton},
      {"hybrid", CutRule::hybrid}, {"chaos", CutRule::chaos},     {"replay", CutRule::replay}};
  return words;
}
const Choices<CostSource>& cost_words() {
  static const Choices<CostSource> words{{"time", CostSource::time}, {"counts", CostSource::counts}};
  return words;
}
const Choices<MonitorKind>& monitor_words() {
  static const Choices<MonitorKind> words{
      {"particle", MonitorKind::particle}, {"group", MonitorKind::group},
      {"energy", MonitorKind::energy},     {"momentum", MonitorKind::momentum},
      {"wall", MonitorKind::wall},         {"contacts", MonitorKind::contacts}};
  return words;
}
const Choices<const ContactLaw*>& contact_law_words() {
  static const Choices<const ContactLaw*> words = [] {
    Choices<const ContactLaw*> all;
    for (const ContactLaw* law : contact_laws()) all.emplace_back(law->word, law);
    return all;
  }();
  return words;
}

}  // namespace sph
