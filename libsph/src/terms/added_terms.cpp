// The terms that are switched on by a number and compiled in. One that is not here, and that the program does
// not add, is none.
#include "sph/terms/artificial_stress.hpp"
#include "sph/terms/xsph.hpp"
#include "terms/term_registry.hpp"

namespace sph {

Registry<AddedTerm>& term_registry() {
  // Outlives scenes, as that of contact laws does: filled before the first is read, constant after it.
  static Registry<AddedTerm> terms({&added_term<Xsph>(), &added_term<ArtificialStress>()});
  return terms;
}

std::span<const AddedTerm* const> added_terms() { return term_registry().look(); }

}  // namespace sph
