// Keys that belong to a law or to a term, as their headers declare them.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "keys/law_keys.hpp"
#include "keys/scene_resolve.hpp"
#include "sph/terms/added_term.hpp"

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

void refuse_keys_of_others(const GroupReader& group, std::string_view choice, const LawWord& law,
                           const std::vector<LawWord>& all) {
  const TableReader& table = group;
  for (const LawWord& other : all)
    for (const LawKey& key : other.keys) {
      const Key& given = *keys::find_key(keys::group, key.name);
      if (has(law, key.name) || !table.has(given)) continue;
      std::vector<std::string> owners;
      for (const LawWord& owner : all)
        if (has(owner, key.name)) owners.emplace_back(owner.word);
      table.only_if(false, given,
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

LawConstants read_law_constants(const GroupReader& group, std::string_view choice, const LawWord& law,
                                const std::vector<LawWord>& all) {
  refuse_keys_of_others(group, choice, law, all);
  const TableReader& table = group;
  LawConstants values{};
  for (std::size_t k = 0; k < law.keys.size(); ++k) {
    const LawKey& key = law.keys[k];
    const Key& given = *keys::find_key(keys::group, key.name);
    if (key.otherwise == nullptr) table.require(given);
    const std::optional<double> value = table.get<&KeyValue::number>(given);
    values[k] = value ? *value : key.otherwise(values);
    if (values[k] > key.above && values[k] <= key.most) continue;
    if (!value)
      table.fail(*keys::find_key(keys::group, law.keys[0].name), "is below the range of numbers",
                 "check its unit");
    const keys::Range range{.least = key.above, .most = key.most, .above_least = true};
    table.fail(given, fmt::format("is {}", values[k]), keys::wanted(range, values[k]));
  }
  return values;
}

void read_added_terms(const TermsReader& reader, Terms& terms) {
  const TableReader& table = reader;
  for (const AddedTerm* t : added_terms())
    terms.added.push_back(table.get<&KeyValue::number>(*keys::find_key(keys::terms, t->word)).value_or(0));
  if (std::ranges::all_of(terms.added, [](double x) { return x == 0; })) terms.added.clear();
}

}  // namespace sph
