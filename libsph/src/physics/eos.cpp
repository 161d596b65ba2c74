// The equations of state that are compiled in. A law that is not here, and that the program does not add, is
// none.
#include "scene/keys/key_owners.hpp"
#include "sph/eos/birch_murnaghan.hpp"
#include "sph/eos/bubbly.hpp"
#include "sph/eos/ideal_gas.hpp"
#include "sph/eos/linear.hpp"
#include "sph/eos/registry.hpp"
#include "sph/registry.hpp"

namespace sph {
namespace {

constexpr std::string_view eos_sort = "equation of state";

Registry<EquationOfState>& registry() {
  // Outlives scenes, as that of contact laws does: filled before the first is read, constant after it.
  static Registry<EquationOfState> laws({&eos_entry_of<LinearEos>(), &eos_entry_of<BubblyMagma>(),
                                         &eos_entry_of<IdealGasEos>(), &eos_entry_of<BirchMurnaghan>()});
  return laws;
}

}  // namespace

std::span<const EquationOfState* const> equations_of_state() { return registry().look(); }

void register_equation_of_state(const EquationOfState& law) {
  keys::refuse_taken_keys({eos_sort, law.word, law.keys});
  registry().add(law);
}

std::vector<keys::KeyOwner> keys::equation_of_state_keys() {
  std::vector<KeyOwner> owners;
  for (const EquationOfState* law : registry().so_far()) owners.push_back({eos_sort, law->word, law->keys});
  return owners;
}

const EquationOfState* linear_eos() { return &eos_entry_of<LinearEos>(); }

}  // namespace sph
