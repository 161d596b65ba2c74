// Files of a simulation's state, as a run writes them.
#pragma once

#include <filesystem>

#include "sph/step/simulation.hpp"

namespace equivalence {

/// A snapshot, for `peperite diff`. Collective, as the next.
void write_state(const std::filesystem::path& path, const sph::Simulation& s);
/// A checkpoint under `dir` in so many files, 0: as many as by default.
void write_restart(const std::filesystem::path& dir, const sph::Simulation& s, int files);

}  // namespace equivalence
