#include "keys/key_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/nearest.hpp"

namespace sph {

using toml_tree::Node;

namespace {

int index_of(const KeyValue& value, const Scene& scene, const std::string& name, std::string_view what) {
  std::vector<std::string> names;
  if (what == "group")
    for (const Group& group : scene.groups) names.push_back(group.name);
  else
    names = scene.grains.names();
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    value.fail(fmt::format("names the unknown {} \"{}\"", what, name),
               names.empty() ? fmt::format("describe it in a [[{}]] table", what) : suggestion(name, names));
  return static_cast<int>(at - names.begin());
}

void require_grains(const KeyValue& value, const Scene& scene, int group) {
  if (const Group& g = scene.groups[static_cast<std::size_t>(group)]; g.kind != GroupKind::grain)
    value.fail(fmt::format("names \"{}\", which is not of grains", g.name),
               "name a group with kind = \"grain\"");
}

const toml_tree::Array& array_of(const KeyValue& value, std::size_t size, std::string_view wanted) {
  const toml_tree::Array& found = value.array(wanted);
  if (found.size() != size) value.fail(fmt::format("has {} values", found.size()), wanted);
  return found;
}

template <class T>
const T& item(const KeyValue& value, const Node& inner, std::string_view wanted) {
  const T* found = std::get_if<T>(&inner.value);
  if (found == nullptr) value.fail(fmt::format("holds {}", type_name(inner)), wanted);
  return *found;
}

}  // namespace

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? std::string(text) : fmt::format("{}...", text.substr(0, longest));
}

void KeyValue::fail(std::string_view what, std::string_view right) const {
  toml_tree::fail(node_->where, path_, what, right);
}

void KeyValue::fail_word(const std::string& word, const std::vector<std::string>& words) const {
  fail(fmt::format("is \"{}\"", shown(word)), suggestion(word, words));
}

template <class T>
const T& KeyValue::as(std::string_view wanted) const {
  const T* found = std::get_if<T>(&node_->value);
  if (found == nullptr) fail(fmt::format("is {}", type_name(*node_)), wanted);
  return *found;
}

const toml_tree::Array& KeyValue::array(std::string_view wanted) const {
  return as<toml_tree::Array>(wanted);
}

std::string KeyValue::text() const { return as<std::string>("it must be a text in quotes"); }

bool KeyValue::flag() const { return as<bool>("it must be true or false, without quotes"); }

std::int64_t KeyValue::whole() const {
  constexpr double exact_limit = 9007199254740992.0;  // 2^53: larger doubles do not count in ones
  const auto [least, most] = std::get<keys::Whole>(key_->kind);
  std::int64_t n = 0;
  if (const auto* i = std::get_if<std::int64_t>(&node_->value)) {
    n = *i;
  } else if (const auto* d = std::get_if<double>(&node_->value);
             d != nullptr && std::trunc(*d) == *d && std::fabs(*d) <= exact_limit) {
    n = static_cast<std::int64_t>(*d);
  } else {
    fail(fmt::format("is {}", d == nullptr ? std::string(type_name(*node_)) : fmt::format("{}", *d)),
         "it must be a whole number");
  }
  if (n < least || n > most)
    fail(fmt::format("is {}", n), most == std::numeric_limits<std::int64_t>::max()
                                      ? fmt::format("it must be at least {}", least)
                                      : fmt::format("it must be {} to {}", least, most));
  return n;
}

double KeyValue::number() const {
  const auto& [dim, range] = std::get<keys::Number>(key_->kind);
  const double x = number_in(*node_, dim);
  if (!range.holds(x)) fail(fmt::format("is {}", x), keys::wanted(range, x));
  return x;
}

double KeyValue::number_in(const Node& value, Dimension dim) const {
  const auto bad = [&](const std::string& what, const std::string& right) {
    toml_tree::fail(value.where, path_, what, right);
  };
  double x = 0;
  if (const auto* i = std::get_if<std::int64_t>(&value.value)) {
    x = static_cast<double>(*i);
  } else if (const auto* d = std::get_if<double>(&value.value)) {
    x = *d;
  } else if (const auto* words = std::get_if<std::string>(&value.value)) {
    const std::string example = dim == dimension::none ? std::string("write a number without quotes")
                                                       : fmt::format("write a number in {u} or \"5 {u}\"",
                                                                     fmt::arg("u", si_unit(dim)));
    const Quantity q = parse_quantity(*words);
    if (!q.problem.empty()) bad(fmt::format("\"{}\" {}", shown(*words), q.problem), example);
    if (!q.has_unit) bad(fmt::format("\"{}\" has no unit", shown(*words)), example);
    if (q.dim != dim)
      bad(fmt::format("\"{}\" is {}", shown(*words), describe(q.dim)),
          fmt::format("it must be {}", describe(dim)));
    x = q.value;
  } else {
    bad(fmt::format("is {}", type_name(value)), fmt::format("it must be {}", describe(dim)));
  }
  if (!std::isfinite(x)) bad(fmt::format("is {}", x), "it must be finite");
  return x;
}

Double3 KeyValue::vector(Dimension dim) const {
  const auto axes = static_cast<std::size_t>(scene_->dim);
  const toml_tree::Array& values =
      array_of(*this, axes, fmt::format("it must be an array of {} numbers (dimension = {})", axes, axes));
  Double3 out{};
  for (std::size_t a = 0; a < axes; ++a) out[a] = number_in(values[a], dim);
  return out;
}

std::array<bool, 3> KeyValue::flags() const {
  const auto axes = static_cast<std::size_t>(scene_->dim);
  const std::string wanted =
      fmt::format("it must be an array of {} true or false (dimension = {})", axes, axes);
  const toml_tree::Array& values = array_of(*this, axes, wanted);
  std::array<bool, 3> out{};
  for (std::size_t a = 0; a < axes; ++a) out[a] = item<bool>(*this, values[a], wanted);
  return out;
}

std::array<std::int64_t, 3> KeyValue::copies() const {
  constexpr std::int64_t most = 1'000'000;  // along one axis
  const auto axes = static_cast<std::size_t>(scene_->dim);
  const std::string wanted = fmt::format("it must be an array of {} whole numbers, like {}",
                                         axes == 3 ? "three" : "two", axes == 3 ? "[4, 4, 1]" : "[4, 4]");
  const toml_tree::Array& counts = array_of(*this, axes, wanted);
  std::array<std::int64_t, 3> out{1, 1, 1};
  for (std::size_t a = 0; a < axes; ++a) {
    out[a] = item<std::int64_t>(*this, counts[a], wanted);
    if (out[a] < 1 || out[a] > most)
      fail(fmt::format("is {} in {}", out[a], "xyz"[a]), fmt::format("it must be 1 to {}", most));
  }
  return out;
}

int KeyValue::choice() const {
  const std::string word = text();
  std::vector<std::string> words;
  for (const keys::Word& w : std::get<keys::Words>(key_->kind).all()) {
    if (w.text == word) return w.value;
    words.emplace_back(w.text);
  }
  fail_word(word, words);
}

int KeyValue::index() const {
  const std::string name = text();
  const auto& [what, or_none, of_grains] = std::get<keys::NameOf>(key_->kind);
  const int found = or_none && name == "none" ? -1 : index_of(*this, *scene_, name, what);
  if (of_grains) require_grains(*this, *scene_, found);
  return found;
}

std::array<int, 2> KeyValue::two_groups() const {
  const std::string wanted = "give " + keys::text_of(key_->kind);
  const toml_tree::Array& names = array_of(*this, 2, wanted);
  std::array<int, 2> out{};
  for (std::size_t k = 0; k < 2; ++k)
    out[k] = index_of(*this, *scene_, item<std::string>(*this, names[k], wanted), "group");
  if (std::get<keys::TwoGroups>(key_->kind).of_grains)
    for (const int group : out) require_grains(*this, *scene_, group);
  return out;
}

std::string KeyValue::file() const {
  const std::string words = text();
  if (words.empty()) fail("is empty", "give the path of a file");
  return std::filesystem::absolute(std::filesystem::path(node_->folder) / words).lexically_normal().string();
}

void KeyValue::put(const keys::Value& member) const {
  std::visit(
      [&]<class T>(T at) {
        if constexpr (std::is_same_v<T, keys::Enumerator>) {
          at.set(at.at, choice());
        } else if constexpr (std::is_same_v<T, keys::Named>) {
          *at.index = index();
        } else if constexpr (std::is_same_v<T, double*> || std::is_same_v<T, std::optional<double>*>) {
          *at = number();
        } else if constexpr (std::is_same_v<T, Double3*> || std::is_same_v<T, std::optional<Double3>*>) {
          *at = vector(std::get<keys::Vector>(key_->kind).dim);
        } else if constexpr (std::is_same_v<T, bool*> || std::is_same_v<T, std::optional<bool>*>) {
          *at = flag();
        } else if constexpr (std::is_same_v<T, std::array<bool, 3>*>) {
          *at = flags();
        } else if constexpr (std::is_same_v<T, std::array<int, 2>*>) {
          *at = two_groups();
        } else if constexpr (std::is_same_v<T, std::array<std::int64_t, 3>*>) {
          *at = copies();
        } else if constexpr (std::is_same_v<T, std::string*>) {
          *at = std::holds_alternative<keys::File>(key_->kind) ? file() : text();
        } else {
          *at = static_cast<std::remove_pointer_t<T>>(whole());
        }
      },
      member);
}

}  // namespace sph
