#include "core/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sph {
namespace {

/// In small letters; others than ASCII's stay.
std::string small(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<int> d((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> int& { return d[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return at(a.size(), b.size());
}

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
  const int limit = std::max(2, static_cast<int>(word.size()) / 3);
  const std::string folded = small(word);
  // Capitals count where nothing else tells two candidates apart.
  std::pair best{limit + 1, 0};
  std::string found;
  for (const std::string& candidate : words) {
    // No distance is below the difference of lengths, and a word may be as long as its file.
    if (word.size() > candidate.size() + static_cast<std::size_t>(limit)) continue;
    const std::pair distance{edit_distance(folded, small(candidate)), edit_distance(word, candidate)};
    // A word that shares nothing with the candidate is as far away as the longer of them.
    if (distance < best && distance.first < static_cast<int>(std::max(word.size(), candidate.size()))) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& words) {
  const std::string near = nearest(word, words);
  if (!near.empty()) return fmt::format("did you mean \"{}\"?", near);
  return fmt::format("valid: {}", fmt::join(words, ", "));
}

}  // namespace sph
