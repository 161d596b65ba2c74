#include "factors.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "decomp/splitmix.hpp"

namespace equivalence {

namespace {

using Table = std::array<FactorInfo, factor_count>;

Table table_of(std::vector<std::string_view> scenes, std::vector<std::string_view> precisions) {
  return {{
      {"scene", std::move(scenes)},
      {"precision", std::move(precisions)},
      {"ranks", {"2", "3", "4", "5", "7", "8"}},
      {"cuts", {"uniform", "time", "counts", "hybrid", "chaos", "replay"}},
      {"overlap", {"on", "off"}},
      {"order", {"placed", "shuffled"}},
      {"list", {"small", "large", "every"}},
      // other: from another count above one; from_one: 1 -> ranks; to_one: ranks -> 1
      {"restart", {"none", "other", "from_one", "to_one"}},
  }};
}

}  // namespace

const Table& factors(Family family) {
  static const Table sph = table_of(
      {"fluid2d",    "solid2d", "gas2d",        "ida2d",      "flow2d",     "bubble2d",   "jump2d",
       "viscous2d",  "dam2d",   "fluid3d",      "viscous3d",  "solid3d",    "bodies2d",   "bodies3d",
       "gas3d",      "blast2d", "blast2d_wide", "mixture",    "exchange2d", "exchange3d", "implicit2d",
       "implicit3d", "laws2d",  "laws3d",       "freezing2d", "through2d",  "wet2d",      "wet3d",
       "crack2d",    "crack3d", "water2d",      "water3d",    "slope2d",    "rock3d",     "rigid2d",
       "rigid3d",    "led3d",   "open2d",       "open3d",     "open_wet2d"},
      {"double", "mixed"});
  // Contacts are always computed in double.
  static const Table grains = table_of({"linear", "hertz", "latched", "smooth", "sizes", "glued", "servo",
                                        "meshes", "silo", "melts2d", "chamber", "chamber_open"},
                                       {"double"});
  return family == Family::grains ? grains : sph;
}

int Row::ranks() const {
  const std::string_view text = (*this)[Factor::ranks];
  int n = 0;
  std::from_chars(text.data(), text.data() + text.size(), n);
  return n;
}

std::string to_text(const Row& row) {
  std::string text;
  for (std::size_t f = 0; f < factor_count; ++f) {
    if (f > 0) text += ' ';
    const FactorInfo& factor = factors(row.family)[f];
    text.append(factor.name).append("=").append(factor.levels[row.level[f]]);
  }
  return text;
}

Row row_from_text(const std::string& text) {
  std::istringstream words(text);
  Row row;
  for (const std::string_view scene : factors(Family::grains)[0].levels)
    if (text.starts_with("scene=" + std::string(scene) + " ")) row.family = Family::grains;
  for (std::size_t f = 0; f < factor_count; ++f) {
    const FactorInfo& factor = factors(row.family)[f];
    const std::string start = std::string(factor.name) + "=";
    std::string word;
    words >> word;
    const auto level = word.starts_with(start) ? std::find(factor.levels.begin(), factor.levels.end(),
                                                           std::string_view(word).substr(start.size()))
                                               : factor.levels.end();
    if (level == factor.levels.end())
      throw std::runtime_error("row: '" + word + "' stands where one of the levels of '" + start +
                               "' is expected");
    row.level[f] = static_cast<std::uint8_t>(level - factor.levels.begin());
  }
  return row;
}

std::vector<Row> full_product(Family family) {
  std::vector<Row> rows{Row{family, {}}};
  for (std::size_t f = 0; f < factor_count; ++f) {
    std::vector<Row> longer;
    for (Row row : rows)
      for (std::size_t l = 0; l < factors(family)[f].levels.size(); ++l) {
        row.level[f] = static_cast<std::uint8_t>(l);
        longer.push_back(row);
      }
    rows = std::move(longer);
  }
  return rows;
}

void shuffle(std::vector<Row>& rows, std::uint64_t seed) {
  for (std::size_t n = rows.size(); n > 1; --n)
    std::swap(rows[n - 1], rows[draw(seed, "shuffle" + std::to_string(n)) % n]);
}

std::uint64_t draw(std::uint64_t seed, std::string_view purpose) {
  // FNV-1a over the text, then mixed so that all bits are usable
  std::uint64_t hash = 0xcbf29ce484222325U ^ seed;
  for (const char c : purpose) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return decomp::splitmix_mix(hash);
}

}  // namespace equivalence
