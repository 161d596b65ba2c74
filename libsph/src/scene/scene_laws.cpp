// Keys that belong to a law or to a term, as their headers declare them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "scene/scene_resolve.hpp"
#include "sph/added_term.hpp"

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

void read_added_terms(const TableReader& table, Scene& scene) {
  const bool has_them = scene.formulation == Formulation::conservative && !scene.total_lagrangian() &&
                        !scene.has_eos(EosKind::ideal_gas);
  for (const AddedTerm* t : added_terms()) {
    table.only_if(has_them, t->word, "it is of liquids and updated-Lagrangian solids");
    const double strength = table.number(t->word, dimension::none, Bound::not_negative).value_or(0);
    if (strength > t->most)
      table.fail(t->word, fmt::format("is {}", strength), fmt::format("it must be 0 to {}", t->most));
    scene.terms.added.push_back(strength);
  }
  if (std::ranges::all_of(scene.terms.added, [](double x) { return x == 0; })) scene.terms.added.clear();
}

}  // namespace sph
