// What `peperite info` and `peperite diff` say about files.
#pragma once

#include <filesystem>
#include <string>

namespace sph {

/// First difference between two snapshots or checkpoints, or empty when every bit of the state agrees:
/// "particle 17: velocity[1]: 0x1.8p+1 (3) != 0x1.9p+1 (3.125)"; cells of melts are named with their place. Rows are matched by id. Serial.
[[nodiscard]] std::string first_difference(const std::filesystem::path& a, const std::filesystem::path& b);

/// What `peperite info` prints about a snapshot or checkpoint: step, time, particles, fields, fingerprint,
/// scene name, git, compiler. Throws InputError if the file is neither.
[[nodiscard]] std::string describe(const std::filesystem::path& path);

}  // namespace sph
