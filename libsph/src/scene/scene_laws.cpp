// Keys of [[group]] that belong to a law, as the law's header declares them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "scene/scene_resolve.hpp"

namespace sph {
namespace {

bool has(const LawWord& law, std::string_view key) {
  return std::ranges::any_of(law.keys, [&](const LawKey& k) { return k.name == key; });
}

std::string names_of(std::span<const LawKey> keys) {
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k)
    text += fmt::format("{}{}", k == 0 ? "" : k + 1 < keys.size() ? ", " : " and ", keys[k].name);
  return text.empty() ? "none" : text;
}

void refuse_keys_of_others(const TableReader& table, std::string_view choice, const LawWord& law,
                           const std::vector<LawWord>& all) {
  for (const LawWord& other : all)
    for (const LawKey& key : other.keys) {
      if (has(law, key.name) || !table.has(key.name)) continue;
      std::vector<std::string> owners;
      for (const LawWord& owner : all)
        if (has(owner, key.name)) owners.emplace_back(owner.word);
      table.only_if(false, key.name,
                    fmt::format("it is of {} = {}; \"{}\" takes {}", choice, either(owners), law.word,
                                names_of(law.keys)));
    }
}

}  // namespace

std::string either(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += fmt::format("{}\"{}\"", k == 0 ? "" : k + 1 < words.size() ? ", " : " or ", words[k]);
  return text;
}

LawConstants read_law_constants(const TableReader& table, std::string_view choice, const LawWord& law,
                                const std::vector<LawWord>& all) {
  refuse_keys_of_others(table, choice, law, all);
  LawConstants values{};
  for (std::size_t k = 0; k < law.keys.size(); ++k) {
    const LawKey& key = law.keys[k];
    const Bound bound = key.above == 0 ? Bound::positive : Bound::any;
    std::optional<double> value = table.number(key.name, key.dimension, bound);
    if (!value && key.otherwise == nullptr) value = table.required_number(key.name, key.dimension, bound);
    values[k] = value ? *value : key.otherwise(values);
    if (values[k] > key.above && values[k] <= key.most) continue;
    if (!value) table.fail(law.keys[0].name, "is below the range of numbers", "check its unit");
    table.fail(key.name, fmt::format("is {}", values[k]),
               std::isinf(key.most) ? fmt::format("it must be above {}", key.above)
                                    : fmt::format("it must be above {} and at most {}", key.above, key.most));
  }
  return values;
}

}  // namespace sph
