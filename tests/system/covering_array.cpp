#include "covering_array.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

namespace equivalence {
namespace {

using Order = std::array<std::size_t, factor_count>;

using Levels = std::array<std::size_t, factor_count>;

Levels levels_of(Family family) {
  Levels n;
  for (std::size_t f = 0; f < factor_count; ++f) n[f] = factors(family)[f].levels.size();
  return n;
}

/// Of three factors f < g < h: is every combination of their levels asked for? See covering_array.hpp.
bool wanted(const Levels& levels, Strength strength, std::size_t f, std::size_t g, std::size_t h) {
  constexpr std::size_t most = 12;  // combinations with each scene
  return strength == Strength::three || f != static_cast<std::size_t>(Factor::scene) ||
         levels[g] * levels[h] <= most;
}

/// Which combinations of levels of three factors f < g < h are still to be covered.
class Triples {
 public:
  Triples(Family family, Strength strength) : levels_(levels_of(family)) {
    for (std::size_t f = 0; f < factor_count; ++f)
      for (std::size_t g = f + 1; g < factor_count; ++g)
        for (std::size_t h = g + 1; h < factor_count; ++h) {
          first_[f][g][h] = open_.size();
          const bool open = wanted(levels_, strength, f, g, h);
          const std::size_t size = levels(f) * levels(g) * levels(h);
          open_.resize(open_.size() + size, open);
          if (open) left_ += size;
        }
  }

  [[nodiscard]] bool done() const { return left_ == 0; }
  [[nodiscard]] std::size_t levels(std::size_t f) const { return levels_[f]; }

  /// How many open combinations of `row` have factor `f` and two of `chosen`.
  [[nodiscard]] std::size_t gain(const Row& row, std::size_t f, const Order& chosen,
                                 std::size_t count) const {
    std::size_t n = 0;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b) n += open_[index(row, {f, chosen[a], chosen[b]})] ? 1 : 0;
    return n;
  }

  void cover(const Row& row) {
    for (std::size_t f = 0; f < factor_count; ++f)
      for (std::size_t g = f + 1; g < factor_count; ++g)
        for (std::size_t h = g + 1; h < factor_count; ++h) {
          const std::size_t k = index(row, {f, g, h});
          if (open_[k]) --left_;
          open_[k] = false;
        }
  }

  /// The three factors of an open combination, chosen by `pick`; their levels go into `row`.
  std::array<std::size_t, 3> open_triple(Row& row, std::uint64_t pick) const {
    std::size_t skip = pick % left_, k = 0;
    while (!open_[k] || skip-- > 0) ++k;
    for (std::size_t f = 0; f < factor_count; ++f)
      for (std::size_t g = f + 1; g < factor_count; ++g)
        for (std::size_t h = g + 1; h < factor_count; ++h) {
          const std::size_t size = levels(f) * levels(g) * levels(h);
          if (k < first_[f][g][h] || k >= first_[f][g][h] + size) continue;
          std::size_t rest = k - first_[f][g][h];
          row.level[h] = static_cast<std::uint8_t>(rest % levels(h));
          rest /= levels(h);
          row.level[g] = static_cast<std::uint8_t>(rest % levels(g));
          row.level[f] = static_cast<std::uint8_t>(rest / levels(g));
          return {f, g, h};
        }
    return {};
  }

 private:
  [[nodiscard]] std::size_t index(const Row& row, std::array<std::size_t, 3> f) const {
    std::sort(f.begin(), f.end());
    return first_[f[0]][f[1]][f[2]] + (row.level[f[0]] * levels(f[1]) + row.level[f[1]]) * levels(f[2]) +
           row.level[f[2]];
  }

  Levels levels_;
  std::size_t first_[factor_count][factor_count][factor_count]{};
  std::vector<bool> open_;
  std::size_t left_ = 0;
};

/// A row that covers an open combination, its other factors set one by one to what covers most.
std::pair<Row, std::size_t> candidate(const Triples& triples, Family family, std::mt19937_64& random) {
  Row row{family, {}};
  const auto start = triples.open_triple(row, random());
  Order order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = factor_count; k > 1; --k) std::swap(order[k - 1], order[random() % k]);
  std::stable_partition(order.begin(), order.end(), [&](std::size_t f) {
    return std::find(start.begin(), start.end(), f) != start.end();
  });
  std::size_t total = 1;
  for (std::size_t k = start.size(); k < factor_count; ++k) {
    const std::size_t f = order[k], first = random() % triples.levels(f);
    std::size_t best = 0, most = 0;
    for (std::size_t l = 0; l < triples.levels(f); ++l) {
      row.level[f] = static_cast<std::uint8_t>((first + l) % triples.levels(f));
      const std::size_t gain = triples.gain(row, f, order, k);
      if (l == 0 || gain > most) best = row.level[f], most = gain;
    }
    row.level[f] = static_cast<std::uint8_t>(best);
    total += most;
  }
  return {row, total};
}

}  // namespace

std::vector<Row> covering_array(Family family, std::uint64_t seed, Strength strength) {
  constexpr int candidates = 60;  // more do not make the array notably shorter
  std::mt19937_64 random(seed);
  Triples triples(family, strength);
  std::vector<Row> rows;
  while (!triples.done()) {
    auto best = candidate(triples, family, random);
    for (int c = 1; c < candidates; ++c)
      if (auto other = candidate(triples, family, random); other.second > best.second) best = other;
    rows.push_back(best.first);
    triples.cover(best.first);
  }
  return rows;
}

std::size_t uncovered_triples(Family family, const std::vector<Row>& rows, Strength strength) {
  const Levels levels = levels_of(family);
  std::size_t missing = 0;
  for (std::size_t f = 0; f < factor_count; ++f)
    for (std::size_t g = f + 1; g < factor_count; ++g)
      for (std::size_t h = g + 1; h < factor_count; ++h) {
        if (!wanted(levels, strength, f, g, h)) continue;
        std::set<std::tuple<int, int, int>> seen;
        for (const Row& row : rows) seen.emplace(row.level[f], row.level[g], row.level[h]);
        missing += levels[f] * levels[g] * levels[h] - seen.size();
      }
  return missing;
}

}  // namespace equivalence
