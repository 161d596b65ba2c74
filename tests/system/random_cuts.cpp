#include "random_cuts.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace equivalence {
namespace {

/// The first cuts that chaos draws.
std::vector<decomp::Cuts> random_cuts(const decomp::Cuts& start, std::uint64_t seed, std::int64_t count) {
  const auto policy = decomp::make_chaos(seed);
  std::vector<decomp::Cuts> drawn;
  for (std::int64_t k = 0; k < count; ++k)
    drawn.push_back(policy->next(drawn.empty() ? start : drawn.back(), {},
                                 {start.row.back(), start.column.front().back()}));
  return drawn;
}

/// Is there a cut through the middle half of a line?
bool divides(const std::vector<std::int64_t>& cut) {
  return std::any_of(cut.begin(), cut.end(),
                     [&](std::int64_t c) { return 4 * c >= cut.back() && 4 * c <= 3 * cut.back(); });
}

}  // namespace

std::uint64_t dividing_seed(const decomp::Cuts& start, std::uint64_t seed, std::uint64_t attempts) {
  for (seed >>= 1; attempts > 0; ++seed, --attempts) {
    const std::vector<decomp::Cuts> drawn = random_cuts(start, seed, 3);
    if (std::count_if(drawn.begin(), drawn.end(), [](const decomp::Cuts& c) {
          return divides(c.row) || std::any_of(c.column.begin(), c.column.end(), divides);
        }) >= 2)
      return seed;
  }
  return seed;
}

void write_random_cuts(const std::filesystem::path& path, const decomp::Cuts& start, std::uint64_t seed,
                       std::int64_t count) {
  std::ofstream out(path);
  for (const decomp::Cuts& c : random_cuts(start, seed, count)) out << decomp::to_text(c) << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace equivalence
