// Random legal cuts. A result that survives them does not depend on where the cuts lie, so the draws reach
// for the extremes (parts one cell thin next to one that has nearly everything) as well as for ordinary cuts.
#include <algorithm>
#include <cmath>

#include "cut_line.hpp"
#include "decomp/cut_policy.hpp"
#include "decomp/splitmix.hpp"

namespace decomp {

namespace {

constexpr std::int64_t width = JaggedPartition::min_width;

/// Draw number `index` of a stream, uniform in [0, 1).
double uniform(std::uint64_t stream, std::uint64_t index) {
  return splitmix_unit(splitmix(stream ^ splitmix(index)));
}

/// Where in [0, 1] inner cut i of `parts` goes, before sorting and before each part gets its least width.
enum class Skew { mild, free, low, high, ends, count_ };

double place(Skew skew, double u, std::size_t i, std::size_t parts) {
  switch (skew) {
    case Skew::mild:  // even spacing, each cut off by up to a quarter of it
      return (static_cast<double>(i) + 0.5 * u - 0.25) / static_cast<double>(parts);
    case Skew::low:
      return u * u * u * u;
    case Skew::high:
      return 1 - u * u * u * u;
    case Skew::ends:
      return u < 0.5 ? 0 : 1;
    default:
      return u;
  }
}

CutLine random_line(std::size_t parts, std::int64_t cells, std::uint64_t stream) {
  const std::int64_t spare = cells - static_cast<std::int64_t>(parts) * width;
  if (spare < 0)
    throw InputError(std::to_string(parts) + " parts do not fit into " + std::to_string(cells) + " cells");
  const auto skew = static_cast<Skew>(splitmix(stream) % static_cast<std::uint64_t>(Skew::count_));
  CutLine cut(parts + 1, 0);
  cut.back() = spare;
  for (std::size_t i = 1; i < parts; ++i) {
    const double at = std::floor(place(skew, uniform(stream, i), i, parts) * static_cast<double>(spare + 1));
    cut[i] = std::clamp<std::int64_t>(static_cast<std::int64_t>(at), 0, spare);
  }
  std::sort(cut.begin(), cut.end());
  for (std::size_t i = 1; i <= parts; ++i) cut[i] += static_cast<std::int64_t>(i) * width;
  return cut;
}

class Chaos final : public CutPolicy {
 public:
  explicit Chaos(std::uint64_t seed) : seed_(seed) {}
  [[nodiscard]] bool uses_costs() const override { return false; }

  Cuts next(const Cuts& now, const Load&, const CutLimits& limits) override {
    const std::uint64_t call = splitmix(splitmix(seed_) ^ calls_++);
    Cuts cuts;
    cuts.row = random_line(now.row.size() - 1, limits.row_cells, splitmix(call));
    for (std::size_t row = 0; row < now.column.size(); ++row)
      cuts.column.push_back(
          random_line(now.column[row].size() - 1, limits.column_cells, splitmix(call ^ (row + 1))));
    return cuts;
  }

 private:
  std::uint64_t seed_;
  std::uint64_t calls_ = 0;
};

}  // namespace

std::unique_ptr<CutPolicy> make_chaos(std::uint64_t seed) { return std::make_unique<Chaos>(seed); }

}  // namespace decomp
