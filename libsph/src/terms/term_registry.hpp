// The list of terms that are switched on by a number, for who may add to it (keys/registration.cpp).
#pragma once

#include "sph/core/registry.hpp"
#include "sph/terms/added_term.hpp"

namespace sph {

[[nodiscard]] Registry<AddedTerm>& term_registry();

}  // namespace sph
