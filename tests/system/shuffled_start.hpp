// The particles of a start as a user's file may have them: in a random order.
#pragma once

#include <cstdint>
#include <filesystem>

#include "sph/step/simulation.hpp"

namespace equivalence {

/// Of a simulation on one rank. Each rank that reads the CSV file takes an equal share of its lines, so that
/// it gets particles from everywhere. 17 digits give every double back. False, and no file, where a position
/// is no double: quanta go to 2^-60 of the domain, and a coordinate that came over a periodic face may need
/// them.
bool write_shuffled_start(const std::filesystem::path& path, const sph::Simulation& s, std::uint64_t seed);

}  // namespace equivalence
