// What --set may change of a run that goes on, and of a branch: another run that begins with its state.
#pragma once

#include <string>
#include <vector>

namespace sph {

/// Of what the next state, the columns and the snapshots of a run do not depend on. InputError for others.
void refuse_other_changes(const std::vector<std::string>& overrides);
/// Also of constants of its laws: what neither the fields of its particles nor the number of its parts depend on. InputError for others.
void refuse_changes_of_parts(const std::vector<std::string>& overrides);
/// Whether any of them is a constant of a law.
[[nodiscard]] bool change_laws(const std::vector<std::string>& overrides);

}  // namespace sph
