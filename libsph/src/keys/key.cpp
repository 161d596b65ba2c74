#include "keys/key.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace sph::keys {
namespace {

template <class... Of>
struct Overloaded : Of... {
  using Of::operator()...;
};
template <class... Of>
Overloaded(Of...) -> Overloaded<Of...>;

std::string list(const Words& words) {
  std::string out;
  const std::span<const Word> all = words.all();
  for (std::size_t k = 0; k < all.size(); ++k)
    out += fmt::format("{}\"{}\"", k == 0 ? "" : k + 1 == all.size() ? " or " : ", ", all[k].text);
  return out;
}

}  // namespace

std::string text_of(const Range& r) {
  const bool from = std::isfinite(r.least), to = std::isfinite(r.most);
  if (from && to) {
    if (r.above_least && r.below_most)
      return fmt::format("between {} and {}, both excluded", r.least, r.most);
    if (r.above_least) return fmt::format("above {} and at most {}", r.least, r.most);
    if (r.below_most) return fmt::format("at least {} and below {}", r.least, r.most);
    return fmt::format("{} to {}", r.least, r.most);
  }
  if (!from) return {};
  if (r.least == 0) return r.above_least ? "positive" : "not negative";
  return fmt::format("{} {}", r.above_least ? "above" : "at least", r.least);
}

std::string wanted(const Range& r, double x) {
  // On the wrong side of 0 the sign is what matters.
  if (r.least == 0 && !(x > 0)) return r.above_least ? "it must be positive" : "it must not be negative";
  return fmt::format("{} {}", r.is, text_of(r));
}

std::string header(const KeyTable& table) {
  return fmt::format("{}[{}]{}", table.array ? "[" : "", table.name, table.array ? "]" : "");
}

std::string text_of(const Kind& kind) {
  return std::visit(
      Overloaded{[](const Number& n) { return describe(n.dim); },
                 [](const Vector& v) { return fmt::format("an array of numbers in {}", si_unit(v.dim)); },
                 [](const Whole&) { return std::string("a whole number"); },
                 [](const Flag&) { return std::string("true or false"); },
                 [](const Flags&) { return std::string("an array of true or false"); },
                 [](const Text&) { return std::string("a text in quotes"); },
                 [](const File&) { return std::string("the path of a file"); },
                 [](const Words& w) { return list(w); },
                 [](const NameOf& n) { return fmt::format("the name of a {}", n.what); },
                 [](const TwoGroups& t) { return std::string(t.is); },
                 [](const Copies&) { return std::string("the copies along each axis, like [4, 4, 1]"); },
                 [](const Inner& t) { return std::string(t.table->array ? "tables" : "a table"); },
                 [](const Special& s) { return fmt::format("{}, like {}", s.is, s.example); }},
      kind);
}

std::string standard_of(const Key& key) {
  if (key.member.in == nullptr) return {};
  const auto list = [](const auto& x) { return fmt::format("[{}]", fmt::join(x, ", ")); };
  return std::visit(Overloaded{[&](const Enumerator& e) {
                                 const std::string_view word = std::get<Words>(key.kind).text_of(e.get(e.at));
                                 return word.empty() ? std::string() : fmt::format("\"{}\"", word);
                               },
                               [](const std::string*) { return std::string(); },
                               [&](const std::array<bool, 3>* x) { return list(*x); },
                               [](const std::array<std::int64_t, 3>*) { return std::string(); },
                               [](const std::array<int, 2>*) { return std::string(); },
                               [](const Named&) { return std::string(); },
                               [](const Double3* x) { return fmt::format("{}", (*x)[0]); },
                               [&](const double* x) {
                                 return std::get<Number>(key.kind).range.holds(*x) ? fmt::format("{}", *x)
                                                                                   : std::string();
                               },
                               []<class T>(const std::optional<T>*) { return std::string(); },
                               []<class T>(const T* x) { return fmt::format("{}", *x); }},
                    key.member.standard());
}

std::string default_of(const Key& key) {
  if (key.required) return "required";
  if (!key.otherwise.empty()) return std::string(key.otherwise);
  const std::string standard = standard_of(key);
  return standard.empty() ? "none" : standard;
}

std::string place_of(const Key& key) {
  std::string out(key.scenes.of);
  for (const Where& w : key.where) {
    if (w.key.empty()) continue;
    out += fmt::format("{}{} {} \"{}\"", out.empty() ? "" : ", ", w.key, w.but.empty() ? "=" : "!=", w.word);
    for (std::string_view other : {w.or_word, w.or_third})
      if (!other.empty()) out += fmt::format(", \"{}\"", other);
  }
  return out;
}

std::string refusal(const KeyTable& table, const Where& where) {
  if (!where.but.empty()) return std::string(where.but);
  const bool many = !table.plural.empty();
  std::string other;
  if (!where.or_word.empty())
    other = fmt::format("{} \"{}\"", where.or_third.empty() ? " or" : ",", where.or_word);
  if (!where.or_third.empty()) other += fmt::format(" or \"{}\"", where.or_third);
  return fmt::format("only {}{} = \"{}\"{} {} it{}", many ? fmt::format("{} with ", table.plural) : "",
                     where.key, where.word, other, many ? "have" : "has", where.more);
}

}  // namespace sph::keys
