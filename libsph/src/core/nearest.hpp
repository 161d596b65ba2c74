// "did you mean": the valid word nearest to a misspelt one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sph {

/// Insertions, deletions, replacements and swaps of neighbours that turn a into b.
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);
/// The word nearest to `word` but for capitals, which decide between words that are equally near, and then the first;
/// empty if none is near enough to be meant.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& words);
/// `did you mean "x"`, or the list of what is valid.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& words);

}  // namespace sph
