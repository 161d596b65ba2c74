// The lists of laws, for who may add to them (keys/registration.cpp).
#pragma once

#include "sph/core/registry.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/laws/drag/law.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {

[[nodiscard]] Registry<ContactLaw>& contact_law_registry();
[[nodiscard]] Registry<EquationOfState>& eos_registry();
[[nodiscard]] Registry<DragLaw>& drag_law_registry();

}  // namespace sph
