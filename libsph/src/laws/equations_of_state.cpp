// The equations of state that are compiled in. A law that is not here, and that the program does not add, is
// none.
#include <algorithm>

#include "laws/registries.hpp"
#include "sph/laws/eos/birch_murnaghan.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/laws/eos/ideal_gas.hpp"
#include "sph/laws/eos/linear.hpp"
#include "sph/laws/eos/registry.hpp"

namespace sph {

Registry<EquationOfState>& eos_registry() {
  // Outlives scenes, as that of contact laws does: filled before the first is read, constant after it.
  static Registry<EquationOfState> laws({&eos_entry_of<LinearEos>(), &eos_entry_of<BubblyMagma>(),
                                         &eos_entry_of<IdealGasEos>(), &eos_entry_of<BirchMurnaghan>()});
  return laws;
}

std::span<const EquationOfState* const> equations_of_state() { return eos_registry().look(); }

const EquationOfState* linear_eos() { return &eos_entry_of<LinearEos>(); }

bool has_eos(const Scene& scene, EosKind kind) {
  return std::ranges::any_of(scene.groups, [&](const Group& g) { return g.eos.law->kind == kind; });
}

}  // namespace sph
