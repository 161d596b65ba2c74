// What no particle may be. A fault is told of the particle that has it, in the stage that made it: in sums that
// follow, what is not finite reaches all that a list holds, beyond the support too (0 times infinity), and how much
// that is depends on the skin and on the ranks.
#pragma once

#include <string>

#include "sph/models/sph_constants.hpp"
#include "sph/plan/stage.hpp"
#include "sph/plan/view.hpp"

namespace sph {

using FaultView = View<FieldSet{Field::id, Field::position, Field::group}, FieldSet{}>;

/// Text for a particle that is what none may be: `what` follows its name and place.
void find_fault(const SphConstants& constants, const FaultView& particles, std::size_t i, const Step& step,
                const std::string& what);

using RangeView =
    View<FaultView::reads | FieldSet{Field::mass, Field::density, Field::pressure, Field::stress},
         FieldSet{}>;

/// Looks at rows [first, last) for a pressure, a stress or a density so far from anything that the sums over pairs,
/// some of single precision, might not be finite.
void find_out_of_range(const SphConstants& constants, const RangeView& particles, std::size_t first,
                       std::size_t last, const Step& step);

}  // namespace sph
