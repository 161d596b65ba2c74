// The factors of the equivalence matrix. A row is one level of each; whatever the row, the particles must end
// with the same bits as on one rank.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace equivalence {

/// Scenes of SPH and scenes of grains: a table of levels each, and so a matrix each.
enum class Family : std::uint8_t { sph, grains };

enum class Factor : std::uint8_t { scene, precision, ranks, cuts, overlap, order, list, restart, count_ };
inline constexpr std::size_t factor_count = static_cast<std::size_t>(Factor::count_);

struct FactorInfo {
  std::string_view name;
  std::vector<std::string_view> levels;
};
[[nodiscard]] const std::array<FactorInfo, factor_count>& factors(Family family);

/// One level per factor, by its index in FactorInfo::levels.
struct Row {
  Family family = Family::sph;
  std::array<std::uint8_t, factor_count> level{};
  [[nodiscard]] std::string_view operator[](Factor f) const {
    const auto k = static_cast<std::size_t>(f);
    return factors(family)[k].levels[level[k]];
  }
  [[nodiscard]] int ranks() const;
  friend bool operator==(const Row&, const Row&) = default;
};

/// "scene=gas2d precision=mixed ranks=5 ...", all factors in their order.
[[nodiscard]] std::string to_text(const Row& row);
/// Throws std::runtime_error; the scene tells the family.
[[nodiscard]] Row row_from_text(const std::string& text);

/// All rows, in the order of their factors.
[[nodiscard]] std::vector<Row> full_product(Family family);
/// The same rows in an order drawn from `seed`.
void shuffle(std::vector<Row>& rows, std::uint64_t seed);

/// Counter-based random numbers: a hash of what they are for.
[[nodiscard]] std::uint64_t draw(std::uint64_t seed, std::string_view purpose);

}  // namespace equivalence
