// What stops a run: each guard names particle, place, step and the key to change, the same on any ranks.
#pragma once

#include "sph/core/findings.hpp"
#include "sph/step/state.hpp"

namespace sph {

/// Throws, on all ranks alike, what is wrong with a state of which the reduction says that something is: first what
/// updates have found on this rank. Collective.
[[noreturn]] void stop_at_fault(const State& state, const Findings& findings);

/// Throws GuardError where the next step might take a particle further, `way` [m], than lists can follow, or where one
/// is faster than anything that the scene could mean. Collective if it throws.
void guard_motion(const State& state, double way);

}  // namespace sph
